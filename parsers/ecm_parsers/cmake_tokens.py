"""Commands of a CMake file, before any evaluation.

Source: cmake-language(7), grammar of command invocations, arguments and comments.
"""

from __future__ import annotations

import re
from bisect import bisect_right

import msgspec

from ecm_parsers.result import Diagnostic, Parsed, shortened
from ecm_parsers.text import decode

_TOO_MANY = "cmake-too-many-commands"
MAX_BYTES = 2_000_000
MAX_COMMANDS = 10_000
MAX_ARGUMENTS = 100_000
MAX_DIAGNOSTICS = 50

_SPACE = re.compile(r"[ \t\r\n;]+")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*+)("?)', re.DOTALL)
_UNQUOTED = re.compile(r'(?:[^\s()#"\\]|\\.|\$\([^\s()]*\)|(?<=[^\s(])"(?:[^"\\\n]|\\.)*+")++', re.DOTALL)
_BRACKET = re.compile(r"\[(=*)\[")
_CONTINUATION = re.compile(r"\\\n")


class Argument(msgspec.Struct, frozen=True):
    """One argument as written.

    Attributes:
        text: without quotes or brackets; references and escapes are not evaluated.
        line: 1-based.
        form: `quoted` stays one value, `bracket` is not evaluated at all, `plain` may become several values,
            as may `argument`: one into which an argument of a macro was written.
    """

    text: str
    line: int
    form: str = "plain"


class Command(msgspec.Struct, frozen=True):
    """A command invocation; the name in lower case, nested parentheses are arguments of their own."""

    name: str
    args: tuple[Argument, ...]
    line: int


def parse_commands(data: bytes) -> Parsed[tuple[Command, ...]]:
    """Read the commands of a CMake file; text that is no command is skipped to the next line."""
    if len(data) > MAX_BYTES:
        message = f"CMake file larger than {MAX_BYTES} bytes is not read. Exclude it if it is generated."
        return Parsed((), (Diagnostic("error", "cmake-too-large", 0, message, cut=True),))
    text, diagnostics = decode(data)
    scanner = _Scanner(text, list(diagnostics))
    commands = scanner.commands()
    return Parsed(tuple(commands), shortened(scanner.diagnostics, MAX_DIAGNOSTICS))


class _Scanner:
    """A cursor over the text."""

    def __init__(self, text: str, diagnostics: list[Diagnostic]) -> None:
        self.diagnostics = diagnostics
        self._text = text
        self._pos = 0
        self._arguments = 0
        self._newlines = [match.start() for match in re.finditer("\n", text)]

    def commands(self) -> list[Command]:
        """Read to the end of the text or to a bound."""
        commands: list[Command] = []
        while self._skip_blank():
            if len(commands) >= MAX_COMMANDS or self._arguments >= MAX_ARGUMENTS:
                self._report(_TOO_MANY, "Too many commands; the rest is not read.")
                break
            command = self._command()
            if command is not None:
                commands.append(command)
        return commands

    def _command(self) -> Command | None:
        """Read `name(args)`; None after skipping a line that does not start one."""
        line = self._line()
        name = _NAME.match(self._text, self._pos)
        if name is not None:
            self._pos = name.end()
            if self._skip_blank() and self._text[self._pos] == "(":
                self._pos += 1
                return Command(name[0].lower(), tuple(self._args(name[0], line)), line)
        self._report("cmake-syntax", "Not a CMake command; the line is skipped.")
        end = self._text.find("\n", self._pos)
        self._pos = len(self._text) if end < 0 else end
        return None

    def _args(self, name: str, line: int) -> list[Argument]:
        """Read arguments up to the parenthesis that closes the command."""
        args: list[Argument] = []
        depth = 1
        while self._skip_blank() and self._arguments < MAX_ARGUMENTS:
            char = self._text[self._pos]
            depth += {"(": 1, ")": -1}.get(char, 0)
            if depth == 0:
                self._pos += 1
                return args
            args.append(self._argument(char))
            self._arguments += 1
        message = f"'{name[:40]}(' is never closed; close it with ')'."
        self.diagnostics.append(Diagnostic("error", "cmake-unclosed", line, message))
        return args

    def _argument(self, char: str) -> Argument:
        line = self._line()
        if char in "()":
            self._pos += 1
            return Argument(char, line)
        if char == '"':
            return self._quoted(line)
        bracket = _BRACKET.match(self._text, self._pos)
        if bracket:
            return Argument(self._bracket_body(bracket), line, "bracket")
        plain = _UNQUOTED.match(self._text, self._pos)
        if plain is None:
            self._pos += 1
            return Argument(char, line)
        self._pos = plain.end()
        return Argument(plain[0], line)

    def _quoted(self, line: int) -> Argument:
        match = _QUOTED.match(self._text, self._pos)
        if match is None or not match[2]:
            self._report("cmake-unclosed", 'A quoted argument is never closed; close it with ".')
        self._pos = match.end() if match else len(self._text)
        return Argument(_CONTINUATION.sub("", match[1]) if match else "", line, "quoted")

    def _bracket_body(self, opening: re.Match[str]) -> str:
        """Return what stands between `[==[` and `]==]`, or the rest of the text."""
        closing = f"]{opening[1]}]"
        end = self._text.find(closing, opening.end())
        if end < 0:
            self._report("cmake-unclosed", f"A bracket is never closed; close it with {closing[:40]}.")
            end = len(self._text)
        self._pos = end + len(closing)
        return self._text[opening.end() : end].removeprefix("\n")

    def _skip_blank(self) -> bool:
        """Skip space and comments; tell whether text is left."""
        while self._pos < len(self._text):
            space = _SPACE.match(self._text, self._pos)
            if space:
                self._pos = space.end()
            elif self._text[self._pos] == "#":
                self._skip_comment()
            else:
                return True
        return False

    def _skip_comment(self) -> None:
        bracket = _BRACKET.match(self._text, self._pos + 1)
        if bracket:
            self._bracket_body(bracket)
        else:
            end = self._text.find("\n", self._pos)
            self._pos = len(self._text) if end < 0 else end

    def _line(self) -> int:
        return bisect_right(self._newlines, self._pos - 1) + 1

    def _report(self, code: str, message: str) -> None:
        self.diagnostics.append(Diagnostic("error", code, self._line(), message, cut=code == _TOO_MANY))
