"""Lists: their elements, and the assignments behind a variable."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import (
    THIS,
    Call,
    Comprehension,
    Expr,
    Items,
    Member,
    Name,
    Op,
    Table,
)

from ecm_extract.infer.compute import UNKNOWN, method
from ecm_extract.infer.held import Held, State
from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.containers import KEEPING, begins_empty, is_container, makes_tuple
from ecm_extract.link.code.own import is_own_member, own_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.folding.captured import captured, is_around
from ecm_extract.link.folding.declared_members import only_source
from ecm_extract.link.folding.made_lists import made_elements
from ecm_extract.link.folding.named_containers import container_of_member
from ecm_extract.link.folding.open_lists import OpenLists
from ecm_extract.link.folding.python_lists import LIST_CALLS, OPERATED, ORDERLESS, SPLITS, operated
from ecm_extract.link.folding.sorted_containers import in_their_order
from ecm_extract.link.folding.subscripts import character_of, copied_range, part_of, slice_of, taken
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, invocation_of
from ecm_extract.link.running.values import Value, alternatives, data_in, demoted, is_proved, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ListFolder:
    """Takes lists apart."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.open = OpenLists(folder)
        self.any_order = False
        self._searching: set[tuple[Cls | None, str]] = set()

    def elements(self, expr: Expr | None, env: Env, index: Expr | None = None) -> tuple[Value, ...]:
        """Return the values that the elements of a list, or the one at an index or key, can have."""
        if index is not None:
            return self._at(expr, index, env)
        items = self.items(expr, env)
        if items is not None:
            return self._folded(items, env) or (unknown("item"),)
        some, _ = self._some(expr, env)
        rest = self.open.element(expr, env, whole=True)
        return alternatives((*self._folded(some, env), *rest)) if some else rest

    def _folded(self, items: Iterable[Bound], env: Env) -> tuple[Value, ...]:
        values = [value for bound in items for value in self.fold(bound, env)]
        return alternatives(demoted(values)) if values else ()

    def fold(self, bound: Bound, env: Env) -> tuple[Value, ...]:
        """Return the values of an element, as a part of an evaluation at a place."""
        return self.folder.fold(bound.expr, bound.env.deeper(max(env.depth, bound.env.depth) + 1))

    def _some(self, expr: Expr | None, env: Env) -> tuple[list[Bound], bool]:
        """Elements that a list surely may have, where not all are known."""
        return self.folder.held.any_items(self._ways(expr, env), env)

    def _ways(self, expr: Expr | None, env: Env) -> Sequence[tuple[Held, ...]]:
        """What a variable may hold, as the function at hand has it, or as all methods leave it."""
        if not isinstance(expr, Name | Member):
            return []
        return self.folder.flow.ways(expr, env) or [(held,) for held, _ in self.sources(expr, env)]

    def _at(self, expr: Expr | None, index: Expr, env: Env) -> tuple[Value, ...]:
        """The element at an index, or of a table the value of a key."""
        if isinstance(index, Op) and index.op == ":":
            return self._sliced_text(expr, index, env)
        keys = self.folder.fold(index, env)
        known = len(keys) == 1 and is_proved(keys[0])
        entries = self.folder.tables.entries(expr, env)
        if entries is not None:
            return self.folder.tables.entry(entries, index, env)
        items = self.items(expr, env)
        data = data_in(keys[0]) if known else UNKNOWN
        if items is not None and isinstance(data, int) and -len(items) <= data < len(items):
            return demoted(self.fold(items[data], env))
        if items is not None and data is UNKNOWN:
            return self._folded(items, env) or (unknown("item"),)
        if items is None and isinstance(expr, Call) and isinstance(data, int):
            split = self._part_of_text(invocation_of(expr, env), data, env)
            if split is not None:
                return split
        if items is None and isinstance(data, int):
            text = self.folder.combined(
                [self.folder.fold(expr, env)], lambda found: character_of(found[0], data), "item"
            )
            if not any(value.confidence == "pattern" for value in text):
                return text
        rest = self.open.element(expr, env) if items is not None else self.open.taken(expr, index, data, env)
        if isinstance(data, str) and env.func.file.language == "python":  # a list has no such index
            others = not isinstance(expr, Name | Member) or self.is_others(expr, env)
            return self.folder.tables.entry_of_any([] if others else self._ways(expr, env), index, env, rest)
        some, _ = self._some(expr, env) if items is None else ([], True)
        return alternatives((*self._folded(some, env), *rest)) if some else rest

    def _part_of_text(self, call: Invocation, at: int, env: Env) -> tuple[Value, ...] | None:
        """`text.split("/")[-1]` of each of the texts that it may be; None for other calls."""
        if env.func.file.language != "python" or call.last not in SPLITS or call.receiver is None or call.keywords:
            return None
        options = [self.folder.fold(part, env) for part in (call.receiver, *call.args)]
        return self.folder.combined(
            options, lambda data: part_of(method(call.last, data[0], data[1:], True), at), "item"
        )

    def _sliced_text(self, expr: Expr | None, index: Op, env: Env) -> tuple[Value, ...]:
        options = [self.folder.fold(part, env) for part in (expr, *index.operands)]
        return self.folder.combined(options, lambda data: slice_of(data[0], data[1:], str), "item")

    # --- lists -------------------------------------------------------------------------------------------------

    def items(self, expr: Expr | None, env: Env) -> list[Bound] | None:
        """Return all elements of a list that an expression is, None when the tree does not show them."""
        if env.depth > MAX_DEPTH or expr is None or not self.folder.steps.take(env):
            self.folder.cuts += 1
            return None
        with self.folder.steps:
            return self._items(expr, env)

    def in_any_order(self, expr: Expr | None, env: Env, any_order: bool = True) -> list[Bound] | None:
        """Return all elements of what may be a set of Python, for who does not mind their order."""
        before, self.any_order = self.any_order, any_order
        try:
            return self.items(expr, env)
        finally:
            self.any_order = before

    def _items(self, expr: Expr, env: Env) -> list[Bound] | None:
        expr = self.folder.class_names.by_object(expr, env)
        inner = env.before(env.at)
        if isinstance(expr, Items):
            copied = copied_range(expr.items)
            return self._spread(expr, env) if copied is None else self.items(copied, env)
        if isinstance(expr, Table):
            return self.folder.tables.keys(expr, env)
        if isinstance(expr, Comprehension):
            return self.folder.comprehended.elements(expr, inner)
        if (listed := self.folder.data_classes.elements(expr, inner)) is not None:
            return listed
        if isinstance(expr, Call):
            return self._called(expr, inner)
        if isinstance(expr, Op):
            return self._of_op(expr, inner)
        if not isinstance(expr, Name | Member):
            return None
        read = self.folder.properties.read(expr, inner)
        if read is not None:
            return self._returned(invocation_of(read, inner), inner)
        return in_their_order(self._of_variable(expr, inner), expr, env, self.folder)

    def _spread(self, expr: Items, env: Env) -> list[Bound] | None:
        """The elements of a display, `*spread` ones in place."""
        found: list[Bound] = []
        for item in expr.items:
            spread = item.operands if isinstance(item, Op) and item.op == "*" and len(item.operands) == 1 else ()
            more = self.items(spread[0], env.before(env.at)) if spread else [Bound(item, env)]
            if more is None:
                return None
            found += more
        return found

    def _of_op(self, expr: Op, env: Env) -> list[Bound] | None:
        if expr.op in OPERATED and len(expr.operands) == 2:
            return operated(self, expr, env)
        if expr.op == "?:":
            holds = self.folder.flow.truth(expr.operands[0], env)
            return None if holds is None else self.items(expr.operands[1 if holds else 2], env)
        if expr.op == "[]":
            return self._of_subscript(expr, env)
        return self.items(expr.operands[0], env) if expr.op == "&" and len(expr.operands) == 1 else None

    def _of_subscript(self, expr: Op, env: Env) -> list[Bound] | None:
        base, index = expr.operands
        entries = self.folder.tables.entries(base, env)
        if entries is not None:
            chosen = self.folder.tables.chosen(entries, index, env)
            return self.items(chosen.expr, chosen.env.deeper(env.depth + 1)) if chosen is not None else None
        items = self.items(base, env)
        if items is None:
            return None
        if isinstance(index, Op) and index.op == ":":
            bounds = [self.folder.fold(bound, env) for bound in index.operands]
            data = [data_in(values[0]) if len(values) == 1 else UNKNOWN for values in bounds]
            found = slice_of(items, data, list)
            return found if isinstance(found, list) else None
        found_ = self._chosen(items, index, env)
        return self.items(found_.expr, found_.env.deeper(env.depth + 1)) if found_ is not None else None

    def element(self, expr: Expr, env: Env) -> Bound | None:
        """Return the element of a list that `rows[1]` or `rows.at(1)` is; None where either is not known."""
        found = taken(expr)
        items = self.items(found[0], env) if found is not None else None
        return self._chosen(items, found[1], env) if items is not None and found is not None else None

    def _chosen(self, items: list[Bound], index: Expr, env: Env) -> Bound | None:
        data = [data_in(value) for value in self.folder.fold(index, env)]
        at = data[0] if len(data) == 1 else UNKNOWN
        return items[at] if isinstance(at, int) and -len(items) <= at < len(items) else None

    def _of_variable(self, expr: Name | Member, env: Env) -> list[Bound] | None:
        ways = self.folder.names.ways_of_class(expr, env) or self.folder.flow.ways(expr, env)
        if ways:
            return self.folder.iterators.of_held(expr, ways, env)
        given = self.folder.names.argument(expr.id, env) if isinstance(expr, Name) else None
        if given is not None:
            return self.folder.iterators.of_given(expr, given, env)
        if is_around(expr, env, self.folder):
            return self._found(captured(expr, env, self.folder))
        begun = self._at_first(expr, env)
        if begun is not None or self.is_others(expr, env):
            return begun
        found = self.sources(expr, env)
        if found:
            return self._left_in(expr, found, env)
        default = self._found(self.declared(expr, env))
        if isinstance(expr, Name):
            return default or self._constant(expr, env) or self.folder.enums.items(expr, env)
        if default is not None:
            return default
        left = self.folder.makers.left_in(expr, env)
        if left is not None:
            return self.folder.held.items(*left)
        field = self.folder.structures.listed(expr, env)
        if field is not None:
            return self._found(field)
        return self._shared_constant(expr, env) or self.folder.enums.items(expr, env)

    def _shared_constant(self, expr: Member, env: Env) -> list[Bound] | None:
        """The elements of a list that a class of Python, or another module, has."""
        dotted = dotted_name(expr) if env.func.file.language == "python" else ""
        return self.folder.names.module_items(dotted, env) if dotted else None

    def sources(self, expr: Name | Member, env: Env) -> list[tuple[Held, Env]]:
        """Return what methods leave a member with that is a list."""
        cls = env.this or env.func.cls
        member = is_own_member(expr) or (isinstance(expr, Name) and env.func.file.language == "cpp")
        name = expr.id if isinstance(expr, Name) else expr.name
        key = (cls, name)
        if cls is None or not member or key in self._searching:
            return []
        self._searching.add(key)
        try:
            return self.folder.members.sources(name, cls, env)
        finally:
            self._searching.discard(key)

    def _found(self, found: Bound | None) -> list[Bound] | None:
        return self.items(found.expr, found.env) if found is not None else None

    def declared(self, expr: Name | Member, env: Env) -> Bound | None:
        """Return what a member of the object at hand is declared with."""
        cls, name = env.this or env.func.cls, own_name(expr)
        if cls is None or self.folder.redefined.is_hidden(name, cls, env):
            return None
        for entry in self.folder.program.ancestry(cls):
            if name in entry.fields:
                given = entry.fields[name].default if not self.folder.names.is_changed(entry, name) else None
                return Bound(given, self.folder.names.at_class(entry, cls, env)) if given is not None else None
        return None

    def _constant(self, expr: Name, env: Env) -> list[Bound] | None:
        if env.func.file.language == "python":
            return self.folder.names.module_items(expr.id, env)
        found = self.folder.scope.constant(expr.id, env)
        if found is None or self.folder.names.may_change(expr.id, found[0], env):
            return None
        return self.items(found[0].value, self.folder.names.stated_at(*found, env))

    def given(self, key: str, env: Env, first: bool) -> list[Bound] | None:
        """Return the elements of a list that a variable is which the function did not change, `first`: yet."""
        name = key.rpartition(".")[2]
        entry = env.entry(State())
        cls = env.func.cls
        if not key.startswith("."):
            return self._items(Name(name), entry) if "." not in key else None
        if not first or not env.func.is_constructor or cls is None:
            return self._left_in(Member(THIS, name), self.sources(Member(THIS, name), entry), entry)
        for base in self.folder.program.bases(cls):
            if found := self.folder.members.sources_in_base(name, base, entry):
                return self.folder.held.items(*found[0]) if len(found) == 1 else None
        default = self._found(self.declared(Member(THIS, name), entry))
        empty = begins_empty(container_of_member(self.folder.scope.member_type(name, cls), cls, self.folder.program))
        return default if default is not None else [] if empty else None

    def _at_first(self, expr: Name | Member, env: Env) -> list[Bound] | None:
        """The elements of a member in a constructor that is run now, which gave it nothing yet, nor called who may."""
        name, cls = expr.id if isinstance(expr, Name) else expr.name, env.func.cls
        own = isinstance(expr, Name) or expr.base == THIS
        if not own or cls is None or env.state is None or not env.func.is_constructor or env.state.called:
            return None
        return self.given(f".{name}", env, True) if self.folder.scope.member_type(name, cls) else None

    def is_others(self, expr: Name | Member, env: Env) -> bool:
        """Tell whether functions that have the object of a member change it, so that no method here shows it."""
        if self.folder.changed_outside.is_handed_out(expr, env):
            return True
        name, cls = expr.id if isinstance(expr, Name) else expr.name, env.this or env.func.cls
        if cls is None or not (
            is_own_member(expr) or (isinstance(expr, Name) and self.folder.scope.member_type(name, cls))
        ):
            return False
        return self.folder.changed_outside.is_changed(name, cls)

    def _left_in(self, expr: Name | Member, given: list[tuple[Held, Env]], env: Env) -> list[Bound] | None:
        """What all methods together leave a member with."""
        only = only_source(expr, given, env, self.folder)
        return self.folder.held.items(*only) if only is not None else None

    # --- calls that give lists ---------------------------------------------------------------------------------

    def _called(self, expr: Call, env: Env) -> list[Bound] | None:
        call = invocation_of(expr, env)
        last = call.last
        if env.func.file.language == "python":
            work = LIST_CALLS.get(last if call.receiver is not None else call.path)
            if work is not None and self.any_order and last not in ORDERLESS:
                return self.in_any_order(expr, env, any_order=False)
            if work is not None:
                return work(self, call, env)
        elif call.receiver is None and is_container(call.path):
            return made_elements(self, call, env)
        elif makes_tuple(expr):
            return [Bound(arg, env) for arg in expr.args]
        elif call.receiver is None and len(call.args) == 1 and call.path in KEEPING:
            return self.items(call.args[0], env)
        return self._returned(call, env)

    def _returned(self, call: Invocation, env: Env) -> list[Bound] | None:
        """What a function of the tree returns, where one return is reached."""
        callee = self.folder.returns.meant(call, env)
        if callee is None or self.folder.redefined.may_be(callee, call, env):
            return None
        if "generator" in callee.fact.traits:
            return self.folder.iterators.yielded(callee, call, env)
        found = self.folder.returns.returned(callee, call, env)
        return self.items(*found[0]) if len(found) == 1 else None
