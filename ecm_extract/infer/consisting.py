"""What things of one function are made of: which variables each names, however it came to what it is."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import Effects
from ecm_extract.infer.held import Held, State, all_ways

_Node: TypeAlias = str | Held
"""A variable, by its key (see `places`), or a thing."""


class _Content(NamedTuple):
    """What one thing is made of.

    Attributes:
        keys: the variables that it names.
        elsewhere: what those hold at the other places where it was made.
        open: what it was before of which later rounds of a loop may show more.
    """

    keys: frozenset[str]
    elsewhere: Mapping[str, frozenset[Held]]
    open: frozenset[Held]


class Consisting:
    """Finds it; what a thing was before is looked through once."""

    def __init__(self, effects: Effects) -> None:
        self.effects = effects
        self._contents: dict[Held, _Content] = {}

    def named(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with those that they are, or consist of, and what these consist of."""
        return _closed(keys, lambda node: self._parts(node, state))

    def naming(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with those that are one of them, or consist of one, and what consists of these."""
        wholes = defaultdict[_Node, list[_Node]](list)
        pending, seen = list[_Node](state.holds), set[_Node]()
        while pending:
            node = pending.pop()
            if node not in seen:
                seen.add(node)
                for part in self._parts(node, state):
                    wholes[part].append(node)
                    pending.append(part)
        return _closed(keys, lambda node: wholes.get(node, ()))

    def _parts(self, node: _Node, state: State) -> Iterator[_Node]:
        """What a variable may hold, or what a thing is made of; one that is bound elsewhere is what it holds there."""
        if isinstance(node, str):
            yield from state.holds.get(node, ())
        elif _is_open(node):
            yield from node.before
        else:
            content = self._content(node)
            yield from content.keys
            yield from content.open
            for key, there in content.elsewhere.items():
                yield from there if key not in state.holds else ()

    def _content(self, held: Held) -> _Content:
        known = self._contents.get(held)
        pending = [held] if known is None else []
        while pending:
            current = pending[-1]
            before = [each for each in _before(current) if not _is_open(each)]
            unknown = [each for each in before if each not in self._contents]
            pending += unknown
            if not unknown:
                self._contents[pending.pop()] = self._of_all(current, before)
        return known if known is not None else self._contents[held]

    def _of_all(self, held: Held, before: Iterable[Held]) -> _Content:
        """What a thing is made of, by what it names itself and what it was before."""
        exprs = (*shared_names(held.expr), *shared_names(held.more))
        keys = frozenset([self.effects.key(expr) for expr in exprs]) - {""}
        there = held.env.state.holds if held.env is not None and held.env.state is not None else {}
        known = [self._contents[each] for each in before]
        elsewhere = {key: frozenset(there[key]) for key in keys if key in there}
        for key, found in ((key, found) for each in known for key, found in each.elsewhere.items()):
            elsewhere[key] = elsewhere[key] | found if key in elsewhere else found
        return _Content(
            keys.union(*[each.keys for each in known]),
            elsewhere,
            frozenset(filter(_is_open, _before(held))).union(*[each.open for each in known]),
        )


def _closed(keys: Iterable[str], following: Callable[[_Node], Iterable[_Node]]) -> set[str]:
    """Return variables, and what follows from them, and from that."""
    found: set[_Node] = set()
    pending: list[_Node] = list(keys)
    while pending:
        node = pending.pop()
        if node not in found:
            found.add(node)
            pending += following(node)
    return {node for node in found if isinstance(node, str)}


def _is_open(held: Held) -> bool:
    """Whether what a variable held before is told once a loop ends: its rounds begin with what nobody knows."""
    return held.how in {"lost", "looped"}


def _before(held: Held) -> Iterable[Held]:
    """What a variable may hold on each route, and what that was before it was changed: it still consists of that."""
    if held.how == "met":
        return all_ways((held,))
    return held.before if held.how != "entered" else ()
