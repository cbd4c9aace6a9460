"""What the variables of a declarative file of Python hold, statement by statement, without running it."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.python_builtins import changed_by
from ecm_parsers.python_tree import Reached, callee_name, fold, read_call, text_of
from ecm_parsers.python_values import Names, Table, Unknown, Value, either, operate

TELLING = frozenset({"assignment", "augmented_assignment", "call"})
"""Statements that give a variable something, or may change what it holds."""
MAX_NAME = 200
MAX_ENTRIES = 200
"""Entries of one dictionary that are set one by one."""


class Variables:
    """Follows assignments, `x += y`, `x["key"] = y` and the methods that change lists and dictionaries.

    Args:
        begun: what is known before the first statement.

    Attributes:
        names: the variables, by name as written.
    """

    def __init__(self, begun: Names | None = None) -> None:
        self.names: dict[str, Value] = dict(begun or {})

    def take(self, reached: Reached) -> None:
        """Note what a statement of `TELLING` does; one that may not be taken leaves what it changes open."""
        node = reached.node
        if node.type == "call":
            self._change(node, reached.certain)
            return
        target, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        if target is None or right is None:
            return
        value = fold(right, self.names)
        if node.type == "augmented_assignment":
            operator, held = node.child_by_field_name("operator"), self.names.get(_name(target))
            made = operate(text_of(operator).removesuffix("="), held, value) if operator and held else None
            value = _open(_name(target), value.line) if made is None else Value(made, value.line)
        if target.type == "subscript":
            self._set_entry(target, value, reached.certain)
        for each in target.named_children if target.type in {"pattern_list", "tuple_pattern"} else ():
            self.give(_name(each), _open(_name(each), value.line), True)
        self.give(_name(target), value, reached.certain)

    def give(self, name: str, value: Value, certain: bool) -> None:
        """Let a variable hold a value; behind a branch that is not decided it may hold what it did."""
        self.names[name] = value if certain else either(self.names.get(name), value, name)

    def _change(self, call: Node, certain: bool) -> None:
        owner, _, method = callee_name(call.child_by_field_name("function")).rpartition(".")
        held = self.names.get(owner)
        made = changed_by(method, held, read_call(call, self.names)) if held is not None else None
        if held is not None and made is not held:
            self.give(owner, made or _open(owner, held.line), certain)

    def _set_entry(self, target: Node, value: Value, certain: bool) -> None:
        """`d["packages"] = [...]` of a dictionary."""
        whole, keys = target.child_by_field_name("value"), target.children_by_field_name("subscript")
        held = self.names.get(_name(whole)) if whole is not None and whole.type == "identifier" else None
        if whole is None or held is None:
            return
        key = fold(keys[0], self.names) if len(keys) == 1 else None
        entries = held.data.entries if isinstance(held.data, Table) else ()
        if key is None or not isinstance(key.data, str) or len(entries) >= MAX_ENTRIES:
            self.give(_name(whole), _open(_name(whole), held.line), True)
            return
        kept = tuple(entry for entry in entries if entry[0].data != key.data)
        before = next((entry[1] for entry in entries if entry[0].data == key.data), None)
        given = value if certain else either(before, value, key.data)
        self.names[_name(whole)] = Value(Table((*kept, (key, given))), held.line)


def _open(name: str, line: int) -> Value:
    return Value(Unknown(name[:80]), line)


def _name(target: Node) -> str:
    return text_of(target)[:MAX_NAME]
