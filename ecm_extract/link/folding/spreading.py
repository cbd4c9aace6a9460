"""Calls of Python that spread values among their arguments, read as if they gave them one by one.

`create_publisher(*spec)` with `spec = (String, "x", 10)` is `create_publisher(String, "x", 10)`. What is not known
stays spread: `*rest` and `**table` at the end of a call stand for whatever else it may give.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Name, Op, Opaque, Table
from msgspec.structs import replace

from ecm_extract.link.code.calls import PLACEHOLDER, Invocation, spreads
from ecm_extract.link.code.left_alone import SPREAD, SPREAD_KEY, is_spread
from ecm_extract.link.code.walk import names_in
from ecm_extract.link.running.arguments import MAX_HANDED, handed_on
from ecm_extract.link.running.env import Bound, Env, invocation_of
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Spread(NamedTuple):
    """A call with the place where its arguments are evaluated."""

    call: Invocation
    env: Env


class _Given:
    """What a call gives in order and by name; `rest` and `table` are what nobody knows of either."""

    def __init__(self) -> None:
        self.placed: list[Bound] = []
        self.named: dict[str, Bound] = {}
        self.rest: Bound | None = None
        self.table: Bound | None = None


class Spreading:
    """Finds what calls are given by what they spread."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def whole(self, expr: Call, env: Env) -> Spread:
        """Return a call expression as the forms see it, with what it spreads in place."""
        return self.out(invocation_of(expr, env), env)

    def out(self, call: Invocation, env: Env) -> Spread:
        """Return a call with what it spreads in place, as far as that is known."""
        if not spreads(call):
            return Spread(call, env)
        given = _Given()
        for arg in call.args:
            self._place(given, Bound(arg, env), 0)
        for name, value in call.keywords:
            self._name(given, name, Bound(value, env), 0)
        return self._written(given, call, env)

    def known(self, call: Invocation, env: Env) -> Spread:
        """Return a call with all that it spreads in place, or as it is where not all of that is known."""
        found = self.out(call, env)
        return found if not spreads(found.call) else Spread(call, env)

    def _written(self, given: _Given, call: Invocation, env: Env) -> Spread:
        bound: dict[str, Bound] = {}

        def at_place(each: Bound) -> Expr:
            if each.env is env or isinstance(each.expr, Opaque):
                return each.expr
            bound[f"{PLACEHOLDER}{len(bound)}"] = each
            return Name(f"{PLACEHOLDER}{len(bound) - 1}")

        args = [at_place(each) for each in given.placed]
        keywords = [(name, at_place(each)) for name, each in given.named.items()]
        if given.rest is not None:
            args.append(Op("*", (at_place(given.rest),)))
        if given.table is not None:
            keywords.append((SPREAD, at_place(given.table)))
        place = self.folder.flow.naming(env, bound) if bound else env
        return Spread(replace(call, args=tuple(args), keywords=tuple(keywords)), place)

    # --- in order ----------------------------------------------------------------------------------------------

    def _place(self, given: _Given, arg: Bound, depth: int) -> None:
        if given.rest is not None:
            return
        if not isinstance(arg.expr, Op) or not is_spread(arg.expr):
            given.placed.append(arg)
            return
        (values,) = arg.expr.operands
        items = self.folder.lists.items(values, arg.env)
        if items is not None:
            given.placed += items
            return
        shown = handed_on(Bound(values, arg.env), self.folder.names.argument)
        if isinstance(shown.expr, Items) and depth < MAX_HANDED:
            for item in shown.expr.items:
                self._place(given, Bound(item, shown.env), depth + 1)
        else:
            given.rest = self._open(shown)

    # --- by name -----------------------------------------------------------------------------------------------

    def _name(self, given: _Given, name: str, value: Bound, depth: int) -> None:
        if name != SPREAD:
            given.named[name] = value
            return
        table = self._entries(value)
        if table is not None:
            given.named |= table
            return
        shown = handed_on(value, self.folder.names.argument)
        if not isinstance(shown.expr, Table) or depth >= MAX_HANDED:
            given.table = self._open(shown)
            return
        for key, each in shown.expr.entries:
            if key == SPREAD_KEY:
                self._name(given, SPREAD, Bound(each, shown.env), depth + 1)
            else:
                named = self._entries(Bound(Table(((key, each),)), shown.env))
                given.named |= named or {}
                given.table = given.table if named is not None else Bound(Opaque(SPREAD), shown.env)

    def _entries(self, table: Bound) -> dict[str, Bound] | None:
        """The entries of a table whose keys are all known texts, the last of each."""
        entries = self.folder.tables.entries(table.expr, table.env)
        found: dict[str, Bound] = {}
        for entry in entries or ():
            keys = self.folder.lists.fold(entry.key, table.env)
            key = data_in(keys[0]) if len(keys) == 1 and is_proved(keys[0]) else None
            if not isinstance(key, str):
                return None
            found[key] = entry.value
        return None if entries is None else found

    # --- parameters --------------------------------------------------------------------------------------------

    def _open(self, value: Bound) -> Bound:
        """A parameter of which the callers know what it is, as the function begins, or what nobody does."""
        entry = value.env.entry()
        params = [name for name in names_in(value.expr) if name in entry.func.given]
        unbound = [name for name in params if self.folder.names.argument(name, entry) is None]
        return Bound(Name(unbound[0]) if unbound else Opaque(SPREAD), entry)
