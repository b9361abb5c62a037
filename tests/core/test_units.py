"""Reading and showing numbers: program units, suffixes, decimals of the screens, sentences."""

from __future__ import annotations

from fractions import Fraction
from math import inf, isclose, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.finding import Finding, Severity
from core.units import (
    MAX_SHOWN,
    Kind,
    Unit,
    Unreadable,
    convert,
    from_mm,
    located_sentence,
    parse,
    printable,
    sentence,
    show,
    to_mm,
)

IN, MM = Unit.IN, Unit.MM


@pytest.mark.parametrize(
    ("text", "kind", "unit", "value"),
    [
        ("1 1/2", Kind.LENGTH, IN, 1.5),
        ("25.4/2", Kind.LENGTH, IN, 12.7),
        ("12.7mm", Kind.LENGTH, IN, 0.5),
        (".5in", Kind.LENGTH, MM, 12.7),
        ('.5"', Kind.LENGTH, MM, 12.7),
        (".5", Kind.LENGTH, MM, 0.5),
        ("1in+3mm", Kind.LENGTH, MM, 28.4),
        ("0.1", Kind.LENGTH, IN, 0.1),
        ("-0", Kind.LENGTH, IN, 0.0),
        ("508mm", Kind.FEED, IN, 20.0),
        ("22.5", Kind.ANGLE, IN, 22.5),
        ("22.5\N{DEGREE SIGN}", Kind.ANGLE, MM, 22.5),
        ("180/7deg", Kind.ANGLE, MM, 180 / 7),
        ("300", Kind.COUNT, IN, 300.0),
        ("2*150", Kind.COUNT, IN, 300.0),
        ("50%", Kind.PERCENT, IN, 50.0),
    ],
)
def test_parse_reads_numbers_and_sums(text, kind, unit, value):
    assert parse(text, kind, unit) == value


@settings(derandomize=True, max_examples=150)
@given(
    st.from_regex(r"-?([0-9]{1,7}(\.[0-9]{0,14})?|\.[0-9]{1,14})", fullmatch=True),
    st.sampled_from((Kind.LENGTH, Kind.FEED, Kind.ANGLE, Kind.PERCENT)),
    st.sampled_from(Unit),
)
def test_a_plain_number_reads_the_same_in_parentheses(text: str, kind: Kind, unit: Unit) -> None:
    plain, exact = parse(text, kind, unit), parse(f"({text})", kind, unit)
    assert plain == exact
    assert str(plain) == str(exact), "no zero is negative"


@pytest.mark.parametrize(
    ("text", "kind", "reason"),
    [
        ("x", Kind.COUNT, "x is not a number: type a whole number."),
        ("2.5", Kind.COUNT, "Type a whole number, such as 2."),
        ("2400.7", Kind.COUNT, "Type a whole number, such as 2401."),
        ("-3.5", Kind.COUNT, "Type a whole number, such as 1."),
        ("10mm", Kind.COUNT, "mm is not a unit here: type a whole number."),
        ("45mm", Kind.ANGLE, "mm is not a unit here: type degrees such as 22.5."),
        ("45deg", Kind.LENGTH, "deg is not a unit here: type a number such as 2.5, 1 1/2, 2.5-.125 or 12.7mm."),
        ("99999999", Kind.LENGTH, "Too large for any machine."),
        ("9" * 60, Kind.COUNT, "Too large for any machine."),
        ("RIGHT", Kind.CHOICE, "This field does not take a number."),
    ],
)
def test_parse_gives_the_reason_for_unreadable_text(text, kind, reason):
    assert parse(text, kind, IN) == Unreadable(reason)


def test_the_largest_number_depends_on_the_unit():
    assert parse("300000", Kind.LENGTH, IN) == 300000.0
    assert isinstance(parse("400000", Kind.LENGTH, IN), Unreadable)
    assert parse("400000", Kind.LENGTH, MM) == 400000.0


@settings(derandomize=True, max_examples=150)
@given(st.text(max_size=30), st.sampled_from(Kind), st.sampled_from(Unit))
def test_parse_never_raises(text, kind, unit):
    assert isinstance(parse(text, kind, unit), float | Unreadable)


