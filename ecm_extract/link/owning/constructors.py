"""Constructors that nobody calls: of a class that the tree makes, those that other arguments would mean."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.owning.made_unseen import made_unseen


class Constructors:
    """Tells constructors of C++ apart by the number of arguments that objects are made with.

    Args:
        program: all that the tree declares.
        calls: all calls by the last part of what they name, those that make objects by the name of the class.
        registered: classes of which frameworks make objects.
    """

    def __init__(
        self, program: Program, calls: Mapping[str, Sequence[Invocation]], registered: Mapping[Cls, object]
    ) -> None:
        self.program = program
        self._calls = calls
        self._registered = registered
        self._unused: dict[Cls, Set[Func]] = {}

    def is_unused(self, func: Func) -> bool:
        """Tell whether a function is a constructor by which nobody makes an object, while others make some."""
        cls = func.cls
        if cls is None or not func.is_constructor or func.file.language != "cpp":
            return False
        if cls not in self._unused:
            self._unused[cls] = frozenset(self._never_meant(cls)) if self._is_seen(cls) else frozenset()
        return func in self._unused[cls]

    def _never_meant(self, cls: Cls) -> Iterator[Func]:
        """Objects are made without arguments in more ways than are seen."""
        counts = {len(call.args) for call in self._calls.get(cls.fact.name, ())}
        for func in cls.methods if counts else ():
            least, most = func.arity
            if func.is_constructor and least and not any(least <= count <= most for count in counts):
                yield func

    def _is_seen(self, cls: Cls) -> bool:
        """Whether all that makes objects of a class names it: neither frameworks nor derived classes make some."""
        made_by_others = cls in self._registered or self.program.derived(cls)
        return not made_by_others and cls.fact.name not in self._unseen

    @cached_property
    def _unseen(self) -> Set[str]:
        return made_unseen(self.program)
