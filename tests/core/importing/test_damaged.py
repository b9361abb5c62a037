"""Damaged drawings: a sample of mutants of six files; the report `tests.reports.dxf_mutants` runs thousands."""

from __future__ import annotations

import random

import pytest

from core.importing.drawing import DrawingError
from core.importing.dxf import read_dxf
from tests.core.importing.drawings import drawing_file, dxf, ellipse, line, square
from tests.core.importing.mutants import (
    TIME_LIMIT,
    full_document,
    lost_in_silence,
    mutant,
    originals,
    outcome,
    text_of,
)

FILES = originals()
SEED = 7
MUTANTS = 25


@pytest.mark.parametrize("name", FILES)
def test_a_mutant_is_refused_or_read_without_silent_loss(name: str) -> None:
    whole = outcome(FILES[name])
    assert whole.code == ""
    refused = 0
    for number in range(MUTANTS):
        result = outcome(mutant(FILES[name], random.Random(f"{SEED} {name} {number}")))
        # plain ASCII: xdist aborts the run at a message with half a surrogate pair
        seconds, lost, message = result.seconds, lost_in_silence(whole, result), ascii((number, result))
        assert seconds < TIME_LIMIT, message
        assert not lost, message
        refused += bool(result.code)
    assert refused >= MUTANTS / 20


def test_a_file_cut_off_anywhere_is_refused() -> None:
    data = drawing_file("d14-layers.dxf")
    for length in range(60, len(data) - 6, 7):
        with pytest.raises(DrawingError):
            read_dxf(data[:length], "cut.dxf")


def test_a_damaged_file_is_read_as_far_as_it_is_intact() -> None:
    data = dxf(*square(0, 0, 10))
    taken = read_dxf(data[: len(data) - 40], "cut.dxf", damaged=True)
    assert taken.entities == 3
    assert "breaks off" in taken.notes[0]


def test_an_entity_without_a_kind_is_reported() -> None:
    data = dxf(*square(0, 0, 10), line((20, 0), (30, 0)))
    for faulty in (data.replace(b"ENTITIES\n0\nLINE\n", b"ENTITIES\n6\nLINE\n", 1), data.replace(b"0\nLINE\n", b"", 1)):
        with pytest.raises(DrawingError, match=r"The entity at line \d+ has no kind \(group code 0\)") as error:
            read_dxf(faulty, "test.dxf")
        assert error.value.code == "DXF_DAMAGED"
        taken = read_dxf(faulty, "test.dxf", damaged=True)
        assert taken.entities == 4
        assert any("it is not read" in note for note in taken.notes)


def test_an_entity_whose_group_codes_cannot_be_right_is_named_and_left_out_on_demand() -> None:
    cases: list[tuple[list[tuple[int, object]], str]] = [
        ([(0, "LINE"), (8, "0"), (10, 0), (20, 0), (11, 5)], "has group code 21 missing"),
        ([*line((0, 0), (1, 1)), (10, 5)], "has group code 10 2 times"),
        ([*ellipse((0, 0), (5, 0), 0.5), (41, 0)], "has group code 41 2 times"),
        ([(0, "LWPOLYLINE"), (90, 3), (10, 0), (20, 0), (10, 5), (20, 5)], "names 3 points and has 2"),
    ]
    for faulty, fault in cases:
        data, where = dxf(line((0, 0), (5, 5)), faulty), f"The {faulty[0][1]} at line 35"
        with pytest.raises(DrawingError) as error:
            read_dxf(data, "test.dxf")
        assert error.value.text == f"This file is damaged: {where} {fault}."
        taken = read_dxf(data, "test.dxf", damaged=True)
        assert (taken.entities, taken.notes[-1]) == (1, f"{where} cannot be read: it {fault}.")


def test_a_section_within_a_section_is_reported_as_damage() -> None:
    data = dxf(*square(0, 0, 10))
    with pytest.raises(DrawingError) as error:
        read_dxf(b"0\nSECTION\n2\nHEADER\n" + data, "twice.dxf")
    assert error.value.text == "This file is damaged: missing ENDSEC tag."
    assert error.value.readable == 4


def test_garbage_after_the_end_is_no_damage() -> None:
    assert read_dxf(dxf(*square(0, 0, 10)) + b"\x00\xff trash\n12\n", "trash.dxf").entities == 4


@pytest.mark.parametrize("ends", [b"\r\n", b"\r"])
def test_line_ends_of_all_systems_are_read(ends: bytes) -> None:
    assert read_dxf(dxf(*square(0, 0, 10)).replace(b"\n", ends), "ends.dxf").entities == 4


def test_more_entities_than_the_limit_are_refused_with_both_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("core.importing.dxf_document.MAX_ENTITIES", 3)
    with pytest.raises(DrawingError, match="The drawing has 4 entities: at most 3 are read"):
        read_dxf(dxf(*square(0, 0, 10)), "many.dxf")


def test_the_message_without_ezdxf_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "ezdxf", None)
    with pytest.raises(DrawingError, match="DXF files need the package ezdxf: pip install ezdxf"):
        read_dxf(dxf(*square(0, 0, 10)), "part.dxf")


def test_a_file_that_needs_repair_is_read_on_demand_with_a_note() -> None:
    before, after = text_of(full_document()).rsplit(b"\n  5\n", 1)
    data = before + b"\n x5\n" + after
    with pytest.raises(DrawingError) as refused:
        read_dxf(data, "tables.dxf")
    assert refused.value.code == "DXF_DAMAGED"
    assert refused.value.readable
    taken = read_dxf(data, "tables.dxf", damaged=True)
    assert taken.entities >= 6
    assert "what could be repaired is taken" in taken.notes[0]
