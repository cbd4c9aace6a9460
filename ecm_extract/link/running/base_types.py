"""Types that a class template of C++ writes, as they are in a class that derives from it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from ecm_extract.link.code.spelling import plain, template_arguments
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program

_WORD: Final = re.compile(r"\w+")
_NOTHING: Final[Mapping[str, str]] = MappingProxyType({})


class BaseTypes:
    """Puts what classes give their bases for template parameters into the types that the bases write."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._given: dict[tuple[Cls, Cls], Mapping[str, str]] = {}

    def within(self, written: str, owner: Cls, cls: Cls) -> str:
        """Return a type that a class writes as it is in one that is the same or derives from it.

        Args:
            written: the type, which may mention template parameters of its class.
            owner: the class that writes it.
            cls: the class whose object is at hand.
        """
        if owner is cls or not owner.fact.template or not written:
            return written
        given = self._given.get((owner, cls))
        if given is None:
            self._given[owner, cls] = _NOTHING  # classes that derive from each other in a circle
            given = self._given[owner, cls] = self._arguments(owner, cls, frozenset())
        return _WORD.sub(lambda word: given.get(word[0], word[0]), written) if given else written

    def _arguments(self, owner: Cls, cls: Cls, below: frozenset[Cls]) -> Mapping[str, str]:
        """Template parameter of a base -> what a class gives it, by itself or through bases between them."""
        seen = below | {cls}  # a template may derive from itself with other arguments
        for written in cls.fact.bases:
            parent = self.program.class_named(plain(written), cls.file, cls.fact.scope)
            if parent is not None and parent not in seen and owner in self.program.ancestry(parent):
                passed = [self._meant(each, cls) for each in template_arguments(written)]
                if parent is owner:
                    return dict(zip(owner.fact.template, passed, strict=False))
                own = dict(zip(parent.fact.template, passed, strict=False))
                further = self._arguments(owner, parent, seen)
                return {name: own.get(each, each) for name, each in further.items()}
        return _NOTHING

    def _meant(self, written: str, cls: Cls) -> str:
        """A template argument by the whole name of its class, which others may not see by its last one."""
        found = self.program.class_named(plain(written), cls.file, cls.fact.scope) if "<" not in written else None
        return written.replace(plain(written), found.qualified) if found is not None else written
