"""Methods that override what has another signature now, or is gone."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.diff.bases import Bases
from ecm_extract.diff.effects import accepts
from ecm_extract.diff.model import Located
from ecm_extract.entities.model import Form
from ecm_extract.entities.side import Workspace
from ecm_extract.entities.signatures import form_of
from ecm_extract.link.units import Cls
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_CONCERNED = frozenset({"removed", "renamed", "signature_changed", "deprecated"})


def override_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the overriding methods of a workspace that a change of the overridden one breaks.

    A method that has the new signature already is quiet.
    """
    by_name: dict[str, list[Located]] = {}
    for located in index.of_kind("method"):
        entity = located.pair.old
        if located.change.change in _CONCERNED and entity is not None and any(f.virtual for f in entity.forms):
            by_name.setdefault(entity.name, []).append(located)
    if not by_name:
        return
    bases = Bases(index.old.entities)
    for group in workspace.program.classes.values():
        for cls in group:
            if cls.file.language == "cpp" and cls.fact.bases:
                yield from _of_class(cls, workspace, by_name, bases)


def _of_class(cls: Cls, workspace: Workspace, by_name: dict[str, list[Located]], bases: Bases) -> Iterator[Use]:
    above: set[str] | None = None
    for method in cls.methods:
        for located in by_name.get(method.fact.name, ()):
            if method.file is not cls.file or "private" in cls.fact.traits:
                continue
            above = above if above is not None else _above(cls, workspace, bases)
            entity = located.pair.old
            if entity is None or entity.owner not in above:
                continue
            form = form_of(method.fact)
            if _breaks(form, located):
                place = Place(cls.file.package, cls.file.path, method.fact.line)
                yield use_at(located, place, f"overrides {entity.owner}::{entity.name} as {form.text}")


def _above(cls: Cls, workspace: Workspace, bases: Bases) -> set[str]:
    """Qualified names of all classes above one, those of the old side included."""
    found: set[str] = set()
    for written in workspace.program.base_names(cls):
        name = bases.resolve(written, cls.qualified)
        if name is not None:
            found |= set(bases.ancestry(name))
    return found


def _breaks(form: Form, located: Located) -> bool:
    old, new = located.pair.old, located.pair.new
    assert old is not None
    if not any(form.types == known.types for known in old.forms):
        return False
    if new is None:
        return True
    fitting = [known for known in new.forms if accepts(known, form) or known.types == form.types]
    if located.change.change == "deprecated":
        return any(known.deprecated for known in fitting)
    same = [known for known in fitting if known.types == form.types and _same_return(known, form)]
    return located.change.change == "renamed" or not same


def _same_return(known: Form, form: Form) -> bool:
    return not known.returns or not form.returns or known.returns == form.returns
