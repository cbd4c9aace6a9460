"""What all variables of a function hold at one place: few changes over many, so that a state costs what it changes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

from ecm_parsers.source.expr import Member, Name

from ecm_extract.infer.places import around

if TYPE_CHECKING:
    from ecm_extract.infer.held import Held

MAX_LAYER = 16
"""Changes beyond which a state is written out in full."""

Helds: TypeAlias = "tuple[Held, ...]"


class Written:
    """What variables hold, written out in full, and what many states ask of it, each found once."""

    def __init__(self, helds: Mapping[str, Helds]) -> None:
        self.helds = helds

    @cached_property
    def within(self) -> Mapping[str, Sequence[str]]:
        """Variable -> the fields that lie in it, at any depth; "" -> the members of the object at hand."""
        found = defaultdict[str, list[str]](list)
        for name in self.helds:
            for whole in around(name):
                found[whole].append(name)
        return found

    @cached_property
    def copies(self) -> Sequence[str]:
        """The variables that were given another one as it is."""
        return [name for name, helds in self.helds.items() if is_copy(helds)]

    @cached_property
    def holding(self) -> Mapping[Held, Sequence[str]]:
        """Thing -> the variables of which it is the first one that they may hold."""
        found = defaultdict[Any, list[str]](list)
        for name, helds in self.helds.items():
            found[helds[0]].append(name)
        return found


class Layers(Mapping[str, Helds]):
    """What variables hold; a variable without a thing among the changes is one that is not held any more.

    Attributes:
        base: what lies beneath. over: what was changed since.
    """

    __slots__ = ("base", "over")

    def __init__(self, base: Written | None = None, over: Mapping[str, Helds] | None = None) -> None:
        self.base = base if base is not None else Written({})
        self.over = over if over is not None else {}

    def having(self, changes: Mapping[str, Helds]) -> Layers:
        """Return the same with other things in some variables."""
        over = {**self.over, **changes}
        if len(over) <= MAX_LAYER:
            return Layers(self.base, over)
        return Layers(Written({name: helds for name, helds in {**self.base.helds, **over}.items() if helds}))

    def apart(self, other: Layers) -> Iterable[str]:
        """Return the variables that may hold something else in another one: what lies beneath both is the same."""
        if self.base is other.base:
            return dict.fromkeys((*self.over, *other.over))
        return dict.fromkeys((*self, *other))

    def within(self, whole: str) -> list[str]:
        """Return the fields that lie in a variable, at any depth; of "" the members of the object at hand."""
        over, dotted = self.over, f"{whole}."
        found = [name for name in self.base.within.get(whole, ()) if over.get(name, True)]
        return found + [name for name in self._added() if name.startswith(dotted)]

    @property
    def has_fields(self) -> bool:
        """Whether a field of anything is held, or was beneath."""
        return bool(self.base.within.keys() - {""}) or any("." in name[1:] for name in self.over)

    def alike(self, helds: Helds) -> list[str]:
        """Return the variables that hold the very same."""
        over = self.over
        found = [name for name in self.base.holding.get(helds[0], ()) if name not in over]
        return [name for name in (*found, *over) if self.get(name) is helds]

    def copies(self) -> list[str]:
        """Return the variables that were given another one as it is."""
        over = self.over
        found = [name for name in self.base.copies if name not in over]
        return found + [name for name, helds in over.items() if helds and is_copy(helds)]

    def __getitem__(self, name: str) -> Helds:
        found = self.over.get(name)
        if found is None:
            return self.base.helds[name]
        if not found:
            raise KeyError(name)
        return found

    def get(self, name: str, default: Any = None) -> Any:
        """Return what a variable holds."""
        found = self.over.get(name)
        return self.base.helds.get(name, default) if found is None else found or default

    def __contains__(self, name: object) -> bool:
        found = self.over.get(name) if isinstance(name, str) else None
        return bool(found) if found is not None else name in self.base.helds

    def __iter__(self) -> Iterator[str]:
        over = self.over
        if not over:
            return iter(self.base.helds)
        return iter([name for name in self.base.helds if over.get(name, True)] + self._added())

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def _added(self) -> list[str]:
        """The variables that are held since what lies beneath."""
        known = self.base.helds
        return [name for name, helds in self.over.items() if helds and name not in known]


def is_copy(helds: Helds) -> bool:
    """Tell whether a variable was given another one as it is."""
    return len(helds) == 1 and helds[0].how == "value" and isinstance(helds[0].expr, Name | Member)
