"""How alike two names are, by their words and letters."""

from __future__ import annotations

import re
from difflib import SequenceMatcher

from ecm_checker.hub.provision import Provision

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
SEPARATOR = re.compile(r"::|[/.]")
_ENDING = re.compile(r"(?<=.)\.(?:h|hh|hpp|hxx|ipp|tpp)$")
_FILE_ENDING = re.compile(r"(?<=\w)(?:\.[a-z]+)+$")
_LAST_EQUAL = 0.6
_PARTS = frozenset({"request.", "response.", "goal.", "result.", "feedback."})
"""Of an interface file: what stands before a field there is no place that people name."""


def words(name: str) -> frozenset[str]:
    """`getGlobalFrame_id` -> {get, global, frame, id}."""
    return frozenset(word.lower() for word in _WORD.findall(name))


def last_part(name: str) -> str:
    """The last part of a name with `/`, `.` or `::`."""
    return SEPARATOR.split(name)[-1]


def stem(entity: Provision) -> str:
    """What tells in the name of an entity: of a file all but its ending."""
    if entity.row.included:
        return _ENDING.sub("", entity.name) if "/" in entity.name else entity.name
    return _FILE_ENDING.sub("", entity.name) if entity.row.started or entity.row.is_file else entity.name


def name_similarity(old: str, new: str) -> float:
    """Return 0 for nothing in common to 1 for the same name; a common place before the last part says nothing."""
    if old == new:
        return 1.0
    one, other = last_part(old), last_part(new)
    place = old.removesuffix(one)
    if place == new.removesuffix(other) and place not in _PARTS:
        old, new = one, other
    first, second = words(old), words(new)
    shared = 2 * len(first & second) / max(1, len(first) + len(second))
    letters = SequenceMatcher(None, old.lower(), new.lower(), autojunk=False).ratio()
    tail = last_part(old)
    same_tail = _LAST_EQUAL if tail == last_part(new) and len(tail) > 1 and tail.strip("<*>") else 0.0
    return max((shared + letters) / 2, letters if letters > 0.85 else 0.0, same_tail)


def may_be_alike(old: Provision, new: Provision) -> bool:
    """A cheap test before the letters are compared: a shared word, or the same beginning."""
    if words(old.name) & words(new.name):
        return True
    return last_part(stem(old))[:4].lower() == last_part(stem(new))[:4].lower()


def shape_equal(old: Provision, new: Provision) -> float:
    """1 for the same type or signature, 0 for another, a half where neither tells."""
    if old.forms or new.forms:
        before = {(form.types, form.returns) for form in old.forms}
        after = {(form.types, form.returns) for form in new.forms}
        return 1.0 if before & after else 0.0
    if old.row.duty and (old.default is None) != (new.default is None):
        return 0.0
    if old.row.is_class or (old.type is None and new.type is None):
        return 0.5
    return float(old.type == new.type)


def in_package(name: str, old: str, new: str) -> str:
    """A name whose part that is the name of a package is that of another one: `arm/msg/Joint` -> `hand/msg/Joint`."""
    pieces = re.split(rf"({SEPARATOR.pattern})", name)
    return "".join(new if piece == old else piece for piece in pieces)


def same_language(old: Provision, new: Provision) -> bool:
    """Whether two symbols or files can stand for each other: nobody imports a header, or includes a module."""
    return not old.row.in_language or old.path.endswith(".py") == new.path.endswith(".py")