@pytest.mark.parametrize(
    ("value", "kind", "unit", "text"),
    [
        (-1.0, Kind.LENGTH, IN, "-1.0000"),
        (-0.25, Kind.LENGTH, MM, "-0.250"),
        (20.0, Kind.FEED, IN, "20.0"),
        (0.25, Kind.FEED, IN, "0.25"),
        (19.68503937, Kind.FEED, IN, "19.685"),
        (0.1 + 0.2, Kind.FEED, MM, "0.3"),
        (300.0, Kind.COUNT, IN, "300"),
        (45.0, Kind.ANGLE, MM, "45.000"),
        (50.0, Kind.PERCENT, IN, "50.0"),
        (33.33, Kind.PERCENT, IN, "33.33"),
        (-0.0, Kind.LENGTH, IN, "0.0000"),
        (-0.00001, Kind.LENGTH, IN, "0.0000"),
        (-0.4, Kind.COUNT, IN, "0"),
        (-0.00005001, Kind.LENGTH, IN, "-0.0001"),
        (99999.9999, Kind.LENGTH, IN, "99999.9999"),
        (-100000.0, Kind.LENGTH, IN, "-100000.00"),
        (-1e300, Kind.LENGTH, IN, "-1e+300"),
        (inf, Kind.LENGTH, IN, "inf"),
        (nan, Kind.LENGTH, IN, "nan"),
    ],
)
def test_show_formats_each_kind(value, kind, unit, text):
    assert show(value, kind, unit) == text


@settings(derandomize=True, max_examples=150)
@given(st.floats(allow_nan=False), st.sampled_from(Kind), st.sampled_from(Unit))
def test_shown_numbers_fit_and_have_no_negative_zero(value, kind, unit):
    text = show(value, kind, unit)
    assert len(text) <= MAX_SHOWN
    assert text.strip("-0.") or not text.startswith("-")


@settings(derandomize=True, max_examples=200)
@given(st.integers(-(10**9), 10**9), st.sampled_from(Unit))
def test_shown_numbers_read_back(ten_thousandths, unit):
    value = ten_thousandths / (10_000 if unit is IN else 1_000)
    if abs(value) < 10_000:
        assert parse(show(value, Kind.LENGTH, unit), Kind.LENGTH, unit) == value


def test_lengths_are_converted_to_and_from_millimeters():
    assert to_mm(2.0, IN) == 50.8
    assert to_mm(2.0, MM) == 2.0
    assert from_mm(50.8, IN) == 2.0
    assert from_mm(2.0, MM) == 2.0


def test_converted_values_have_no_rounding_noise():
    assert convert(0.5, IN, MM) == 12.7
    assert convert(12.7, MM, IN) == 0.5
    assert convert(0.1, IN, MM) == 2.54
    assert convert(20.0, IN, MM) == 508.0
    assert convert(3.0, MM, IN) == 0.1181102362
    assert convert(3.0, MM, MM) == 3.0
    assert convert(0.0, IN, MM) == 0.0


@settings(derandomize=True, max_examples=150)
@given(st.integers(-(10**8), 10**8), st.sampled_from(Unit))
def test_converting_there_and_back_restores_the_value(digits, unit):
    value, other = digits / 10_000, MM if unit is IN else IN
    assert convert(convert(value, unit, other), other, unit) == value


@pytest.mark.parametrize("text", ["1/3", "5/7", "1/512", "25.4/3", "9999.87654321", ".0000001234567"])
@pytest.mark.parametrize("unit", Unit)
def test_typed_values_survive_converting_there_and_back(text, unit):
    value, other = parse(text, Kind.LENGTH, unit), MM if unit is IN else IN
    assert isinstance(value, float)
    converted = convert(value, unit, other)
    assert convert(converted, other, unit) == value
    assert abs(to_mm(converted, other) - to_mm(value, unit)) < 1e-8


@settings(derandomize=True, max_examples=200)
@given(st.integers(-(10**14), 10**14), st.integers(1, 14), st.sampled_from(Unit))
def test_decimals_of_fourteen_digits_survive_converting_there_and_back(digits, places, unit):
    value, other = float(Fraction(digits, 10**places) % 10_000), MM if unit is IN else IN
    assert convert(convert(value, unit, other), other, unit) == value


@settings(derandomize=True, max_examples=150)
@given(st.floats(-10_000.0, 10_000.0), st.sampled_from(Unit))
def test_any_number_converted_there_and_back_is_nearly_the_same(value, unit):
    other = MM if unit is IN else IN
    converted = convert(value, unit, other)
    assert abs(to_mm(converted, other) - to_mm(value, unit)) <= 5e-9
    assert isclose(convert(converted, other, unit), value, rel_tol=1e-14, abs_tol=1e-300)


