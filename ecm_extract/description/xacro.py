"""xacro expanded over the files of a tree; nothing is run.

Source: the xacro wiki page. Bounded in elements, nesting and includes; what is not known statically keeps `{name}`,
and of a condition that is not known both branches are taken.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.xml_tree import line_of, local_name, parse_xml
from lxml import etree

from ecm_extract.description.element import Element
from ecm_extract.description.macros import Macro, Macros, macro_parameters
from ecm_extract.description.model import Problem, ProblemKind
from ecm_extract.description.symbols import Block, Raw, Symbols, Unknown
from ecm_extract.description.xacro_call import bind
from ecm_extract.description.xacro_expression import XacroExpression
from ecm_extract.description.xacro_files import Files, XacroFiles, is_glob
from ecm_extract.description.xacro_missing import call_problem, include_problem
from ecm_extract.description.xacro_tags import elements, is_control, is_xacro, may_call, own_attributes, xacro_attribute
from ecm_extract.description.xacro_text import XacroText, truth_of

MAX_STEPS = 40_000
MAX_NESTING = 90
MAX_INCLUDES = 200
MAX_PROBLEMS = 40


class Xacro:
    """One expansion.

    Attributes:
        problems: (path, line, message) of what could not be expanded. files_read: in order.
    """

    def __init__(self, files: Files, arguments: Mapping[str, str]) -> None:
        self.arguments: dict[str, str | Unknown] = dict(arguments)
        self.problems: list[Problem] = []
        self.files_read: list[str] = []
        self.files = XacroFiles(files)
        self.expressions = XacroExpression(
            self.arguments,
            lambda name: self.files.yaml(name, self._place[0]),
            lambda word, rest: self.files.substitute(word, rest, self._place[0]),
            self._value_problem,
        )
        self.text = XacroText(self._expression, self._command, self._value_problem)
        self.symbols = Symbols(self.text.value)
        self._macros = Macros()
        self._place = ("", 0)
        self._steps = 0
        self._nesting = 0
        self._stopped = False
        self._unvalued = 0
        self._open: list[Macro] = []
        self._namespace: tuple[str, Symbols | None] = ("", None)

    def expand(self, path: str) -> Element | None:
        """Return the expanded root of a file, None when it cannot be read; a bound that is hit cuts the tree."""
        root = self._root(path)
        return self._plain(root, path, self.symbols) if root is not None else None

    def problem(self, message: str, kind: ProblemKind = "other", about: str = "") -> None:
        """Note what could not be expanded, with the place that is being read."""
        entry = Problem(*self._place, message, kind, about)
        if len(self.problems) - self._unvalued < MAX_PROBLEMS and entry not in self.problems:
            self.problems.append(entry)

    def _value_problem(self, message: str, kind: ProblemKind = "other") -> None:
        """Note a value that is not known; these have a bound of their own, for one missing file makes many."""
        entry = Problem(*self._place, message, kind)
        if self._unvalued < MAX_PROBLEMS and entry not in self.problems:
            self._unvalued += 1
            self.problems.append(entry)

    def below(self, parent: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        """Return what the children of an element expand to."""
        return self._expanded(elements(parent), path, symbols)

    def _root(self, path: str) -> etree._Element | None:
        data = self.files.read(path)
        if data is None:
            self.problem(f"{path} is there and cannot be read", "unread")
            return None
        self.files_read.append(path)
        tree = parse_xml(data)
        for entry in tree.diagnostics:
            self._place = (path, entry.line)
            self.problem(entry.message)
        return tree.root

    def _expanded(self, found: list[etree._Element], path: str, symbols: Symbols) -> list[Element]:
        if self._nesting > MAX_NESTING:
            self._stop("macros, files or elements nest too deeply; one may include itself")
        made: list[Element] = []
        self._nesting += 1
        for element in found:
            if self._stopped:
                break
            made.extend(self._any(element, path, symbols))
        self._nesting -= 1
        return made

    def _any(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        self._count()
        self._place = (path, line_of(element))
        name = local_name(element)
        if not is_xacro(element.tag) and not self.files.may_be_early(path):
            return [self._plain(element, path, symbols)]
        if is_control(element):
            handler = _HANDLERS.get(name)
            return handler(self, element, path, symbols) if handler else self._call(name, element, path, symbols)
        macro = self._macros.find(name, self._namespace[0]) if may_call(element) else None
        if macro is not None and macro not in self._open and macro.fits({str(key) for key in element.attrib}):
            return self._call(name, element, path, symbols)
        return [self._plain(element, path, symbols)]

    def _plain(self, element: etree._Element, path: str, symbols: Symbols) -> Element:
        self._place = (path, line_of(element))
        made = Element(
            local_name(element),
            {name: self.text.shown(value, symbols) for name, value in own_attributes(element)},
            path,
            line_of(element),
            self.text.shown(element.text or "", symbols) if element.text and element.text.strip() else "",
        )
        made.children = self.below(element, path, symbols)
        for child in elements(element):
            if is_xacro(child.tag) and local_name(child) == "attribute":
                name = self.text.shown(str(child.get("name", "")), symbols)
                made.attributes[name] = self.text.shown(str(child.get("value", "")), symbols)
        return made

    # --- definitions -------------------------------------------------------------------------------------------

    def _property(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = self.text.shown(str(element.get("name", "")), symbols)
        scope = str(element.get("scope", ""))
        target = symbols.target(scope)
        if element.get("remove") is not None:
            symbols.forget(name)
            return []
        value = element.get("value")
        if value is None and element.get("default") is not None:
            if name in symbols:
                return []
            value = element.get("default")
        if value is None:
            target.own["**" + name] = Block(elements(element), path, symbols)
            target.own.setdefault(name, element.text or "")
        elif not scope and element.get("lazy_eval") in {None, "true", "True", "1"} and "$" in str(value):
            target.own[name] = Raw(str(value), symbols)
        else:
            target.own[name] = self.text.value(str(value), symbols)
        return []

    def _macro(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = str(element.get("name", "")).removeprefix("xacro:")
        self._macros.add(Macro(name, macro_parameters(str(element.get("params", ""))), element, path, *self._namespace))
        return []

    def _argument(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name, default = str(element.get("name", "")), element.get("default")
        if name not in self.arguments and default is not None:
            self.arguments[name] = self.text.text(str(default), symbols)
        return []

    def _include(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        written = str(element.get("filename", ""))
        name = self.text.text(written, symbols)
        found = [] if isinstance(name, Unknown) else self.files.named(name, path)
        unsaid = element.get("optional") in {"1", "true", "True"}
        if not found and not isinstance(name, Unknown) and not unsaid and not is_glob(name):
            told = include_problem(written, name, path, self.files, lambda part: self.text.shown(part, symbols))
            self.problem(told.message, told.kind, told.about)
        return [made for each in found for made in self._included(each, str(element.get("ns") or ""), symbols)]

    def _included(self, found: str, space: str, symbols: Symbols) -> list[Element]:
        if len(self.files_read) >= MAX_INCLUDES:
            self._stop("files include each other without end")
        root = None if self._stopped else self._root(found)
        if root is None:
            return []
        outer = self._namespace
        if space:
            inner = Symbols(self.text.value, symbols)
            symbols.own[space] = inner
            self._namespace, symbols = (f"{outer[0]}{space}.", inner), inner
        made = self.below(root, found, symbols)
        self._namespace = outer
        return made

    # --- control -----------------------------------------------------------------------------------------------

    def _condition(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        value = self.text.value(str(element.get("value", "")), symbols)
        holds, wanted = truth_of(value), local_name(element) == "if"
        if holds is not None:
            return self.below(element, path, symbols) if holds is wanted else []
        is_late = isinstance(value, Unknown)
        why = "is known at launch only" if is_late else "is no truth value"
        self.problem(f"condition `{str(value)[:80]}` {why}; it is read as if it held", "late" if is_late else "other")
        made = self.below(element, path, symbols)
        for entry in made:
            entry.conditional = entry.conditional or f"{'' if wanted else 'not '}{str(value).strip('{}')}"
        return made

    def _insert(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        name = self.text.shown(str(element.get("name", "")), symbols)
        block = symbols.get("**" + name) or symbols.get("*" + name)
        if not isinstance(block, Block):
            self.problem(f"block `{name}` is not defined here")
            return []
        return self._expanded(block.elements, block.path, block.symbols)

    def _element(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        made = self._plain(element, path, symbols)
        made.tag = self.text.shown(xacro_attribute(element, "name"), symbols) or made.tag
        return [made]

    def _nothing(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        """`xacro:attribute` is read by the element around it."""
        return []

    # --- calls -------------------------------------------------------------------------------------------------

    def _dynamic_call(self, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        return self._call(self.text.shown(str(element.get("macro", "")), symbols), element, path, symbols)

    def _call(self, name: str, element: etree._Element, path: str, symbols: Symbols) -> list[Element]:
        macro = self._macros.find(name, self._namespace[0])
        if macro is None:
            self.problem(f"macro `{name}` is not defined", "macro", name)
            return []
        inner = Symbols(self.text.value, symbols if macro.scope is None else macro.scope)
        if missing := bind(macro, element, path, inner, symbols):
            self.problem(call_problem(missing, name), "argument", missing[0])
        known = {"macro", *(entry.name for entry in macro.parameters)}
        for extra in (str(entry) for entry in element.attrib if entry not in known):
            self.problem(f"macro `{name}` has no parameter `{extra[:80]}`")
        outer = self._namespace
        self._namespace = (macro.prefix, macro.scope)
        self._open.append(macro)
        made = self.below(macro.body, macro.path, inner)
        self._open.pop()
        self._namespace = outer
        return made

    # --- texts and bounds --------------------------------------------------------------------------------------

    def _expression(self, code: str, symbols: Symbols) -> Any:
        self._count()
        inner = self.text.text(code, symbols)  # `${load_yaml('$(find package)/file')}`
        return (
            Unknown("{...}") if self._stopped or isinstance(inner, Unknown) else self.expressions.value(inner, symbols)
        )

    def _command(self, inner: str, symbols: Symbols) -> Any:
        self._count()
        word, _, rest = inner.strip().partition(" ")
        if word == "eval":
            return self.expressions.launch_value(rest, symbols)
        rest = self.text.shown(rest, symbols).strip()
        known = self.arguments.get(rest) if word == "arg" else self.files.substitute(word, rest, self._place[0])
        if known is None:
            why = ": the package is not in the tree" if word == "find" else ""
            self.problem(f"`$({word} {rest})` is known at launch only{why}"[:300], "late")
            return Unknown("{" + (rest or word) + "}")
        return known

    def _count(self) -> None:
        self._steps += 1
        if self._steps > MAX_STEPS:
            self._stop(f"the description takes more than {MAX_STEPS} steps; macros may call each other without end")

    def _stop(self, message: str) -> None:
        if not self._stopped:
            self.problem(message + "; the rest is not read")
        self._stopped = True


_Handler = Callable[[Xacro, etree._Element, str, Symbols], list[Element]]
_HANDLERS: Mapping[str, _Handler] = MappingProxyType(
    {
        "property": Xacro._property,
        "macro": Xacro._macro,
        "include": Xacro._include,
        "arg": Xacro._argument,
        "if": Xacro._condition,
        "unless": Xacro._condition,
        "insert_block": Xacro._insert,
        "call": Xacro._dynamic_call,
        "element": Xacro._element,
        "attribute": Xacro._nothing,
    }
)
