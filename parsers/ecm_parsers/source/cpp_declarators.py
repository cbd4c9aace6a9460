"""What stands around a declared name: the function it may be, keywords, traits, lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader

if TYPE_CHECKING:
    from tree_sitter import Node

GROUPS = frozenset(
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


def function_declarator(node: Node) -> Node | None:
    """Return the function declarator within a declarator, None for a variable."""
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


def split_name(name: str, scope: str) -> tuple[str, str]:
    """Return (scope, own name) of a name declared in a scope."""
    if "::" not in name:
        return scope, name
    head, last = name.rsplit("::", 1)
    return "::".join(part for part in (scope, head.strip(":")) if part), last


def leading_words(reader: ExprReader, node: Node) -> tuple[str, ...]:
    """Keywords before the declarator: static, virtual, constexpr, inline, const, explicit."""
    kinds = {
        "storage_class_specifier",
        "type_qualifier",
        "virtual",
        "virtual_function_specifier",
        "explicit_function_specifier",
    }
    return tuple([reader.text(child) for child in node.children if child.type in kinds])


def fixed_pointer(declarator: Node) -> tuple[str, ...]:
    """Return the trait of a pointer that points to one thing for good: `const char * const name`."""
    own = {child.type for child in declarator.children} if declarator.type == "pointer_declarator" else set()
    return ("fixed",) if "type_qualifier" in own else ()


def function_traits(
    reader: ExprReader, node: Node, declarator: Node, words: tuple[str, ...], declared: bool
) -> list[str]:
    """Return the traits that keywords, specifiers and clauses of a function tell."""
    traits = [word for word in words if word in {"static", "virtual"}]
    specifiers = {"virtual_specifier", "type_qualifier"}
    traits.extend(reader.text(child) for child in declarator.named_children if child.type in specifiers)
    traits += _given_out(node)
    default = node.child_by_field_name("default_value")
    if default is not None and reader.text(default) == "0":  # else the empty body of a method with a stray `;`
        traits.append("pure")
    if any(child.type == "delete_method_clause" for child in node.named_children):
        traits.append("deleted")
    traits.extend(announced_end(reader, node))
    if declared and not any(child.type.endswith("_method_clause") for child in node.named_children):
        traits.append("declaration")
    return traits


def _given_out(node: Node) -> tuple[str, ...]:
    """A function that returns a reference or pointer to what may be changed lets its callers do that."""
    declarator = node.child_by_field_name("declarator")
    refers = declarator is not None and declarator.type in {"reference_declarator", "pointer_declarator"}
    fixed = any(child.type == "type_qualifier" for child in node.children)
    return (("lending",) if fixed else ("reference",)) if refers else trailing_reference(declarator)


def trailing_reference(declarator: Node | None) -> tuple[str, ...]:
    """Return the same of what a function or a lambda returns behind `->`."""
    parts = declarator.named_children if declarator is not None else []
    written = next((part.text or b"" for part in parts if part.type == "trailing_return_type"), b"")
    returned = written.removeprefix(b"->").strip()
    refers = returned.endswith((b"&", b"*")) or returned == b"decltype(auto)"
    return (("lending",) if returned.startswith(b"const ") else ("reference",)) if refers else ()


def attributes(reader: ExprReader, node: Node) -> tuple[str, ...]:
    """Return the attributes of a declaration one by one, with what they are given."""
    groups = [child for child in node.named_children if child.type == "attribute_declaration"]
    return tuple([reader.text(each) for group in groups for each in group.named_children])


def announced_end(reader: ExprReader, node: Node) -> tuple[str, ...]:
    """Return `deprecated` when an attribute of a declaration says so: `[[deprecated("use b")]] int a;`."""
    for child in node.named_children:
        if child.type == "attribute_declaration" and b"deprecated" in _bytes(reader, child):
            return ("deprecated",)
    return ()


def _bytes(reader: ExprReader, node: Node) -> bytes:
    return reader.data[node.start_byte : node.end_byte]


def first_value(root: Node) -> Node | None:
    """Return the initial value of the first declaration of a parsed text."""
    declaration = root.named_children[0] if root.named_children else None
    declarator = declaration.child_by_field_name("declarator") if declaration is not None else None
    if root.has_error or declarator is None:
        return None
    return declarator.child_by_field_name("value")


def lines_of(node: Node) -> tuple[int, int]:
    """Return first and last line, from 1."""
    return node.start_point[0] + 1, node.end_point[0] + 1


def flat_members(body: Node) -> list[Node]:
    """Members of a class body, those inside preprocessor conditionals included."""
    found: list[Node] = []
    for child in body.named_children:
        if child.type.startswith("preproc_") and child.type in GROUPS:
            found.extend(flat_members(child))
        else:
            found.append(child)
    return found
