"""The setup sheet against a slot calculated by hand."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

from core.comp.compensated import CenterPath
from core.finding import Finding, Severity
from core.geometry.piece import Turn
from core.output.passes import Cutter, Job
from core.output.sheet import (
    NOT_READY_TEXT,
    PAGE_COLUMNS,
    READY_BUT_TEXT,
    READY_TEXT,
    Sheet,
    as_page,
    as_text,
    sheet,
)
from core.program.model import Coolant
from core.units import Unit
from tests.core.output.jobs import INCH, arc, floors, job, path_of, polyline

SLOT = job(polyline((0, 0), (2, 0)))
NAMES = ("slot", "Key way", "2026-01-02")


def sheet_of(*jobs: Job, unit: Unit = Unit.IN) -> Sheet:
    return sheet(jobs, unit, *NAMES)


def pairs(setup_sheet: Sheet) -> dict[str, str]:
    """The value beside each label of the first block."""
    return dict(setup_sheet.blocks[0].pairs)


def test_the_head_lists_the_program_and_the_tools():
    setup_sheet = sheet_of(SLOT)
    head = dict(setup_sheet.head)
    assert head.pop("TIME").startswith("cut 0:37, rapid ")
    assert head == {
        "PROGRAM": "slot",
        "PART NAME": "Key way",
        "DATE": "2026-01-02",
        "UNITS": "INCH",
        "WORK OFFSET": "G54",
        "SAFE Z": "1.0000",
        "RAPID RATE": "200.0 a minute, assumed, not typed",
    }
    assert setup_sheet.errors == ()
    assert setup_sheet.tools.table[1:] == (("1", "END MILL", "0.5000", "H1", "1"),)


def test_a_block_lists_its_settings():
    values = pairs(sheet_of(SLOT))
    assert values["CUTTER COMP."] == "ON"
    assert values["CONTOUR START"] == "X 0.0000  Y 0.0000"
    assert values["FIRST PLUNGE AT"] == "X 0.0000  Y 0.0000"
    assert values["CUTTER REACHES"] == "X -0.2500 to 2.2500  Y -0.2500 to 0.2500"
    assert values["Z START, Z BOTTOM"] == "0.0000  -0.2500"
    assert values["PECK DEPTH"] == "0.1000"
    assert values["SPEED"] == "300 RPM"
    assert values["PLUNGE FEED"] == "20.0"
    assert values["FEEDS"] == "10.0 (segment 1)"


def warned(block: int, *severities: Severity) -> Job:
    """A slot with findings of these severities."""
    findings = tuple(Finding(f"F{at}", severity, f"Finding {at}.") for at, severity in enumerate(severities))
    return replace(SLOT, block=block, findings=findings)


def test_ready_says_on_top_how_many_warnings_there_are_and_where():
    one = as_text(sheet_of(warned(1, Severity.WARNING, Severity.INFO)))
    assert f"{READY_BUT_TEXT}\n  ! 1 warning: see FINDINGS of block 1.\n" in one
    two, three = warned(1, Severity.WARNING, Severity.WARNING), warned(3, Severity.WARNING)
    setup_sheet = sheet_of(two, warned(2, Severity.INFO), three)
    text = "3 warnings: see FINDINGS of blocks 1 (2), 3 (1)."
    assert f"{READY_BUT_TEXT}\n  ! {text}\n" in as_text(setup_sheet)
    assert f"<li>{text}</li>" in as_page(setup_sheet, [""] * 3)
    assert READY_TEXT in as_text(sheet_of(warned(1, Severity.INFO)))


def test_not_ready_counts_the_warnings_after_the_errors():
    text = as_text(sheet_of(warned(1, Severity.ERROR, Severity.WARNING)))
    assert f"{NOT_READY_TEXT}\n  !! Block 1: Finding 0.\n  ! 1 warning: see FINDINGS of block 1.\n" in text


def test_the_passes_have_the_posted_depths():
    assert [row[3:5] for row in sheet_of(SLOT).blocks[0].table[1:]] == [
        ("1 of 3", "-0.1000"),
        ("2 of 3", "-0.2000"),
        ("3 of 3", "-0.2500"),
    ]


def test_the_reach_of_the_cutter_includes_the_top_of_an_arc():
    half = job(path_of(arc((1, 0), (-1, 0), (0, 0), Turn.CCW)))
    assert pairs(sheet_of(half))["CUTTER REACHES"] == "X -1.2500 to 1.2500  Y -0.2500 to 1.2500"


def test_a_finish_tool_has_its_own_line_and_passes():
    path = SLOT.finish[0].path
    both = replace(SLOT, finisher=Cutter(2, 0.25 * INCH), finish_tool=2, rough=(CenterPath(path, offset=0.01 * INCH),))
    setup_sheet = sheet_of(both)
    assert [row[0] for row in setup_sheet.tools.table[1:]] == ["1", "2"]
    assert setup_sheet.tools.table[2][4] == "1 finish"
    rows = setup_sheet.blocks[0].table[1:]
    assert [row[1] for row in rows if row[2] == "FINISH"] == ["2"] * 3
    assert {row[5] for row in rows if row[2] == "PASS"} == {"0.0100"}


def test_the_sheet_says_which_coolant_is_on():
    assert pairs(sheet_of(replace(SLOT, coolant=Coolant.MIST)))["COOLANT"] == "MIST"


def test_a_metric_sheet_is_in_millimeters():
    setup_sheet = sheet_of(SLOT, unit=Unit.MM)
    assert pairs(setup_sheet)["Z START, Z BOTTOM"] == "0.000  -6.350"
    assert setup_sheet.tools.table[1][2] == "12.700"


def gouging() -> Job:
    gouge = Finding("GOUGE", Severity.ERROR, "gouges by {value} (deep).", segment=1, value=INCH / 4)
    return replace(SLOT, findings=(gouge,), lookahead="CAL 2", comp="LEFT")


def test_a_gouge_makes_the_sheet_say_do_not_run_and_keeps_the_depths():
    setup_sheet = sheet_of(gouging())
    assert setup_sheet.errors == ("Block 1, segment 1: gouges by 0.2500 (deep).",)
    assert len(setup_sheet.blocks[0].table) == 4
    assert NOT_READY_TEXT in as_text(setup_sheet)
    assert READY_TEXT not in as_text(setup_sheet)
    assert "LOOKAHEAD          CAL 2" in as_text(setup_sheet)


def test_a_block_that_cannot_be_cut_has_no_passes_and_a_reason():
    setup_sheet = sheet_of(replace(SLOT, cutter=None))
    assert setup_sheet.blocks[0].table == ()
    assert pairs(setup_sheet)["TOOL"] == "NOT KNOWN"
    assert any("TOOL is not in the tool table" in text for text in setup_sheet.errors)


def test_a_program_without_blocks_is_not_ready():
    assert sheet_of().errors == ("There is no block to post.",)
    assert NOT_READY_TEXT in as_text(sheet_of())


def test_the_text_fits_the_page_and_has_no_control_characters():
    wild = sheet([gouging()], Unit.IN, "a\x1b[2J\n" + "b" * 200, "\x07bell", "now")
    lines = as_text(wild).splitlines()
    assert all(line.isprintable() for line in lines)
    assert max(map(len, lines)) <= PAGE_COLUMNS
    assert "?bell" in as_text(wild)


def test_the_page_is_one_document_with_embedded_drawings():
    drawing = '<svg xmlns="http://www.w3.org/2000/svg"><title>d</title></svg>'
    page = as_page(sheet_of(SLOT), [drawing])
    tree = ElementTree.fromstring(page.replace("<!DOCTYPE html>\n", "").replace('<meta charset="utf-8">', ""))
    assert [element.tag for element in tree.iter() if element.tag.endswith("}svg")] == [
        "{http://www.w3.org/2000/svg}svg"
    ]
    assert READY_TEXT in page
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "")


def test_names_on_the_page_are_escaped():
    page = as_page(sheet([gouging()], Unit.IN, "</title><script>x()</script>", "\x1b<b>", ""), [""])
    assert "<script" not in page
    assert "&lt;script&gt;" in page
    assert "\x1b" not in page
    assert NOT_READY_TEXT in page


def test_a_finding_on_the_page_has_only_the_mark_of_its_severity():
    page = as_page(sheet_of(gouging()), [""])
    assert '<ul class="marked">\n<li>!! Segment 1: gouges' in page
    assert ".marked { list-style: none" in page


def two_blocks() -> tuple[Job, Job]:
    """A corner with a finish tool and findings, and a slot."""
    path = polyline((0, 0), (2, 0), (2, 1))
    (first,), (second,) = floors(1), floors(2, feed=8.0)[1:]
    words = "Leaves {value} of the long wall uncut, which a smaller tool would reach."
    uncut = Finding("UNCUT", Severity.INFO, words, 2.0, value=2.54)
    corner = job(
        path,
        comp="LEFT",
        lookahead="CAL 2",
        floors=(first, second),
        finisher=Cutter(7, 0.25 * INCH, "BALL"),
        finish_tool=7,
        rough=(CenterPath(path, offset=0.02 * INCH),),
        finish_z=0.01 * INCH,
        findings=(uncut, Finding("NEAR", Severity.WARNING, "Near.")),
    )
    return corner, job(polyline((3, 0), (4, 0)), block=2, peck_depth=0.0, safe_z=2 * INCH)


def test_a_whole_sheet_is_written_as_text():
    assert as_text(sheet_of(*two_blocks())).splitlines() == [
        "SETUP SHEET",
        "==============================================================================",
        "PROGRAM            slot",
        "PART NAME          Key way",
        "DATE               2026-01-02",
        "UNITS              INCH",
        "WORK OFFSET        G54",
        "SAFE Z             1.0000, 2.0000",
        "TIME               cut 2:07, rapid 0:08, total 2:15",
        "RAPID RATE         200.0 a minute, assumed, not typed",
        "",
        "READY to post. Know before you run it:",
        "  ! 1 warning: see FINDINGS of block 1.",
        "",
        "TOOLS",
        "------------------------------------------------------------------------------",
        "TOOL      TYPE  DIAMETER  LENGTH OFFSET    BLOCKS",
        "   1  END MILL    0.5000             H1      1, 2",
        "   7      BALL    0.2500             H7  1 finish",
        "",
        "BLOCK 1  MILL CONTOUR",
        "------------------------------------------------------------------------------",
        "CUTTER COMP.       LEFT",
        "LOOKAHEAD          CAL 2",
        "TOOL               1 END MILL",
        "FINISH TOOL        7 BALL",
        "CONTOUR START      X 0.0000  Y 0.0000",
        "FIRST PLUNGE AT    X 0.0000  Y 0.0000",
        "CUTTER REACHES     X -0.2500 to 2.2500  Y -0.2500 to 1.2500",
        "                   on the center path; a G41/G42 program plunges farther off",
        "Z START, Z BOTTOM  0.0000  -0.2500",
        "PECK DEPTH         0.1000",
        "SPEED              300 RPM",
        "COOLANT            OFF",
        "PLUNGE FEED        20.0",
        "FEEDS              10.0 (segment 1), 8.0 (segment 2)",
        "TIME               cut 2:00, rapid 0:05, total 2:05",
        "",
        "NO.  TOOL    KIND   DEPTH        Z  LEAVES ON SIDE",
        "  1     1    PASS  1 of 3  -0.1000          0.0200",
        "  2     1    PASS  2 of 3  -0.2000          0.0200",
        "  3     1    PASS  3 of 3  -0.2400          0.0200",
        "  4     7  FINISH  1 of 3  -0.1000          0.0000",
        "  5     7  FINISH  2 of 3  -0.2000          0.0000",
        "  6     7  FINISH  3 of 3  -0.2500          0.0000",
        "",
        "FINDINGS",
        "  - Segment 2: Leaves 0.1000 of the long wall uncut, which a smaller tool",
        "     would reach.",
        "  ! Near.",
        "",
        "BLOCK 2  MILL CONTOUR",
        "------------------------------------------------------------------------------",
        "CUTTER COMP.       ON",
        "LOOKAHEAD          none: the center runs on the contour",
        "TOOL               1 END MILL",
        "FINISH TOOL        none",
        "CONTOUR START      X 3.0000  Y 0.0000",
        "FIRST PLUNGE AT    X 3.0000  Y 0.0000",
        "CUTTER REACHES     X 2.7500 to 4.2500  Y -0.2500 to 0.2500",
        "Z START, Z BOTTOM  0.0000  -0.2500",
        "PECK DEPTH         none: full depth in one pass",
        "SPEED              300 RPM",
        "COOLANT            OFF",
        "PLUNGE FEED        20.0",
        "FEEDS              10.0 (segment 1)",
        "TIME               cut 0:07, rapid 0:01, total 0:08",
        "",
        "NO.  TOOL  KIND   DEPTH        Z  LEAVES ON SIDE",
        "  1     1  PASS  1 of 1  -0.2500          0.0000",
    ]


def test_a_whole_sheet_is_written_as_a_page():
    lines = as_page(sheet(two_blocks(), Unit.IN, "slot"), ["<svg/>", ""]).splitlines()
    assert lines[0] == "<!DOCTYPE html>"
    assert lines[lines.index("<h1>Setup sheet: slot</h1>") :][:54] == [
        "<h1>Setup sheet: slot</h1>",
        "<table>",
        "<tr><th>PROGRAM</th><td>slot</td></tr>",
        "<tr><th>PART NAME</th><td>-</td></tr>",
        "<tr><th>DATE</th><td>-</td></tr>",
        "<tr><th>UNITS</th><td>INCH</td></tr>",
        "<tr><th>WORK OFFSET</th><td>G54</td></tr>",
        "<tr><th>SAFE Z</th><td>1.0000, 2.0000</td></tr>",
        "<tr><th>TIME</th><td>cut 2:07, rapid 0:08, total 2:15</td></tr>",
        "<tr><th>RAPID RATE</th><td>200.0 a minute, assumed, not typed</td></tr>",
        "</table>",
        '<div class="good">READY to post. Know before you run it:<ul>',
        "<li>1 warning: see FINDINGS of block 1.</li>",
        "</ul></div>",
        "<section><h2>TOOLS</h2>",
        "</section>",
        '<table class="tools">',
        "<tr><th>TOOL</th><th>TYPE</th><th>DIAMETER</th><th>LENGTH OFFSET</th><th>BLOCKS</th></tr>",
        "<tr><td>1</td><td>END MILL</td><td>0.5000</td><td>H1</td><td>1, 2</td></tr>",
        "<tr><td>7</td><td>BALL</td><td>0.2500</td><td>H7</td><td>1 finish</td></tr>",
        "</table>",
        "<section><h2>BLOCK 1  MILL CONTOUR</h2>",
        "<figure><svg/></figure>",
        "<table>",
        "<tr><th>CUTTER COMP.</th><td>LEFT</td></tr>",
        "<tr><th>LOOKAHEAD</th><td>CAL 2</td></tr>",
        "<tr><th>TOOL</th><td>1 END MILL</td></tr>",
        "<tr><th>FINISH TOOL</th><td>7 BALL</td></tr>",
        "<tr><th>CONTOUR START</th><td>X 0.0000  Y 0.0000</td></tr>",
        "<tr><th>FIRST PLUNGE AT</th><td>X 0.0000  Y 0.0000</td></tr>",
        "<tr><th>CUTTER REACHES</th><td>X -0.2500 to 2.2500  Y -0.2500 to 1.2500</td></tr>",
        "<tr><th></th><td>on the center path; a G41/G42 program plunges farther off</td></tr>",
        "<tr><th>Z START, Z BOTTOM</th><td>0.0000  -0.2500</td></tr>",
        "<tr><th>PECK DEPTH</th><td>0.1000</td></tr>",
        "<tr><th>SPEED</th><td>300 RPM</td></tr>",
        "<tr><th>COOLANT</th><td>OFF</td></tr>",
        "<tr><th>PLUNGE FEED</th><td>20.0</td></tr>",
        "<tr><th>FEEDS</th><td>10.0 (segment 1), 8.0 (segment 2)</td></tr>",
        "<tr><th>TIME</th><td>cut 2:00, rapid 0:05, total 2:05</td></tr>",
        "</table>",
        '<h3>FINDINGS</h3><ul class="marked">',
        "<li>- Segment 2: Leaves 0.1000 of the long wall uncut, which a smaller tool would reach.</li>",
        "<li>! Near.</li>",
        "</ul>",
        "</section>",
        '<table class="passes">',
        "<tr><th>NO.</th><th>TOOL</th><th>KIND</th><th>DEPTH</th><th>Z</th><th>LEAVES ON SIDE</th></tr>",
        "<tr><td>1</td><td>1</td><td>PASS</td><td>1 of 3</td><td>-0.1000</td><td>0.0200</td></tr>",
        "<tr><td>2</td><td>1</td><td>PASS</td><td>2 of 3</td><td>-0.2000</td><td>0.0200</td></tr>",
        "<tr><td>3</td><td>1</td><td>PASS</td><td>3 of 3</td><td>-0.2400</td><td>0.0200</td></tr>",
        "<tr><td>4</td><td>7</td><td>FINISH</td><td>1 of 3</td><td>-0.1000</td><td>0.0000</td></tr>",
        "<tr><td>5</td><td>7</td><td>FINISH</td><td>2 of 3</td><td>-0.2000</td><td>0.0000</td></tr>",
        "<tr><td>6</td><td>7</td><td>FINISH</td><td>3 of 3</td><td>-0.2500</td><td>0.0000</td></tr>",
        "</table>",
    ]
    assert lines[-4:] == [
        "<tr><th>NO.</th><th>TOOL</th><th>KIND</th><th>DEPTH</th><th>Z</th><th>LEAVES ON SIDE</th></tr>",
        "<tr><td>1</td><td>1</td><td>PASS</td><td>1 of 1</td><td>-0.2500</td><td>0.0000</td></tr>",
        "</table>",
        "</body></html>",
    ]


def test_a_page_that_is_not_ready_gives_the_reason():
    page = as_page(sheet_of(gouging()), [""])
    against = (
        f'<div class="bad">{NOT_READY_TEXT}<ul>\n<li>Block 1, segment 1: gouges by 0.2500 (deep).</li>\n</ul></div>'
    )
    assert against in page
    assert READY_TEXT not in page


def test_findings_of_start_or_of_no_segment_name_no_segment():
    start, general = (Finding(code, Severity.ERROR, f"{code}.", segment) for code, segment in (("A", 0), ("B", None)))
    assert sheet_of(replace(SLOT, findings=(start, general, start))).errors == ("Block 1, START: A.", "Block 1: B.")


def test_an_incomplete_block_shows_its_known_values():
    empty = replace(SLOT, surface=SLOT.surface.part(0, 0), finish=(), floors=(), cutter=None, finish_tool=9)
    values = pairs(sheet_of(empty))
    assert (values["TOOL"], values["FINISH TOOL"], values["FEEDS"]) == ("NOT KNOWN", "NOT KNOWN", "-")
    assert not values.keys() & {"CONTOUR START", "FIRST PLUNGE AT", "CUTTER REACHES", "TIME"}


def test_consecutive_segments_with_one_feed_are_combined():
    path = polyline((0, 0), (1, 0), (1, 1), (0, 1))
    assert pairs(sheet_of(job(path)))["FEEDS"] == "10.0 (segments 1-3)"


def test_all_work_offsets_are_listed():
    assert dict(sheet_of(SLOT, replace(SLOT, work_offset=57)).head)["WORK OFFSET"] == "G54, G57"
    assert dict(sheet_of().head)["WORK OFFSET"] == "-"


def test_text_next_to_a_label_is_wrapped_at_the_last_column():
    fits, longer = "a" * 59, "a" * 40 + " " + "b" * 19
    lines = as_text(sheet([SLOT], Unit.IN, fits, longer)).splitlines()
    assert f"PROGRAM            {fits}" in lines
    assert len(f"PROGRAM            {fits}") == PAGE_COLUMNS
    assert lines[lines.index("PART NAME          " + "a" * 40) + 1] == " " * 19 + "b" * 19


def test_deleted_segments_are_noted_at_ready_and_in_the_block():
    note = "DELETED BY THE LOOK-AHEAD: SEGMENT 9"
    setup_sheet = sheet_of(replace(job(polyline((0, 0), (1, 0))), notes=(note,)))
    text = as_text(setup_sheet)
    assert "READY to post. Know before you run it:" in text
    assert f"! Block 1: {note}" in text
    assert f"NOTE               {note}" in text
    assert f"<li>Block 1: {note}</li>" in as_page(setup_sheet, [""])
