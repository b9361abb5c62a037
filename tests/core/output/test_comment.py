import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.output.nc import comments


def test_plain_text_stays():
    assert list(comments("TOOL 1 END MILL")) == ["(TOOL 1 END MILL)"]


def test_blank_text_says_nothing():
    assert list(comments("  \n ")) == []


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a) G0 Z-1 (b", "(a] G0 Z-1 [b)"),
        ("one\nG0 Z-9", "(one G0 Z-9)"),
        ("50%", "(50 PERCENT)"),
        ("Ø 12 mm", "(DIA 12 mm)"),
        ("⌀12 ø6,5", "(DIA 12 DIA 6,5)"),
        ("1½ END MILL 10² ⅜ Ø¾ 5 μm", "(1 1/2 END MILL 10 2 3/8 DIA 3/4 5 um)"),
        ("Gehäuse Öse für Straße", "(Gehaeuse Oese fuer Strasse)"),
        ("GEHÄUSE ÜBERMAß STRAẞE Ä", "(GEHAEUSE UEBERMASS STRASSE Ae)"),
        ("a\u0308ußere", "(aeussere)"),
        ("pièce n\u00ba 3, señor, Øst, Łódź", "(piece n DEG 3, senor, Ost, Lodz)"),
        ("30\u00b0 \u00b10.1 10\u00d745\u00b0 mm\u00b2 \u00bd", "(30 DEG +-0.1 10x45 DEG mm2 1/2)"),
        ("部品 1", "(?? 1)"),
        ("\uff08x\uff09 \uff05 \u207dy\u207e", "([x]  PERCENT [y])"),
        ("\uff2d\uff33\uff27\uff0c stop", "(* MSG, stop)"),
        ("MSG, stop", "(* MSG, stop)"),
        ("logopen,/tmp/x", "(* logopen,/tmp/x)"),
    ],
)
def test_nothing_in_a_comment_ends_it_or_is_an_order(text, expected):
    assert list(comments(text)) == [expected]


def test_long_text_goes_on_in_further_comments():
    found = list(comments("word " * 100))
    assert len(found) > 1
    assert max(map(len, found)) <= 76
    assert sum(line.count("word") for line in found) == 100


@given(st.text(max_size=600))
@settings(derandomize=True, max_examples=200)
def test_every_line_is_one_closed_ascii_comment(text):
    for line in comments(text):
        assert line.isascii()
        assert line.isprintable()
        assert len(line) < 256
        assert line.count("(") == line.count(")") == 1
        assert line.startswith("(")
        assert line.endswith(")")
