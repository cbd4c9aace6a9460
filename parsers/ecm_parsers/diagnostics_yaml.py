"""Analyzers of diagnostic_aggregator: which diagnostics are expected, grouped and given up as stale.

Source: wiki.ros.org/diagnostic_aggregator (ROS 1), docs.ros.org diagnostic_aggregator (ROS 2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final, Literal

import msgspec

from ecm_parsers.result import Diagnostic, Parsed, Severity, shortened
from ecm_parsers.yaml_tree import Entry, Mapping, Node, Scalar, Sequence, parse_yaml

MAX_NAMESPACES = 12
MAX_DIAGNOSTICS = 100
_MARKER: Final = "ros__parameters"
_ANALYZERS: Final = "analyzers"
_MAX_NUMBER: Final = 1e18  # an integer of many digits is no double
_ENDINGS: Final = ("Analyzer", "AnalyzerGroup")


class Analyzer(msgspec.Struct, frozen=True):
    """One analyzer.

    Attributes:
        key: its name in the file. type: lookup name of its class, as written. path: where its results are shown.
        line: 1-based, of the key.
        startswith, contains, names, expected, regex: what the diagnostics that it takes are called.
        remove_prefix, find_and_remove_prefix: what is cut off their names; the second one also selects.
        timeout: seconds until a diagnostic is stale; None when the file leaves the default.
        num_items: how many diagnostics must be there. discard_stale: whether stale ones are dropped.
        analyzers: of a group, what it holds.
    """

    key: str
    type: str
    path: str
    line: int
    startswith: tuple[str, ...] = ()
    contains: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    expected: tuple[str, ...] = ()
    regex: tuple[str, ...] = ()
    remove_prefix: tuple[str, ...] = ()
    find_and_remove_prefix: tuple[str, ...] = ()
    timeout: float | None = None
    num_items: int | None = None
    discard_stale: bool | None = None
    analyzers: tuple[Analyzer, ...] = ()


class Aggregator(msgspec.Struct, frozen=True):
    """The parameters of one aggregator node.

    Attributes:
        node: absolute name or pattern; in ROS 1 the namespace in which the file holds it, `/` at the top.
        base_path: put before all paths. pub_rate: in Hz, None when the file leaves the default.
        line: 1-based, of what holds the analyzers.
    """

    node: str
    base_path: str
    pub_rate: float | None
    analyzers: tuple[Analyzer, ...]
    line: int


class DiagnosticsFile(msgspec.Struct, frozen=True):
    """All aggregators that a file configures; `ros` tells which layout it has."""

    ros: Literal[1, 2]
    aggregators: tuple[Aggregator, ...] = ()


def is_diagnostics(data: bytes) -> bool:
    """Tell by its words whether a YAML file may configure an aggregator."""
    return b"Analyzer" in data


def parse_diagnostics(data: bytes) -> Parsed[DiagnosticsFile]:
    """Read the analyzers of a parameter file; nodes without analyzers are left out."""
    tree = parse_yaml(data)
    maps = [document for document in tree.facts if isinstance(document, Mapping)]
    ros: Literal[1, 2] = 2 if any(_has_marker(document, MAX_NAMESPACES) for document in maps) else 1
    reader = _Reader(ros, list(tree.diagnostics))
    found = tuple(each for document in maps for each in reader.aggregators(document, "", MAX_NAMESPACES))
    return Parsed(DiagnosticsFile(ros, found), shortened(reader.problems, MAX_DIAGNOSTICS))


class _Reader:
    """Reads analyzers in one of the layouts and collects what is wrong."""

    def __init__(self, ros: Literal[1, 2], problems: list[Diagnostic]) -> None:
        self.ros = ros
        self.problems = problems

    def aggregators(self, around: Mapping, path: str, depth: int) -> Iterator[Aggregator]:
        """Walk down namespaces to the maps that hold analyzers."""
        holder = _ANALYZERS if self.ros == 1 else _MARKER
        for entry in around.unique() if depth else ():
            if not isinstance(entry.value, Mapping):
                continue
            if entry.key != holder:
                yield from self.aggregators(entry.value, f"{path}/{entry.key.strip('/')}", depth - 1)
            elif self.ros == 1:
                yield from self._aggregator(around, list(entry.value.unique()), path, entry.line)
            else:
                yield from self._aggregator(entry.value, _of_node(entry.value), path, entry.line)

    def _aggregator(self, own: Mapping, entries: list[Entry], path: str, line: int) -> Iterator[Aggregator]:
        if not any(self._is_analyzer(entry) for entry in entries):
            return
        base = _text(own.get("base_path" if self.ros == 1 else "path"))
        yield Aggregator(path or "/", base, _number(own.get("pub_rate")), tuple(self._analyzers(entries)), line)

    def _is_analyzer(self, entry: Entry) -> bool:
        """In ROS 2 any node may have maps with a type; only those of analyzers end so."""
        kind = _text(entry.value.get("type")) if isinstance(entry.value, Mapping) else ""
        return bool(kind) and (self.ros == 1 or kind.endswith(_ENDINGS))

    def _analyzers(self, entries: Iterable[Entry]) -> Iterator[Analyzer]:
        for entry in entries:
            if isinstance(entry.value, Mapping):
                analyzer = self._analyzer(entry, entry.value)
                self._check(analyzer)
                yield analyzer

    def _analyzer(self, entry: Entry, own: Mapping) -> Analyzer:
        held = own.get(_ANALYZERS)
        return Analyzer(
            key=entry.key,
            type=_text(own.get("type")),
            path=_text(own.get("path")),
            line=entry.line,
            startswith=self._texts(own, "startswith"),
            contains=self._texts(own, "contains"),
            names=self._texts(own, "name"),
            expected=self._texts(own, "expected"),
            regex=self._texts(own, "regex"),
            remove_prefix=self._texts(own, "remove_prefix"),
            find_and_remove_prefix=self._texts(own, "find_and_remove_prefix"),
            timeout=self._timeout(own),
            num_items=_whole(own.get("num_items")),
            discard_stale=_flag(own.get("discard_stale")),
            analyzers=tuple(self._analyzers(held.unique())) if isinstance(held, Mapping) else (),
        )

    def _texts(self, own: Mapping, key: str) -> tuple[str, ...]:
        """A list of names, or one name: in ROS 2 the node dies of the latter."""
        value = own.get(key)
        if isinstance(value, Sequence):
            return tuple(item.text for item in value.items if isinstance(item, Scalar))
        if not isinstance(value, Scalar) or value.value is None:
            return ()
        if self.ros == 2:
            message = f"`{key}` is one value where ROS 2 needs a list. Put it in brackets."
            self._report("error", "diagnostics-not-a-list", value.line, message)
        return (value.text,)

    def _timeout(self, own: Mapping) -> float | None:
        value = own.get("timeout")
        if self.ros == 2 and isinstance(value, Scalar) and type(value.value) is int:
            message = f"`timeout` is an integer where ROS 2 needs a double. Write {value.text[:20]}.0."
            self._report("error", "diagnostics-not-a-double", value.line, message)
        return _number(value)

    def _check(self, found: Analyzer) -> None:
        """Report what the aggregator refuses to load."""
        missing = [name for name, value in (("type", found.type), ("path", found.path)) if not value]
        if missing:
            message = (
                f"Analyzer `{found.key[:80]}` has no {' and no '.join(missing)} and is not loaded. Add what is missing."
            )
            self._report("error", "diagnostics-incomplete", found.line, message)
        elif found.type.endswith("AnalyzerGroup") and not found.analyzers:
            message = f"Group `{found.key[:80]}` holds no analyzers and is not loaded. Add some below `analyzers`."
            self._report("error", "diagnostics-empty-group", found.line, message)
        elif found.type.endswith("GenericAnalyzer") and not _selects(found):
            message = f"Analyzer `{found.key[:80]}` takes no diagnostics. Add startswith, contains, expected or regex."
            self._report("error", "diagnostics-selects-nothing", found.line, message)

    def _report(self, severity: Severity, code: str, line: int, message: str) -> None:
        self.problems.append(Diagnostic(severity, code, line, message))


def _of_node(parameters: Mapping) -> list[Entry]:
    """The analyzers of a ROS 2 node stand among its parameters, or below `analyzers` there."""
    held = parameters.get(_ANALYZERS)
    below = held.unique() if isinstance(held, Mapping) else ()
    own = (entry for entry in parameters.unique() if entry.key != _ANALYZERS)
    return [*(entry for entry in own if isinstance(entry.value, Mapping) and entry.value.get("type")), *below]


def _selects(found: Analyzer) -> bool:
    return any(
        (found.startswith, found.contains, found.names, found.expected, found.regex, found.find_and_remove_prefix)
    )


def _has_marker(node: Node, depth: int) -> bool:
    if not isinstance(node, Mapping) or not depth:
        return False
    return any(entry.key == _MARKER or _has_marker(entry.value, depth - 1) for entry in node.entries)


def _text(node: Node | None) -> str:
    return node.text.strip() if isinstance(node, Scalar) and node.value is not None else ""


def _number(node: Node | None) -> float | None:
    value = node.value if isinstance(node, Scalar) else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value) if abs(value) < _MAX_NUMBER else None


def _whole(node: Node | None) -> int | None:
    value = node.value if isinstance(node, Scalar) else None
    return value if isinstance(value, int) and not isinstance(value, bool) else None


def _flag(node: Node | None) -> bool | None:
    value = node.value if isinstance(node, Scalar) else None
    return value if isinstance(value, bool) else None
