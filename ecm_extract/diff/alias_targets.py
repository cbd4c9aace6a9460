"""Other names of classes (`using A = B<T>`) that stand for another class now: who uses one gets that other class."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ecm_checker.hub.provision import ALIAS, Key, Provision
from ecm_checker.match.hierarchy import Bases

from ecm_extract.diff.model import Pair

Retargeted = tuple[Pair, str, str]
"""An alias with what it stood for and what it stands for now."""


def retargeted(
    pairs: Iterable[Pair], old: Mapping[Key, Provision], new: Mapping[Key, Provision]
) -> Iterator[Retargeted]:
    """Yield the aliases that stand for another class; that one of a new name, or a class of its kind, is no other one.

    Args:
        pairs: of all kinds.
        old: provisions of the side before.
        new: those of the side after.
    """
    listed = list(pairs)
    aliases = [pair for pair in listed if _is_alias(pair.old) and _is_alias(pair.new)]
    if not aliases:
        return
    names = {pair.old.name: pair.new.name for pair in listed if pair.old and pair.new and pair.old.row.is_class}
    before, after = Bases(old), Bases(new)
    for pair in aliases:
        assert pair.old is not None
        assert pair.new is not None
        target, now = (_target(each, bases) for each, bases in ((pair.old, before), (pair.new, after)))
        is_same = _is_same(names.get(target, target), now, after)
        if not is_same or (target == now and pair.old.given != pair.new.given):
            yield pair, _shown(pair.old), _shown(pair.new)


def _is_alias(entity: Provision | None) -> bool:
    return entity is not None and entity.type == ALIAS and bool(entity.bases)


def _target(alias: Provision, bases: Bases) -> str:
    """The class that an alias names, in full where it is of the tree."""
    return bases.resolve(alias.bases[0], alias.name) or alias.bases[0]


def _is_same(name: str, other: str, after: Bases) -> bool:
    """Whether a class has all that another one has: it is that one, derives from it, or both are one by aliases."""
    if name.rpartition("::")[2] == other.rpartition("::")[2]:
        return True  # a namespace may be written or not
    return name in after.ancestry(other) or other in after.stands_for(name)


def _shown(alias: Provision) -> str:
    arguments = ", ".join(alias.given[0]) if alias.given else ""
    return f"{alias.bases[0]}<{arguments}>" if arguments else alias.bases[0]
