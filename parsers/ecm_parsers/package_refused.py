"""A package.xml that is XML and that catkin_pkg refuses, and with it catkin, colcon and bloom (REP 127, 140, 149)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Final, TypeAlias

from lxml import etree

from ecm_parsers.result import Diagnostic, diagnostic
from ecm_parsers.xml_tree import children, line_of, parse_xml, text_of

CODE: Final = "package-refused"
_RANGES: Final = frozenset({"version_lt", "version_lte", "version_eq", "version_gte", "version_gt"})
_NONE: Final[frozenset[str]] = frozenset()
_OF_EVERY: Final = {
    "name": _NONE,
    "version": frozenset({"compatibility"}),
    "description": _NONE,
    "maintainer": frozenset({"email"}),
    "license": _NONE,
    "url": frozenset({"type"}),
    "author": frozenset({"email"}),
    "export": _NONE,
}
_DEPENDS: Final = ("build_depend", "buildtool_depend", "test_depend", "conflict", "replace")
_DEPENDS_1: Final = (*_DEPENDS, "run_depend")
_EXPORTS: Final = ("build_export_depend", "buildtool_export_depend")
_DEPENDS_2: Final = (*_DEPENDS, *_EXPORTS, "depend", "exec_depend", "doc_depend")
_CONDITION: Final = frozenset({"condition"})
_TAGS: Final = {
    1: {**_OF_EVERY, **dict.fromkeys(_DEPENDS_1, _RANGES)},
    2: {**_OF_EVERY, **dict.fromkeys(_DEPENDS_2, _RANGES)},
    3: {
        **_OF_EVERY,
        **dict.fromkeys(_DEPENDS_2, _RANGES | _CONDITION),
        **dict.fromkeys(("group_depend", "member_of_group"), _CONDITION),
        "license": frozenset({"file"}),
    },
}
"""The tags of each format with their attributes."""
_ONCE: Final = frozenset({"name", "version", "description", "export"})
_FREE: Final = frozenset({"description", "export"})
"""Tags that may hold others."""
_INSTEAD: Final = {"run_depend": "<exec_depend>", "exec_depend": "<run_depend>, or say format 2"}
_NAME: Final = re.compile(r"[a-zA-Z0-9][a-zA-Z0-9_-]*")
_OF_ITSELF: Final = frozenset({*_DEPENDS_1, *_DEPENDS_2} - {"conflict", "replace"})
_COVERED_1: Final = (frozenset({"build_depend", "run_depend"}), frozenset({"test_depend"}))
_COVERED_2: Final = (frozenset({"depend"}), frozenset({"build_depend", "build_export_depend", "exec_depend"}))

_Elements: TypeAlias = Sequence[tuple[str, etree._Element]]


def is_package_name(name: str) -> bool:
    """Tell whether a package can have a name: letters, digits, underscores and dashes."""
    return _NAME.fullmatch(name) is not None


def refused_manifest(data: bytes) -> Diagnostic | None:
    """Return the first problem for which no build tool takes a package.xml; None where it is no manifest at all."""
    root = parse_xml(data).root
    if root is None or root.tag != "package":
        return None
    written = str(root.get("format", "1")).strip()
    elements = tuple(children(root))
    if not written.isdecimal() or int(written) not in _TAGS:
        return _problem(root, f"there is no format '{written[:20]}'", "Say format 1, 2 or 3")
    form = int(written)
    found = chain(_unknown(elements, form), _repeated(elements), _names(elements), _covered(elements, form))
    return min(found, key=lambda each: each.line, default=None)


def _unknown(elements: _Elements, form: int) -> Iterator[Diagnostic]:
    """Tags, attributes and elements within tags that a format does not have."""
    known = _TAGS[form]
    for tag, element in elements:
        if tag not in known:
            yield _problem(element, f"format {form} has no <{tag}>", f"Write {_INSTEAD.get(tag, 'what it has')}")
            continue
        for key in map(str, element.attrib):
            if key not in known[tag] and "}" not in key and ":" not in key:
                yield _problem(element, f"<{tag}> of format {form} has no attribute '{key}'", "Remove it")
        if tag not in _FREE and any(True for _ in children(element)):
            yield _problem(element, f"<{tag}> holds another element", "Close it before")


def _repeated(elements: _Elements) -> Iterator[Diagnostic]:
    seen = Counter[str]()
    for tag, element in elements:
        seen[tag] += 1
        if tag in _ONCE and seen[tag] == 2:
            yield _problem(element, f"there is more than one <{tag}>", "Keep one")


def _names(elements: _Elements) -> Iterator[Diagnostic]:
    """A name that no package can have, and a package that depends on itself."""
    name = next(((text_of(element), element) for tag, element in elements if tag == "name"), None)
    if name is None or not name[0]:
        return
    if not is_package_name(name[0]):
        yield _problem(name[1], f"no package can be called '{name[0][:80]}'", "Use letters, digits and underscores")
    for tag, element in elements:
        if tag in _OF_ITSELF and text_of(element) == name[0]:
            yield _problem(element, f"the package has a <{tag}> on itself", "Remove it")


def _covered(elements: _Elements, form: int) -> Iterator[Diagnostic]:
    """Dependencies that another one of the same package holds already, whatever their conditions."""
    wide, narrow = _COVERED_1 if form == 1 else _COVERED_2
    covering = {text_of(element) for tag, element in elements if tag in wide}
    for tag, element in elements:
        if tag in narrow and text_of(element) in covering:
            yield _problem(element, f"another tag has the <{tag}> on {text_of(element)[:80]} already", "Keep one")


def _problem(element: etree._Element, wrong: str, advice: str) -> Diagnostic:
    return diagnostic("error", CODE, line_of(element), wrong, advice)
