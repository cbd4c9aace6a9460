"""`ecm.toml`: what a project sets for itself. A mistake in it is an error with its file, line and key."""

import re
import tomllib
from collections.abc import Iterator
from typing import Any, Literal, get_args

import msgspec
from pathspec import GitIgnoreSpec

from ecm_extract.errors import ConfigError
from ecm_extract.link.declaring.forms import Form
from ecm_extract.macros.rows import HeaderRow
from ecm_extract.rule_ids import rule_id
from ecm_extract.tree import printable

FILE_NAME = "ecm.toml"
MAX_CONFIG_BYTES = 1024 * 1024

Level = Literal["error", "warning", "info", "off"]
Promise = Literal["wire", "graph", "qos", "config", "source", "safety"]

_KEY_OF = re.compile(r" - at `\$(?P<path>[^`]*)`$")
_UNKNOWN_KEY = re.compile(r"Object contains unknown field `(?P<key>[^`]*)`")
_HEADER = re.compile(r"\s*(?P<open>\[\[?)(?P<key>[^\]]+)\]")
_TOML_PLACE = re.compile(r"\(at line (?P<line>\d+), column \d+\)")


class Extract(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Table `[extract]`: what is read.

    Attributes:
        exclude: paths relative to the root of the tree that are not read, in patterns of a `.gitignore`.
        include_tests: whether test code counts as part of the package.
    """

    exclude: tuple[str, ...] = ()
    include_tests: bool = False


class Config(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """All of `ecm.toml`; every key may be left out.

    Attributes:
        extract: what is read.
        forms: rows `[[form]]` for wrappers of the project, tried before the bundled ones.
        headers: rows `[[header]]` for macros of headers that are not in the tree.
        severity: level by rule id, `off` to silence it.
        promise: who must not break: the layers that the project guards (DESIGN §6); empty for all.
        externals: names that others provide, so never reported as unresolved: packages, topics, frames.
    """

    extract: Extract = Extract()
    forms: tuple[Form, ...] = msgspec.field(default=(), name="form")
    headers: tuple[HeaderRow, ...] = msgspec.field(default=(), name="header")
    severity: dict[str, Level] = {}
    promise: tuple[Promise, ...] = ()
    externals: tuple[str, ...] = ()


def parse_config(data: bytes, path: str = FILE_NAME) -> Config:
    """Read the bytes of an `ecm.toml`; `path` is only named in errors.

    Raises:
        ConfigError: not TOML, an unknown key, or a value of the wrong type.
    """
    text = _text(data, path)
    table = _toml(text, path)
    _check_levels(table.get("severity"), text, path)
    try:
        config = msgspec.convert(table, Config)
    except msgspec.ValidationError as error:
        steps, message = _explain(str(error))
        key = ".".join(str(step) for step in steps if isinstance(step, str))
        raise ConfigError(path, locate(text, steps), printable(key), message) from None
    _check_patterns(config.extract.exclude, text, path)
    return msgspec.structs.replace(config, severity={rule_id(rule): level for rule, level in config.severity.items()})


def _check_patterns(patterns: tuple[str, ...], text: str, path: str) -> None:
    try:
        GitIgnoreSpec.from_lines(patterns)
    except ValueError as error:
        message = f"is not a list of patterns as in a .gitignore: {printable(str(error))}"
        raise ConfigError(path, locate(text, ("extract", "exclude")), "extract.exclude", message) from None


def _check_levels(severity: object, text: str, path: str) -> None:
    """Checked by hand, because the library does not say which key of a mapping is wrong."""
    for rule, level in severity.items() if isinstance(severity, dict) else ():
        if level not in get_args(Level):
            message = f"{printable(repr(level))} is not a level: {', '.join(get_args(Level))}"
            raise ConfigError(path, locate(text, ("severity", rule)), f"severity.{printable(rule)}", message)


def locate(text: str, steps: tuple[str | int, ...]) -> int:
    """1-based line where a key stands: its own line, else that of the table it belongs to, else 0."""
    names = tuple(step for step in steps if isinstance(step, str))
    row = next((step for step in steps if isinstance(step, int)), 0)
    best, best_depth = 0, 0
    for number, place, seen in _places(text, names[:1]):
        depth = _shared(place, names)
        if depth > best_depth and seen in (0, row + 1):
            best, best_depth = number, depth
    return best


def _places(text: str, table: tuple[str, ...]) -> Iterator[tuple[int, tuple[str, ...], int]]:
    """Line, key and row number of each header and assignment; rows are counted of `[[table]]` only."""
    current: tuple[str, ...] = ()
    rows, seen = 0, 0
    for number, line in enumerate(text.splitlines(), 1):
        header = _HEADER.match(line)
        if header:
            current = _key_parts(header["key"])
            rows += header["open"] == "[[" and current == table
            seen = rows if header["open"] == "[[" else 0
            yield number, current, seen
        elif "=" in line:
            yield number, (*current, *_key_parts(line.partition("=")[0])), seen


def _shared(place: tuple[str, ...], names: tuple[str, ...]) -> int:
    """How many parts of a key a line names; 0 when the line is about something else."""
    return len(place) if names[: len(place)] == place else 0


def _key_parts(text: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in text.split("."))


def _text(data: bytes, path: str) -> str:
    if len(data) > MAX_CONFIG_BYTES:
        raise ConfigError(path, 0, "", f"has more than {MAX_CONFIG_BYTES} bytes; it is a short file of settings")
    try:
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ConfigError(path, line, "", "is not UTF-8; save it as UTF-8") from None


def _toml(text: str, path: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = _TOML_PLACE.search(str(error))
        line = int(place["line"]) if place else text.count("\n") + 1
        raise ConfigError(path, line, "", f"is not TOML: {printable(str(error))}") from None
    except RecursionError:
        raise ConfigError(path, 0, "", "is nested too deeply") from None


def _explain(error: str) -> tuple[tuple[str | int, ...], str]:
    """Key and message of a validation error, whose text ends in its place: ` - at `$.a.b[0]``."""
    place = _KEY_OF.search(error)
    steps = _steps(place["path"]) if place else ()
    message = _KEY_OF.sub("", error)
    unknown = _UNKNOWN_KEY.search(error)
    if unknown is None:
        return steps, printable(message)
    return (*steps, unknown["key"]), "there is no such key; see the manual, or check the spelling"


def _steps(path: str) -> tuple[str | int, ...]:
    found = re.findall(r"\.([^.\[]+)|\[(\d+)\]", path)
    return tuple(int(index) if index else name for name, index in found)
