"""YAML as a light typed tree with lines: no objects, bounded aliases, nesting and size.

Built from parser events with a stack of our own, so that nesting exhausts neither stack (Python or C), and
what was read before an error is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

import msgspec
import yaml

from ecm_parsers.result import Diagnostic, Parsed, shortened
from ecm_parsers.text import decode
from ecm_parsers.yaml_scalar import PlainScalar, typed

MAX_BYTES = 8_000_000
MAX_NODES = 200_000
MAX_DEPTH = 100
MAX_DIAGNOSTICS = 100
_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_LIMIT = "yaml-limit"
_TOO_DEEP = f"YAML nested deeper than {MAX_DEPTH} levels"
_OWN_BOUND = "exceeded maximum nesting depth"
"""What libyaml says of nesting that it looks ahead over, beyond a bound of its own (PyYAML from 6.0.4 on)."""
_CORE = "tag:yaml.org,2002:"
_ANGLES = frozenset({"!degrees", "!radians"})


class Scalar(msgspec.Struct, frozen=True):
    """A leaf.

    Attributes:
        value: typed when written plain, text when quoted.
        line: 1-based.
        text: as written, without quotes.
        tag: local tag such as `!degrees`, else empty.
        column: 1-based, in characters; 0 where it stands for something that is not written.
    """

    value: PlainScalar
    line: int
    text: str
    tag: str = ""
    column: int = 0


class Sequence(msgspec.Struct, frozen=True):
    """A list; `line` is 1-based."""

    items: tuple[Node, ...]
    line: int


class Entry(msgspec.Struct, frozen=True):
    """One `key: value` of a mapping; the key as text, with its 1-based line and column."""

    key: str
    value: Node
    line: int
    column: int = 0


class Mapping(msgspec.Struct, frozen=True):
    """A map in the order of the file.

    Duplicate keys are all kept, since readers differ: PyYAML takes the last one, ROS 2 reads each.
    """

    entries: tuple[Entry, ...]
    line: int

    def get(self, key: str) -> Node | None:
        """Return the value of `key`, the last one of duplicates, or None."""
        return next((entry.value for entry in reversed(self.entries) if entry.key == key), None)

    def unique(self) -> tuple[Entry, ...]:
        """Return the entries with the last one of duplicate keys."""
        return tuple({entry.key: entry for entry in self.entries}.values())


Node: TypeAlias = Scalar | Sequence | Mapping


class _Built(msgspec.Struct, frozen=True):
    """A finished node with what it costs when an alias repeats it."""

    node: Node
    size: int = 1
    height: int = 1


class _Frame(msgspec.Struct):
    """A collection that is still open."""

    is_map: bool
    line: int
    anchor: str | None
    children: list[_Built] = []


class _LimitError(Exception):
    """A bound of ours was exceeded; reading stops there."""


def parse_yaml(data: bytes, scalar: Callable[[str], PlainScalar] = typed) -> Parsed[tuple[Node, ...]]:
    """Read all documents of a YAML file.

    Args:
        data: its bytes, at most `MAX_BYTES`.
        scalar: gives the value of an unquoted scalar, see `yaml_scalar`.

    Returns:
        One tree per document that is not empty. After an error the documents before it and the part of the
        broken one that was read are kept, and a diagnostic tells the line.
    """
    if len(data) > MAX_BYTES:
        message = f"YAML file larger than {MAX_BYTES} bytes is not read. Split it or exclude it."
        return Parsed((), (Diagnostic("error", "yaml-too-large", 0, message, cut=True),))
    text, diagnostics = decode(data)
    builder = _Builder(list(diagnostics), scalar)
    builder.read(text)
    return Parsed(tuple(builder.documents), shortened(builder.diagnostics, MAX_DIAGNOSTICS))


def plain(node: Node) -> Any:
    """Return a node as plain data: dict, list, text, number, boolean or None."""
    if isinstance(node, Mapping):
        return {entry.key: plain(entry.value) for entry in node.entries}
    if isinstance(node, Sequence):
        return [plain(item) for item in node.items]
    return node.value


class _Builder:
    """Turns parser events into trees."""

    def __init__(self, diagnostics: list[Diagnostic], scalar: Callable[[str], PlainScalar]) -> None:
        self._typed = scalar
        self.documents: list[Node] = []
        self.diagnostics = diagnostics
        self._stack: list[_Frame] = []
        self._anchors: dict[str, _Built] = {}
        self._nodes = 0

    def read(self, text: str) -> None:
        """Consume all events of `text`; never raises on content."""
        line = 0
        try:
            for event in _events(text):
                line = event.start_mark.line + 1
                self._take(event, line)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            at, deep = mark.line + 1 if mark else line, error.problem == _OWN_BOUND
            problem = _TOO_DEEP if deep else f"Invalid YAML: {error.problem or error.context}"
            self._report(
                "error", _LIMIT if deep else "yaml-syntax", at, f"{problem}. What follows this line is not read."
            )
        except (yaml.YAMLError, UnicodeError, ValueError) as error:
            problem = str(error).splitlines()[0] if str(error) else "unreadable"
            self._report("error", "yaml-syntax", line, f"Invalid YAML: {problem[:200]}. The rest is not read.")
        except _LimitError as error:
            self._report("error", _LIMIT, line, f"{error}. What follows this line is not read.")
        self._close_all()

    def _take(self, event: Any, line: int) -> None:
        """Handle one parser event."""
        if isinstance(event, yaml.ScalarEvent):
            self._add(self._scalar(event, line), event.anchor)
        elif isinstance(event, yaml.AliasEvent):
            self._add(self._aliased(str(event.anchor), line), None)
        elif isinstance(event, yaml.MappingStartEvent | yaml.SequenceStartEvent):
            self._open(event, line)
        elif isinstance(event, yaml.CollectionEndEvent):
            self._close()
        elif isinstance(event, yaml.DocumentStartEvent):
            self._anchors.clear()

    def _open(self, event: Any, line: int) -> None:
        if len(self._stack) >= MAX_DEPTH:
            raise _LimitError(_TOO_DEEP)
        if event.tag and not event.tag.startswith((_CORE + "map", _CORE + "seq", _CORE + "omap")):
            self._unknown_tag(event.tag, line)
        self._stack.append(_Frame(isinstance(event, yaml.MappingStartEvent), line, event.anchor))

    def _close(self) -> None:
        frame = self._stack.pop()
        node = self._mapping(frame) if frame.is_map else _sequence(frame)
        size = 1 + sum(child.size for child in frame.children)
        height = 1 + max((child.height for child in frame.children), default=0)
        self._add(_Built(node, size, height), frame.anchor)

    def _close_all(self) -> None:
        """Finish what an error left open, so that it is not lost."""
        while self._stack:
            self._nodes = 0
            self._close()

    def _add(self, built: _Built, anchor: str | None) -> None:
        """Give a finished node to the collection around it, or to the list of documents."""
        self._nodes += built.size if built.height == 1 else 1
        if self._nodes > MAX_NODES:
            message = f"YAML has more than {MAX_NODES} values"
            raise _LimitError(message)
        if anchor is not None:
            self._anchors[anchor] = built
        if self._stack:
            self._stack[-1].children.append(built)
        elif not (isinstance(built.node, Scalar) and built.node.value is None):
            self.documents.append(built.node)

    def _aliased(self, anchor: str, line: int) -> _Built:
        """Return the node that an alias repeats, as long as the expanded tree stays small."""
        built = self._anchors.get(anchor)
        if built is None:
            self._report("warning", "yaml-unknown-alias", line, f"Alias *{anchor} has no anchor; read as null.")
            return _Built(Scalar(None, line, ""))
        self._nodes += built.size
        if self._nodes > MAX_NODES or len(self._stack) + built.height > MAX_DEPTH:
            message = f"YAML alias *{anchor} expands beyond {MAX_NODES} values or {MAX_DEPTH} levels"
            raise _LimitError(message)
        return built

    def _scalar(self, event: Any, line: int) -> _Built:
        tag = event.tag or ""
        value: PlainScalar = event.value
        if tag in _ANGLES or tag.startswith((_CORE + "int", _CORE + "float", _CORE + "bool", _CORE + "null")):
            value = self._typed(event.value)
        elif tag and tag not in {"!", _CORE + "str"}:
            self._unknown_tag(tag, line)
        elif event.implicit[0]:
            value = self._typed(event.value)
        local = "" if tag.startswith(_CORE) else tag
        return _Built(Scalar(value, line, event.value, local, event.start_mark.column + 1))

    def _mapping(self, frame: _Frame) -> Mapping:
        """Pair keys with values; a key without a value (cut file) has value null."""
        entries: list[Entry] = []
        merged: list[Mapping] = []
        nodes = [child.node for child in frame.children]
        for position in range(0, len(nodes), 2):
            key = nodes[position]
            value = nodes[position + 1] if position + 1 < len(nodes) else Scalar(None, key.line, "")
            if not isinstance(key, Scalar):
                self._report("warning", "yaml-complex-key", key.line, "A key that is a collection is skipped.")
            elif key.text == "<<":
                merged.extend(_mappings(value))
            else:
                entries.append(Entry(key.text, value, key.line, key.column))
        lines = self._key_lines(entries)
        for mapping in merged:
            for entry in mapping.entries:
                if entry.key not in lines:
                    lines[entry.key] = entry.line
                    entries.append(entry)
        return Mapping(tuple(entries), frame.line)

    def _key_lines(self, entries: list[Entry]) -> dict[str, int]:
        """Return the line of each key, and report duplicates."""
        lines: dict[str, int] = {}
        for entry in entries:
            if entry.key in lines:
                message = f"Key '{entry.key[:80]}' repeats line {lines[entry.key]}. Merge the two or remove one."
                self._report("warning", "yaml-duplicate-key", entry.line, message)
            lines[entry.key] = entry.line
        return lines

    def _unknown_tag(self, tag: str, line: int) -> None:
        message = f"Tag '{tag[:80]}' is not interpreted; the value is read as plain data."
        self._report("warning", "yaml-unknown-tag", line, message)

    def _report(self, severity: Any, code: str, line: int, message: str) -> None:
        self.diagnostics.append(Diagnostic(severity, code, line, message, cut=code == _LIMIT))


def _events(text: str) -> Iterator[Any]:
    """Yield parser events and free the parser afterwards."""
    loader = _LOADER(text)
    try:
        while loader.check_event():
            yield loader.get_event()
    finally:
        loader.dispose()


def _sequence(frame: _Frame) -> Sequence:
    return Sequence(tuple(child.node for child in frame.children), frame.line)


def _mappings(node: Node) -> list[Mapping]:
    """Return the mappings that a merge key `<<` brings in."""
    if isinstance(node, Mapping):
        return [node]
    items = node.items if isinstance(node, Sequence) else ()
    return [item for item in items if isinstance(item, Mapping)]
