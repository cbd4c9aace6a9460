"""What things of one function are made of: which variables each names, however it came to what it is."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Set
from typing import Final, NamedTuple

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import Effects
from ecm_extract.infer.held import Held, State, all_ways
from ecm_extract.infer.places import owners, wholes


class _Content(NamedTuple):
    """What a thing, or what a variable may hold, is made of.

    Attributes:
        keys: the variables that it names.
        elsewhere: what those hold at the other places where it was made.
        open: what it was before of which later rounds of a loop may show more.
    """

    keys: frozenset[str]
    elsewhere: Mapping[str, frozenset[Held]]
    open: frozenset[Held]


_NOTHING: Final = _Content(frozenset(), {}, frozenset())


class Consisting:
    """Finds it; what a thing was before is looked through once, and what a variable holds once until a loop ends."""

    def __init__(self, effects: Effects) -> None:
        self.effects = effects
        self._contents: dict[Held, _Content] = {}
        self._of_ways: dict[Collection[Held], _Content] = {}

    def loop_ended(self) -> None:
        """Forget what was found of variables: what they held when a round of a loop began is known now."""
        self._of_ways.clear()

    def forget(self) -> None:
        """Drop all that was found, since the run is over: who ran it may be kept by a circle until the end of all."""
        self._contents.clear()
        self._of_ways.clear()

    def named(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with those that they are, or consist of, and what these consist of."""
        return self._within(keys, {}, state)

    def reached(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with all that who has them may change: what they and their fields are, or consist of."""
        return self._within(keys, _fields(state), state)

    def _within(self, keys: Iterable[str], fields: Mapping[str, list[str]], state: State) -> set[str]:
        found, pending = set[str](), list(keys)
        while pending:
            key = pending.pop()
            if key not in found:
                found.add(key)
                pending += self._parts(key, state)
                pending += fields.get(key, ())
        return found

    def naming(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with those that are one of them, or consist of one, and what consists of these."""
        holding = defaultdict[str, list[str]](list)
        for name in state.holds:
            for part in self._parts(name, state):
                holding[part] += (name, *wholes(name), *owners(name))
        found, pending = set[str](), list(keys)
        while pending:
            key = pending.pop()
            if key not in found:
                found.add(key)
                pending += holding.get(key, ())
        return found

    def _parts(self, name: str, state: State) -> Set[str]:
        """The variables that one consists of; of one that is bound elsewhere, what it holds there consists of."""
        ways = state.holds.get(name, ())
        content = self._together(ways)
        elsewhere = self._since_other_methods(name, ways)
        if elsewhere:
            content = content._replace(keys=content.keys | elsewhere)
        pending = [there for key, there in content.elsewhere.items() if key not in state.holds]
        if not pending:
            return content.keys
        keys, seen = set(content.keys), set[Collection[Held]]()
        while pending:
            there = pending.pop()
            if there not in seen:
                seen.add(there)
                content = self._together(there)
                keys |= content.keys
                pending += [ways for key, ways in content.elsewhere.items() if key not in state.holds]
        return keys

    def _since_other_methods(self, name: str, ways: Collection[Held]) -> Set[str]:
        """The members that one may be, or consist of, as other methods left it."""
        shared = self.effects.targets.shared_members(self.effects.func) if name[:1] == "." else {}
        others = shared.get(name) if shared else None
        own = bool(ways) and all(held.how == "value" for held in all_ways(ways))
        return others if others and not own else frozenset()

    def _together(self, ways: Collection[Held]) -> _Content:
        """What is held, as far as the rounds of loops have shown what it was before."""
        known = self._of_ways.get(ways)
        if known is None:
            found, seen, pending = list[_Content](), set[Held](), list(ways)
            while pending:
                held = pending.pop()
                if held not in seen:
                    seen.add(held)
                    content = None if _is_open(held) else self._content(held)
                    found += [] if content is None else [content]
                    pending += held.before if content is None else content.open
            known = self._of_ways[ways] = _merged(found)
        return known

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
        elsewhere = {key: frozenset(there[key]) for key in keys if key in there}
        own = _Content(keys, elsewhere, frozenset(filter(_is_open, _before(held))))
        return _merged([own, *[self._contents[each] for each in before]])


def _merged(contents: Iterable[_Content]) -> _Content:
    """What several things are made of, most of which are made of nothing."""
    found = [each for each in contents if each != _NOTHING]
    if len(found) <= 1:
        return found[0] if found else _NOTHING
    elsewhere: dict[str, frozenset[Held]] = {}
    for key, there in _all_elsewhere(found):
        elsewhere[key] = elsewhere[key] | there if key in elsewhere else there
    keys = frozenset[str]().union(*[each.keys for each in found])
    return _Content(keys, elsewhere, frozenset[Held]().union(*[each.open for each in found]))


def _all_elsewhere(contents: Iterable[_Content]) -> Iterator[tuple[str, frozenset[Held]]]:
    for content in contents:
        yield from content.elsewhere.items()


def _is_open(held: Held) -> bool:
    """Whether what a variable held before is told once a loop ends: its rounds begin with what nobody knows."""
    return held.how in {"lost", "looped"}


def _before(held: Held) -> Iterable[Held]:
    """What a variable may hold on each route, and what that was before it was changed: it still consists of that."""
    if held.how == "met":
        return all_ways((held,))
    return held.before if held.how != "entered" else ()


def _fields(state: State) -> Mapping[str, list[str]]:
    """The fields of objects that something is known of."""
    found = defaultdict[str, list[str]](list)
    for key in state.holds:
        for owner in (*wholes(key), *owners(key)):
            found[owner].append(key)
    return found
