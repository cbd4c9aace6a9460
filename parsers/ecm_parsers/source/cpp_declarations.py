"""Declarations of a C++ file: namespaces, classes, functions, constants, aliases, includes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from ecm_parsers.source.cpp_arrays import array_value
from ecm_parsers.source.cpp_body import BodyReader
from ecm_parsers.source.cpp_brought import holds_partly, is_directive, names_used
from ecm_parsers.source.cpp_containers import given, holds_several
from ecm_parsers.source.cpp_declarators import (
    GROUPS,
    announced_end,
    attributes,
    fixed_pointer,
    function_declarator,
    function_traits,
    leading_words,
    lines_of,
    split_name,
)
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_lambdas import DeclaredFunctions
from ecm_parsers.source.cpp_macro_values import macro_value
from ecm_parsers.source.cpp_members import CLASSES, declared_type, members
from ecm_parsers.source.cpp_namespaces import opened
from ecm_parsers.source.cpp_parameters import declared_name, parameters, specialized
from ecm_parsers.source.cpp_place import Place
from ecm_parsers.source.cpp_templates import is_variadic, template_parameters
from ecm_parsers.source.cpp_vexing import is_call_of_macro
from ecm_parsers.source.expr import Call, Expr, Items, Name, Number, Op
from ecm_parsers.source.facts import Alias, Class, Constant, Function, Import, Macro, SourceFile, Using

if TYPE_CHECKING:
    from tree_sitter import Node

MAX_NESTING = 60


class DeclarationReader:
    """Collects the declarations of one file."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.expr = ExprReader(data, lambda body: None)
        self.imports: list[Import] = []
        self.usings: list[Using] = []
        self.aliases: list[Alias] = []
        self.classes: list[Class] = []
        self.functions: list[Function] = []
        self.constants: list[Constant] = []
        self._declared = DeclaredFunctions(data)
        self._namespaces: list[tuple[int, int, str]] = []
        self._nesting = 0

    def facts(self, macros: tuple[Macro, ...]) -> SourceFile:
        """Return everything read, as the facts of one file."""
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

    def read(self, node: Node, place: Place) -> None:
        """Read one declaration, or a group of them."""
        if self._nesting >= MAX_NESTING:
            return
        self._nesting += 1
        kind = node.type
        if kind == "ERROR":
            self._torn(node, place)
        elif kind in GROUPS:
            for child in node.named_children:
                self.read(child, place)
        else:
            handler = _DECLARATIONS.get(kind)
            if handler is not None:
                handler(self, node, place)
        self._nesting -= 1

    def _torn(self, node: Node, place: Place) -> None:
        """What is left around an error; a namespace that it tore still holds what follows."""
        inside, words = [place], ["", ""]
        for child in node.children:
            if child.type == "{":
                opened = words[0] == "namespace" and inside[-1].scope.rsplit("::", 1)[-1] != words[1]
                inside.append(inside[-1].inside(words[1]) if opened else inside[-1])
            elif child.type == "}" and len(inside) > 1:
                inside.pop()
            elif child.is_named:
                self.read(child, inside[-1])
            words = [words[1], self.expr.text(child) if child.child_count == 0 else ""]

    def namespace(self, node: Node, place: Place) -> None:
        """A namespace, anonymous ones included; what is in an inline one counts as in the one around it."""
        body = node.child_by_field_name("body")
        if body is None:
            return
        for name, inline in opened(node):
            if inline:
                self.aliases.append(Alias(name, place.scope, f"::{place.scope}", lines_of(node)[0]))
            else:
                place = place.inside(name)
        self._namespaces.append((*lines_of(body), place.scope))
        self.read(body, place)

    def namespace_at(self, line: int) -> str:
        """Return the innermost namespace around a line of what was read; empty outside of all."""
        around = [scope for first, last, scope in self._namespaces if first <= line <= last]
        return around[-1] if around else ""

    def template(self, node: Node, place: Place) -> None:
        """A template: its parameters go to what it declares."""
        listed = node.child_by_field_name("parameters")
        written = (*template_parameters(self.expr, listed), is_variadic(listed))
        for child in node.named_children:
            if child.type != "template_parameter_list":
                self.read(child, Place(place.scope, place.access, place.anonymous, *written))

    def classes_of(self, node: Node, place: Place) -> None:
        """A class or struct with its members; one without a name is called like what it declares."""
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is None:
            return
        written = self.expr.name(name) if name is not None else self._declared_of(node)
        scope, own = split_name(written, place.scope)
        inner = Place(f"{scope}::{own}" if scope else own, "", place.anonymous)
        access = "private" if node.type == "class_specifier" else ""
        fields = members(self, body, inner, access)
        bases = next((child for child in node.named_children if child.type == "base_class_clause"), None)
        listed = self._bases(bases) if bases is not None else ()
        traits = (*place.traits(), *announced_end(self.expr, node))
        self.classes.append(Class(own, scope, listed, *lines_of(node), tuple(fields), place.template, traits))

    def _declared_of(self, node: Node) -> str:
        """The variable, member or typedef whose type an unnamed struct is."""
        declaration = node.parent
        declarator = declaration.child_by_field_name("declarator") if declaration is not None else None
        return declared_name(self.expr, declarator) if declarator is not None else ""

    def _bases(self, node: Node) -> tuple[str, ...]:
        return tuple([self.expr.type_text(c) for c in node.named_children if c.type not in _NOT_BASES])

    def initial(self, node: Node | None, kind: Node | None, declarator: Node) -> Expr | None:
        """Return the value that a variable begins with; of several arguments of a constructor, or an array, a list."""
        if node is None:
            return None
        array = array_value(self.expr, kind, declarator, node) if kind is not None else None
        if array is not None:
            return array
        if node.type in {"initializer_list", "argument_list"}:
            args = self.expr.arguments(node)
            name = self.expr.name(kind) if kind is not None else ""
            if len(args) == 1 and kind is not None and holds_several(name):
                listed = given(name, args, node.type == "initializer_list")
                return Call(Name(name), listed, (), self.expr.template_arguments(kind), lines_of(node)[0])
            if not args and kind is not None and kind.type == "primitive_type" and declarator.type in _PLAIN:
                return Call(Name(name), (), (), (), lines_of(node)[0])
            return args[0] if len(args) == 1 else Items(args) if args else None
        return self.expr.read(node)

    def function(self, node: Node, place: Place) -> None:
        """A function definition."""
        declarator = node.child_by_field_name("declarator")
        function = function_declarator(declarator) if declarator is not None else None
        if function is not None:
            self.add_function(node, function, place, leading_words(self.expr, node))

    def add_function(self, node: Node, declarator: Node, place: Place, words: tuple[str, ...]) -> None:
        """Add a function; `words` stand before its declarator, such as `static`."""
        named = declarator.child_by_field_name("declarator")
        if named is None:
            return
        scope, name = split_name(declared_name(self.expr, named), place.scope)
        kind, body = node.child_by_field_name("type"), node.child_by_field_name("body")
        if is_call_of_macro(node, scope, name):
            return
        read = BodyReader(self.data, f"{scope}::{name}" if scope else name, self._declared)
        for child in node.named_children:
            if child.type == "field_initializer_list":
                read.initializers(child)
        params = parameters(self.expr, declarator.child_by_field_name("parameters"))
        read.writer.declared.update(each.name for each in params)
        if body is not None:
            read.read(body)
        for local in read.local_names:
            self._local_name(local.node, Place(local.scope if local.node.type in CLASSES else f"{local.scope}()"))
        elsewhere = ("elsewhere",) if scope != place.scope else ()
        traits = (*place.traits(), *elsewhere, *function_traits(self.expr, node, declarator, words, body is None))
        specializes = specialized(self.expr, named) if place.written == () else None
        returns = self.expr.type_text(kind) if kind is not None else ""
        self.functions.append(
            Function(
                name,
                scope,
                params,
                returns,
                *lines_of(node),
                tuple(read.writer.statements),
                place.template,
                traits,
                attributes(self.expr, node),
                read.writer.flow(),
                specializes=specializes,
                defaults=place.defaults,
            )
        )
        self.functions.extend(read.functions)

    def declaration(self, node: Node, place: Place) -> None:
        """Variables, and functions without a body."""
        kind = node.child_by_field_name("type")
        if kind is not None and kind.type in CLASSES | {"enum_specifier"}:
            self.read(kind, place)
        words = leading_words(self.expr, node)
        for declarator in node.children_by_field_name("declarator"):
            function = function_declarator(declarator)
            if function is not None:
                self.add_function(node, function, place, words)
                continue
            bound = declarator.child_by_field_name("declarator") or declarator
            scope, name = split_name(declared_name(self.expr, bound), place.scope)
            value = self.initial(declarator.child_by_field_name("value"), kind, bound)
            written = declared_type(self, kind, bound)
            traits = (*place.traits(), *words, *fixed_pointer(bound))
            self.constants.append(Constant(name, scope, value, lines_of(node)[0], written, traits))

    def alias(self, node: Node, place: Place) -> None:
        """`using A = B`."""
        name, kind = node.child_by_field_name("name"), node.child_by_field_name("type")
        if name is not None and kind is not None:
            target, outdated = self.expr.type_text(kind), bool(announced_end(self.expr, node))
            own = self.expr.text(name)
            line, template = lines_of(node)[0], place.template
            self.aliases.append(Alias(own, place.scope, target, line, outdated, template=template))

    def _local_name(self, node: Node, place: Place) -> None:
        """Another way to name something within a function; the scope with `()` keeps it from being one for others."""
        kind, known = node.child_by_field_name("type"), (len(self.aliases), len(self.usings))
        if node.type != "type_definition":
            _DECLARATIONS[node.type](self, node, place)
        elif kind is not None and kind.type not in CLASSES | {"enum_specifier"}:
            self.typedef(node, place)
        if holds_partly(node):
            self.aliases[known[0] :] = [replace(each, partly=True) for each in self.aliases[known[0] :]]
            self.usings[known[1] :] = [replace(each, partly=True) for each in self.usings[known[1] :]]

    def typedef(self, node: Node, place: Place) -> None:
        """`typedef B A`."""
        kind = node.child_by_field_name("type")
        if kind is not None and kind.type in CLASSES | {"enum_specifier"}:
            self.read(kind, place)
        for declarator in node.children_by_field_name("declarator"):
            if kind is not None and declarator.type == "type_identifier":
                target = self.expr.type_text(kind)
                self.aliases.append(Alias(self.expr.text(declarator), place.scope, target, lines_of(node)[0]))

    def namespace_alias(self, node: Node, place: Place) -> None:
        """`namespace a = b`."""
        children = node.named_children
        if len(children) == 2:
            name, target = (self.expr.text(child) for child in children)
            self.aliases.append(Alias(name, place.scope, target, lines_of(node)[0]))

    def using(self, node: Node, place: Place) -> None:
        """`using namespace a` and `using a::B`."""
        for name in names_used(self.expr, node):
            if is_directive(node):
                self.usings.append(Using(name, place.scope))
            elif "::" in name:
                self.aliases.append(Alias(name.rsplit("::", 1)[1], place.scope, name, lines_of(node)[0]))

    def include(self, node: Node, place: Place) -> None:
        """`#include`."""
        path = node.child_by_field_name("path")
        if path is not None:
            written, line = self.expr.text(path), lines_of(node)[0]
            self.imports.append(Import(written.strip('<>"'), "", "", line, written.startswith("<")))

    def define(self, node: Node, place: Place) -> None:
        """`#define` of a value."""
        name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
        if name is None or value is None:
            return
        read = macro_value(self.data[value.start_byte : value.end_byte].strip())
        if read is not None:
            traits = ("define", "default") if self._is_unless_given(node, name) else ("define",)
            self.constants.append(Constant(self.expr.text(name), "", read, lines_of(node)[0], "", traits))

    def _is_unless_given(self, node: Node, name: Node) -> bool:
        """Whether a build may give a macro another value: it is defined where it is not yet (`#ifndef NAME`)."""
        around = node.parent
        asked = around.child_by_field_name("name") if around is not None and around.type == "preproc_ifdef" else None
        if around is None or asked is None or around.children[0].type != "#ifndef":
            return False
        return self.expr.text(asked) == self.expr.text(name)

    def enum(self, node: Node, place: Place) -> None:
        """An enum: each value is a constant; those of an `enum class` are known within it only."""
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if body is None:
            return
        own = self.expr.name(name) if name is not None else ""
        scope = "::".join(part for part in (place.scope, own) if part)
        scoped = any(child.type in {"class", "struct"} for child in node.children)
        traits = (*place.traits(), "enum", *(("scoped",) if scoped else ()))
        read: Expr | None = Number(-1)
        for child in body.named_children:
            label, value = child.child_by_field_name("name"), child.child_by_field_name("value")
            if child.type == "enumerator" and label is not None:
                read = self.expr.read(value) if value is not None else _following(read)
                self.constants.append(Constant(self.expr.text(label), scope, read, lines_of(child)[0], own, traits))
            elif child.type != "comment":
                read = None  # `#if` decides which of them there are


def _following(before: Expr | None) -> Expr | None:
    """The value of an enumerator that is given none: one more than the one before it has. Source: [dcl.enum]."""
    if isinstance(before, Number):
        return Number(before.value + 1)
    return Op("+", (before, Number(1))) if before is not None else None


_DECLARATIONS = {
    "namespace_definition": DeclarationReader.namespace,
    "template_declaration": DeclarationReader.template,
    "class_specifier": DeclarationReader.classes_of,
    "struct_specifier": DeclarationReader.classes_of,
    "union_specifier": DeclarationReader.classes_of,
    "function_definition": DeclarationReader.function,
    "declaration": DeclarationReader.declaration,
    "alias_declaration": DeclarationReader.alias,
    "type_definition": DeclarationReader.typedef,
    "namespace_alias_definition": DeclarationReader.namespace_alias,
    "using_declaration": DeclarationReader.using,
    "preproc_include": DeclarationReader.include,
    "preproc_def": DeclarationReader.define,
    "enum_specifier": DeclarationReader.enum,
}
_PLAIN = frozenset({"identifier", "field_identifier"})
_NOT_BASES = frozenset({"access_specifier", "virtual", "comment"})