def finding(text: str, **places: object) -> Finding:
    return Finding("X", Severity.ERROR, text, **places)  # type: ignore[arg-type]  # places are the test's own


def test_a_sentence_shows_lengths_in_program_units():
    deep = finding("Deep {value} at X {x} Y {y}, {0} of {1}.", at=(25.4, -0.00001), value=6.35, lengths=(2.54, 50.8))
    assert sentence(deep, IN) == "Deep 0.2500 at X 1.0000 Y 0.0000, 0.1000 of 2.0000."
    assert sentence(deep, MM) == "Deep 6.350 at X 25.400 Y 0.000, 2.540 of 50.800."


@pytest.mark.parametrize(
    ("lengths", "words"),
    [
        ((19.05, 31.75), "0.7500 and 1.2500"),
        ((25.40127, 25.404826), "1.00005 and 1.00019"),
        ((25.4, 25.4025401), "1.0000 and 1.0001"),
        ((3810000.0, 3810000.00254), "150000.0000 and 150000.0001"),
        ((25.4, 25.4), "1.0000 and 1.0000"),
        ((25.4, 25.4000002), "1.000000000 and 1.000000008"),
        ((25.4, 25.400000000000002), "1.0000 and 1.0000"),
        ((inf, 1.0), "inf and 0.0394"),
    ],
)
def test_two_nearly_equal_lengths_get_enough_digits(lengths, words):
    assert sentence(finding("{0~1} and {1~0}", lengths=lengths), IN) == words


@pytest.mark.parametrize(
    ("length", "unit", "words"),
    [
        (4.14278, MM, "4.142 to 4.143"),
        (4.0, MM, "4.000 to 4.000"),
        (3.9999999999, MM, "4.000 to 4.000"),
        (10000.1 - 10000.0, MM, "0.100 to 0.100"),
        (-4.14278, MM, "-4.143 to -4.142"),
        (1.0, IN, "0.0393 to 0.0394"),
        (25.4 * 0.7, IN, "0.7000 to 0.7000"),
        (0.0004278, MM, "0.0004 to 0.001"),
        (0.0, MM, "0.000 to 0.000"),
        (inf, MM, "inf to inf"),
    ],
)
def test_a_limit_is_rounded_so_that_the_number_typed_is_within_it(length, unit, words):
    assert sentence(finding("{0-} to {0+}", lengths=(length,)), unit) == words


def test_a_sentence_keeps_unknown_braces():
    assert sentence(finding("{odd} {0} {x} {} {value!r}"), IN) == "{odd} {0} {x} {} {value!r}"


def test_printable_text_has_no_control_characters():
    assert printable(" \x1b[31m red\n") == "?[31m red"
    assert printable("x" * 100) == "x" * 24 + "..."


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("1,5", Unit.IN, 1.5),
        (",5", Unit.IN, 0.5),
        ("2,25", Unit.MM, 2.25),
        ("1,500", Unit.MM, 1.5),
        ("0,3125", Unit.IN, 0.3125),
        ("2-1,5", Unit.IN, 0.5),
        ("12,7mm", Unit.IN, 0.5),
    ],
)
def test_a_single_comma_is_a_decimal_point(text, unit, value):
    assert parse(text, Kind.LENGTH, unit) == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "unit", "reason"),
    [
        ("1,500", Unit.IN, "Type 1.500 or 1500."),
        (",250", Unit.IN, "Type .250 or 250."),
        ("1,500mm", Unit.IN, "Type 1.500 or 1500."),
        ("1,5.2", Unit.IN, "Use one decimal point (1.5) and no thousands comma."),
        ("1,000,000", Unit.MM, "Use one decimal point (1.5) and no thousands comma."),
    ],
)
def test_a_comma_that_may_be_a_thousands_comma_is_refused(text, unit, reason):
    assert parse(text, Kind.LENGTH, unit) == Unreadable(reason)


@pytest.mark.parametrize(
    ("block", "segment", "where"),
    [
        (None, None, ""),
        (2, None, "Block 2: "),
        (None, 3, "Segment 3: "),
        (2, 0, "Block 2, START: "),
        (2, 3, "Block 2, segment 3: "),
    ],
)
def test_a_sentence_begins_with_the_place_that_is_known(block, segment, where):
    finding = Finding("CODE", Severity.ERROR, "Off by {0}.", segment, block=block, lengths=(25.4,))
    assert located_sentence(finding, IN) == f"{where}Off by 1.0000."
