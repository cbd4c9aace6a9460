"""The qualified names that a written C++ name can have, innermost scope first.

Source: C++, [basic.lookup.unqual] and [basic.lookup.qual]: enclosing scopes outwards, bases of classes among them,
namespaces of using-directives, aliases of namespaces and classes in front of `::`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import takewhile
from typing import NamedTuple

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls
from ecm_extract.resolve.aliases import Aliases
from ecm_extract.resolve.views import View

MAX_RENAMES = 10
"""How many aliases in front of `::` are followed: code that compiles needs two or three."""


class _Led(NamedTuple):
    """How a name was led to by aliases.

    Attributes:
        depth: how many.
        asked: the names, each with its scope, that were looked through on any way: they give nothing new.
    """

    depth: int
    asked: set[tuple[str, str]]


def enclosing_scopes(scope: str) -> list[str]:
    """`a::b` -> [`a::b`, `a`, ``]."""
    parts = scope.split("::") if scope else []
    return ["::".join(parts[:count]) for count in range(len(parts), -1, -1)]


def joined(scope: str, name: str) -> str:
    """Return a name in a scope."""
    return f"{scope}::{name}" if scope else name


class Scopes:
    """Spells out where a name is looked for.

    Args:
        aliases: of the tree.
        classes: by their qualified names.
        bases: gives the bases of a class, at any distance.
    """

    def __init__(
        self, aliases: Aliases, classes: Mapping[str, Sequence[Cls]], bases: Callable[[Cls], Sequence[Cls]]
    ) -> None:
        self._aliases = aliases
        self._classes = classes
        self._bases = bases
        self._by_directives: dict[tuple[str, View], Mapping[str, list[str]]] = {}

    def levels(self, name: str, scope: str, view: View) -> Iterator[Sequence[str]]:
        """Yield the qualified names of a name as written in a scope, those of one scope together.

        Args:
            name: possibly qualified, without template arguments.
            scope: in which it is written.
            view: the files that are seen.
        """
        return self._levels(name, scope, view, _Led(0, set()))

    def _levels(self, name: str, scope: str, view: View, led: _Led) -> Iterator[Sequence[str]]:
        bare = name.removeprefix("::")
        around = scope.removeprefix("::") if bare is name else ""
        used = self._used(around, view)
        for prefix in enclosing_scopes(around):
            own, through = joined(prefix, bare), [joined(each, bare) for each in used.get(prefix, ())]
            found = [own, *through]
            yield list(dict.fromkeys(each for one in found for each in self._meanings(one, view, led)))
            brought = [each for one in (found if "::" in bare else through) for each in _brought(one, view)]
            if brought:
                yield brought

    def _used(self, scope: str, view: View) -> Mapping[str, Sequence[str]]:
        """Scope -> the namespaces whose names it seems to have by using-directives of it, or of scopes within it.

        Source: [basic.lookup.unqual]: the scope around both, the directive and the namespace that it names.
        """
        known = self._by_directives.get((scope, view))
        if known is None:
            known = self._by_directives[scope, view] = defaultdict(list)
            for where in enclosing_scopes(scope):
                for namespace in view.usings.get(where, ()):
                    for prefix in enclosing_scopes(where):
                        whole = joined(prefix, namespace)
                        known[_around(where, whole)].append(whole)
        return known

    def _meanings(self, qualified: str, view: View, led: _Led) -> Iterator[str]:
        """A qualified name, and what it is by the bases and aliases of what stands in front of it."""
        yield qualified
        owner, _, last = qualified.rpartition("::")
        for cls in self._classes.get(owner, ()) if owner else ():
            if cls.file in view:
                yield from (joined(base.qualified, last) for base in self._bases(cls))
        if owner and led.depth < MAX_RENAMES:
            yield from self._renamed(qualified, view, led)

    def _renamed(self, qualified: str, view: View, led: _Led) -> Iterator[str]:
        parts = qualified.split("::")
        for count in range(1, len(parts)):
            if parts[count - 1] not in self._aliases.last_names:
                continue
            for entry in self._aliases.by_name.get("::".join(parts[:count]), ()):
                target = plain(entry.alias.target)
                if entry.file in view and target and target != parts[count - 1]:
                    full = "::".join([target, *parts[count:]])
                    if (full, entry.scope) not in led.asked:
                        led.asked.add((full, entry.scope))
                        for level in self._levels(full, entry.scope, view, _Led(led.depth + 1, led.asked)):
                            yield from level


def _around(one: str, other: str) -> str:
    """The innermost scope that is around two, or one of them."""
    pairs = takewhile(lambda pair: pair[0] == pair[1], zip(one.split("::"), other.split("::"), strict=False))
    return "::".join(part for part, _ in pairs)


def _brought(qualified: str, view: View) -> Iterator[str]:
    """What a qualified name means by the using-directives of the namespace in front, which has none of that name."""
    owner, _, last = qualified.rpartition("::")
    if owner and owner in view.usings:
        yield from _through_usings(owner, last, view)


def _through_usings(scope: str, name: str, view: View) -> Iterator[str]:
    """A name by the using-directives of a scope, whose namespaces are looked up from there."""
    for namespace in view.usings.get(scope, ()):
        yield from (joined(joined(prefix, namespace), name) for prefix in enclosing_scopes(scope))
