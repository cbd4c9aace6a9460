"""New pure virtual methods that nobody has to write anew."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.hub.provision import Key, Provision
from ecm_checker.match.hierarchy import Bases

from ecm_extract.entities.side import Side


def old_duties(added: Iterable[Provision], old: Side) -> frozenset[Key]:
    """Return the keys of additions that a base outside of the tree asked for before.

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
