"""What is new and must be written or given, and by nobody anew: pure virtual methods, parameters of new nodes."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.hub.provision import Key, Provision
from ecm_checker.match.hierarchy import Bases

from ecm_extract.entities.side import Side


def old_duties(added: Iterable[Provision], old: Side) -> frozenset[Key]:
    """Return the keys of additions that ask nothing new: a base of elsewhere did, or nobody ran what asks now."""
    listed = list(added)
    return _of_new_nodes(listed, old) | _asked_before(listed, old)


def _of_new_nodes(added: Iterable[Provision], old: Side) -> frozenset[Key]:
    """Parameters of what nobody started before."""
    modules = {(entity.package, entity.owner) for entity in old.entities.values() if entity.is_of_module}
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
