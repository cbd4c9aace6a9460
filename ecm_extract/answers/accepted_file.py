"""`ecm-accepted.toml`: findings that are accepted, one file for lint, diff and check."""

from __future__ import annotations

import tomllib
from datetime import date
from pathlib import Path

import msgspec

from ecm_extract.answers.scope import Scope
from ecm_extract.errors import ConfigError, InputError
from ecm_extract.own_files import own_file
from ecm_extract.tree import printable
from ecm_extract.tree.git_repo import find_repo

FILE_NAME = "ecm-accepted.toml"


class Accepted(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One accepted finding.

    Attributes:
        fingerprint: of the finding. reason: why it is right as it is.
        rule: that found it; for people.
        until: the day after which it counts again.
        scope: of the runs that find it.
    """

    fingerprint: str
    reason: str
    rule: str = ""
    until: date | None = None
    scope: Scope = "tree"


def accepted_file(folder: Path) -> Path:
    """Return the file that is right for a folder: the nearest one above, else one in the root of the repository.

    It is in the folder itself where that is in no repository.

    Raises:
        InputError: its place is taken by a link that leads out of the repository.
    """
    start = folder.resolve()
    repo = find_repo(start) if start.is_dir() else None
    root = repo.work_tree if repo is not None and repo.work_tree is not None else start
    inside = [start, *(each for each in start.parents if each.is_relative_to(root))]
    place = next((each for each in inside if (each / FILE_NAME).is_file() or (each / FILE_NAME).is_symlink()), root)
    return own_file(place, FILE_NAME)


def accepted_in(file: Path) -> tuple[Accepted, ...]:
    """Read the rows of a file; none where there is no file.

    Raises:
        ConfigError: it is not TOML, or a row is wrong.
    """
    return parse_accepted(accepted_bytes(file), printable(str(file)))


def accepted_bytes(file: Path) -> bytes:
    """Read the file; empty where there is none.

    Raises:
        InputError: it cannot be read.
    """
    try:
        return file.read_bytes() if file.is_file() else b""
    except OSError as error:
        message = f"{printable(str(file))} cannot be read: {error.strerror}"
        raise InputError(message, "make it readable") from None


def parse_accepted(data: bytes, path: str = FILE_NAME) -> tuple[Accepted, ...]:
    """Read the bytes of a file of accepted findings; `path` is only named in errors.

    Raises:
        ConfigError: it is not TOML, or a row is wrong.
    """
    try:
        table = tomllib.loads(data.decode("utf-8"))
        return msgspec.convert(table.get("accept", []), tuple[Accepted, ...])
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ConfigError(path, 0, "accept", f"{error}") from None


def accepted_row(entry: Accepted) -> str:
    """Return one row as it is written into the file."""
    lines = ["", "[[accept]]", f"fingerprint = {_quoted(entry.fingerprint)}"]
    lines += [f"rule = {_quoted(entry.rule)}"] if entry.rule else []
    lines += [f"reason = {_quoted(entry.reason)}"]
    lines += [f"scope = {_quoted(entry.scope)}"] if entry.scope != "tree" else []
    lines += [f"until = {entry.until.isoformat()}"] if entry.until is not None else []
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    plain = "".join(char for char in text if char.isprintable())
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
