"""The document that a name on the command line opens."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.cli.screens import begin
from app.documents.document_service import DocumentService, Opened, Trouble
from app.documents.files import load
from app.documents.programs import example
from core.program.file.write import dumps


@pytest.fixture
def service(state: Path) -> Iterator[DocumentService]:
    service = DocumentService(state=state)
    yield service
    service.stop()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with the pocket as pk2.toml."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pk2.toml").write_text(dumps(load(example("pocket"))))
    return tmp_path


def opened(service: DocumentService, name: str) -> Opened[Any]:
    result = begin(service, Path(name), None)
    assert isinstance(result, Opened)
    return result


def test_a_name_without_suffix_opens_the_existing_toml_file(service: DocumentService, folder: Path) -> None:
    document = opened(service, "pk2").document
    assert document.program == load(folder / "pk2.toml")
    assert document.file.path == Path("pk2.toml")


@pytest.mark.usefixtures("folder")
def test_a_new_name_without_suffix_gets_the_toml_suffix(service: DocumentService) -> None:
    result = opened(service, "new")
    assert result.document.file.path == Path("new.toml")
    assert result.notice.text == "new.toml does not exist yet: saving makes it."


def test_an_existing_file_without_suffix_keeps_its_name(service: DocumentService, folder: Path) -> None:
    (folder / "pk2").write_text(dumps(load(example("notch"))))
    document = opened(service, "pk2").document
    assert (document.file.path, document.program) == (Path("pk2"), load(example("notch")))


def test_an_unreadable_file_is_reported_by_name(service: DocumentService, folder: Path) -> None:
    (folder / "pk2.toml").write_bytes(b"no program")
    result = begin(service, Path("pk2.toml"), None)
    assert isinstance(result, Trouble)
    assert "pk2.toml" in result.text


def test_a_name_without_a_file_in_the_folder_of_the_examples_is_refused() -> None:
    result = DocumentService().open(example("none"))
    assert isinstance(result, Trouble)
    assert "none.toml cannot be read: there is no such file or folder." in result.text
