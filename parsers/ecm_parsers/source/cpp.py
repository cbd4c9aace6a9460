"""C++ source and headers, read by tree-sitter: also code that does not compile."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import tree_sitter_cpp
from tree_sitter import Language, Parser

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.source import cpp_text
from ecm_parsers.source.cpp_body import BodyReader, declared_name, parameters
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.expr import Expr, Items
from ecm_parsers.source.facts import Alias, Class, Constant, Field, Function, Import, Macro, SourceFile

if TYPE_CHECKING:
    from tree_sitter import Node, Tree

MAX_BYTES = 4_000_000
MAX_NESTING = 60
_CLASSES = frozenset({"class_specifier", "struct_specifier", "union_specifier"})
_GROUPS = frozenset(
    {
        "translation_unit",
        "declaration_list",
        "linkage_specification",
        "preproc_if",
        "preproc_ifdef",
        "preproc_else",
    }
    | {"preproc_elif", "preproc_elifdef", "ERROR"}
)


def parse_cpp(data: bytes) -> Parsed[SourceFile]:
    """Read one C++ file.

    Args:
        data: the file's bytes, any encoding that keeps ASCII.

    Returns:
        Its facts; what the grammar could not read is one `info` diagnostic with the first such line.
    """
    if len(data) > MAX_BYTES:
        message = (
            f"{len(data)} bytes of C++ were not read: the limit is {MAX_BYTES}. Exclude generated files."
        )
        return Parsed(SourceFile("cpp"), (Diagnostic("warning", "cpp-too-large", 0, message),))
    tree, read = _tree(data)
    reader = _FileReader(read)
    reader.read(tree.root_node, _Place())
    macros = tuple([Macro(name, args, line) for name, args, line in cpp_text.registrations(data)])
    return Parsed(reader.facts(macros), _diagnostics(tree))


@cache
def _parser() -> Parser:
    return Parser(Language(tree_sitter_cpp.language()))


def _tree(data: bytes) -> tuple[Tree, bytes]:
    """Parse as it is; on errors without macros, and then without conditionals, whichever reads more.

    A missing `;` after a macro spoils nothing, so only real errors are worth a second parse.
    """
    tree = _parser().parse(data)
    if _first_error(tree.root_node) is None:
        return tree, data
    rewritten = cpp_text.without_macros(data)
    if rewritten != data:
        tree, data = _parser().parse(rewritten), rewritten
    if b"#if" in data and _first_error(tree.root_node) is not None:
        flat = cpp_text.without_conditionals(data)
        other = _parser().parse(flat)
        if _first_error(other.root_node) is None:
            return other, flat
    return tree, data


def _diagnostics(tree: Tree) -> tuple[Diagnostic, ...]:
    node = _first_error(tree.root_node)
    if node is None:
        return ()
    line = node.start_point[0] + 1
    message = "Part of the file is not C++ that can be read without a preprocessor; declarations there may be missing."
    return (Diagnostic("info", "cpp-syntax", line, message),)


def _first_error(root: Node) -> Node | None:
    """Return the first ERROR node; nodes that the parser only missed do not count."""
    pending = [root] if root.has_error else []
    while pending:
        node = pending.pop()
        if node.type == "ERROR":
            return node
        pending.extend(child for child in reversed(node.children) if child.has_error)
    return None


class _Place:
    """Where a declaration stands: scope, access, template parameters, anonymous namespace."""

    __slots__ = ("access", "anonymous", "scope", "template")

    def __init__(
        self, scope: str = "", access: str = "", anonymous: bool = False, template: tuple[str, ...] = ()
    ) -> None:
        self.scope = scope
        self.access = access
        self.anonymous = anonymous
        self.template = template

    def inside(self, name: str, access: str = "") -> _Place:
        scope = f"{self.scope}::{name}" if self.scope and name else self.scope or name
        return _Place(scope, access, self.anonymous or not name)

    def traits(self) -> tuple[str, ...]:
        hidden = (self.access,) if self.access in {"private", "protected"} else ()
        return (*hidden, "anonymous") if self.anonymous else hidden


class _FileReader:
    """Collects the declarations of one file."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.expr = ExprReader(data, lambda body: None)
        self.imports: list[Import] = []
        self.usings: list[str] = []
        self.aliases: list[Alias] = []
        self.classes: list[Class] = []
        self.functions: list[Function] = []
        self.constants: list[Constant] = []
        self._nesting = 0

    def facts(self, macros: tuple[Macro, ...]) -> SourceFile:
        return SourceFile(
            "cpp",
            tuple(self.imports),
            tuple(self.usings),
            tuple(self.aliases),
            tuple(self.classes),
            tuple(self.functions),
            tuple(self.constants),
            macros,
        )

    def read(self, node: Node, place: _Place) -> None:
        """Read one declaration, or a group of them."""
        if self._nesting >= MAX_NESTING:
            return
        self._nesting += 1
        kind = node.type
        if kind in _GROUPS:
            for child in node.named_children:
                self.read(child, place)
        else:
            handler = _DECLARATIONS.get(kind)
            if handler is not None:
                handler(self, node, place)
        self._nesting -= 1

    def namespace(self, node: Node, place: _Place) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is not None:
            self.read(body, place.inside(self.expr.text(name).replace(" ", "") if name is not None else ""))

    def template(self, node: Node, place: _Place) -> None:
        listed = node.child_by_field_name("parameters")
        names = (
            tuple([self._template_name(child) for child in listed.named_children])
            if listed is not None
            else ()
        )
        for child in node.named_children:
            if child.type != "template_parameter_list":
                self.read(child, _Place(place.scope, place.access, place.anonymous, names))

    def _template_name(self, node: Node) -> str:
        words = self.expr.text(node).split("=")[0].replace("...", " ").split()
        return words[-1] if words else ""

    def classes_of(self, node: Node, place: _Place) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is None:
            return
        own = self.expr.name(name) if name is not None else ""
        inner = _Place(f"{place.scope}::{own}" if place.scope else own, "", place.anonymous)
        access = "private" if node.type == "class_specifier" else ""
        fields = self._members(body, inner, access)
        bases = next((child for child in node.named_children if child.type == "base_class_clause"), None)
        listed = self._bases(bases) if bases is not None else ()
        self.classes.append(
            Class(own, place.scope, listed, *_lines(node), tuple(fields), place.template, place.traits())
        )

    def _bases(self, node: Node) -> tuple[str, ...]:
        return tuple([self.expr.type_text(c) for c in node.named_children if c.type not in _NOT_BASES])

    def _members(self, body: Node, place: _Place, access: str) -> list[Field]:
        fields: list[Field] = []
        place.access = access
        for child in _flat(body):
            if child.type == "access_specifier":
                place.access = self.expr.text(child).split()[0]
            elif child.type == "field_declaration":
                fields.extend(self._field(child, place))
            else:
                self.read(child, place)
        return fields

    def _field(self, node: Node, place: _Place) -> list[Field]:
        kind = node.child_by_field_name("type")
        if kind is not None and (kind.type in _CLASSES or kind.type == "enum_specifier"):
            self.read(kind, _Place(place.scope, place.access, place.anonymous))
        words = _words(self.expr, node)
        fields = []
        for declarator in node.children_by_field_name("declarator"):
            function = _function_declarator(declarator)
            if function is not None:
                self._function(node, function, place, words)
                continue
            default = node.child_by_field_name("default_value")
            value = self._initial(default, kind)
            name = declared_name(self.expr, declarator)
            written = self._declared_type(kind, declarator)
            traits = (
                *place.traits(),
                *(word for word in words if word in {"static", "constexpr", "const", "mutable"}),
            )
            if "static" in traits or "constexpr" in traits:
                self.constants.append(Constant(name, place.scope, value, _lines(node)[0], written, traits))
            fields.append(Field(name, written, _lines(declarator)[0], value, traits))
        return fields

    def _declared_type(self, kind: Node | None, declarator: Node) -> str:
        mark = "*" if declarator.type == "pointer_declarator" else ""
        return (self.expr.type_text(kind) if kind is not None else "") + mark

    def _initial(self, node: Node | None, kind: Node | None) -> Expr | None:
        if node is None:
            return None
        if node.type in {"initializer_list", "argument_list"}:
            args = self.expr.arguments(node)
            return args[0] if len(args) == 1 else Items(args) if args else None
        return self.expr.read(node)

    def function(self, node: Node, place: _Place) -> None:
        declarator = node.child_by_field_name("declarator")
        function = _function_declarator(declarator) if declarator is not None else None
        if function is not None:
            self._function(node, function, place, _words(self.expr, node))

    def _function(self, node: Node, declarator: Node, place: _Place, words: tuple[str, ...]) -> None:
        named = declarator.child_by_field_name("declarator")
        if named is None:
            return
        scope, name = _split(declared_name(self.expr, named), place.scope)
        kind, body = node.child_by_field_name("type"), node.child_by_field_name("body")
        read = BodyReader(self.data, f"{scope}::{name}" if scope else name)
        for child in node.named_children:
            if child.type == "field_initializer_list":
                read.initializers(child)
        if body is not None:
            read.read(body)
        params = parameters(self.expr, declarator.child_by_field_name("parameters"))
        traits = (*place.traits(), *_function_traits(self.expr, node, declarator, words, body is None))
        returns = self.expr.type_text(kind) if kind is not None else ""
        decorators = tuple(
            [self.expr.text(c) for c in node.named_children if c.type == "attribute_declaration"]
        )
        self.functions.append(
            Function(
                name,
                scope,
                params,
                returns,
                *_lines(node),
                tuple(read.statements),
                place.template,
                traits,
                decorators,
            )
        )
        self.functions.extend(read.functions)

    def declaration(self, node: Node, place: _Place) -> None:
        kind = node.child_by_field_name("type")
        if kind is not None and kind.type in _CLASSES | {"enum_specifier"}:
            self.read(kind, place)
        words = _words(self.expr, node)
        for declarator in node.children_by_field_name("declarator"):
            function = _function_declarator(declarator)
            if function is not None:
                self._function(node, function, place, words)
                continue
            bound = declarator.child_by_field_name("declarator") or declarator
            scope, name = _split(declared_name(self.expr, bound), place.scope)
            value = self._initial(declarator.child_by_field_name("value"), kind)
            written = self._declared_type(kind, bound)
            self.constants.append(
                Constant(name, scope, value, _lines(node)[0], written, (*place.traits(), *words))
            )

    def alias(self, node: Node, place: _Place) -> None:
        name, kind = node.child_by_field_name("name"), node.child_by_field_name("type")
        if name is not None and kind is not None:
            self.aliases.append(
                Alias(self.expr.text(name), place.scope, self.expr.type_text(kind), _lines(node)[0])
            )

    def typedef(self, node: Node, place: _Place) -> None:
        kind = node.child_by_field_name("type")
        if kind is not None and kind.type in _CLASSES | {"enum_specifier"}:
            self.read(kind, place)
        for declarator in node.children_by_field_name("declarator"):
            if kind is not None and declarator.type == "type_identifier":
                target = self.expr.type_text(kind)
                self.aliases.append(Alias(self.expr.text(declarator), place.scope, target, _lines(node)[0]))

    def namespace_alias(self, node: Node, place: _Place) -> None:
        children = node.named_children
        if len(children) == 2:
            name, target = (self.expr.text(child) for child in children)
            self.aliases.append(Alias(name, place.scope, target, _lines(node)[0]))

    def using(self, node: Node, place: _Place) -> None:
        for child in node.named_children:
            name = self.expr.name(child)
            if "namespace" in self.expr.text(node).split():
                self.usings.append(name)
            elif "::" in name:
                self.aliases.append(Alias(name.rsplit("::", 1)[1], place.scope, name, _lines(node)[0]))

    def include(self, node: Node, place: _Place) -> None:
        path = node.child_by_field_name("path")
        if path is not None:
            self.imports.append(Import(self.expr.text(path).strip('<>"'), "", "", _lines(node)[0]))

    def define(self, node: Node, place: _Place) -> None:
        name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
        if name is None or value is None:
            return
        text = self.data[value.start_byte : value.end_byte].strip()
        tree = _parser().parse(b"auto x = " + text + b";") if len(text) < 200 else None
        found = _first_value(tree.root_node) if tree is not None else None
        if found is not None:
            read = ExprReader(b"auto x = " + text + b";", lambda body: None).read(found)
            self.constants.append(Constant(self.expr.text(name), "", read, _lines(node)[0], "", ("define",)))

    def enum(self, node: Node, place: _Place) -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is None:
            return
        own = self.expr.name(name) if name is not None else ""
        scope = "::".join(part for part in (place.scope, own) if part)
        for child in body.named_children:
            label, value = child.child_by_field_name("name"), child.child_by_field_name("value")
            if child.type == "enumerator" and label is not None:
                read = self.expr.read(value) if value is not None else None
                traits = (*place.traits(), "enum")
                self.constants.append(
                    Constant(self.expr.text(label), scope, read, _lines(child)[0], own, traits)
                )


