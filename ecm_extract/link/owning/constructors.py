"""Constructors that nobody calls: of a class that the tree makes, those that other arguments would mean."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence, Set
from typing import Final

from ecm_parsers.source.expr import Call, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.pointed import makes_pointed
from ecm_extract.link.code.spelling import last_name, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program

_WORD: Final = re.compile(r"\w+")


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
        self._handed: Set[str] | None = None

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
        """Whether all that makes objects of a class is seen: neither frameworks, derived classes nor templates do."""
        made_by_others = cls in self._registered or self.program.derived(cls)
        return not made_by_others and cls.fact.name not in self._made_unseen()

    def _made_unseen(self) -> Set[str]:
        """Names of types that have another name, outlive functions, or are given to templates other than pointers."""
        if self._handed is None:
            self._handed = frozenset(word for written in self._written() for word in _WORD.findall(written))
        return self._handed

    def _written(self) -> Iterator[str]:
        for func in (each for group in self.program.functions.values() for each in group):
            for statement in func.fact.body:
                yield _given(statement.type)
            for call in (each for group in func.calls for each in group if not _makes_pointed(each)):
                yield from call.types
        for cls in (each for group in self.program.classes.values() for each in group):
            yield from (_given(field.type) for field in cls.fact.fields)
        for _, constant in (each for group in self.program.constants.values() for each in group):
            yield constant.type
        for alias in (each for file in self.program.files for each in file.facts.aliases):
            yield _given(alias.target) or ("" if "<" in alias.target else alias.target)


def _given(written: str) -> str:
    """What a type gives a template; nothing for a pointer, and for a type without any."""
    return pointee(written).partition("<")[2]


def _makes_pointed(call: Call) -> bool:
    return isinstance(call.callee, Name) and makes_pointed(last_name(call.callee.id))
