"""Changes of lists: their elements after a method, or after one was given a value; the order that they are put in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.infer.held import Held
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_APPENDS: Final = frozenset({"push_back", "emplace_back", "append"})


class ListChanges:
    """Does to the elements of lists what code does; None for what is not modelled."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def changed(self, items: list[Bound], call: Call, env: Env) -> list[Bound] | None:
        """Return the elements of a list after a method changed it; None for what is not modelled."""
        name = call.callee.name if isinstance(call.callee, Member) else ""
        args = call.args
        if name in _APPENDS and len(args) == 1:
            return [*items, Bound(args[0], env)]
        if name == "emplace_back" and len(args) > 1:
            return [*items, Bound(Items(args), env)]
        if name in {"pop", "pop_back"} and not args and items:
            return items[:-1]
        if name == "remove" and len(args) == 1 and env.func.file.language == "python":
            return self._without(items, args[0], env)
        if name == "clear" and not args:
            return []
        if name == "reverse" and not args:
            return items[::-1]
        if name == "extend" and len(args) == 1:
            more = self.folder.lists.items(args[0], env)
            return None if more is None else [*items, *more]
        if name == "sort" and not args and not call.keywords:
            return self.ordered(items)
        return self._at_place(name, items, args, env)

    def _at_place(self, name: str, items: list[Bound], args: tuple[Expr, ...], env: Env) -> list[Bound] | None:
        at = self._place(args[0], items, env) if args else None
        if at is None:
            return None
        if name == "insert" and len(args) == 2:
            return [*items[:at], Bound(args[1], env), *items[at:]]
        inside = -len(items) <= at < len(items)
        return (
            [item for index, item in enumerate(items) if index != at % len(items)] if name == "pop" and inside else None
        )

    def _place(self, expr: Expr, items: list[Bound], env: Env) -> int | None:
        if isinstance(expr, Call) and isinstance(expr.callee, Member) and not expr.args:
            return {"begin": 0, "end": len(items)}.get(expr.callee.name)
        values = self.folder.fold(expr, env)
        data = values[0].data if len(values) == 1 and is_proved(values[0]) else None
        return data if isinstance(data, int) and not isinstance(data, bool) else None

    def stored(self, items: list[Bound], held: Held, env: Env) -> list[Bound] | None:
        """Return the elements of a list after one was given a value."""
        at = self._place(held.expr, items, env) if held.expr is not None else None
        if at is None or held.more is None or not -len(items) <= at < len(items):
            return None
        changed = list(items)
        changed[at] = Bound(held.more, env)
        return changed

    def ordered(self, items: list[Bound]) -> list[Bound] | None:
        """Return elements in their order, where each of them is known."""
        return self.ordered_by(items, items)

    def ordered_by(self, items: list[Bound], keys: Sequence[Bound]) -> list[Bound] | None:
        """Return elements in the order of other ones, where each of these is known."""
        values = [self.folder.lists.fold(key, key.env) for key in keys]
        if len(keys) != len(items) or any(
            len(found) != 1 or not is_proved(found[0]) or data_in(found[0]) is UNKNOWN for found in values
        ):
            return None
        data = [data_in(found[0]) for found in values]
        if len({type(entry) for entry in data}) > 1:
            return None
        return [item for _, item in sorted(zip(data, items, strict=True), key=lambda pair: pair[0])]

    def _without(self, items: list[Bound], what: Expr, env: Env) -> list[Bound] | None:
        """A list without the first element that is equal; None where that is not decided."""
        for at, item in enumerate(items):
            place = self.folder.flow.naming(env, {"#item": item})
            same = self.folder.flow.alike(what, Name("#item"), place)
            if same is not False:
                return [*items[:at], *items[at + 1 :]] if same else None
        return None
