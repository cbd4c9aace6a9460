"""xacro expanded over the files of a tree; nothing is run.

Source: the xacro wiki page. Bounded in elements, nesting and includes; what is not known statically keeps `{name}`,
and of a condition that is not known both branches are taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, Protocol

from ecm_parsers.xml_tree import line_of, local_name, parse_xml
from lxml import etree

from ecm_extract.description.element import Element
from ecm_extract.description.macros import Macro, MacroParameter, macro_parameters
from ecm_extract.description.symbols import Block, Raw, Symbols
from ecm_extract.description.xacro_text import UnknownPart, XacroText

MAX_ELEMENTS = 60_000
MAX_STEPS = 120_000
MAX_NESTING = 100
MAX_INCLUDES = 200
MAX_PROBLEMS = 40
_BARE = frozenset({"property", "macro", "include", "if", "unless", "insert_block", "arg"})
"""Elements that early xacro files write without the prefix."""


class Files(Protocol):
    """The files of a tree, as descriptions name them."""

    def share(self, package: str) -> str | None:
        """Return the marked path of a package, None when the tree does not hold it."""

    def folder(self, path: str) -> str:
        """Return the marked path of the folder of a file."""

    def find(self, text: str) -> str | None:
        """Return the path in the tree of a marked path."""

    def read(self, path: str) -> bytes | None:
        """Return the bytes of a file of the tree."""


class ExpansionStoppedError(Exception):
    """The expansion exceeds a bound and stops."""


class Xacro:
    """One expansion.

    Attributes:
        problems: (path, line, message) of what could not be expanded. files_read: in order.
    """

    def __init__(self, files: Files, arguments: Mapping[str, str]) -> None:
        self.files = files
        self.arguments = dict(arguments)
        self.problems: list[tuple[str, int, str]] = []
        self.files_read: list[str] = []
        self._macros: dict[str, Macro] = {}
        self._place = ("", 0)
        self._count = 0
        self._nesting = 0
        self._prefix = ""
        self._text = XacroText(self.arguments, self._substitute, self._read_named, self._problem)
        self.symbols = Symbols(self._text.value)
        self._handlers: dict[str, Callable[[etree._Element, str, Symbols], list[Element]]] = {
            "property": self._property,
            "macro": self._macro,
            "include": self._include,
            "arg": self._argument,
            "if": self._condition,
            "unless": self._condition,
            "insert_block": self._insert,
            "call": self._dynamic_call,
            "element": self._element,
            "attribute": lambda *_: [],
        }

    def expand(self, path: str) -> Element | None:
        """Return the expanded root of a file, None when it cannot be read."""
        root = self._root(path)
        if root is None:
            return None
        try:
            made = self._plain(root, path, self.symbols)
        except ExpansionStoppedError:
            return None
        except RecursionError:
            self._problem("elements nest too deeply; flatten them")
            return None
        return made

    def _root(self, path: str) -> etree._Element | None:
        data = self.files.read(path)
        if data is None:
            return None
        self.files_read.append(path)
        tree = parse_xml(data)
        for entry in tree.diagnostics:
            self._place = (path, entry.line)
            self._problem(entry.message)
        return tree.root

    # --- elements ----------------------------------------------------------------------------------------------

    def _below(self, parent: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        return [made for child in parent if isinstance(child.tag, str) for made in self._any(child, path, symbols)]

    def _any(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        self._count += 1
        self._place = (path, line_of(element))
        if self._count > MAX_STEPS:
            self._stop(
                f"the description expands to more than {MAX_STEPS} elements; macros may call each other for ever"
            )
        name = local_name(element)
        if _is_xacro(element) or (name in _BARE and _is_bare(element)):
            handler = self._handlers.get(name)
            return handler(element, path, symbols) if handler is not None else self._call(name, element, path, symbols)
        if name in self._macros and not _has_namespace(element) and self._is_old_call(name, element):
            return self._call(name, element, path, symbols)
        return [self._plain(element, path, symbols)]

    def _is_old_call(self, name: str, element: etree._Element) -> bool:
        """Early xacro calls macros without the prefix; URDF elements of the same name are no calls."""
        return name not in _URDF and {entry.name for entry in self._macros[name].parameters} >= set(element.attrib)

    def _plain(self, element: etree._Element, path: str, symbols: Symbols) -> Element:
        made = Element(
            local_name(element),
            {_bare_name(name): self._text.text(str(value), symbols) for name, value in element.attrib.items()},
            path,
            line_of(element),
            self._text.text(element.text or "", symbols) if element.text and element.text.strip() else "",
        )
        for child in element:
            if isinstance(child.tag, str) and _is_xacro(child) and local_name(child) == "attribute":
                made.attributes[str(child.get("name"))] = self._text.text(str(child.get("value", "")), symbols)
        made.children = self._nested(lambda: self._below(element, path, symbols))
        return made

    def _nested(self, work: Callable[[], list[Element]]) -> list[Element]:
        if self._nesting > MAX_NESTING:
            self._stop("macros or elements nest too deeply; a macro may call itself")
        self._nesting += 1
        try:
            return work()
        finally:
            self._nesting -= 1

    # --- definitions -------------------------------------------------------------------------------------------

    def _property(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = self._prefix + str(element.get("name", ""))
        target = {"global": symbols.top(), "parent": symbols.parent or symbols}.get(str(element.get("scope")), symbols)
        value = element.get("value")
        if value is None and element.get("default") is not None:
            if name in symbols:
                return []
            value = element.get("default")
        if value is None:
            children = [child for child in element if isinstance(child.tag, str)]
            target.own[name] = Block(children, path, symbols) if children else (element.text or "")
        elif target is symbols and "${" in str(value) and name not in str(value):
            target.own[name] = Raw(str(value), symbols)
        else:
            target.own[name] = self._text.value(str(value), symbols)
        return []

    def _macro(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = str(element.get("name", "")).removeprefix("xacro:")
        self._macros[self._prefix + name] = Macro(name, macro_parameters(str(element.get("params", ""))), element, path)
        return []

    def _argument(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name, default = str(element.get("name", "")), element.get("default")
        if name not in self.arguments and default is not None:
            self.arguments[name] = self._text.text(str(default), symbols)
        return []

    def _include(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = self._text.text(str(element.get("filename", "")), symbols)
        found = self._find(name, path)
        if found is None:
            if element.get("optional") not in {"1", "true", "True"}:
                self._problem(f"included file `{name.removeprefix('tree:')}` is not in the tree")
            return []
        if len(self.files_read) > MAX_INCLUDES:
            self._stop("files include each other without end")
        root = self._root(found)
        if root is None:
            return []
        outer, namespace = self._prefix, element.get("ns")
        self._prefix = f"{outer}{namespace}." if namespace else outer
        try:
            return self._nested(lambda: self._below(root, found, symbols))
        finally:
            self._prefix = outer

    # --- control -----------------------------------------------------------------------------------------------

    def _condition(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        value = self._text.value(str(element.get("value", "")), symbols)
        holds = _truth(value)
        wanted = local_name(element) == "if"
        if holds is None:
            found = self._nested(lambda: self._below(element, path, symbols))
            for made in found:
                made.conditional = made.conditional or f"{'' if wanted else 'not '}{str(value).strip('{}')}"
            return found
        return self._nested(lambda: self._below(element, path, symbols)) if holds is wanted else []

    def _insert(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = self._text.text(str(element.get("name", "")), symbols)
        block = symbols.get(name) or symbols.get(f"**{name}") or symbols.get(f"*{name}")
        if not isinstance(block, Block):
            self._problem(f"block `{name}` is not defined here")
            return []
        return self._nested(
            lambda: [made for child in block.elements for made in self._any(child, block.path, block.symbols)]
        )

    def _element(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        made = self._plain(element, path, symbols)
        made.tag = made.attributes.pop("xacro:name", "") or made.attributes.pop("name", "") or made.tag
        return [made]

    # --- calls -------------------------------------------------------------------------------------------------

    def _dynamic_call(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        return self._call(self._text.text(str(element.get("macro", "")), symbols), element, path, symbols)

    def _call(self, name: str, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        macro = self._macros.get(self._prefix + name) or self._macros.get(name) or self._macros.get(_written(element))
        if macro is None:
            self._problem(f"macro `{name}` is not defined")
            return []
        inner = Symbols(self._text.value, symbols)
        blocks = iter([child for child in element if isinstance(child.tag, str)])
        for parameter in macro.parameters:
            self._bind(parameter, element, path, inner, blocks)
        return self._nested(lambda: self._below(macro.body, macro.path, inner))

    def _bind(
        self,
        parameter: MacroParameter,
        element: etree._Element,
        path: str,
        inner: Symbols,
        blocks: Iterator[etree._Element],
    ) -> None:
        symbols = inner.parent or inner
        if parameter.block:
            block = next(blocks, None)
            if block is not None:
                inner.own[parameter.name] = Block(self._inserted(parameter, block), path, symbols)
            return
        given = element.get(parameter.name)
        if given is not None:
            inner.own[parameter.name] = self._text.value(str(given), symbols)
        elif parameter.forward and parameter.name in symbols:
            inner.own[parameter.name] = symbols[parameter.name]
        elif parameter.default is not None:
            inner.own[parameter.name] = self._text.value(parameter.default, inner)
        else:
            self._problem(f"`{parameter.name}` is not given to macro `{local_name(element)}`")
            inner.own[parameter.name] = UnknownPart("{" + parameter.name + "}")

    def _inserted(self, parameter: MacroParameter, block: etree._Element) -> list[etree._Element]:
        if parameter.block == "*":
            return [block]
        return [child for child in block if isinstance(child.tag, str)]

    # --- files -------------------------------------------------------------------------------------------------

    def _find(self, name: str, path: str) -> str | None:
        if isinstance(name, UnknownPart):
            return None
        return self.files.find(name if name.startswith("tree:") else f"{self.files.folder(path)}/{name}")

    def _read_named(self, name: str) -> bytes | None:
        found = self._find(name, self._place[0])
        if found is None:
            self._problem(f"file `{name.removeprefix('tree:')}` is not in the tree")
        return self.files.read(found) if found is not None else None

    def _substitute(self, word: str, rest: str) -> str | None:
        if word == "find":
            share = self.files.share(rest)
            return share if share is not None else None
        if word == "dirname":
            return self.files.folder(self._place[0])
        if word == "optenv" and " " in rest:
            return rest.split(" ", 1)[1]
        return "" if word == "optenv" else None

    def _problem(self, message: str) -> None:
        entry = (*self._place, message)
        if len(self.problems) < MAX_PROBLEMS and entry not in self.problems:
            self.problems.append(entry)

    def _stop(self, message: str) -> None:
        self._problem(message)
        raise ExpansionStoppedError


_URDF = frozenset(
    {"robot", "link", "joint", "origin", "visual", "collision", "inertial", "geometry", "material", "limit", "axis"}
    | {"parent", "child", "mass", "inertia", "mesh", "box", "cylinder", "sphere", "gazebo", "plugin", "sensor"}
    | {"transmission", "actuator", "param", "hardware", "ros2_control"}
)


def _truth(value: Any) -> bool | None:
    if isinstance(value, UnknownPart):
        return None
    if isinstance(value, str):
        bare = value.strip().lower()
        return {"true": True, "false": False, "1": True, "0": False, "": False}.get(bare)
    return bool(value)


def _is_xacro(element: etree._Element) -> bool:
    tag = str(element.tag)
    if tag.startswith("{"):
        return "xacro" in tag[1:].split("}")[0].rsplit("/", 1)[-1]
    return tag.startswith("xacro:")


def _has_namespace(element: etree._Element) -> bool:
    return str(element.tag).startswith("{")


def _is_bare(element: etree._Element) -> bool:
    """Tell whether an element without prefix is one of early xacro: a property has a name and a value and so on."""
    name = local_name(element)
    if _has_namespace(element) or not any(uri and "xacro" in uri for uri in element.nsmap.values()):
        return False
    needed = {"property": {"name", "value"}, "macro": {"name"}, "include": {"filename"}, "insert_block": {"name"}}
    return needed.get(name, {"value"} if name in {"if", "unless"} else {"name", "default"}) <= set(element.attrib)


def _written(element: etree._Element) -> str:
    """A macro of an included namespace is called `xacro:ns.name`."""
    return local_name(element)


def _bare_name(name: object) -> str:
    return str(name).rpartition("}")[2]
