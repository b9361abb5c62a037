"""Journals with right sums and wrong content: none of them ends the program, at the start or from OPEN.

`python -m tests.reports.journals` tries 800 in which one value is wrong and 5,000 of random values, and prints what
became of them: `restored`, `damaged` (set aside and told), `nothing` (nothing new in it).
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

from app.documents.document import ContourDocument
from app.documents.document_service import DocumentService, Opened
from app.documents.journal_file import journal_path, lines
from app.documents.questions import RESTORE
from app.documents.unsaved_work import file_of_copy
from core.pipeline.derived import solve_fields
from tests.app.documents.typist import DEAD, TIME, started
from tests.app.nc_lines import inserted

SEED = 20_250_304
WRONG: tuple[Any, ...] = (
    None,
    True,
    0,
    -1,
    10**309,
    1e308,
    -(10**400),
    "",
    "\x1b[2J",
    "a\0b",
    "\ud800",
    "x" * 5000,
    [],
    [[]],
    [1, 2, 3],
    [None, None, None],
    {},
    {"": {}},
    {"owner": None},
    {"inc": 10**309},
)
"""Values in the place of a right one."""
KEYS = ("journal", "nc", "kind", "owner", "file", "stamp", "base", "do", "delta", "undo", "redo", "at", "time", "row")


def records_of(data: bytes) -> list[Any]:
    return [json.loads(line[9:]) for line in data.splitlines()]


def signed(records: list[Any]) -> bytes:
    """Lines with right sums, whatever they say."""
    return lines(records)[0]


def places(value: object, way: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The way to every value inside."""
    yield way
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        yield from places(child, (*way, key))


def replaced(value: Any, way: tuple[Any, ...], new: object) -> Any:  # anything JSON has
    """The value with another one at a place; without it where `new` is Ellipsis."""
    if not way:
        return new
    copy = dict(value) if isinstance(value, dict) else list(value)
    inner = replaced(value[way[0]], way[1:], new)
    if inner is ...:
        del copy[way[0]]
    else:
        copy[way[0]] = inner
    return copy


def one_wrong(right: list[Any], random: Random, count: int) -> Iterator[bytes]:
    """Journals in which one value is another one, or is left out."""
    ways = [way for way in places(right) if way]
    for _ in range(count):
        way = random.choice(ways)
        yield signed(replaced(right, way, ... if random.random() < 0.1 else random.choice(WRONG)))


def random_value(random: Random, depth: int = 0) -> Any:  # anything JSON has
    kind = random.random()
    if depth > 3 or kind < 0.5:
        return random.choice(WRONG)
    if kind < 0.75:
        return [random_value(random, depth + 1) for _ in range(random.randrange(4))]
    return {random.choice((*KEYS, "blocks", "tools", "x_start")): random_value(random, depth + 1) for _ in range(3)}


def all_random(right: list[Any], random: Random, count: int) -> Iterator[bytes]:
    """Journals whose lines have the keys of real ones and random values; half of them begin as a real one does."""
    for _ in range(count):
        rows = [{key: random_value(random) for key in random.sample(KEYS, 6)} for _ in range(random.randrange(1, 4))]
        yield signed([right[0], *rows] if random.random() < 0.5 else rows)


def outcome(file: Path, own: Path, data: bytes, *, copy: bool) -> str:
    """What becomes of a file with this journal, opened by itself or from the list of OPEN."""
    journal = journal_path(file)
    journal = journal.with_name(f"{journal.name}.discarded-1") if copy else journal
    journal.write_bytes(data)
    documents = DocumentService(DEAD, own, lambda: TIME)
    try:
        opened = _opened(documents, file, journal if copy else None)
        offer = opened.offer
        if offer is None:
            return "nothing"
        if RESTORE not in [answer.word for answer in offer.ask.answers]:
            documents.answer(opened.document, offer, "CONTINUE")
            return "damaged"
        _used(documents, documents.answer(opened.document, offer, RESTORE))
        return "restored"
    finally:
        documents.stop()
        for path in file.parent.iterdir():
            if path != file:
                path.unlink()


def _opened(documents: DocumentService, file: Path, copy: Path | None) -> Opened[Any]:
    path = file if copy is None else file_of_copy(copy, file.parent) or file
    opened = documents.open(path if path.parent == file.parent else file, kept_copy=copy)
    assert isinstance(opened, Opened), opened
    return opened


def _used(documents: DocumentService, opened: Opened[Any]) -> None:
    """What the screens do with a document: derive all of its undo, ask for its text, keep an edit."""
    document = opened.document
    if isinstance(document, ContourDocument):
        for step in document.history.past:
            solve_fields(step.program)
        solve_fields(document.program)
        document.data()
        documents.keep(document.edited(document.history.undo(), document.cursor, document.field_name))
    else:
        document.data()
        documents.keep(document.edited(inserted(document.text, 0, "M0"), 0))


def tried(folder: Path, wrong: int, random_count: int, seed: int = SEED) -> Counter[tuple[str, str]]:
    """How many became what, of each of the two ways to be wrong; an error of ours is raised."""
    counts: Counter[tuple[str, str]] = Counter()
    own, nc, program = folder / "own", folder / "nc" / "part.nc", folder / "program" / "part.toml"
    for file, content in ((nc, b"G20\nG0 X1\nM30\n"), (program, None)):
        file.parent.mkdir()
        if content is None:
            started(own, file).save().left()
        else:
            file.write_bytes(content)
        operator = started(own, file).type(7, 8).undo()
        right = records_of(journal_path(file).read_bytes())
        operator.left()
        random = Random(f"{seed} {file.name}")
        for name, journals in (
            ("one value wrong", one_wrong(right, random, wrong // 2)),
            ("random values", all_random(right, random, random_count // 2)),
        ):
            for data in journals:
                counts[name, outcome(file, own, data, copy=random.random() < 0.3)] += 1
    return counts


def main() -> None:
    """Try them all and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wrong", type=int, default=800)
    parser.add_argument("--random", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=SEED)
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        counts = tried(Path(folder), options.wrong, options.random, options.seed)
    for (name, became), count in sorted(counts.items()):
        print(f"{name:16} {became:9} {count:6}")
    print(f"{counts.total()} journals, no traceback")


if __name__ == "__main__":
    main()
