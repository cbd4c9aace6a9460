"""Which methods a class may override: what says nothing of it is still virtual where a base of its class says so."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ecm_checker.hub.provision import Form, Key, Provision
from ecm_checker.match.hierarchy import Bases
from msgspec.structs import replace

from ecm_extract.diff.model import Pair


def with_inherited_virtual(pairs: Iterable[Pair], new: Mapping[Key, Provision]) -> Iterator[Pair]:
    """Yield the pairs; a method that lost the word is virtual as long as a base may say it.

    Args:
        pairs: of all kinds.
        new: provisions of the new side.
    """
    bases = Bases(new)
    for pair in pairs:
        if pair.old is None or pair.new is None or not no_longer_overridable(pair.old, pair.new):
            yield pair
        else:
            yield replace(pair, new=_inheriting(pair.new, bases))


def no_longer_overridable(old: Provision, new: Provision) -> list[Form]:
    """Return the forms that a class of C++ could override and that are there, and not virtual, now."""
    if old == new or old.is_python or new.is_python:
        return []
    before = {form.types for form in old.forms if form.virtual}
    virtual = {form.types for form in new.forms if form.virtual}
    return [form for form in new.forms if form.types in before and form.types not in virtual]


def _inheriting(method: Provision, bases: Bases) -> Provision:
    forms = tuple(replace(form, virtual=form.virtual or _may_inherit(method, form, bases)) for form in method.forms)
    return replace(method, forms=forms)


def _may_inherit(method: Provision, form: Form, bases: Bases) -> bool:
    """Whether a base of the tree has the form virtual, or there is a base that is not known."""
    if form.final:
        return False
    ancestry = bases.ancestry(method.owner)
    above = (bases.member(cls, called=True, name=method.name) for cls in ancestry[1:])
    inherited = any(other.virtual and other.types == form.types for each in above if each for other in each.forms)
    return inherited or any(
        bases.resolve(base, cls) is None for cls in ancestry for entity in bases.named(cls) for base in entity.bases
    )
