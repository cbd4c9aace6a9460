"""What a regular expression can tell of a call: its arguments, its receiver, whether it is a definition."""

from __future__ import annotations

import re

_LONGEST = 20_000
_BACK = 400
_QUALIFIERS = re.compile(r"(?:\w+(?:<[^<>;]*>)?\s*::\s*)+$")
_RECEIVER = re.compile(r"(?:\.|->)\s*(?:template\s+)?$")
_NOT_A_TYPE = {
    "return",
    "else",
    "throw",
    "case",
    "do",
    "co_await",
    "co_return",
    "and",
    "or",
    "not",
    "in",
    "await",
}


def open_paren(masked: str, position: int) -> int | None:
    """Offset of the `(` of the call whose name ends at `position`; template arguments may come between."""
    after = position
    if opened := re.compile(r"\s*<").match(masked, position):
        after = call_end(masked, opened.end() - 1, "<", ">")
    paren = re.compile(r"\s*\(").match(masked, after)
    return paren.end() - 1 if paren else None


def call_end(masked: str, opening: int, left: str = "([{", right: str = ")]}") -> int:
    """Offset after the bracket that closes the one at `opening`; bounded, else just after `opening`."""
    depth = 0
    for position in range(opening, min(len(masked), opening + _LONGEST)):
        if masked[position] in left:
            depth += 1
        elif masked[position] in right and masked[position - 1 : position + 1] != "->":
            depth -= 1
            if depth == 0:
                return position + 1
    return opening + 1


def count_arguments(masked: str, opening: int, end: int) -> int:
    """Number of arguments between two brackets; commas inside brackets or templates do not count."""
    inner = masked[opening + 1 : end - 1]
    flat = inner
    while (shorter := re.sub(r"\([^()]*\)|\{[^{}]*\}|\[[^\[\]]*\]|(?<=\w)<[^<>()]*>", "x", flat)) != flat:
        flat = shorter
    parts = flat.split(",")
    return len(parts) - (not parts[-1].strip())


def is_definition(masked: str, name: int) -> bool:
    """True where a return type stands before the (qualified) name: it is declared or defined there."""
    before = masked[max(0, name - _BACK) : name]
    if _RECEIVER.search(before):
        return False
    before = _QUALIFIERS.sub("", before).rstrip()
    if before.endswith(("&&", "->", "(*", ",*", "=*", "= *", "&(")):
        return False
    word = re.search(r"(\w+)$", before)
    if word:
        return word.group(1) not in _NOT_A_TYPE
    return bool(re.search(r"[\w>]\s*[&*]$|[\w>]>$|\w\s>$", before))


def receiver_start(masked: str, name: int) -> int:
    """Offset where the expression that is called starts: `node->get(x).name` starts at `node`."""
    floor = max(0, name - _BACK)
    position = name
    for _ in range(8):
        before = masked[floor:position]
        step = _QUALIFIERS.search(before) or re.search(r"[\w\])]+\s*(?:\([^()]*\))?\s*(?:\.|->)\s*$", before)
        template = re.search(r"(?:\.|->)\s*template\s+$", before)
        if template:
            position = floor + template.start() + len(template.group()) - len(template.group().lstrip(".->"))
        elif step:
            position = floor + step.start()
        else:
            break
    return position
