"""Text with `$(...)` of launch XML and YAML -> templates, in the dialects of ROS 1 and ROS 2.

Sources: wiki.ros.org/roslaunch/XML "substitution args"; `launch.frontend.parse_substitution`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from ecm_parsers.template import TOO_LARGE, Substitution, Template

MAX_TEXT = 20_000
MAX_DEPTH = 10
_KINDS: Mapping[str, str] = MappingProxyType(
    {
        "arg": "arg",
        "var": "arg",
        "env": "env",
        "optenv": "env",
        "find": "find",
        "find-pkg-share": "find",
        "find-pkg-prefix": "find_prefix",
        "dirname": "dirname",
        "anon": "anon",
        "eval": "eval",
        "command": "command",
        "exec-in-pkg": "command",
        "find-exec": "command",
        "not": "not",
        "and": "and",
        "or": "or",
        "equals": "equals",
        "if": "if",
    }
)
_WORD = re.compile(r"""\s+|"((?:[^"\\]|\\.)*)"|'((?:[^'\\]|\\.)*)'|((?:[^\s"'$]|\$(?!\())+)""")


def parse_template(text: str | None, depth: int = 0) -> Template:
    """Return a text as literal parts and substitutions; an unclosed `$(` stays text.

    What is too long or nests too deeply to be read is `TOO_LARGE`.
    """
    if not text:
        return ()
    if "$(" not in text:
        return (text,)
    if len(text) > MAX_TEXT or depth > MAX_DEPTH:
        return TOO_LARGE
    parts: list[str | Substitution] = []
    position = 0
    while (start := text.find("$(", position)) >= 0:
        end = _closing(text, start + 2)
        if end < 0:
            break
        if start > position:
            parts.append(text[position:start])
        parts.append(_substitution(text[start + 2 : end], depth))
        position = end + 1
    if position < len(text):
        parts.append(text[position:])
    return tuple(parts)


def _closing(text: str, position: int) -> int:
    """Return where the parenthesis that is open at a position closes, -1 for nowhere."""
    depth = 1
    for at in range(position, len(text)):
        if text[at] == "(":
            depth += 1
        elif text[at] == ")":
            depth -= 1
            if depth == 0:
                return at
    return -1


def _substitution(inner: str, depth: int) -> Substitution:
    word, _, rest = inner.strip().partition(" ")
    kind = _KINDS.get(word)
    if kind is None:
        return Substitution("unknown", ((inner.strip(),),))
    if kind == "eval":
        return Substitution("eval", (parse_template(_unquoted(rest.strip()), depth + 1),))
    return Substitution(kind, _words(rest, depth, whole=word == "optenv"))


def _words(text: str, depth: int, *, whole: bool) -> tuple[Template, ...]:
    """Split at blanks outside quotes and substitutions; with `whole` everything after the first word is one."""
    words: list[Template] = []
    current: list[str | Substitution] = []
    position = 0
    while position < len(text):
        if text.startswith("$(", position) and (end := _closing(text, position + 2)) >= 0:
            current.append(_substitution(text[position + 2 : end], depth + 1))
            position = end + 1
            continue
        match = _WORD.match(text, position)
        if match is None:
            current.append(text[position])
            position += 1
            continue
        if match.lastindex is None:
            if current and not (whole and words):
                words.append(tuple(current))
                current = []
            elif current:
                current.append(" ")
        else:
            word = match[match.lastindex]
            current += parse_template(word, depth + 1) or ("",)  # quotes keep blanks, not substitutions
        position = match.end()
    if current:
        words.append(tuple(current))
    return tuple(words)


def _unquoted(text: str) -> str:
    """Python code of ROS 2 stands in quotes, that of ROS 1 does not."""
    if (
        len(text) > 1
        and text[0] == text[-1]
        and text[0] in "\"'"
        and text[0] not in text[1:-1].replace("\\" + text[0], "")
    ):
        return text[1:-1].replace("\\" + text[0], text[0])
    return text
