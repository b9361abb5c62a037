"""The setup sheet against a slot one can work out by hand."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

from core.finding import Finding, Severity
from core.geometry.piece import Turn
from core.output.passes import Cutter, Job, Run
from core.output.sheet import NOT_READY, READY, WIDTH, About, Sheet, as_page, as_text, sheet
from core.units import Unit
from tests.core.output.jobs import INCH, arc, floors, job, path_of, polyline

SLOT = job(polyline((0, 0), (2, 0)))
ABOUT = About("slot", "Key way", "2026-01-02")


def of(*jobs: Job, unit: Unit = Unit.IN) -> Sheet:
    return sheet(jobs, unit, ABOUT)


def pairs(one: Sheet) -> dict[str, str]:
    """What stands beside each label of the first block."""
    return dict(one.blocks[0].pairs)


def test_the_head_and_the_tools():
    one = of(SLOT)
    assert dict(one.head) == {
        "PROGRAM": "slot",
        "PART NAME": "Key way",
        "DATE": "2026-01-02",
        "UNITS": "INCH",
        "WORK OFFSET": "G54",
        "SAFE Z": "1.0000",
    }
    assert one.against == ()
    assert one.tools.table[1:] == (("1", "END MILL", "0.5000", "H1", "1"),)


def test_a_block_from_top_to_bottom():
    said = pairs(of(SLOT))
    assert said["CUTTER COMP."] == "ON"
    assert said["CONTOUR START"] == "X 0.0000  Y 0.0000"
    assert said["FIRST PLUNGE AT"] == "X 0.0000  Y 0.0000"
    assert said["CUTTER REACHES"] == "X -0.2500 to 2.2500  Y -0.2500 to 0.2500"
    assert said["Z START, Z BOTTOM"] == "0.0000  -0.2500"
    assert said["PECK DEPTH"] == "0.1000"
    assert said["SPEED"] == "300 RPM"
    assert said["PLUNGE FEED"] == "20.0"
    assert said["FEEDS"] == "10.0 (segment 1)"


def test_depths_as_they_will_be_posted():
    assert [row[3:5] for row in of(SLOT).blocks[0].table[1:]] == [
        ("1 of 3", "-0.1000"),
        ("2 of 3", "-0.2000"),
        ("3 of 3", "-0.2500"),
    ]


def test_cutting_time_is_length_over_feed():
    # three pecks along 2 in at 10 in/min are 0.6 min; down from 0.1, -0.05 and -0.15: 0.2, 0.15 and 0.1 at 20 in/min
    assert pairs(of(SLOT))["CUTTING TIME"].startswith("about 0.6 min")
    slower = replace(SLOT, floors=floors(len(SLOT.floors), feed=0.1))
    assert pairs(of(slower))["CUTTING TIME"].startswith("about 60.0 min")


def test_the_cutter_reaches_over_the_top_of_an_arc():
    half = job(path_of(arc((1, 0), (-1, 0), (0, 0), Turn.CCW)))
    assert pairs(of(half))["CUTTER REACHES"] == "X -1.2500 to 1.2500  Y -0.2500 to 1.2500"


def test_a_finish_tool_has_its_own_line_and_its_own_pass():
    path = SLOT.finish[0].path
    both = replace(SLOT, finisher=Cutter(2, 0.25 * INCH), finish_tool=2, rough=(Run(path, offset=0.01 * INCH),))
    one = of(both)
    assert [row[0] for row in one.tools.table[1:]] == ["1", "2"]
    assert one.tools.table[2][4] == "1 finish"
    rows = one.blocks[0].table[1:]
    assert [row[1] for row in rows if row[2] == "FINISH"] == ["2"] * 3
    assert {row[5] for row in rows if row[2] == "PASS"} == {"0.0100"}


def test_millimeters():
    one = of(SLOT, unit=Unit.MM)
    assert pairs(one)["Z START, Z BOTTOM"] == "0.000  -6.350"
    assert one.tools.table[1][2] == "12.700"


def gouging() -> Job:
    gouge = Finding("GOUGE", Severity.ERROR, "gouges by {value} (deep).", segment=1, value=INCH / 4)
    return replace(SLOT, findings=(gouge,), lookahead="CAL 2", comp="LEFT")


def test_a_gouge_makes_the_sheet_say_do_not_run_and_keeps_the_depths():
    one = of(gouging())
    assert one.against == ("segment 1: gouges by 0.2500 (deep).",)
    assert len(one.blocks[0].table) == 4
    assert NOT_READY in as_text(one)
    assert READY not in as_text(one)
    assert "LOOKAHEAD          CAL 2" in as_text(one)


def test_what_cannot_be_cut_has_no_passes_and_says_why():
    one = of(replace(SLOT, cutter=None))
    assert one.blocks[0].table == ()
    assert pairs(one)["TOOL"] == "NOT KNOWN"
    assert any("TOOL is not in the tool table" in text for text in one.against)


def test_no_block_is_not_ready():
    assert of().against == ("There is no block.",)
    assert NOT_READY in as_text(of())


def test_the_text_is_narrow_and_holds_nothing_a_printer_obeys():
    wild = sheet([gouging()], Unit.IN, About("a\x1b[2J\n" + "b" * 200, "\x07bell", "now"))
    lines = as_text(wild).splitlines()
    assert all(line.isprintable() for line in lines)
    assert max(map(len, lines)) <= WIDTH
    assert "?bell" in as_text(wild)


def test_the_page_is_one_document_with_the_drawings_in_it():
    drawing = '<svg xmlns="http://www.w3.org/2000/svg"><title>d</title></svg>'
    page = as_page(of(SLOT), [drawing])
    tree = ElementTree.fromstring(page.replace("<!DOCTYPE html>\n", "").replace('<meta charset="utf-8">', ""))
    assert [one.tag for one in tree.iter() if one.tag.endswith("}svg")] == ["{http://www.w3.org/2000/svg}svg"]
    assert READY in page
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "")


def test_names_cannot_leave_their_place_on_the_page():
    page = as_page(sheet([gouging()], Unit.IN, About("</title><script>x()</script>", "\x1b<b>", "")), [""])
    assert "<script" not in page
    assert "&lt;script&gt;" in page
    assert "\x1b" not in page
    assert NOT_READY in page


def test_a_finding_on_the_page_has_one_mark_that_of_its_weight():
    page = as_page(of(gouging()), [""])
    assert '<ul class="marked">\n<li>!! segment 1: gouges' in page
    assert ".marked { list-style: none" in page
