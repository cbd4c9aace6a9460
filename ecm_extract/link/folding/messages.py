"""Exceptions of Python as texts: what `str(error)` gives for one that code raises with a message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Name

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, literal, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_QUOTED: Final = "KeyError"
"""docs.python.org, Built-in Exceptions: the one whose text is its argument as it is written in code."""
_TEXT_OF_ITS_OWN: Final = frozenset({"UnicodeError", "ImportError"})
"""Those that may show more than their argument."""


class MessageFolder:
    """Folds what exceptions say."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, held: Held, env: Env) -> tuple[Value, ...]:
        """Return the text of an exception that a handler has; a hole where it is not seen how it was made."""
        made = self.folder.returns.raises.made(held) if env.func.file.language == "python" else None
        return (self._said(made, env) if made is not None else ()) or (unknown(held.name),)

    def _said(self, made: Bound, env: Env) -> tuple[Value, ...]:
        """The text of an exception that an expression makes, where its type has none of its own."""
        name = dotted_name(made.expr.callee if isinstance(made.expr, Call) else made.expr)
        kind = self.folder.flow.exceptions.kind(name, made.env.func) if name else None
        if kind is None or not kind.whole or kind.above & _TEXT_OF_ITS_OWN or self._has_methods(name, made.env):
            return ()
        if isinstance(made.expr, Name):
            return (literal("")._replace(confidence="folded"),)
        if not isinstance(made.expr, Call) or len(made.expr.args) != 1 or made.expr.keywords:
            return ()
        inner = made.env.deeper(max(made.env.depth, env.depth) + 1)
        values = self.folder.shown(self.folder.fold(made.expr.args[0], inner), made.env)
        return self.folder.combined([values], _quoted, name) if _QUOTED in kind.above else values

    def _has_methods(self, name: str, env: Env) -> bool:
        """Whether a class of the tree, or one that it derives from, may make or show its objects in its own way."""
        cls = self.folder.program.class_named(name.replace(".", "::"), env.func.file, env.func.scope)
        return cls is not None and any(entry.methods for entry in self.folder.program.ancestry(cls))


def _quoted(data: list[object]) -> object:
    return repr(data[0]) if len(data) == 1 and isinstance(data[0], str) else UNKNOWN
