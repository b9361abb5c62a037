"""A finding that is put into words late is the finding that it tells."""

import copy
import pickle
from collections.abc import Callable
from dataclasses import replace

import pytest

from core.finding import Finding, Severity, Unworded

WHOLE = Finding("UNCUT", Severity.INFO, "{value} of it, {0}.", 3.0, None, (1.0, 2.0), 0.5, (0.25,), area=0.1)


def late(tell: Callable[[], Finding] = lambda: WHOLE) -> Finding:
    (one,) = Unworded.each("UNCUT", Severity.INFO, [3.0], lambda _row: tell())
    return one


def untold() -> Finding:
    raise AssertionError("read")


def test_it_tells_all_that_the_finding_does() -> None:
    one = late()
    assert [getattr(one, name) for name in Finding.__match_args__] == [
        getattr(WHOLE, name) for name in Finding.__match_args__
    ]
    assert repr(one) == repr(WHOLE).replace("Finding", "Unworded", 1)


def test_it_is_told_once_and_not_before_it_is_read() -> None:
    calls = []

    def tell() -> Finding:
        calls.append(1)
        return WHOLE

    one = late(tell)
    assert (one.code, one.severity, one.segment, one.field) == ("UNCUT", Severity.INFO, 3.0, None)
    assert not calls
    assert one.text == WHOLE.text
    assert one.lengths == WHOLE.lengths
    assert one.line is None
    assert calls == [1]


def test_each_tells_its_own_row() -> None:
    told = [replace(WHOLE, segment=number, text=str(number)) for number in (3.0, 5.0)]
    assert list(Unworded.each("UNCUT", Severity.INFO, [3.0, 5.0], lambda row: told[row])) == told


def test_it_equals_the_finding_from_both_sides() -> None:
    other = replace(WHOLE, text="another")
    for left, right in ((late(), WHOLE), (WHOLE, late()), (late(), late())):
        assert left == right
        assert hash(left) == hash(right)
    for left, right in ((late(), other), (other, late()), (late(), late(lambda: other))):
        assert left != right
    assert late() != object()


def test_an_error_in_the_wording_is_no_missing_attribute() -> None:
    one = late(lambda: replace(WHOLE, text=WHOLE.txt))  # type: ignore[attr-defined]
    for asked in (
        lambda: hasattr(one, "text"),
        lambda: getattr(one, "at", None),
        lambda: repr(one),
        lambda: one == WHOLE,
    ):
        with pytest.raises(RuntimeError, match=r"UNCUT of segment 3\.0") as raised:
            asked()
        assert isinstance(raised.value.__cause__, AttributeError)


def test_one_of_another_code_differs_unread() -> None:
    other = Finding("OPEN", Severity.INFO, "text")
    assert late(untold) not in [other]
    assert other not in [late(untold)]


def test_it_is_copied_and_goes_to_another_process_and_back() -> None:
    for one in (late(), pickle.loads(pickle.dumps(late())), copy.copy(late()), replace(late(), segment=3.0)):
        assert one == WHOLE
        assert not hasattr(one, "nothing")
    assert replace(late(), segment=None) == replace(WHOLE, segment=None)


def test_it_is_frozen() -> None:
    with pytest.raises(AttributeError):
        late().text = "other"  # type: ignore[misc]
