"""`ecm.yaml` beside a package.xml: what people declare of modules because no tool can know it.

schema: ecm-extract/overlay/1
defaults: {name: lab, recovery: {escalation: [failure -> operator]}}
all: {permissions: {audit: standard}}
modules:
  base_driver: {behavior: {preconditions: [battery_charged]}}

`origin: observed` says that nobody declares this: it was seen, and `endpoints` of a module then give names and policies
that its contract leaves open.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

import msgspec

from ecm_parsers.result import Diagnostic, Parsed, diagnostic
from ecm_parsers.yaml_tree import Entry, Mapping, Node, Scalar, Sequence, parse_yaml, plain

SCHEMA: Final = "ecm-extract/overlay/1"
SECTIONS: Final = ("signature", "behavior", "resources", "permissions", "recovery", "versioning")
ORIGINS: Final = ("declared", "observed")
ENDPOINTS: Final = "endpoints"
_KEYS: Final = ("schema", "origin", "defaults", "all", "modules")


class Declared(msgspec.Struct, frozen=True):
    """One field that a person declares: section and field name, the value as data, its 1-based line."""

    section: str
    field: str
    value: Any
    line: int


class SeenEndpoint(msgspec.Struct, frozen=True):
    """An endpoint as it was seen, with its 1-based line.

    Attributes:
        role: as in a contract. was: name in the contract, with its holes. name: as seen.
        type: as seen; None when nobody told it. qos: policies as seen, by their names in a contract.
    """

    role: str
    was: str
    name: str
    type: str | None
    qos: dict[str, Any]
    line: int


class ModuleOverlay(msgspec.Struct, frozen=True):
    """What is declared of one module, named as in `module_id` or by its last part."""

    module: str
    fields: tuple[Declared, ...]
    line: int
    endpoints: tuple[SeenEndpoint, ...] = ()


class Overlay(msgspec.Struct, frozen=True):
    """One file.

    Attributes:
        default_name: name of the defaults; empty without. defaults: for fields that nothing else fills.
        everywhere: declared of every module of the package. modules: of single ones.
        origin: `declared` by a person, or `observed`.
    """

    default_name: str = ""
    defaults: tuple[Declared, ...] = ()
    everywhere: tuple[Declared, ...] = ()
    modules: tuple[ModuleOverlay, ...] = ()
    origin: str = "declared"


def parse_overlay(data: bytes) -> Parsed[Overlay]:
    """Read an overlay; a key that means nothing is a diagnostic and costs nothing else."""
    tree = parse_yaml(data)
    problems = list(tree.diagnostics)
    root = next(iter(tree.facts), None)
    if root is None:
        return Parsed(Overlay(), tuple(problems))
    if not isinstance(root, Mapping):
        advice = "Write `modules:` with a map"
        problems.append(_problem("overlay-not-a-map", root.line, "The overlay is no map", advice))
        return Parsed(Overlay(), tuple(problems))
    for entry in root.entries:
        if entry.key not in _KEYS:
            advice = f"Write one of {', '.join(_KEYS)}"
            problems.append(_problem("overlay-unknown-key", entry.line, f"`{entry.key}` means nothing here", advice))
    if not _is_ours(root, problems):
        return Parsed(Overlay(), tuple(problems))
    defaults = root.get("defaults")
    return Parsed(
        Overlay(
            default_name=_name(defaults),
            defaults=tuple(_fields(defaults, "defaults", problems, skipped="name")),
            everywhere=tuple(_fields(root.get("all"), "all", problems)),
            modules=tuple(_modules(root.get("modules"), problems)),
            origin=_origin(root.get("origin"), problems),
        ),
        tuple(problems),
    )


def _is_ours(root: Mapping, problems: list[Diagnostic]) -> bool:
    """A file that does not say what it is is read all the same; one that says it is something else is not."""
    schema = root.get("schema")
    if schema is None:
        problems.append(_problem("overlay-schema", root.line, "`schema` is missing", f"Begin with `schema: {SCHEMA}`"))
        return True
    if isinstance(schema, Scalar) and schema.text == SCHEMA:
        return True
    shown = f"`{schema.text}`" if isinstance(schema, Scalar) else "no text"
    wrong = f"The schema is {shown}, so nothing of this file is used"
    problems.append(_problem("overlay-schema", schema.line, wrong, f"Write `schema: {SCHEMA}`"))
    return False


def _entries(node: Node | None, what: str, problems: list[Diagnostic]) -> Iterator[Entry]:
    """Entries of a map; nothing of what is left empty, and a diagnostic for what is something else."""
    if isinstance(node, Mapping):
        yield from node.unique()
    elif node is not None and plain(node) is not None:
        advice = "Write `key: value` lines below it"
        problems.append(_problem("overlay-not-a-map", node.line, f"{what} is no map", advice))


def _modules(node: Node | None, problems: list[Diagnostic]) -> Iterator[ModuleOverlay]:
    for entry in _entries(node, "`modules`", problems):
        fields = tuple(_fields(entry.value, entry.key, problems, skipped=ENDPOINTS))
        yield ModuleOverlay(entry.key, fields, entry.line, tuple(_endpoints(entry.value, problems)))


def _endpoints(node: Node, problems: list[Diagnostic]) -> Iterator[SeenEndpoint]:
    seen = node.get(ENDPOINTS) if isinstance(node, Mapping) else None
    for item in seen.items if isinstance(seen, Sequence) else ():
        data = plain(item)
        found = data if isinstance(data, dict) else {}
        if not all(isinstance(found.get(key), str) for key in ("role", "was", "name")):
            wrong, advice = "An endpoint needs `role`, `was` and `name`", "`ecm-extract observe --complete` writes them"
            problems.append(_problem("overlay-endpoint", item.line, wrong, advice))
            continue
        kind, qos = found.get("type"), found.get("qos")
        yield SeenEndpoint(
            found["role"],
            found["was"],
            found["name"],
            kind if isinstance(kind, str) else None,
            qos if isinstance(qos, dict) else {},
            item.line,
        )


def _origin(node: Node | None, problems: list[Diagnostic]) -> str:
    text = node.text if isinstance(node, Scalar) else ORIGINS[0]
    if text in ORIGINS:
        return text
    line, wrong = node.line if node is not None else 1, f"`origin: {text}` means nothing"
    problems.append(_problem("overlay-unknown-origin", line, wrong, f"Write one of {', '.join(ORIGINS)}"))
    return ORIGINS[0]


def _fields(node: Node | None, what: str, problems: list[Diagnostic], skipped: str = "") -> Iterator[Declared]:
    for section in _entries(node, f"`{what}`", problems):
        if section.key == skipped:
            continue
        if section.key not in SECTIONS:
            wrong, advice = f"`{section.key}` is no section of a contract", f"Write one of {', '.join(SECTIONS)}"
            problems.append(_problem("overlay-unknown-section", section.line, wrong, advice))
            continue
        yield from _of_section(section, problems)


def _of_section(section: Entry, problems: list[Diagnostic]) -> Iterator[Declared]:
    for entry in _entries(section.value, f"`{section.key}`", problems):
        value = plain(entry.value)
        if value is not None:  # a field without a value stays undeclared
            yield Declared(section.key, entry.key, value, entry.line)


def _name(node: Node | None) -> str:
    name = node.get("name") if isinstance(node, Mapping) else None
    return name.text if isinstance(name, Scalar) else ""


def _problem(code: str, line: int, wrong: str, advice: str) -> Diagnostic:
    return diagnostic("error", code, line, wrong, advice)
