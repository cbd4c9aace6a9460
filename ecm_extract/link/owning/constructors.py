"""Constructors that nobody calls: of a class that the tree makes, those that other arguments would mean."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set

from ecm_extract.link.code.calls import Invocation, taken_by
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.owning.made_unseen import SeenMakers


class Constructors:
    """Tells constructors of C++ apart by the number of arguments that objects are made with.

    Args:
        calls: all calls by the last part of what they name, those that make objects by the name of the class.
        makers: tells whose objects are all made where it is seen.
    """

    def __init__(self, calls: Mapping[str, Sequence[Invocation]], makers: SeenMakers) -> None:
        self._calls = calls
        self._makers = makers
        self._unused: dict[Cls, Set[Func]] = {}

    def is_unused(self, func: Func) -> bool:
        """Tell whether a function is a constructor by which nobody makes an object, while others make some."""
        cls = func.cls
        if cls is None or not func.is_constructor or func.file.language != "cpp":
            return False
        if cls not in self._unused:
            self._unused[cls] = frozenset(self._never_meant(cls)) if self._makers.is_seen(cls) else frozenset()
        return func in self._unused[cls]

    def _never_meant(self, cls: Cls) -> Iterator[Func]:
        """Objects are made without arguments in more ways than are seen."""
        calls = self._calls.get(cls.fact.name, ())
        for func in cls.methods if calls else ():
            least, most = func.arity
            counts = {len(taken_by(func, call)) for call in calls}
            if func.is_constructor and least and not any(least <= count <= most for count in counts):
                yield func
