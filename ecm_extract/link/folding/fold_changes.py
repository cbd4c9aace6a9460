"""What a text or a stream of C++ holds after a method that changes it."""

from __future__ import annotations

from collections.abc import Callable, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Text

from ecm_extract.infer.compute import changed
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, demoted, joined

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

STREAMS: Final = frozenset({"stringstream", "ostringstream"})
_TEXTS: Final = frozenset({"string"})
_EMPTYING: Final = frozenset({"clear", "erase"})
"""Methods that leave an empty text, whatever it held (en.cppreference.com: basic_string::clear, ::erase)."""
_ANEW: Final = frozenset({"assign", "str"})
"""Methods that give a text or a stream another text, whatever it held (en.cppreference.com: basic_string::assign,
basic_stringstream::str)."""


class ChangeFolder:
    """Evaluates texts after methods that change them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, call: Call, before: Callable[[], tuple[Value, ...]], env: Env, label: str) -> tuple[Value, ...]:
        """Return what the object of a call holds after it; `before` gives what it held, `label` names its hole."""
        name = call.callee.name if isinstance(call.callee, Member) else ""
        given = [self.folder.fold(arg, env) for arg in call.args]
        if name in _ANEW and len(given) == 1:
            return demoted(given[0])
        if name == "clear" and isinstance(call.callee, Member) and self._is(call.callee.base, STREAMS, env):
            return before()  # the state of errors is cleared, not the text
        if (
            name in _EMPTYING
            and isinstance(call.callee, Member)
            and not given
            and self._is(call.callee.base, _TEXTS, env)
        ):
            return demoted(self.folder.fold(Text(""), env))
        options = [before(), *given]
        if name == "append" and len(given) == 1 and all(value.data is None for value in given[0]):
            return joined(options)  # what is not known stands at its place
        return self.folder.combined(options, lambda data: changed(name, data[0], data[1:]), label)

    def _is(self, expr: Expr, types: Set[str], env: Env) -> bool:
        """Whether a variable is declared with one of some types."""
        return plain(self.folder.objects.type_of(expr, env)).rsplit("::", 1)[-1] in types
