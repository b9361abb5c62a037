import copy
import dataclasses
import pickle
import sys
from dataclasses import FrozenInstanceError, fields, replace
from typing import Any, ClassVar

import pytest

from core import records
from core.finding import Finding, Severity

LONG = ("number", "text", "rest", "more", "note")


def made(decorator: Any) -> tuple[Any, ...]:
    @decorator(frozen=True, slots=True)
    class Part:
        """A part."""

        kind: ClassVar[str] = "part"
        number: float
        text: str = "none"
        rest: tuple[int, ...] = ()
        more: list[int] = dataclasses.field(default_factory=list)
        note: str = dataclasses.field(default="", compare=False)

        def doubled(self: Any) -> Any:
            return replace(self, number=2 * self.number)

    @decorator(frozen=True, eq=False, slots=True)
    class Larger(Part):
        """One field more."""

        last: int = 7

    @decorator(slots=True)
    class Loose:
        """Not frozen."""

        value: int = 0

    @decorator(frozen=True, slots=True)
    class Empty:
        """No fields."""

    @decorator(frozen=True, slots=True)
    class One:
        """One field."""

        value: float

    return Part, Larger, Loose, Empty, One


def standard(*, frozen=False, eq=True, slots=True):
    return dataclasses.dataclass(frozen=frozen, eq=eq, slots=slots)


def compiled(**options):
    """Ours as they are behind the first instances."""

    def decorated(bare):
        cls = records.slotted(**options)(bare)
        type.__setattr__(cls, "__init__", records._compiled(cls))
        return cls

    return decorated


OURS, THEIRS, MANY = made(records.slotted), made(standard), made(compiled)


@pytest.mark.parametrize("classes", [OURS, MANY, THEIRS], ids=["ours", "many of ours", "the standard library's"])
class TestAsTheStandardLibrary:
    def test_values_by_place_by_name_and_by_default(self, classes):
        part, larger, *_ = classes
        one = part(1.5, rest=(1,))
        assert [getattr(one, name) for name in LONG] == [1.5, "none", (1,), [], ""]
        assert part(1.0).more is not part(1.0).more
        assert larger(1.0, last=8).last == 8
        assert larger(1.0).last == 7
        with pytest.raises(TypeError, match="number"):
            part()
        with pytest.raises(TypeError, match="wrong"):
            part(1.0, wrong=2)
        with pytest.raises(TypeError, match="number"):
            part(1.0, number=2.0)
        with pytest.raises(TypeError, match="positional"):
            part(1.0, "text", (), [], "", 6)

    def test_frozen(self, classes):
        part, _, loose, *_ = classes
        one = part(1.0)
        with pytest.raises(FrozenInstanceError):
            one.number = 2.0
        with pytest.raises(FrozenInstanceError):
            del one.number
        free = loose(1)
        free.value = 2
        assert free == loose(2)
        with pytest.raises(AttributeError):
            free.other = 3

    def test_equality_and_hash(self, classes):
        part, _, loose, empty, one = classes
        assert part(1.0, more=[1]) == part(1.0, more=[1])
        assert part(1.0) != part(1.0, "other")
        assert part(1.0, note="one") == part(1.0, note="other")
        assert one(1.0) != part(1.0)
        assert one(1.0) == one(1.0)
        assert hash(one(1.0)) == hash(one(1.0))
        not_a_number = one(float("nan"))
        # the standard library's are equal to what holds the same nan up to Python 3.12, ours always
        assert not_a_number == one(not_a_number.value) or (classes is THEIRS and sys.version_info >= (3, 13))
        assert empty() == empty()
        assert hash(empty()) == hash(empty())
        with pytest.raises(TypeError, match="unhashable"):
            hash(loose(1))
        with pytest.raises(TypeError, match="unhashable"):
            hash(part(1.0))

    def test_tools_of_the_standard_library(self, classes):
        part, larger, *_ = classes
        assert part(1.0).doubled() == part(2.0)
        assert [one.name for one in fields(larger)] == [*LONG, "last"]
        assert dataclasses.asdict(part(1.0)) == {"number": 1.0, "text": "none", "rest": (), "more": [], "note": ""}
        assert repr(part(1.0)).endswith("Part(number=1.0, text='none', rest=(), more=[], note='')")
        assert part.kind == "part"
        match part(3.0, "three"):
            case part(number, text):
                assert (number, text) == (3.0, "three")


def test_without_equality_of_its_own_a_class_keeps_the_one_it_inherits():
    for _, larger, *_ in (OURS, MANY, THEIRS):
        assert larger(1.0, last=1) == larger(1.0, last=2)


def test_nothing_is_compiled_for_the_first_instances():
    part = made(records.slotted)[0]
    before, first = part.__init__, [part(float(number), rest=(1,)) for number in range(records.FEW)]
    assert part.__init__ is before
    more = [part(float(number), rest=(1,)) for number in range(records.FEW)]
    assert part.__init__ is not before
    assert more == first


def test_a_call_that_cannot_be_leaves_the_next_one_as_it_is():
    part = made(records.slotted)[0]
    with pytest.raises(TypeError, match="wrong"):
        part(1.0, wrong=2)
    assert part(1.0) == part(1.0)


def test_own_methods_stay():
    @records.dataclass(frozen=True, slots=True)
    class Own:
        """Knows what it looks like."""

        value: int

        def __repr__(self):
            return "own"

        def __eq__(self, other: object) -> bool:
            return True

    assert repr(Own(1)) == "own"
    assert Own(1) == Own(2)


def test_a_frozen_one_goes_to_another_process_and_back():
    finding = Finding("A", Severity.ERROR, "text", lengths=(1.0,))
    assert pickle.loads(pickle.dumps(finding)) == finding
    assert copy.copy(finding) == copy.deepcopy(finding) == finding


def test_what_is_not_done_is_refused():
    with pytest.raises(TypeError, match="Late needs"):

        @records.slotted(slots=True)
        class Late:
            """Does something afterwards."""

            value: int

            def __post_init__(self) -> None: ...


@pytest.mark.parametrize("options", [{"kw_only": True}, {"init": False}, {"repr": False}, {"hash": False}])
def test_options_of_fields_are_refused(options):
    with pytest.raises(TypeError, match="Optioned needs"):

        @records.slotted(slots=True)
        class Optioned:
            value: int = dataclasses.field(default=0, **options)


@pytest.mark.parametrize("decorator", [records.slotted, standard])
def test_an_equality_of_its_own_keeps_the_hash_of_the_fields(decorator):
    @decorator(frozen=True, slots=True)
    class Own:
        value: int

        def __eq__(self, other):
            return isinstance(other, Own) and self.value == other.value

    own: Any = Own
    assert hash(own(3)) == hash(own(3))
