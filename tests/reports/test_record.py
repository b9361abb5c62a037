"""The record tells numbers, codes and NC words apart, and neither texts nor spelling."""

from __future__ import annotations

from random import Random
from typing import Any

from tests.reports.corpus import cases, iso_program
from tests.reports.record import Comparison, Tally


def differences(old: Any, new: Any, *expected: str) -> list[str]:
    return list(Comparison(Tally(), frozenset(expected)).documents(old, new))


def texts(old: str, new: str) -> list[str]:
    return list(Comparison(Tally(), frozenset()).texts(old, new))


def test_numbers_are_equal_within_a_billionth_of_a_millimeter() -> None:
    assert differences({"units": "MM", "x": 1.0}, {"units": "MM", "x": 1.0 + 9e-10}) == []
    assert len(differences({"units": "MM", "x": 1.0}, {"units": "MM", "x": 1.0 + 2e-9})) == 1
    assert len(differences({"units": "IN", "x": 1.0}, {"units": "IN", "x": 1.0 + 9e-10})) == 1
    assert len(differences({"x": True}, {"x": False})) == 1
    assert len(differences({"x": None}, {"x": 0.0})) == 1


def test_findings_are_compared_by_all_but_their_texts() -> None:
    old = {"findings": [{"code": "GOUGE", "x": 1.0, "text": "Centre."}]}
    assert differences(old, {"findings": [{"code": "GOUGE", "x": 1.0, "text": "Gouge."}]}) == []
    assert len(differences(old, {"findings": [{"code": "GOUGE", "x": 2.0, "text": ""}]})) == 1
    assert len(differences(old, {"findings": []})) == 1
    assert differences(old, {"findings": []}, "GOUGE") == []


def test_controls_are_compared_by_their_names() -> None:
    old = {"results": [{"control": "haas:a", "x": 1.0}, {"control": "linuxcnc", "x": 2.0}]}
    more = [{"control": "fanuc:a", "x": 3.0}, *reversed(old["results"])]
    assert differences(old, {"results": more}) == []
    assert differences(old, {"results": more[:2]}) == ["results haas:a: missing after"]
    assert len(differences(old, {"results": [{"control": "haas:a", "x": 1.0}, {"control": "linuxcnc", "x": 1.0}]})) == 1


def test_nc_texts_may_differ_in_spelling_and_sentences_of_findings() -> None:
    old = "(THE TOOL CENTRE)\n(OVERRIDDEN GOUGE: Segment 2: The path)\n(gouges.)\n(G64 P0.005)\nG1 X1.5 Y2.0\n"
    assert texts(old, old.replace("CENTRE", "CENTER").replace("The path)\n(gouges", "It gouges")) == []
    assert len(texts(old, old.replace("GOUGE:", "WRONG_SIDE:"))) == 1
    assert len(texts(old, old.replace("X1.5", "X1.7"))) == 1
    assert len(texts(old, old.replace("G1", "G0"))) == 1
    assert texts(old, old.replace("Y2.0", "Y2.1")) == []


def test_the_corpus_is_the_same_for_a_seed() -> None:
    first, again = (list(cases(20, 3)) for _ in range(2))
    assert first == again
    assert first != list(cases(20, 4))
    assert len({case.name for case in first}) == 20


def test_an_nc_program_of_the_corpus_is_compensated_once() -> None:
    for case in cases(20, 1):
        text = iso_program(case, Random(1))
        assert (text.count("G41") + text.count("G42"), text.count(" G40 "), text.count("\nG40")) == (1, 1, 1)
