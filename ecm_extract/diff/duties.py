"""What is new and must be written or given, and by nobody anew: pure virtual methods, parameters of new nodes."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.hub.provision import Key, Provision
from ecm_checker.match.hierarchy import Bases

from ecm_extract.diff.model import Pair
from ecm_extract.entities.side import Side


def old_duties(pairs: Iterable[Pair], old: Side) -> frozenset[Key]:
    """Return the keys of additions that ask nothing new: a base of elsewhere did, or nobody ran what asks now."""
    listed = list(pairs)
    added = [pair.new for pair in listed if pair.new is not None and pair.old is None]
    return _of_new_nodes(added, old, _under_other_names(listed)) | _asked_before(added, old)


def _under_other_names(pairs: Iterable[Pair]) -> set[tuple[str, str]]:
    """Modules that offer what one of another name offered: whoever started that starts these."""
    return {
        (pair.new.package, pair.new.owner)
        for pair in pairs
        if pair.old is not None and pair.new is not None and pair.how == "same" and pair.new.is_of_module
    }


def _of_new_nodes(added: Iterable[Provision], old: Side, others: set[tuple[str, str]]) -> frozenset[Key]:
    """Parameters of what nobody started before."""
    modules = {(entity.package, entity.owner) for entity in old.entities.values() if entity.is_of_module} | others
    needed = (entity for entity in added if entity.needed)
    return frozenset(entity.key for entity in needed if (entity.package, entity.owner) not in modules)


def _asked_before(added: Iterable[Provision], old: Side) -> frozenset[Key]:
    """Methods that a base outside of the tree asked for before.

    Its classes at the old ref show it: each one that derived from the class had the method already.
    """
    pure = [entity for entity in added if any(form.pure for form in entity.forms)]
    if not pure:
        return frozenset()
    bases = Bases(old.entities)
    classes = [entity for entity in old.entities.values() if entity.row.is_class]
    found = set()
    for entity in pure:
        before = bases.named(entity.owner)
        foreign = any(bases.resolve(base, each.name) is None for each in before for base in each.bases)
        derived = [each.name for each in classes if entity.owner in bases.ancestry(each.name)[1:]] if foreign else []
        if derived and all(bases.offers(name, entity.owner, entity.name) for name in derived):
            found.add(entity.key)
    return frozenset(found)
