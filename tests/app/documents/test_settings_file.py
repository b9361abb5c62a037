from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.settings import Settings, SettingsFile, load_settings, parsed, written


def test_settings_are_read_as_they_were_written(tmp_path):
    settings = Settings("block", "light", str(tmp_path / 'a "b"'), mouse=True, control="fanuc:b")
    settings = settings.with_tools(tmp_path / 'a "b".nc', "1=0.5in").with_tools(tmp_path / "b.nc", "2=12.0mm")
    assert parsed(written(settings)) == settings
    assert settings.tools_of(tmp_path / 'a "b".nc') == "1=0.5in"


def test_the_folder_of_the_last_used_file_is_kept(tmp_path):
    settings = Settings().using(tmp_path / "first" / "1.toml").using(tmp_path / "2.toml")
    assert settings.folder == str(tmp_path)
    assert settings.using(tmp_path / "un\nprintable" / "3.toml") == settings


def test_a_file_of_an_earlier_version_is_read():
    assert parsed('unit = "MM"\nrecent = ["/a.toml"]\nmode = "ascii"\n') == Settings(characters="ascii")


@pytest.mark.parametrize(
    "text",
    [
        "folder = 3\n",
        'folder = "not/absolute"\n',
        'theme = "pink"\n',
        "control = 3\n",
        "tools = 3\n",
        "[tools]\nx = 3\n",
    ],
)
def test_unusable_settings_are_ignored(text):
    assert parsed(text) == Settings()


def test_unreadable_settings_are_replaced_by_defaults_and_reported(tmp_path):
    (tmp_path / "settings.toml").write_bytes(b"\xff\xfe = [")
    settings, sentence = load_settings(tmp_path / "settings.toml")
    assert settings == Settings()
    assert "cannot be read" in sentence
    assert load_settings(tmp_path / "none.toml") == (Settings(), "")


def test_endless_brackets_are_refused_as_settings(tmp_path):
    path = tmp_path / "settings.toml"
    path.write_text("a = " + "[" * 50_000)
    assert load_settings(path) == (
        Settings(),
        f"Your settings in {path} cannot be read: it is no settings file. The usual ones hold.",
    )


def test_only_changes_are_written_and_a_failure_is_reported_once(tmp_path):
    keeper = SettingsFile(tmp_path / "folder" / "settings.toml", Settings())
    assert keeper.keep(Settings()) == ""
    assert not (tmp_path / "folder").exists()
    changed = replace(Settings(), characters="ascii")
    assert keeper.keep(changed) == ""
    assert load_settings(tmp_path / "folder" / "settings.toml")[0] == changed
    blocked = SettingsFile(Path("/proc/nowhere/settings.toml"), Settings())
    assert "Settings are not kept" in blocked.keep(changed)
    assert blocked.keep(Settings()) == ""
