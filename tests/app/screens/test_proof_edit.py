"""NC PROOF's listing typed into: lines changed, put in, taken out and brought back."""

from __future__ import annotations

from tests.app.prover import SQUARE, Prover, square


def test_a_line_is_typed_and_the_verdict_follows() -> None:
    prover = square().press(*["down"] * 3, "enter", *["backspace"] * 7, *"N22X-.5", "enter")
    assert prover.lines[3] == "N22X-.5"
    assert prover.page.row == 4
    assert prover.page.unsaved
    assert "gouges by 0.0075" not in "\n".join(prover.screen())


def test_esc_leaves_a_line_as_it_was() -> None:
    prover = square().press("enter", *"abc", "escape")
    assert prover.page.listing.data == SQUARE
    assert not prover.page.unsaved


def test_lines_are_put_in_and_taken_out_and_brought_back() -> None:
    prover = square().press("down", "i", *"G4 P1", "enter")
    assert prover.lines[1:3] == ["G4 P1", "N20G41Y0Z0"]
    assert prover.press("up", "x").lines[1] == "N20G41Y0Z0"
    prover.press("u", "u", "u")
    assert prover.page.listing.data == SQUARE
    assert prover.press("u").said == "There is nothing to undo."
    prover.press("r", "r")
    assert prover.lines[1] == "G4 P1"
    assert prover.press("ctrl+z").lines[1] == ""
    assert prover.press("ctrl+y").lines[1] == "G4 P1"


def test_a_softkey_takes_the_line_being_typed_first() -> None:
    prover = square().press("enter", *"X", "f3")
    assert prover.lines[0].endswith("X")
    assert prover.page.control == "rosettacnc:nist"


def test_behind_the_last_line_and_in_an_empty_program() -> None:
    prover = Prover.of(b"", "linuxcnc").press("x")
    assert prover.said == "There is no line."
    prover.press("i", *"M30", "enter")
    assert prover.page.listing.data == b"M30\n"
    prover.press("o", *"M2", "enter")
    assert prover.lines == ["M30", "M2"]


def test_the_only_line_is_taken_out_and_comes_back() -> None:
    prover = Prover.of(b"M30\n", "linuxcnc").press("x")
    assert prover.lines == []
    assert prover.press("u").lines == ["M30"]
    prover = Prover.of(b"", "linuxcnc").press("i", *"M2", "enter", "u", "u")
    assert prover.page.listing.data == b""
    assert not prover.page.unsaved


def test_a_line_of_signs_a_terminal_obeys_shows_none_of_them() -> None:
    prover = Prover.of(b"G1 X1\x1b[2J\x07\tY2\n" + b"x" * 5000 + b"\n\xc2\x9b31m\n", "linuxcnc")
    assert all(line.isprintable() for line in prover.screen())
    prover.press("enter")
    assert all(line.isprintable() for line in prover.screen())


def test_lines_of_any_length_and_with_any_signs_can_be_changed() -> None:
    prover = Prover.of(b"\tG1 X1\x07\r\n" + b"x" * 5000 + b"\r\nM30\r\n", "linuxcnc")
    prover.press("enter", *" Y2", "enter")
    assert prover.page.listing.data.startswith(b"\tG1 X1\x07 Y2\r\nxx")
    assert prover.page.row == 1
    prover.press("enter", "home", "delete", "(", "end", ")")
    assert max(map(len, prover.screen())) <= 80
    prover.press("enter", "s")
    assert prover.lines[1] == f"({'x' * 4999})"


def test_a_line_the_file_cannot_hold_is_refused() -> None:
    prover = Prover.of(b"(\xe9)\nG1 X1\n", "linuxcnc").press("enter", "\u2192", "enter")
    assert "latin-1" in prover.said
    assert prover.page.editing is not None


def test_pasted_text_gives_no_orders() -> None:
    prover = square()
    prover.desk = prover.desk.paste("xxx")
    assert prover.page.listing.data == SQUARE
    prover.press("enter")
    prover.desk = prover.desk.paste("(a)\n(b)")
    assert prover.press("enter").lines[0] == "N10G0G90X-1.Y1.T1M6(a)"
