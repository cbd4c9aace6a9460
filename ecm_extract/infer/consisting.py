"""What things of one function are made of: which variables each names, however it came to what it is."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Expr

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import Effects
from ecm_extract.infer.held import Held, State, all_ways
from ecm_extract.infer.layers import Written
from ecm_extract.infer.places import around
from ecm_extract.infer.plain_elements import without_plain


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


class _Holders(NamedTuple):
    """Who consists of what, of the variables that lie beneath many states.

    Attributes:
        of: variable -> those that consist of it. elsewhere: variable -> those that are made of one of its name, which
            may be bound elsewhere.
    """

    of: Mapping[str, Sequence[str]]
    elsewhere: Mapping[str, Sequence[str]]


class Consisting:
    """Finds it; what a thing was before is looked through once, and what a variable holds once until a loop ends."""

    def __init__(self, effects: Effects) -> None:
        self.effects = effects
        self._contents: dict[Held, _Content] = {}
        self._of_ways: dict[Collection[Held], _Content] = {}
        self._holders: dict[Written, _Holders] = {}

    def loop_ended(self) -> None:
        """Forget what was found of variables: what they held when a round of a loop began is known now."""
        self._of_ways.clear()
        self._holders.clear()

    def forget(self) -> None:
        """Drop all that was found, since the run is over: who ran it may be kept by a circle until the end of all."""
        self._contents.clear()
        self._of_ways.clear()
        self._holders.clear()

    def named(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with those that they are, or consist of, and what these consist of."""
        return self._within(keys, state, with_fields=False)

    def reached(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with all that who has them may change: what they and their fields are, or consist of."""
        return self._within(keys, state, with_fields=True)

    def _within(self, keys: Iterable[str], state: State, with_fields: bool) -> set[str]:
        found, pending = set[str](), list(keys)
        while pending:
            key = pending.pop()
            if key not in found:
                found.add(key)
                pending += self._parts(key, state)
                pending += state.holds.within(key) if with_fields and key else ()
        return found

    def naming(self, keys: Iterable[str], state: State) -> set[str]:
        """Return variables with those that are one of them, or consist of one, and what consists of these."""
        holds = state.holds
        beneath, since = self._beneath(holds.base), self._since(state)
        found, pending = set[str](), list(keys)
        while pending:
            key = pending.pop()
            if key not in found:
                found.add(key)
                holders = [name for name in beneath.of.get(key, ()) if name not in holds.over]
                pending += (each for name in (*holders, *since.get(key, ())) for each in (name, *around(name)) if each)
        return found

    def _beneath(self, written: Written) -> _Holders:
        """Who consists of what beneath a state, found once for all that lie over it."""
        known = self._holders.get(written)
        if known is None:
            of, elsewhere = defaultdict[str, list[str]](list), defaultdict[str, list[str]](list)
            for name, ways in written.helds.items():
                content = self._together(ways)
                for parts, holders in ((content.keys, of), (content.elsewhere, elsewhere)):
                    for part in parts:
                        holders[part].append(name)
            known = self._holders[written] = _Holders(of, elsewhere)
        return known

    def _since(self, state: State) -> Mapping[str, Sequence[str]]:
        """Who consists of what, of what was changed since, and of what is made of variables bound elsewhere."""
        holds = state.holds
        gone = [names for part, names in self._beneath(holds.base).elsewhere.items() if part not in holds]
        asked = [name for name, ways in holds.over.items() if ways]
        asked += {name for names in gone for name in names if name not in holds.over}
        found = defaultdict[str, list[str]](list)
        for name in asked:
            for part in self._parts(name, state):
                found[part].append(name)
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
        earlier = [self._contents[each] for each in before]
        open_ = [each for each in _before(held) if _is_open(each)]
        if held.expr is None and held.more is None and not open_:
            return _merged(earlier)
        body = held.env.func.fact.body if held.env is not None else ()
        named = (each for expr in self._changeable(held) for each in shared_names(expr, body))
        found = set(map(self.effects.key, named)) - {""}
        keys = frozenset(key for key in found if not self.effects.is_of_library(key))
        there = held.env.state.holds if held.env is not None and held.env.state is not None else {}
        elsewhere = {key: frozenset(there[key]) for key in keys if key in there}
        own = _Content(keys, elsewhere, frozenset(open_)) if keys or open_ else _NOTHING
        return _merged([own, *earlier])

    def _changeable(self, held: Held) -> Iterator[Expr | None]:
        """What a thing is made of, without texts and numbers of Python out of lists, which leave those alone."""
        state = held.env.state if held.env is not None else None
        own = held.env is not None and held.env.func is self.effects.func and self.effects.python
        for expr in (held.expr, held.more):
            yield without_plain(expr, state, self.effects.key) if own and expr is not None else expr


def _merged(contents: Iterable[_Content]) -> _Content:
    """What several things are made of, most of which are made of nothing."""
    found = [each for each in contents if each is not _NOTHING]
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
