"""What `$(eval ...)` of roslaunch may name and call: arguments, `arg`, `env`, `optenv`, `find`, `anon`, `dirname`.

Source: roslaunch `substitution_args._eval`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any, Protocol

from ecm_parsers.expression import ExpressionError, UnknownNameError
from ecm_parsers.template import Substitution, Template

from ecm_extract.system.model import Text


class Texts(Protocol):
    """Evaluates templates of a launch file."""

    @property
    def environment(self) -> Mapping[str, Text]:
        """Variable -> its text."""

    def text(self, template: Template | None, depth: int = 0) -> Text:
        """Return the text of a template."""


class EvalNames(Mapping[str, Any]):
    """The arguments by name; one that only the launch knows hides the constant or function of its name all the same."""

    def __init__(self, arguments: Mapping[str, Text], typed: Callable[[str], Any]) -> None:
        self._arguments = arguments
        self._typed = typed

    def __getitem__(self, name: str) -> Any:
        found = self._arguments[name]
        if not found.known:
            msg = f"`{name}` is known to the launch only. Give its value."
            raise UnknownNameError(msg)
        return self._typed(found.text)

    def __iter__(self) -> Iterator[str]:
        return iter(self._arguments)

    def __len__(self) -> int:
        return len(self._arguments)


def launch_functions(texts: Texts, typed: Callable[[str], Any]) -> Mapping[str, Callable[..., Any]]:
    """Return the functions by name; they raise `ExpressionError` where only the launch knows what they give.

    Args:
        texts: of the launch file.
        typed: gives the value of the text of an argument.
    """
    told = partial(_told, texts)
    return {
        "arg": lambda name: typed(told("arg", name)),
        "env": partial(told, "env"),
        "optenv": partial(_optional, texts),
        "find": partial(told, "find"),
        "anon": partial(told, "anon"),
        "dirname": partial(told, "dirname"),
    }


def _told(texts: Texts, kind: str, *words: str) -> str:
    found = texts.text((Substitution(kind, tuple((str(word),) for word in words)),))
    if not found.known:
        msg = f"`{kind}` of {', '.join(map(str, words))} is known to the launch only. Give its value."
        raise ExpressionError(msg)
    return found.text


def _optional(texts: Texts, name: str, default: Any = "") -> Any:
    """Return a variable of the environment, or what stands for it as it is."""
    return _told(texts, "env", name) if name in texts.environment else default
