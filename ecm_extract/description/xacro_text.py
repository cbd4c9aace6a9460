"""Text of xacro files: `${expression}` and `$(substitution)` replaced by what they are.

Source: the xacro wiki page, "Math expressions", "Rospack commands", "YAML support".
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from ecm_parsers.expression import ExpressionError, evaluate
from ecm_parsers.yaml_tree import parse_yaml, plain

from ecm_extract.description.symbols import Symbols

MAX_TEXT = 200_000
_LOAD_YAML = re.compile(r"(?:xacro\.)?load_yaml\(")
_ARGUMENT = re.compile(r"xacro\.arg\(\s*['\"]([^'\"]+)['\"]\s*\)")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


class UnknownPart(str):
    """Text with a part that only the launch knows."""

    __slots__ = ()


class XacroText:
    """Evaluates texts of one expansion.

    Attributes:
        arguments: `xacro:arg` values by name. substitute: what `$(word rest)` is, None when not known.
        read: bytes of a file that an expression names, None when it is not in the tree.
        problem: told what could not be evaluated.
    """

    def __init__(
        self,
        arguments: dict[str, str],
        substitute: Callable[[str, str], str | None],
        read: Callable[[str], bytes | None],
        problem: Callable[[str], None],
    ) -> None:
        self.arguments = arguments
        self.substitute = substitute
        self.read = read
        self.problem = problem

    def value(self, text: str, symbols: Symbols) -> Any:
        """Return the value of a text: typed when it is one expression or a literal, else text."""
        pieces = self._pieces(text, symbols)
        if len(pieces) == 1:
            return typed(pieces[0]) if isinstance(pieces[0], str) else pieces[0]
        return typed(self._joined(pieces))

    def text(self, text: str, symbols: Symbols) -> str:
        """Return a text with everything in it evaluated."""
        return self._joined(self._pieces(text, symbols)) if "$" in text else text

    def _joined(self, pieces: list[Any]) -> str:
        joined = "".join(shown(piece) for piece in pieces)[:MAX_TEXT]
        return UnknownPart(joined) if any(isinstance(piece, UnknownPart) for piece in pieces) else joined

    def _pieces(self, text: str, symbols: Symbols) -> list[Any]:
        pieces: list[Any] = []
        position = 0
        while position < len(text):
            start = text.find("$", position)
            if start < 0 or start + 1 >= len(text):
                pieces.append(text[position:])
                break
            if start > position:
                pieces.append(text[position:start])
            end = _closing(text, start + 1)
            if text.startswith("$$", start):
                pieces.append(text[start + 1 : start + 2])
                position = start + 2
            elif end < 0:
                pieces.append(text[start : start + 1])
                position = start + 1
            else:
                inner = text[start + 2 : end]
                pieces.append(
                    self._expression(inner, symbols) if text[start + 1] == "{" else self._command(inner, symbols)
                )
                position = end + 1
        return pieces or [""]

    def _expression(self, code: str, symbols: Symbols) -> Any:
        extra: dict[str, Any] = {}
        code = self._loaded(_ARGUMENT.sub(lambda match: self._argument(match[1], extra), code), symbols, extra)
        names: Any = symbols if not extra else _With(symbols, extra)
        try:
            found = evaluate(code, names)
        except ExpressionError as error:
            self.problem(str(error))
            return UnknownPart("{" + code.strip().strip("{}") + "}")
        return found

    def _argument(self, name: str, extra: dict[str, Any]) -> str:
        label = f"argument_{len(extra)}"
        if name in self.arguments:
            extra[label] = typed(self.arguments[name])
        return label

    def _loaded(self, code: str, symbols: Symbols, extra: dict[str, Any]) -> str:
        """Replace `load_yaml(path)` by a name that holds the data of the file."""
        while (match := _LOAD_YAML.search(code)) is not None:
            end = _closing(code, match.end() - 1)
            if end < 0:
                break
            path = self._expression(code[match.end() : end], symbols)
            data = self.read(str(path))
            label = f"yaml_{len(extra)}"
            if data is not None:
                documents = parse_yaml(data).facts
                extra[label] = plain(documents[0]) if documents else {}
            code = code[: match.start()] + label + code[end + 1 :]
        return code

    def _command(self, inner: str, symbols: Symbols) -> str:
        word, _, rest = self.text(inner, symbols).strip().partition(" ")
        if word == "arg":
            known = self.arguments.get(rest.strip())
        elif word == "eval":
            return self._joined([self._expression(rest, symbols)])
        else:
            known = self.substitute(word, rest.strip())
        if known is None:
            self.problem(f"`$({inner.strip()})` is known at launch only")
            return UnknownPart("{" + (rest.strip() or word) + "}")
        return known


class _With(Symbols):
    """Symbols with names that one expression adds."""

    def __init__(self, symbols: Symbols, extra: dict[str, Any]) -> None:
        super().__init__(symbols._evaluate, symbols)
        self.own = extra


def shown(value: Any) -> str:
    """Return a value as xacro writes it into the document."""
    return str(value)


def typed(text: str) -> Any:
    """Return what a property's text means: number, truth value or text."""
    if isinstance(text, UnknownPart):
        return text
    bare = text.strip()
    if len(bare) > 1 and bare[0] == bare[-1] and bare[0] in "\"'":
        return bare[1:-1]
    if _NUMBER.fullmatch(bare):
        return int(bare) if bare.lstrip("+-").isdecimal() and not _octal(bare) else float(bare)
    return {"true": True, "false": False}.get(bare.lower(), text)


def _octal(text: str) -> bool:
    digits = text.lstrip("+-")
    return len(digits) > 1 and digits.startswith("0")


def _closing(text: str, position: int) -> int:
    """Return where the bracket that opens at a position closes, -1 for nowhere; quotes are skipped."""
    if position >= len(text) or text[position] not in "({":
        return -1
    depth, quote = 0, ""
    for at in range(position, len(text)):
        char = text[at]
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'" and text[position] == "{":
            quote = char
        elif char in "({[":
            depth += 1
        elif char in ")}]":
            depth -= 1
            if depth == 0:
                return at
    return -1
