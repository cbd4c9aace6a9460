"""Plugin descriptions of pluginlib and nodelet -> the classes that a library offers.

Source: pluginlib `ClassLoader`: roots are `<library>` (several are read) or `<class_libraries>`; a class is
looked up by its `name`, or by its `type` when it has none.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from lxml import etree

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.xml_tree import children, line_of, local_name, parse_xml, text_of


class PluginClass(msgspec.Struct, frozen=True):
    """One `<class>`.

    Attributes:
        lookup_name: what a loader asks for: `name`, or `type` without one.
        type: C++ class, e.g. `pkg::Planner`; white space between its tokens as written.
        base_class_type: C++ base class.
        library: `path` of the library, e.g. `libplanner` or `planner`.
        description: text with white space collapsed.
        line: 1-based.
    """

    lookup_name: str
    type: str
    base_class_type: str
    library: str
    description: str
    line: int


def parse(data: bytes) -> Parsed[tuple[PluginClass, ...]]:
    """Read one plugin description.

    Returns:
        The classes in order of the file, and diagnostics.
    """
    tree = parse_xml(data, many_roots=True)
    problems: list[Diagnostic] = list(tree.diagnostics)
    classes: list[PluginClass] = []
    for library in _libraries(tree.roots, problems):
        classes += _classes(library, problems)
    return Parsed(tuple(classes), tuple(problems))


def _libraries(roots: tuple[etree._Element, ...], problems: list[Diagnostic]) -> Iterator[etree._Element]:
    for root in roots:
        if local_name(root) == "library":
            yield root
        elif local_name(root) == "class_libraries":
            yield from (child for tag, child in children(root) if tag == "library")
        else:
            message = f"<{local_name(root)}> is neither <library> nor <class_libraries>. Correct the root."
            problems.append(Diagnostic("error", "plugin-wrong-root", line_of(root), message))


def _classes(library: etree._Element, problems: list[Diagnostic]) -> Iterator[PluginClass]:
    path = _attribute(library, "path")
    if not path:
        message = 'The library has no path, its classes cannot be loaded. Add path="...".'
        problems.append(Diagnostic("error", "plugin-no-path", line_of(library), message))
    for tag, element in children(library):
        if tag != "class":
            continue
        plugin = _class(element, path)
        if not plugin.type or not plugin.base_class_type:
            message = f"Class `{plugin.lookup_name}` needs type and base_class_type. Add what is missing."
            problems.append(Diagnostic("error", "plugin-incomplete", plugin.line, message))
        if plugin.lookup_name:
            yield plugin


def _class(element: etree._Element, library: str) -> PluginClass:
    kind = _attribute(element, "type")
    described = next((text_of(child) for tag, child in children(element) if tag == "description"), "")
    return PluginClass(
        lookup_name=_attribute(element, "name") or kind,
        type=kind,
        base_class_type=_attribute(element, "base_class_type"),
        library=library,
        description=described,
        line=line_of(element),
    )


def _attribute(element: etree._Element, name: str) -> str:
    return str(element.get(name, "")).strip()
