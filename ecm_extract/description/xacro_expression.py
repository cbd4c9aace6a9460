"""Expressions of xacro with the calls that need files or arguments: `load_yaml`, `arg`, `find`, `optenv`.

Source: the xacro wiki page, "Math expressions", "YAML support"; wiki.ros.org/roslaunch/XML "eval".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from ecm_parsers.expression import MAX_LENGTH, Budget, ExpressionError, evaluate

from ecm_extract.description.symbols import Symbols, Unknown, Watched
from ecm_extract.description.xacro_text import closing, typed

MAX_CALLS = 20
MAX_WORK = 4_000_000
_CALL = re.compile(r"(?<![\w.])(?:xacro\.)?(?P<name>load_yaml|arg|find|optenv|env|dirname)\(")
_WORD = re.compile(r"'([^']*)'|\"([^\"]*)\"")


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
        extra = dict(names or {})
        watched = Watched(symbols, extra)
        try:
            found = evaluate(self._without_calls(code, watched, extra), watched, self._budget)
        except ExpressionError as error:
            if not watched.touched:
                self.problem(str(error))
            return _hole(code)
        if not watched.touched or isinstance(found, dict | list | tuple):
            return found
        return Unknown(found) if isinstance(found, str) and "{" in found else _hole(code)

    def launch_value(self, code: str, symbols: Symbols) -> Any:
        """Return the value of `$(eval ...)`, which knows the arguments by name."""
        return self.value(code, symbols, {name: typed(value) for name, value in self.arguments.items()})

    def _without_calls(self, code: str, watched: Watched, extra: dict[str, Any]) -> str:
        """Replace calls that this evaluator makes itself by names that hold their results."""
        for _ in range(MAX_CALLS if len(code) <= MAX_LENGTH else 0):
            calls = list(_CALL.finditer(code))
            end = closing(code, calls[-1].end() - 1) if calls else -1  # the last call has no other call inside it
            if end < 0:
                break
            label = f"called_{len(extra)}"
            extra[label] = self._called(calls[-1]["name"], code[calls[-1].end() : end], watched)
            code = code[: calls[-1].start()] + label + code[end + 1 :]
        return code

    def _called(self, name: str, inside: str, watched: Watched) -> Any:
        if name == "load_yaml":
            return self._loaded(inside, watched)
        word = " ".join(single or double for single, double in _WORD.findall(inside))
        known = typed(self.arguments.get(word)) if name == "arg" else self.substitute(name, word)
        if known is None:
            self.problem(f"`{name}({inside.strip()})` is known at launch only", "late")
            return _hole(word)
        return known

    def _loaded(self, inside: str, watched: Watched) -> Any:
        own = watched.anew()
        path = str(evaluate(inside, own, self._budget))
        if own.touched:
            return _hole(path)
        data = self.yaml(path)
        if isinstance(data, Unknown):
            self.problem(f"file `{data.text.strip('{}')}` is not in the tree")
        return data


def _hole(code: str) -> Unknown:
    return Unknown("{" + code.strip().strip("{}") + "}")
