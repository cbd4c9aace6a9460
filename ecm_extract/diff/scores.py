"""How surely a name that is gone lives on under one that is new."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.history import History
from ecm_extract.diff.moves import is_of_its_node
from ecm_extract.diff.similarity import (
    SEPARATOR,
    last_part,
    may_be_alike,
    name_similarity,
    same_language,
    shape_equal,
    stem,
    words,
)

_THRESHOLD = 0.62
_LEAST_NAME, _LEAST_WRITTEN = 0.5, 0.35
"""How alike two names must be, and where somebody wrote of both."""
_NAME, _SHAPE, _PLACE = 0.5, 0.25, 0.25
_WRITTEN = 0.12
_SURE_NAME = 0.85
_SURE_ALONE = 0.8
_SURE_LISTED = 0.68
"""Where all of a package stand in one file, as libraries in CMakeLists.txt, only the name can tell."""
_DESCRIPTIONS = (".urdf", ".xacro")
_MODEL = re.compile(r"[a-zA-Z]*\d+[a-zA-Z]*")
_GENERIC = frozenset(
    ("use", "enable", "enabled", "is", "has", "get", "set", "on", "new", "do", "default", "num", "max")
)
_GENERIC |= {"min", "publish", "callback", "handler", "node", "server", "type", "name"}
"""Words that half of all names hold: two names that share no other word are two things."""


def score(
    old: Provision, new: Provision, files: Mapping[str, str], history: History | None, kin: bool = True
) -> tuple[float, str] | None:
    """Return a confidence from 0 to 1 with its reason; None when the two are not alike enough.

    Args:
        old: what is gone.
        new: what came, of the same kind.
        files: new path of each file that moved.
        history: what people wrote.
        kin: whether the owner of the one has become that of the other, or nobody knows.
    """
    place, where = _place(old, new, files)
    if not may_be_alike(old, new) and place < 1:
        return None
    if _is_another(old, new, place, kin) or not same_language(old, new):
        return None
    name = name_similarity(stem(old), stem(new))
    shape = shape_equal(old, new)
    total = _NAME * name + _SHAPE * shape + _PLACE * place
    if _is_other_structure(old, new) or (shape == 0 and (name < _SURE_NAME or _parts(old) != _parts(new))):
        return None
    if name < _LEAST_WRITTEN or total + _WRITTEN < _THRESHOLD or (old.row.listed and name < _SURE_LISTED):
        return None
    if name < _SURE_NAME and not _shared_words(old, new):
        return None
    written = history.mentions(old.name, new.name) if history is not None else None
    if not written and name < _LEAST_NAME:
        return None
    if not written and place < 1 and (shape < 1 or not kin) and name < _SURE_ALONE:
        return None
    if written:
        total += _WRITTEN
    if total < _THRESHOLD:
        return None
    return total, _reason(name, shape, where, written)


def _is_another(old: Provision, new: Provision, place: float, kin: bool) -> bool:
    """Whether two cannot be one whatever their names: the number is what a constant means, `~/a` is of its node."""
    if is_of_its_node(old, new) and place < 1 and not kin:
        return True
    if old.row.fixed:
        return bool(old.default != new.default)  # a list or a sum, of which no value is known, is no number or text
    described = old.row.included and old.path.endswith(_DESCRIPTIONS)
    return (old.row.of_file or described) and (place < 1 or _models(old.name) != _models(new.name))


def _models(name: str) -> list[str]:
    """What tells one robot or device from the next of its family: `l515`, `ur10e`."""
    return _MODEL.findall(name)


def _shared_words(old: Provision, new: Provision) -> frozenset[str]:
    """The words that tell what both are; those of a common base or folder only tell which kind of thing."""
    if old.row.included:
        return (words(last_part(stem(old))) & words(last_part(stem(new)))) - _GENERIC
    if not old.row.based:
        return (words(stem(old)) & words(stem(new))) - _GENERIC
    base = words(" ".join((*old.bases, old.type or "")))
    return (words(last_part(old.name)) & words(last_part(new.name))) - _GENERIC - base


def _is_other_structure(old: Provision, new: Provision) -> bool:
    """Whether names of unlike nesting differ in more than where the separators stand: `a.b_c` is no `a_b_cs`."""
    if _parts(old) == _parts(new) or last_part(old.name) == last_part(new.name):
        return False
    before, after = words(old.name), words(new.name)
    return not (before <= after or after <= before)


def _parts(entity: Provision) -> int:
    return len(SEPARATOR.split(entity.name))


def _place(old: Provision, new: Provision, files: Mapping[str, str]) -> tuple[float, str]:
    if files.get(old.path, old.path) == new.path:
        return 1.0, "in the same file" if old.path == new.path else "git sees its file move"
    if old.owner and old.owner == new.owner:
        return 1.0, f"of the same {'class' if '::' in old.owner else 'owner'}"
    return 0.5, "in the same package"


def _reason(name: float, shape: float, where: str, written: str | None) -> str:
    alike = f"names alike to {name:.0%}"
    kind = "same type or signature" if shape == 1 else "type or signature changed" if shape == 0 else "no type"
    text = f"gone and new {where}; {alike}; {kind}"
    return f"{text}; history says: {written[:160]}" if written else text
