"""Answers of one tree's command line to a file of questions; the record starts it by its path, in that tree."""

from __future__ import annotations

import io
import json
import sys
import tomllib
import traceback
from contextlib import redirect_stderr, redirect_stdout
from importlib import import_module
from pathlib import Path


def main() -> None:
    questions, folder = Path(sys.argv[1]), Path(sys.argv[2])
    scripts = tomllib.loads(Path("pyproject.toml").read_text())["project"]["scripts"]
    module, _, entry = scripts["cutcomp"].partition(":")
    command = getattr(import_module(module), entry)
    if not str(import_module("core").__file__).startswith(f"{Path.cwd()}/"):
        sys.exit(f"core of another tree is imported: {import_module('core').__file__}")
    answers = sys.stdout
    with questions.open() as lines:
        for line in lines:
            question = json.loads(line)
            arguments = [word.replace("{folder}", str(folder)) for word in question["arguments"]]
            answer = _answer(command, arguments)
            if question["save"] and answer["text"]:
                (folder / question["save"]).write_text(str(answer["text"]))
            answers.write(f"{json.dumps(answer)}\n")


def _answer(command: object, arguments: list[str]) -> dict[str, object]:
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True) for _ in range(2))
    sys.argv = ["cutcomp", *arguments]
    status: object = 0
    with redirect_stdout(out), redirect_stderr(err):
        try:
            assert callable(command)
            command()
        except SystemExit as left:
            status = left.code or 0
        except Exception:  # noqa: BLE001 - a traceback is an answer, too
            status = traceback.format_exc()
    return {"status": status, "text": _text(out), "messages": _text(err)}


def _text(stream: io.TextIOWrapper) -> str:
    buffer = stream.buffer
    assert isinstance(buffer, io.BytesIO)
    return buffer.getvalue().decode()


if __name__ == "__main__":
    main()
