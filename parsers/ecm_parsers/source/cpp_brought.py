"""Names that a block of C++ takes from a namespace: `using names::topic;`, until the block ends.

Source: [namespace.udecl] of the C++ standard: such a name hides those of the blocks and namespaces around. A name that
a block takes from two namespaces means either; whoever resolves names is left to tell which.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader

_NAMING = frozenset(
    {"using_declaration", "alias_declaration", "namespace_alias_definition", "type_definition", "comment"}
)


def names_used(reader: ExprReader, node: Node) -> list[str]:
    """Return what a using-declaration names, also several (`using a::b, c::d;`), which no grammar reads."""
    if node.has_error:
        return ["".join(part.split()) for part in reader.text(node).removeprefix("using").rstrip("; ").split(",")]
    return [reader.name(child) for child in node.named_children]


def is_directive(node: Node) -> bool:
    """Tell whether a using-declaration is `using namespace a`."""
    return any(child.type == "namespace" for child in node.children)


def holds_partly(node: Node) -> bool:
    """Tell whether a part of the function does not have what a declaration brings: it is in a block, or comes late."""
    block = node.parent
    if block is None or block.type != "compound_statement" or block.parent is None:
        return True
    earlier = (child for child in block.named_children if child.start_byte < node.start_byte)
    of_function = block.parent.type in {"function_definition", "lambda_expression"}
    return not of_function or any(child.type not in _NAMING for child in earlier)


class Brought:
    """The names that are taken where a body is being read, with what they stand for; empty of others.

    Args:
        around: those of the function around a lambda.
    """

    def __init__(self, around: Brought | None = None) -> None:
        self._names: ChainMap[str, str] = ChainMap({}, dict(around._names) if around is not None else {})

    def take(self, whole: str) -> None:
        """Take `topic` of `names::topic` from here on."""
        name = whole.rpartition("::")[2]
        other = self._names.maps[0].get(name, whole) != whole
        self._names[name] = "" if other else whole

    def hide(self, names: Iterable[str]) -> None:
        """Mean variables of these names from here on."""
        self._names.update(dict.fromkeys(set(names) & self._names.keys(), ""))

    def meant(self, name: str) -> str:
        """Return what a name stands for; itself where it is not taken."""
        return self._names.get(name) or name

    @contextmanager
    def block(self, hidden: Iterable[str] = ()) -> Iterator[None]:
        """Read a block of its own, with variables of its own."""
        around = self._names
        self._names = around.new_child()
        self.hide(hidden)
        yield
        self._names = around
