"""Tables: their entries, by the statements that made and changed them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Comprehension, Constant, Expr, Items, Member, Name, Op, Table, Text

from ecm_extract.infer.compute import NULL
from ecm_extract.infer.held import Held, State
from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.containers import is_map
from ecm_extract.link.code.left_alone import SPREAD, SPREAD_KEY
from ecm_extract.link.code.own import is_own_member, own_name
from ecm_extract.link.folding.captured import captured, is_around
from ecm_extract.link.folding.declared_members import only_source
from ecm_extract.link.folding.named_containers import container_of_member, container_of_variable, is_table
from ecm_extract.link.folding.paired_tables import MAKERS, pairs_of
from ecm_extract.link.folding.reached_elements import reached
from ecm_extract.link.folding.subscripts import taken
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, invocation_of
from ecm_extract.link.running.values import Value, alternatives, constant, data_in, demoted, is_proved, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Entry(NamedTuple):
    """An entry of a table."""

    key: Bound
    value: Bound


class TableFolder:
    """Takes tables apart."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._asked: set[Held] = set()

    def entry(self, entries: list[Entry], key: Expr, env: Env) -> tuple[Value, ...]:
        """Return the value of a key: of the last entry that has it, of any that may have it."""
        found, surely = self._having(entries, key, env)
        return alternatives(demoted(found) if surely else (*demoted(found), unknown("item")))

    def entry_of_any(
        self, ways: Sequence[tuple[Held, ...]], key: Expr, env: Env, rest: Sequence[Value]
    ) -> tuple[Value, ...]:
        """Return the value of a key in each table that a variable may hold, `rest` for one that is not known."""
        tables = [self.held_entries(held, env) for held in dict.fromkeys(held for way in ways for held in way)]
        found = [value for table in tables if table is not None for value in self.entry(table, key, env)]
        return alternatives((*found, *(rest if None in tables or len(tables) < 2 else ())))

    def entry_or(self, entries: list[Entry], key: Expr, rest: Sequence[Expr], env: Env) -> tuple[Value, ...]:
        """Return `table.get(key, default)`."""
        found, surely = self._having(entries, key, env)
        default = self.folder.fold(rest[0], env) if rest else (constant(NULL),)
        return alternatives(demoted(found if surely else (*found, *default)))

    def chosen(self, entries: list[Entry], key: Expr, env: Env, likely: bool = False) -> Bound | None:
        """Return what a table surely has for a key, or has as long as nobody sets a parameter; None for undecided."""
        entry, alike = self._last_alike(entries, key, env, likely)
        return entry.value if entry is not None and alike else None

    def _last_alike(self, entries: list[Entry], key: Expr, env: Env, likely: bool) -> tuple[Entry | None, bool]:
        """The last entry that may have a key, and whether it has; none where no entry has it."""
        for entry in reversed(entries):
            place = self.folder.flow.naming(env, {"#key": entry.key})
            alike = self.folder.flow.alike(key, Name("#key"), place, likely)
            if alike is not False:
                return entry, bool(alike)
        return None, False

    def _having(self, entries: list[Entry], key: Expr, env: Env) -> tuple[list[Value], bool]:
        """The values of the entries that may have a key, the last first, and whether one of them surely has it."""
        found: list[Value] = []
        for entry in reversed(entries):
            alike = self.folder.flow.alike(key, Name("#key"), self.folder.flow.naming(env, {"#key": entry.key}))
            if alike is not False:
                found += self.folder.lists.fold(entry.value, env)
            if alike:
                return found, True
        return found, False

    def entries(self, expr: Expr | None, env: Env) -> list[Entry] | None:
        """Return the entries of a table in the order in which they were given; None when they are not all known."""
        if env.depth > MAX_DEPTH or expr is None or not self.folder.steps.take(env):
            self.folder.cuts += 1
            return None
        with self.folder.steps:
            return self._entries(expr, env.before(env.at))

    def _entries(self, expr: Expr, env: Env) -> list[Entry] | None:
        expr = self.folder.class_names.by_object(expr, env)
        if isinstance(expr, Table):
            return self._displayed(expr, env)
        if (listed := self.folder.data_classes.entries(expr, env)) is not None:
            return [Entry(*pair) for pair in listed]
        if isinstance(expr, Comprehension) and isinstance(expr.element, Table):
            rows = self.folder.comprehended.elements(expr, env)
            return None if rows is None else [entry for row in rows for entry in self._entries(row.expr, row.env) or ()]
        if isinstance(expr, Call):
            return self._entries_of_call(expr, env)
        if isinstance(expr, Op) and expr.op == "[]":
            each = self.element(expr, env)
            return self.entries(each.expr, each.env.deeper(env.depth + 1)) if each is not None else None
        if isinstance(expr, Op) and expr.op == "|":
            return _one_after_the_other([self.entries(side, env) for side in expr.operands])
        return self._entries_of_variable(expr, env) if isinstance(expr, Name | Member) else None

    def _entries_of_variable(self, expr: Name | Member, env: Env) -> list[Entry] | None:
        read = self.folder.properties.read(expr, env)
        if read is not None:
            return self._returned_entries(invocation_of(read, env), env)
        ways = self.folder.names.ways_of_class(expr, env) or self.folder.flow.ways(expr, env)
        if ways:
            states = list(dict.fromkeys(ways))
            return self.held_entries(states[0][0], env) if len(states) == 1 and len(states[0]) == 1 else None
        given = self.folder.names.argument(expr.id, env) if isinstance(expr, Name) else None
        if given is not None:
            return self.entries(given.expr, given.env.deeper(env.depth + 1))
        if is_around(expr, env, self.folder):
            around = captured(expr, env, self.folder)
            return self.entries(around.expr, around.env) if around is not None else None
        if self.folder.lists.is_others(expr, env):
            return None
        found = self.folder.lists.sources(expr, env)
        if found:
            only = only_source(expr, found, env, self.folder)
            return self.held_entries(*only) if only is not None else None
        left = self.folder.makers.left_in(expr, env) if isinstance(expr, Member) else None
        return self.held_entries(*left) if left is not None else self._declared_entries(expr, env)

    def element(self, expr: Expr, env: Env, likely: bool = False) -> Bound | None:
        """Return what a table (likely: see `chosen`) has for a key, or a list at an index: `table["a"]`, `rows[0]`."""
        place = taken(expr)
        entries = self.entries(place[0], env) if place is not None else None
        if place is None or entries is None:
            return self.folder.lists.element(expr, env)
        return self.chosen(entries, place[1], env, likely)

    def element_or(self, table: Expr, given: Sequence[Expr], env: Env) -> Bound | None:
        """Return what `table.get(key, default)` gives as long as nobody sets a parameter; None for undecided."""
        entries = self.entries(table, env)
        if entries is None:
            return None
        entry, alike = self._last_alike(entries, given[0], env, likely=True)
        if entry is not None:
            return entry.value if alike else None
        return Bound(given[1], env) if len(given) == 2 else None

    def _displayed(self, expr: Table, env: Env) -> list[Entry] | None:
        """The entries of a display, those of tables that it spreads in place."""
        found: list[Entry] = []
        for key, value in expr.entries:
            more = self.entries(value, env) if key == SPREAD_KEY else [Entry(Bound(key, env), Bound(value, env))]
            if more is None:
                return None
            found += more
        return found

    def _declared_entries(self, expr: Name | Member, env: Env) -> list[Entry] | None:
        if env.func.file.language == "python":
            dotted = dotted_name(expr)
            own = self.folder.lists.declared(expr, env) if is_own_member(expr) else None
            return self.entries(own.expr, own.env) if own is not None else self.folder.names.module_entries(dotted, env)
        if self.folder.flow.effects(env.func).key(expr).startswith("."):
            own = self.folder.lists.declared(expr, env)
            written = self.folder.scope.member_type(own_name(expr), env.this or env.func.cls)
            return self._pairs(own.expr, own.env) if own is not None and "map" in written else None
        found = self.folder.scope.constant(expr.id, env) if isinstance(expr, Name) else None
        if found is not None and found[0].value is not None and "map" in found[0].type:
            fixed = not self.folder.names.may_change(found[0].name, found[0], env)
            return self._pairs(found[0].value, self.folder.names.stated_at(*found, env)) if fixed else None
        return None

    def _entries_of_call(self, expr: Call, env: Env) -> list[Entry] | None:
        call = invocation_of(expr, env)
        if env.func.file.language == "python":
            if call.path in MAKERS:
                return self._made(call, env)
            copies = call.last == "copy" and call.receiver is not None and not call.args
            return self.entries(call.receiver, env) if copies else self._returned_entries(call, env)
        if call.receiver is None and is_map(container_of_variable(call.path, env.func, self.folder.program)):
            listed = call.args[0] if len(call.args) == 1 else Items(call.args)
            if not isinstance(listed, Items):
                return self.entries(listed, env)
            pairs = self._pairs(listed, env)
            return self._pairs(Items(call.args), env) if pairs is None else pairs
        return self._returned_entries(call, env)

    def _made(self, call: Invocation, env: Env) -> list[Entry] | None:
        """The entries of `dict(other, key=value)`: those of the other one, and what is given by name over them."""
        found = [self._entries_or_pairs(base, env) for base in call.args[:1]]
        for key, value in call.keywords:
            given = self.entries(value, env) if key == SPREAD else [Entry(Bound(Text(key), env), Bound(value, env))]
            found.append(given)
        return _one_after_the_other(found)

    def _entries_or_pairs(self, base: Expr, env: Env) -> list[Entry] | None:
        known = self.entries(base, env)
        pairs = pairs_of(base, env, self.folder) if known is None else None
        return [Entry(*pair) for pair in pairs] if pairs is not None else known

    def _returned_entries(self, call: Invocation, env: Env) -> list[Entry] | None:
        callee = self.folder.returns.meant(call, env)
        if callee is None or self.folder.redefined.may_be(callee, call, env):
            return None
        found = self.folder.returns.returned(callee, call, env)
        return self.entries(*found[0]) if len(found) == 1 else None

    def _pairs(self, expr: Expr, env: Env) -> list[Entry] | None:
        items = expr.items if isinstance(expr, Items) else ()
        if not isinstance(expr, Items) or not all(isinstance(item, Items) and len(item.items) == 2 for item in items):
            return None
        return [Entry(*[Bound(part, env) for part in item.items]) for item in items if isinstance(item, Items)]

    def held_entries(self, held: Held, env: Env) -> list[Entry] | None:
        """Return the entries of a table that a variable holds; None when they are not all known."""
        if env.depth > MAX_DEPTH or held in self._asked:
            self.folder.cuts += 1
            return None
        self._asked.add(held)
        try:
            return self._kept_entries(held, env.deeper(env.depth + 1))
        finally:
            self._asked.discard(held)

    def _entries_at_first(self, held: Held, env: Env) -> list[Entry] | None:
        """The entries of a table that the function did not change."""
        if held.how == "given":
            entered = self.folder.states.entered(held.name, env)
            return self.held_entries(entered, env) if entered is not None else self._given_entries(held.name, env)
        member = Member(THIS, held.name.rpartition(".")[2])
        only = only_source(member, self.folder.lists.sources(member, env), env, self.folder)
        return self.held_entries(*only) if only is not None else None

    def _kept_entries(self, held: Held, env: Env) -> list[Entry] | None:
        inner = held.env.deeper(env.depth + 1) if held.env is not None else env.deeper(env.depth + 1)
        if held.how == "value":
            declared = is_table(held, self.folder.program)
            return (
                self._pairs(held.expr, inner)
                if declared and isinstance(held.expr, Items)
                else self.entries(held.expr, inner)
            )
        if held.how == "made":
            return [] if is_table(held, self.folder.program) else None
        if held.how in {"given", "shared"}:
            return self._entries_at_first(held, env)
        if held.how == "out":
            found = self.folder.behind_calls.out(held, inner)
            single = found is not None and len(found[0]) == 1
            return self.held_entries(found[0][0], found[1].deeper(env.depth + 1)) if found and single else None
        if held.how == "after":
            left = self.folder.behind_calls.left(held, inner)
            single = left is not None and len(left[0]) == 1
            return self.held_entries(left[0][0], left[1].deeper(env.depth + 1)) if left and single else None
        ways = self.folder.flow.decisions.ways(held.before)
        if held.how == "entered":
            return self.held_entries(ways[0], inner) if len(ways) == 1 else None
        before = self.held_entries(ways[0], env) if len(ways) == 1 else None
        if before is None:
            return None
        if held.how == "reached":
            return [Entry(entry.key, reached(entry.value)) for entry in before]
        if held.how == "stored" and held.expr is not None and held.more is not None:
            return [*before, Entry(Bound(held.expr, inner), Bound(held.more, inner))]
        return self._changed_entries(before, held, inner) if held.how == "changed" else None

    def _given_entries(self, key: str, env: Env) -> list[Entry] | None:
        """A member at the start of a constructor is empty, or what it is declared with."""
        name, cls = key.rpartition(".")[2], env.func.cls
        if "." not in key:
            entry = env.entry(State())
            return self._entries(Name(name), entry)
        if not key.startswith(".") or not env.func.is_constructor or cls is None:
            return None
        for base in self.folder.program.bases(cls):
            found = self.folder.members.sources_in_base(name, base, env)
            if found:
                return self.held_entries(*found[0]) if len(found) == 1 else None
        field = cls.fields.get(name)
        if field is None:
            return None
        if field.default is None:
            return [] if is_map(container_of_member(field.type, cls, self.folder.program)) else None
        place = Env(env.func, 0, depth=env.depth + 1, this=cls)
        return (
            self._pairs(field.default, place)
            if isinstance(field.default, Items)
            else self.entries(field.default, place)
        )

    def _changed_entries(self, entries: list[Entry], held: Held, env: Env) -> list[Entry] | None:
        """`update`, `setdefault`, `insert`, `emplace`: those of C++ keep what a key has."""
        call = held.expr
        if not isinstance(call, Call) or not isinstance(call.callee, Member):
            return None
        name, args = call.callee.name, call.args
        if name == "clear" and not args:
            return []
        if name == "pop" and args and env.func.file.language == "python":
            return self.folder.popped.left(entries, args[0], env)
        if name == "update" and len(args) <= 1 and (args or env.func.file.language == "python"):
            keys = [SPREAD_KEY if key == SPREAD else Text(key) for key, _ in call.keywords]
            named = Table(tuple(zip(keys, [value for _, value in call.keywords], strict=True)))
            parts = [self.entries(part, env) for part in (*args, named)]
            return None if None in parts else [*entries, *(entry for part in parts for entry in part or ())]
        if name in {"insert_or_assign"} and len(args) == 2:
            return [*entries, Entry(Bound(args[0], env), Bound(args[1], env))]
        pair = args[0].items if name == "insert" and len(args) == 1 and isinstance(args[0], Items) else args
        if name in {"insert", "emplace", "setdefault", "try_emplace"} and len(pair) == 2:
            return self._completed(entries, Entry(Bound(pair[0], env), Bound(pair[1], env)), env)
        return None

    def _completed(self, entries: list[Entry], more: Entry, env: Env) -> list[Entry] | None:
        """The entries with one more behind them, unless a table has its key: Python keeps the order they came in."""
        found, surely = self._having(entries, more.key.expr, env)
        if surely or not found:
            return entries if surely else [*entries, more]
        return None if env.func.file.language == "python" else [more, *entries]

    def keys(self, table: Expr, env: Env) -> list[Bound] | None:
        """Return the keys of a table, which a loop over it gives."""
        if isinstance(table, Table) and all(key != Constant("null") for key, _ in table.entries):
            return [Bound(key, env) for key, _ in table.entries]
        entries = self.entries(table, env)
        found = self.distinct(entries, env) if entries is not None else None
        return [entry.key for entry in found] if found is not None else None

    def distinct(self, entries: list[Entry], env: Env) -> list[Entry] | None:
        """Return the entries that a table has in the end: each key once, in the place where it came first."""
        found: dict[Any, Entry] = {}
        for entry in entries:
            keys = self.folder.lists.fold(entry.key, env)
            if len(keys) != 1 or not is_proved(keys[0]):
                return None
            first = found.get(data_in(keys[0]))
            found[data_in(keys[0])] = Entry(first.key if first is not None else entry.key, entry.value)
        return list(found.values())


def _one_after_the_other(tables: Sequence[list[Entry] | None]) -> list[Entry] | None:
    """The entries of several tables in one, where the last of a key counts; None where one of them is not known."""
    known = [table for table in tables if table is not None]
    return [entry for table in known for entry in table] if len(known) == len(tables) else None
