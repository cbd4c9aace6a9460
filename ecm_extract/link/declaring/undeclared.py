"""Nodes that take parameters which they do not declare: what they read is a parameter all the same."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Constant

from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_OPTIONS: Final = frozenset({"allow_undeclared_parameters", "automatically_declare_parameters_from_overrides"})
"""Options of `rclcpp::NodeOptions` and of the nodes of rclpy."""
_TRUE: Final = Constant("true")


class Undeclared:
    """Knows which nodes take what they do not declare.

    `makers` gives the functions that make objects of a class; who indexes calls sets it.
    """

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.makers: Callable[[Cls], Iterable[Func]] | None = None
        self._taking: dict[Func, bool] = {}

    def takes_any(self, func: Func) -> bool:
        """Tell whether the node of a function takes what it does not declare, as its class, file or maker says."""
        known = self._taking.get(func)
        if known is None:
            known = self._taking[func] = any(_says_so(each) for each in dict.fromkeys(self._saying(func)))
        return known

    def _saying(self, func: Func) -> Iterator[Func]:
        """Yield the functions in which options of the node can stand."""
        own = self.folder.nesting.object_of(func)
        for cls in self.folder.program.ancestry(own) if own is not None else ():
            yield from cls.methods
        yield from self.folder.program.functions_in(func.file)
        if own is not None and self.makers is not None:
            for cls in (own, *self.folder.program.derived(own)):
                yield from self.makers(cls)


def _says_so(func: Func) -> bool:
    return any(_is_option(call) for calls in func.calls for call in calls)


def _is_option(call: Call) -> bool:
    name = getattr(call.callee, "name", "")
    by_name = any(key in _OPTIONS and value == _TRUE for key, value in call.keywords)
    return by_name or (name in _OPTIONS and call.args == (_TRUE,))
