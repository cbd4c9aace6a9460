"""Parameters of which a function may change what they consist of, and whether its body shows what it does."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Member

from ecm_extract.infer.bare_names import bare_names
from ecm_extract.infer.effects import is_within
from ecm_extract.infer.other_names import changed_as_others
from ecm_extract.link.code.units import Func

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ChangedParameters:
    """Tells it; each parameter is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._changing: dict[tuple[Func, str], bool] = {}
        self._hidden: dict[tuple[Func, str], bool] = {}

    def may(self, func: Func, name: str) -> bool:
        """Tell whether a function may change what its parameter consists of; in C++ the fields of that."""
        if func.file.language == "cpp":
            return any(each.startswith(f"{name}.") for each in self.folder.flow.outline(func).changes)
        key = (func, name)
        known = self._changing.get(key)
        if known is None:
            self._changing[key] = True  # who asks in a circle is told that it may
            by_name = self.folder.flow.effects(func).may_change(name)
            known = self._changing[key] = by_name or self.is_hidden(func, name)
        return known

    def is_hidden(self, func: Func, name: str) -> bool:
        """Tell whether it does, or may, by a method, by another name, or in a function within it."""
        key = (func, name)
        known = self._hidden.get(key)
        if known is None:
            self._hidden[key] = True  # who asks in a circle
            found = self._by_methods(func, name) or self._is_put_away(func, name) or self._inside(func, name)
            known = self._hidden[key] = found or name in changed_as_others(self.folder.flow.outline(func), name)
        return known

    def _by_methods(self, func: Func, name: str) -> bool:
        """Whether a method of it, or of a part of it, may change its object."""
        effects = self.folder.flow.effects(func)
        called = {callee.name for _, callee in _methods(func) if is_within(effects.root(callee.base), name)}
        return not all(self.folder.methods.all_leave(each, func) for each in called)

    def _is_put_away(self, func: Func, name: str) -> bool:
        """Whether it is put into something, by a method of that, which may be changed through it."""
        effects = self.folder.flow.effects(func)
        puts = (call for call, callee in _methods(func) if callee.name in effects.calls.changing)
        given = (each for call in puts for arg in call.args for each in bare_names(arg))
        return any(effects.key(each) == name for each in given)

    def _inside(self, func: Func, name: str) -> bool:
        """Whether a function within it may change it."""
        inner = (each for each in self.folder.nesting.inner(func) if name not in self.folder.flow.effects(each).own)
        return any(
            name in self.folder.shifting.names(each) and (self.may(each, name) or self._is_bound(each, name))
            for each in inner
        )

    def _is_bound(self, func: Func, name: str) -> bool:
        return any(is_within(key, name) for key in self.folder.flow.outline(func).changes)


def _methods(func: Func) -> Iterator[tuple[Call, Member]]:
    for group in func.calls:
        for call in group:
            if isinstance(call.callee, Member):
                yield call, call.callee
