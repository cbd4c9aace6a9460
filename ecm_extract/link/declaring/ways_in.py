"""From the outermost call of a site to its form: where each call on the way is evaluated, in which states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from ecm_parsers.source.expr import THIS

from ecm_extract.infer.held import Turn
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.closures import around, captured
from ecm_extract.link.declaring.making import Making
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.template_types import TemplateTypes
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env, Instance

MAX_WAYS = 1000
"""Ways to one form beyond which the states of the calls between are not told apart."""


@dataclass(frozen=True, slots=True)
class Way:
    """The places of the first calls of a site; `is_split` says that some of them have a state that they had not."""

    places: tuple[Env, ...] = ()
    certain: bool = True
    is_split: bool = False


class WaysIn:
    """Enters one function after the other, with what its caller hands it."""

    def __init__(self, folder: Folder, making: Making, types: TemplateTypes) -> None:
        self.folder = folder
        self.making = making
        self.types = types

    def in_each_state(self, site: Site) -> Iterator[Site]:
        """Yield a site once for each way in which its calls are reached; none where arguments keep it from that."""
        ways = [Way()]
        for at in range(len(site.chain) + 1):
            ways = [each for way in ways for each in self._longer(site, at, way)]
            if len(ways) > MAX_WAYS:
                ways = list(self._longer(site, len(site.chain), Way(site.places)))
                break
        for way in ways:
            *places, env = way.places
            yield replace(site, env=env, places=tuple(places), certain=site.certain and way.certain)

    def _longer(self, site: Site, at: int, way: Way) -> Iterator[Way]:
        """The ways that begin with one and have one more place."""
        calls = (*site.chain, site.call)
        env = (*site.places, site.env)[at]
        if way.is_split:
            env = self.enter(calls[at - 1], calls[at], way.places[-1])
        if at and not self.folder.flow.is_reached(env):
            return
        is_last = at == len(site.chain)
        states = list(self.places(env)) if is_last or env.state is None else []
        if len(states) <= 1 and not is_last:
            yield replace(way, places=(*way.places, env))
        else:
            for place, certain in states:
                yield Way((*way.places, place), way.certain and certain, is_split=True)

    def places(self, env: Env) -> Iterator[tuple[Env, bool]]:
        """Yield a place once for each state, and whether a run that gets there in any of them does so in this one."""
        places = self.folder.flow.places(env)
        paths = dict.fromkeys(self._turns(place) for place in places if place.state is not None)
        for place in places:
            yield place, len(paths) <= 1 or _is_on_all(self._turns(place), paths)

    def _turns(self, place: Env) -> tuple[Turn, ...]:
        return self.folder.flow.decisions.turns(place.state.path) if place.state is not None else ()

    def inside(self, site: Site, root: Env) -> list[Env]:
        """Walk from the outermost function, whose place is given, to the form itself: the place of each call."""
        found = [root]
        for link, following in zip(site.chain, (*site.chain[1:], site.call), strict=False):
            found.append(self.enter(link, following, found[-1]))
        return found

    def of_class(self, site: Site, cls: Cls | None) -> Site:
        """Return a site of a method as it is of objects of just this class, whoever makes one."""
        root, made = site.root, Instance(cls, {}, {}, exact=True) if cls is not None else None
        part = self.folder.objects.part(made, root.cls) if made is not None and root.cls is not None else None
        place = Env(root, site.first.at, {}, dict(part.types) if part is not None else {}, cls, made)
        *places, env = self.inside(site, place)
        return replace(site.as_written(), env=env, owner=cls, places=tuple(places), exact=cls)

    def enter(self, link: Invocation, following: Invocation, env: Env) -> Env:
        """Return the place of a call in the function that the one before it calls."""
        func, at = following.func, following.at
        link, env = self.folder.spreading.known(link, env)
        args = bind(func, link, env)
        types = self.types.of_function(func, link, env)
        if around(func, self.folder) is not None:
            outer = captured(func, link, env, self.folder)
            return Env(func, at, args, types, outer.this, outer.made, outer=outer)
        if func.cls is None:
            return Env(func, at, args, types)
        cls = self.making.made(link, func.cls)
        if func.is_constructor or cls is not None:
            return self._made(link, following, env, cls or func.cls)
        same = (
            env.this is not None
            and func.cls in self.folder.program.ancestry(env.this)
            and link.receiver in {None, THIS}
        )
        this = env.this if same else func.cls
        inner = env.made if same else self.folder.makers.part(link.receiver, func.cls, env)
        return Env(func, at, args, types, this, inner)

    def _made(self, link: Invocation, following: Invocation, env: Env, cls: Cls) -> Env:
        """The place of a call in a constructor, or in a method, of the object of a class that a call makes."""
        func = following.func
        begins = func.is_constructor and func.cls is cls
        maker = func if begins else self.folder.objects.constructor(cls, link)
        given = bind(maker, link, env) if maker is not None else {}
        made = Instance(cls, given, self.types.of_class(cls, link, env), maker, exact=True)
        types = self.types.of_function(func, link, env)
        return Env(func, following.at, given if begins else {}, types, cls, made)


def _is_on_all(path: tuple[Turn, ...], paths: Iterable[tuple[Turn, ...]]) -> bool:
    """Whether all paths to a place are one of them, but for what is asked beyond it: `if (more) names.add("b")`."""
    own = set(path)
    beyond = (turn for other in paths for turn in other if turn not in own)
    return all(own.issubset(other) for other in paths) and all(turn.test is not None for turn in beyond)
