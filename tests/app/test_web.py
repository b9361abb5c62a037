"""The addresses that are served, and who may connect."""

from __future__ import annotations

import errno
import shlex
import socket
from pathlib import Path

import pytest

from app.__main__ import main
from app.cli.web import address, command, from_served_page, has_secret, is_local, page_for_browser, refusal


@pytest.mark.parametrize("host", ["127.0.0.1", "127.8.9.1", "::1", "localhost", "LOCALHOST"])
def test_addresses_of_this_machine_are_served(host: str) -> None:
    assert is_local(host)
    assert refusal(host, allow_network=False) == ""


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.1.5", "shop-pc", "localhost.example"])
def test_other_addresses_are_refused_until_allowed(host: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert "no login" in refusal(host, allow_network=False)
    assert refusal(host, allow_network=True) == ""
    assert main(["serve", "--host", host]) == 2
    assert "--allow-network" in capsys.readouterr().err


@pytest.mark.parametrize("port", ["99999", "65536", "0", "-1", "x", "8_0", "²"])
def test_an_invalid_port_is_refused_in_a_sentence(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as error:
        main(["serve", f"--port={port}"])
    assert error.value.code == 2
    assert f"{port} is not a port; ports go from 1 to 65535." in capsys.readouterr().err


@pytest.mark.parametrize(
    ("fault", "reason"),
    [
        (OSError(errno.EADDRINUSE, "error while attempting to bind"), "another program uses this port."),
        (OSError(errno.EADDRNOTAVAIL, "error while attempting to bind"), "this is not an address of this machine."),
        (PermissionError(errno.EACCES, "denied"), "the system keeps this port for itself."),
        (socket.gaierror(socket.EAI_NONAME, "Name or service not known"), "no such machine is known."),
        (UnicodeError("label too long"), "no such machine is known."),
    ],
)
def test_an_unservable_address_is_refused_in_a_sentence(
    fault: Exception, reason: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def serve(*_: object) -> None:
        raise fault

    monkeypatch.setattr("app.cli.web_server.serve", serve)
    assert main(["serve", "--port", "8123"]) == 2
    err = capsys.readouterr().err
    assert f"http://127.0.0.1:8123 cannot be served: {reason}" in err
    assert "Errno" not in err


def test_a_port_in_use_is_refused_in_a_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        assert main(["serve", "--port", str(other.getsockname()[1])]) == 2
    err = capsys.readouterr().err
    assert "another program uses this port. Choose another one with --port." in err
    assert "Errno" not in err


def test_a_file_name_is_one_shell_word_and_not_an_option() -> None:
    words = shlex.split(command(Path("-o; rm $(x) `y`.toml")))
    assert words[-2] == "--"
    assert words[-1].endswith("/-o; rm $(x) `y`.toml")


@pytest.mark.parametrize(
    ("host", "origin", "let_in"),
    [
        ("127.0.0.1:8000", "http://127.0.0.1:8000", True),
        ("localhost:8000", "http://localhost:8000", True),
        ("127.0.0.1:8000", "http://elsewhere.example", False),
        ("127.0.0.1:8000", "", False),
        ("", "", False),
        ("elsewhere.example:8000", "http://elsewhere.example:8000", False),
        ("127.0.0.1:9000", "http://127.0.0.1:9000", False),
        ("127.0.0.1:8000", "null", False),
        ("127.0.0.1:x", "http://127.0.0.1:x", False),
        ("127.0.0.1:8000", "http://[1", False),
    ],
)
def test_only_the_served_page_may_connect(host: str, origin: str, let_in: bool) -> None:
    assert from_served_page(host, origin, "127.0.0.1", 8000) is let_in


def test_the_printed_address_can_be_typed_into_a_browser() -> None:
    assert address("127.0.0.1", 80) == "http://127.0.0.1:80"
    assert address("::1", 8000) == "http://[::1]:8000"


PAGE = """<link
  rel="stylesheet"
  href="https://fonts.googleapis.com/css?family=Roboto%20Mono"
/><script src="http://0.0.0.0:8000/static/js/textual.js"></script>
<div data-session-websocket-url="ws://0.0.0.0:8000/ws"></div></body>"""


@pytest.mark.parametrize("host", ["shop-pc:8000", "192.168.1.5:8000", "[::1]:8000", "localhost:8000"])
def test_the_page_connects_to_the_address_that_was_requested(host: str) -> None:
    page = page_for_browser(PAGE, "http://0.0.0.0:8000", host)
    assert f'"http://{host}/static/js/textual.js"' in page
    assert f'"ws://{host}/ws"' in page
    assert "0.0.0.0" not in page


@pytest.mark.parametrize("host", ["", '"><script>', "a b"])
def test_an_invalid_host_does_not_get_into_the_page(host: str) -> None:
    assert "http://0.0.0.0:8000/static" in page_for_browser(PAGE, "http://0.0.0.0:8000", host)


def test_the_page_loads_no_fonts_from_another_machine() -> None:
    assert "fonts" not in page_for_browser(PAGE, "http://0.0.0.0:8000", "shop-pc:8000")


@pytest.mark.parametrize("path", ["/", "/static/js/textual.js", "/ws", "/abcd/ws", "/abcde", "/é/"])
def test_a_path_without_the_secret_is_refused(path: str) -> None:
    assert not has_secret(path, "abc")


def test_a_path_below_the_secret_is_accepted() -> None:
    assert has_secret("/abc/static/js/textual.js", "abc")
