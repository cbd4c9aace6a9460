"""Code of C++ that no build compiles: behind `#if 0`, and behind tests of a macro that the file itself undefines."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

from ecm_parsers.source.cpp_directives import Directive, directives
from ecm_parsers.source.cpp_text import blanked_at

_TESTED: Final = re.compile(
    rb"(?P<not>!\s*)?(?:defined\s*\(\s*(?P<asked>\w+)\s*\)|defined\s+(?P<bare>\w+)|(?P<value>\w+))"
)
_NUMBERS: Final = {b"0": False, b"false": False, b"1": True, b"true": True}
_HINT: Final = re.compile(rb"\#[ \t]*(?:undef|(?:el)?if[\s\\(!]*(?:0|1|false|true)\b)")
"""What a file has that has anything of the kind: searching it costs a thousandth of a parse."""

_Range = tuple[int, int]


@dataclass(slots=True)
class _Group:
    """An `#if` that is not closed yet.

    Attributes:
        holds: whether the branch at hand is compiled; None where the build decides.
        begin: where that branch begins.
        settled: whether one before it is compiled, so that none after it is.
        certain: whether the file decides all branches so far.
        directives, dead: the lines of the group itself, and branches that are not compiled.
    """

    holds: bool | None
    begin: int
    settled: bool = False
    certain: bool = True
    directives: list[_Range] = field(default_factory=list)
    dead: list[_Range] = field(default_factory=list)


def without_dead(data: bytes) -> bytes:
    """Return `data` with all that is not compiled blanked, length unchanged; what the build decides stays."""
    if _HINT.search(data) is None:
        return data
    return blanked_at(data, _dead(data))


def _dead(data: bytes) -> Iterator[_Range]:
    groups: list[_Group] = []
    undefined: set[bytes] = set()
    for found in directives(data):
        if found.word in {b"if", b"ifdef", b"ifndef"}:
            groups.append(_Group(None, found.end))
            _turn(groups[-1], _verdict(found.word, found.rest, undefined), found)
        elif found.word in {b"elif", b"else"} and groups:
            _close(groups[-1], found)
            _turn(groups[-1], found.word == b"else" or _verdict(b"if", found.rest, undefined), found)
        elif found.word == b"endif" and groups:
            _close(groups[-1], found)
            yield from _found(groups.pop(), found)
        elif all(group.holds is not False for group in groups):
            _define(found.word, found.rest, undefined, all(group.holds for group in groups))


def _turn(group: _Group, verdict: bool | None, found: Directive) -> None:
    """Go on with the next branch: of several that hold the first is compiled, and no other one."""
    group.holds = False if group.settled else verdict if group.certain or verdict is False else None
    group.settled = group.settled or group.holds is True
    group.certain = group.certain and group.holds is not None
    group.begin = found.end
    group.directives.append((found.start, found.end))


def _close(group: _Group, found: Directive) -> None:
    if group.holds is False:
        group.dead.append((group.begin, found.start))


def _found(group: _Group, found: Directive) -> list[_Range]:
    """The dead branches, and the lines around them where nothing is left to decide."""
    lines = [*group.directives, (found.start, found.end)] if group.certain else []
    return [*group.dead, *lines]


def _verdict(word: bytes, test: bytes, undefined: set[bytes]) -> bool | None:
    """Whether a test holds, as far as the file says so."""
    if word != b"if":
        return word == b"ifndef" if test in undefined else None
    asked = _TESTED.fullmatch(test)
    if asked is None:
        return None
    name = asked["asked"] or asked["bare"] or asked["value"]
    found = False if name in undefined else _NUMBERS.get(asked["value"] or b"")
    return found if found is None or not asked["not"] else not found


def _define(word: bytes, rest: bytes, undefined: set[bytes], always: bool) -> None:
    """What a header defines is not known here."""
    name = (rest.split() or [b""])[0]
    if word == b"undef" and always:
        undefined.add(name)
    elif word == b"define":
        undefined.discard(name.partition(b"(")[0])
    elif word.startswith((b"include", b"import")):
        undefined.clear()