_DECLARATIONS = {
    "namespace_definition": _FileReader.namespace,
    "template_declaration": _FileReader.template,
    "class_specifier": _FileReader.classes_of,
    "struct_specifier": _FileReader.classes_of,
    "function_definition": _FileReader.function,
    "declaration": _FileReader.declaration,
    "alias_declaration": _FileReader.alias,
    "type_definition": _FileReader.typedef,
    "namespace_alias_definition": _FileReader.namespace_alias,
    "using_declaration": _FileReader.using,
    "preproc_include": _FileReader.include,
    "preproc_def": _FileReader.define,
    "enum_specifier": _FileReader.enum,
}
_NOT_BASES = frozenset({"access_specifier", "virtual", "comment"})


def _flat(body: Node) -> list[Node]:
    """Members of a class body, those inside preprocessor conditionals included."""
    found: list[Node] = []
    for child in body.named_children:
        if child.type.startswith("preproc_") and child.type in _GROUPS:
            found.extend(_flat(child))
        else:
            found.append(child)
    return found


def _function_declarator(node: Node) -> Node | None:
    while node.type in {"pointer_declarator", "reference_declarator", "init_declarator"}:
        inner = node.child_by_field_name("declarator")
        if inner is None:
            inner = next((child for child in node.named_children if child.type.endswith("declarator")), None)
        if inner is None:
            return None
        node = inner
    if node.type == "operator_cast":
        return None
    if node.type != "function_declarator":
        return None
    named = node.child_by_field_name("declarator")
    return None if named is None or named.type == "parenthesized_declarator" else node


