"""Arguments that launch files give to descriptions: `xacro $(find arm)/urdf/arm.urdf.xacro side:=left`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.launch.templates import substitutions, written
from ecm_parsers.template import Substitution, Template

from ecm_extract.requires.place import Place, required

_PROGRAMS: Final = frozenset({"xacro", "xacro.py"})
_FINDS: Final = frozenset({"find", "find_prefix"})
_QUOTES: Final = "'\""
_SPACE: Final = re.compile(r"\s")
_GIVEN: Final = ":="


def given_to_descriptions(value: object, place: Place) -> Iterator[Requirement]:
    """Yield the arguments that commands below a value give to descriptions of packages."""
    for found in substitutions(value):
        if found.substitution.kind == "command":
            yield from _given([word for each in found.substitution.args for word in _words(each)], place)


def _program(word: Template) -> str:
    """The program that a word names; `FindExecutable` stands in its place as a command of its own."""
    first = word[0]
    found = first.args[0] if isinstance(first, Substitution) and first.kind == "command" and first.args else word
    return written(found).rpartition("/")[2]


def _given(words: list[Template], place: Place) -> Iterator[Requirement]:
    if not words or _program(words[0]) not in _PROGRAMS:
        return
    described = next((target for word in words[1:] if (target := _described(word)) is not None), None)
    if described is None:
        return
    package, path = described
    for word in words[1:]:
        first = word[0]
        name, mark, _ = first.partition(_GIVEN) if isinstance(first, str) else ("", "", "")
        if name and mark:
            yield required("gives_xacro_argument", name, place, package=package, owner=path)


def _described(word: Template) -> tuple[str, str] | None:
    """Package and path of what a word names by them; None for any other word."""
    first = word[0]
    if not isinstance(first, Substitution) or first.kind not in _FINDS or not first.args:
        return None
    path = written(word[1:])
    return (written(first.args[0]), path.lstrip("/")) if path.startswith("/") and "$" not in path else None


def _words(command: Template) -> Iterator[Template]:
    """Split a command at the white space that it says itself, without the quotes around its words."""
    word: list[str | Substitution] = []
    for part in command:
        if not isinstance(part, str):
            word.append(part)
            continue
        for at, text in enumerate(_SPACE.split(part)):
            if at and word:
                yield tuple(word)
                word = []
            if text.strip(_QUOTES):
                word.append(text.strip(_QUOTES))
    if word:
        yield tuple(word)
