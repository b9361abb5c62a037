"""Fixtures for the app; the environment is cleared of colors, themes and options, so pictures look alike everywhere."""

from __future__ import annotations

import os
from collections.abc import AsyncIterator, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import pytest
import pytest_asyncio

if TYPE_CHECKING:
    from textual.css.model import RuleSet
    from textual.css.tokenizer import Token
    from textual.css.types import CSSLocation

    from tests.app.widget_pilot import Operator

KEPT = "TEXTUAL_SNAPSHOT_"
"""Variables of the snapshot plugin, which may be set before this file is imported."""

for name in list(os.environ):
    if (name.startswith("TEXTUAL_") and not name.startswith(KEPT)) or name in ("NO_COLOR", "FORCE_COLOR"):
        del os.environ[name]
os.environ["COLUMNS"], os.environ["LINES"] = "80", "24"


@pytest.fixture(scope="session", autouse=True)
def _styles_read_once() -> Iterator[None]:
    """Read the styles of the widgets once for all apps that this process starts."""
    from textual.css.parse import parse
    from textual.css.tokenize import tokenize_values

    values: dict[Any, dict[str, list[Token]]] = {}
    rules: dict[Any, list[RuleSet]] = {}

    def values_once(variables: dict[str, str]) -> dict[str, list[Token]]:
        key = tuple(variables.items())
        if key not in values:
            values[key] = tokenize_values(variables)
        return values[key]

    def rules_once(
        scope: str,
        css: str,
        read_from: CSSLocation,
        variable_tokens: dict[str, list[Token]],
        is_default_rules: bool,
        tie_breaker: int,
    ) -> list[RuleSet]:
        # the values are those of `values_once`, which keeps them
        key = scope, css, read_from, id(variable_tokens), is_default_rules, tie_breaker
        if key not in rules:
            found = parse(
                scope,
                css,
                read_from,
                variable_tokens=variable_tokens,
                is_default_rules=is_default_rules,
                tie_breaker=tie_breaker,
            )
            rules[key] = list(found)
        return rules[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("textual.css.stylesheet.tokenize_values", values_once)
        patch.setattr("textual.css.stylesheet.parse", rules_once)
        yield


@pytest.fixture
def tmp_path() -> Iterator[Path]:
    """A folder whose path has the same length on every machine, because the screen truncates long paths."""
    with TemporaryDirectory(prefix="cutcomp-", dir="/tmp", ignore_cleanup_errors=True) as folder:
        yield Path(folder)


@pytest.fixture(autouse=True)
def _painted_at_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a screen be painted when a test waits for it, and not several times on the way there."""
    from tests.app.widget_pilot import paint_at_rest

    monkeypatch.setattr("textual.screen.UPDATE_PERIOD", 1.0)
    monkeypatch.setattr("textual.screen.Screen._compositor_refresh", paint_at_rest)


@pytest.fixture(autouse=True)
def _own_state(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Give each test its own state folder, apart from the user's."""
    with TemporaryDirectory(prefix="cutcomp-", ignore_cleanup_errors=True) as folder:
        monkeypatch.setenv("XDG_STATE_HOME", folder)
        yield


@pytest_asyncio.fixture(loop_scope="module", scope="module")
async def opened() -> AsyncIterator[Operator]:
    """Open one app for all tests of a module that take `user`."""
    from tests.app.widget_pilot import operator

    async with operator() as user:
        yield user


@pytest_asyncio.fixture(loop_scope="module")
async def user(opened: Operator) -> Operator:
    """Start again on the pocket example, in the app of the module: opening another app would take most of a test.

    The module or the test is marked `pytest.mark.asyncio(loop_scope="module")`.
    """
    await opened.begin("pocket")
    return opened


@pytest.fixture
def state(tmp_path: Path) -> Path:
    """The user's state folder, for journals that cannot be in the folder of their document."""
    return tmp_path / "own"


@pytest.fixture
def part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The pocket example in its own folder, which is the current one."""
    # only once the environment is cleared
    from app.documents.files import load, save
    from app.documents.programs import example

    path = tmp_path / "shop" / "part.toml"
    path.parent.mkdir()
    monkeypatch.chdir(path.parent)
    save(load(example("pocket")), path)
    return path
