"""Declarations for `generate_parameter_library`: one YAML file becomes a struct of typed parameters.

Source: generate_parameter_library, README ("YAML Syntax").
"""

from __future__ import annotations

from typing import Any

import msgspec

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.yaml_tree import Entry, Mapping, Scalar, parse_yaml, plain

_MAP = "__map_"
_BASE_TYPES = frozenset({"bool", "int", "double", "string"})


class ParameterDeclaration(msgspec.Struct, frozen=True):
    """One declared parameter.

    Attributes:
        name: dotted; an entry of `__map_joints` is the hole `{joints}`, filled from parameter `joints`.
        type: as declared, e.g. `double`, `string_array`, `double_array_fixed_6`, `none`.
        default: plain data; None when there is none (see `has_default`).
        has_default: whether a default is declared: a parameter without one must be set.
        description: text for people.
        read_only: whether it can only be set at start.
        validation: validator name without `<>` -> arguments.
        additional_constraints: free text.
        line: 1-based.
    """

    name: str
    type: str
    line: int
    default: Any = None
    has_default: bool = False
    description: str = ""
    read_only: bool = False
    validation: dict[str, Any] = {}
    additional_constraints: str = ""


class ParameterNamespace(msgspec.Struct, frozen=True):
    """A generated struct: the top-level key of the file and its parameters."""

    name: str
    line: int
    parameters: tuple[ParameterDeclaration, ...] = ()


def parse_parameter_library(data: bytes) -> Parsed[tuple[ParameterNamespace, ...]]:
    """Read a parameter declaration file; normally it holds one namespace."""
    tree = parse_yaml(data)
    diagnostics = list(tree.diagnostics)
    namespaces: list[ParameterNamespace] = []
    for document in tree.facts:
        if not isinstance(document, Mapping):
            message = "A parameter declaration file must be a map with one namespace on top."
            diagnostics.append(Diagnostic("error", "gpl-not-a-map", document.line, message))
            continue
        for entry in document.unique():
            found: list[ParameterDeclaration] = []
            _read(entry, "", found, diagnostics)
            namespaces.append(ParameterNamespace(entry.key, entry.line, tuple(found)))
    return Parsed(tuple(namespaces), tuple(diagnostics))


def _read(group: Entry, prefix: str, found: list[ParameterDeclaration], diagnostics: list[Diagnostic]) -> None:
    """Collect the declarations below `group`."""
    if not isinstance(group.value, Mapping):
        message = f"'{group.key[:80]}' is neither a parameter (it has no 'type') nor a group; it is skipped."
        diagnostics.append(Diagnostic("warning", "gpl-not-a-parameter", group.line, message))
        return
    for entry in group.value.unique():
        name = prefix + _segment(entry.key)
        if _is_leaf(entry):
            found.append(_declaration(name, entry, diagnostics))
        else:
            _read(entry, f"{name}.", found, diagnostics)


def _segment(key: str) -> str:
    """Return the part of a name that a key stands for: `__map_joints` is a hole."""
    return f"{{{key.removeprefix(_MAP)}}}" if key.startswith(_MAP) else key


def _is_leaf(entry: Entry) -> bool:
    """A parameter has a `type` that is text; a group may hold a parameter that is called `type`."""
    return isinstance(entry.value, Mapping) and isinstance(entry.value.get("type"), Scalar)


def _declaration(name: str, entry: Entry, diagnostics: list[Diagnostic]) -> ParameterDeclaration:
    fields = plain(entry.value)
    kind = str(fields.get("type"))
    if not _is_known(kind):
        message = f"Parameter '{name[:80]}' has unknown type '{kind[:40]}'."
        diagnostics.append(Diagnostic("warning", "gpl-unknown-type", entry.line, message))
    return ParameterDeclaration(
        name=name,
        type=kind,
        line=entry.line,
        default=fields.get("default_value"),
        has_default="default_value" in fields,
        description=_text(fields.get("description")),
        read_only=fields.get("read_only") is True,
        validation=_validation(fields.get("validation")),
        additional_constraints=_text(fields.get("additional_constraints")),
    )


def _is_known(kind: str) -> bool:
    """Tell whether `kind` is a type of the generator: a base type, its array, a fixed size, or none."""
    base, _, size = kind.partition("_fixed_")
    if size and not size.isdigit():
        return False
    return kind == "none" or base.removesuffix("_array") in _BASE_TYPES


def _text(value: Any) -> str:
    return "" if value is None else str(value)


def _validation(value: Any) -> dict[str, Any]:
    """Return validators by name, without the template brackets of built-in ones."""
    if not isinstance(value, dict):
        return {}
    return {name.removesuffix("<>"): arguments for name, arguments in value.items()}
