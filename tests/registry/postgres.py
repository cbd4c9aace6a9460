"""A PostgreSQL server of our own for the tests: that of the system, run as somebody who is not root."""

from __future__ import annotations

import os
import pwd
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PLACES = ("/usr/lib/postgresql", "/usr/pgsql", "/opt/homebrew/opt/postgresql")
_ACCOUNTS = ("postgres", "nobody")


class NotThereError(Exception):
    """There is no server that starts; the message says why."""


@contextmanager
def server(folder: Path) -> Iterator[str]:
    """Start a server in a folder, and give the URL of its database; it listens on a socket only.

    Raises:
        NotThereError: it does not start.
    """
    programs = _programs()
    account = _account()
    data, options = folder / "data", {"user": account} if account else {}
    if account:
        _open_to(folder, account)
    try:
        _run([programs / "initdb", "-D", data, "-U", "ecm", "-A", "trust", "-E", "UTF8", "--no-sync"], options)
        flags = f"-c listen_addresses= -c unix_socket_directories={folder} -c fsync=off -c max_connections=60"
        _run([programs / "pg_ctl", "-D", data, "-w", "-l", folder / "log", "-o", flags, "start"], options)
    except (OSError, subprocess.SubprocessError) as error:
        message = f"PostgreSQL does not start: {error}"
        raise NotThereError(message) from error
    try:
        yield f"postgresql://ecm@/postgres?host={folder}"
    finally:
        _run([programs / "pg_ctl", "-D", data, "-m", "immediate", "stop"], options)


def _run(words: list[object], options: dict[str, str]) -> None:
    subprocess.run([str(word) for word in words], check=True, capture_output=True, timeout=60, cwd="/", **options)


def _programs() -> Path:
    found = shutil.which("initdb")
    if found:
        return Path(found).resolve().parent
    candidates = sorted(path.parent for place in _PLACES for path in Path(place).glob("**/bin/initdb"))
    if not candidates:
        message = "no PostgreSQL server is installed (initdb)"
        raise NotThereError(message)
    return candidates[-1]


def _account() -> str | None:
    """Whose right the server runs under: it refuses to be root."""
    if os.geteuid() != 0:
        return None
    known = {entry.pw_name for entry in pwd.getpwall()}
    found = next((name for name in _ACCOUNTS if name in known), None)
    if found is None:
        message = "PostgreSQL does not run as root, and there is no account postgres or nobody"
        raise NotThereError(message)
    return found


def _open_to(folder: Path, account: str) -> None:
    shutil.chown(folder, account)
    for parent in folder.parents:
        if parent != Path("/tmp") and parent.stat().st_uid == 0 and parent.is_relative_to("/tmp"):
            parent.chmod(parent.stat().st_mode | 0o011)