def _split(name: str, scope: str) -> tuple[str, str]:
    if "::" not in name:
        return scope, name
    head, last = name.rsplit("::", 1)
    return "::".join(part for part in (scope, head.strip(":")) if part), last


def _words(reader: ExprReader, node: Node) -> tuple[str, ...]:
    """Keywords before the declarator: static, virtual, constexpr, inline, const, explicit."""
    kinds = {
        "storage_class_specifier",
        "type_qualifier",
        "virtual",
        "virtual_function_specifier",
        "explicit_function_specifier",
    }
    return tuple([reader.text(child) for child in node.children if child.type in kinds])


def _function_traits(
    reader: ExprReader, node: Node, declarator: Node, words: tuple[str, ...], declared: bool
) -> list[str]:
    traits = [word for word in words if word in {"static", "virtual"}]
    for child in declarator.named_children:
        if child.type in {"virtual_specifier", "type_qualifier"}:
            traits.append(reader.text(child))
    default = node.child_by_field_name("default_value")
    if default is not None:
        traits.append("pure")
    if any(child.type == "delete_method_clause" for child in node.named_children):
        traits.append("deleted")
    if any(
        child.type == "attribute_declaration" and b"deprecated" in _bytes(reader, child)
        for child in node.named_children
    ):
        traits.append("deprecated")
    if declared and not any(child.type.endswith("_method_clause") for child in node.named_children):
        traits.append("declaration")
    return traits


def _bytes(reader: ExprReader, node: Node) -> bytes:
    return reader.data[node.start_byte : node.end_byte]


def _first_value(root: Node) -> Node | None:
    declaration = root.named_children[0] if root.named_children else None
    declarator = declaration.child_by_field_name("declarator") if declaration is not None else None
    if root.has_error or declarator is None:
        return None
    return declarator.child_by_field_name("value")


def _lines(node: Node) -> tuple[int, int]:
    return node.start_point[0] + 1, node.end_point[0] + 1
