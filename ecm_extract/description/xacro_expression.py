"""Expressions of xacro with the calls that need files or arguments: `load_yaml`, `arg`, `find`, `optenv`.

Source: the xacro wiki page, "Math expressions", "YAML support"; wiki.ros.org/roslaunch/XML "eval".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from ecm_parsers.expression import Budget, ExpressionError, evaluate

from ecm_extract.description.symbols import Symbols, Unknown, Watched
from ecm_extract.description.xacro_files import MARK
from ecm_extract.description.xacro_text import typed

MAX_WORK = 4_000_000
_SUBSTITUTIONS = ("find", "optenv", "env", "dirname")
_SPOKEN = ("message", "warning", "error", "print_location")


class XacroExpression:
    """Evaluates expressions of one expansion.

    Attributes:
        arguments: `xacro:arg` values by name. yaml: data of a named file. substitute: what `$(word rest)` is.
        problem: told what could not be evaluated.
    """

    def __init__(
        self,
        arguments: Mapping[str, str | Unknown],
        yaml: Callable[[str], Any],
        substitute: Callable[[str, str], str | None],
        problem: Callable[..., None],
    ) -> None:
        self.arguments = arguments
        self.yaml = yaml
        self.substitute = substitute
        self.problem = problem
        self._budget = Budget(MAX_WORK)

    def value(self, code: str, symbols: Symbols, names: Mapping[str, Any] | None = None) -> Any:
        """Return the value of an expression, an `Unknown` when only the launch knows it.

        Args:
            code: between the brackets of `${...}`.
            symbols: properties.
            names: further names.
        """
        watched = Watched(symbols, names or {})
        try:
            found = evaluate(code, watched, self._budget, self._functions(watched))
        except ExpressionError as error:
            if not watched.touched:
                self.problem(str(error))
            return _hole(code)
        return _with_holes(found, code) if watched.touched else found

    def launch_value(self, code: str, symbols: Symbols) -> Any:
        """Return the value of `$(eval ...)`, which knows the arguments by name."""
        return self.value(code, symbols, {name: typed(value) for name, value in self.arguments.items()})

    def _functions(self, watched: Watched) -> Mapping[str, Callable[..., Any]]:
        """Functions of xacro beside those of all expressions."""
        return {
            **{name: partial(self._substituted, name, watched) for name in _SUBSTITUTIONS},
            **dict.fromkeys(_SPOKEN, lambda *_, **__: ""),
            "arg": partial(self._argument, watched),
            "load_yaml": partial(self._loaded, watched),
            "abs_filename": self._absolute,
            "dotify": lambda table: table,
            "tokenize": _tokens,
            "fatal": _ended,
        }

    def _argument(self, watched: Watched, name: str) -> Any:
        return self._known(watched, "arg", name, typed(self.arguments.get(name)))

    def _substituted(self, word: str, watched: Watched, *rest: object) -> Any:
        words = " ".join(map(str, rest))
        return self._known(watched, word, words, self.substitute(word, words))

    def _known(self, watched: Watched, name: str, inside: str, value: Any) -> Any:
        if value is None:
            self.problem(f"`{name}({inside!r})` is known at launch only", "late")
            value = _hole(inside)
        return watched.told(value)

    def _loaded(self, watched: Watched, name: str) -> Any:
        path = str(name)
        if watched.touched and "{" in path:
            return watched.told(_hole(path))
        data = self.yaml(path)
        if isinstance(data, Unknown):
            self.problem(f"file `{data.text.strip('{}')}` is not in the tree")
        return watched.told(data)

    def _absolute(self, name: str) -> str:
        """A path that is relative is one of the folder of the file that is read."""
        is_absolute = name.startswith(("/", MARK))
        return name if is_absolute else f"{self.substitute('dirname', '')}/{name}"


def _tokens(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    for each in sep[1:]:
        text = text.replace(each, sep[0])
    return [token for token in text.split(sep[0]) if token or not skip_empty]


def _ended(*words: object) -> Any:
    msg = f"The description ends itself: {' '.join(map(str, words))[:200]}"
    raise ExpressionError(msg)


def _with_holes(found: Any, code: str) -> Unknown:
    """What an expression gives of which a part is not known."""
    if isinstance(found, dict | list | tuple):
        return Unknown(str(found), found)
    return Unknown(found) if isinstance(found, str) and "{" in found else _hole(code)


def _hole(code: str) -> Unknown:
    return Unknown("{" + code.strip().strip("{}") + "}")
