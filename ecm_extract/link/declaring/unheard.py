"""Parameters that a node reads and nobody declares: where it takes no others, nobody can give it one."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from ecm_parsers.source.expr import THIS, Text

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.match import name_argument
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.undeclared import Undeclared
from ecm_extract.link.index.module_kinds import is_node_base
from ecm_extract.link.index.program import Program


def heard(sites: Iterable[Site], undeclared: Undeclared, program: Program) -> list[Site]:
    """Return the sites without reads that certainly get no more than what their call has instead."""
    known = list(sites)
    declaring = defaultdict[str, set[Cls | None]](set)
    for site in (each for each in known if not each.form.reads):
        declaring[_name(site)].add(_own_node(site, program))
    return [each for each in known if not _is_unheard(each, declaring, undeclared, program)]


def _is_unheard(site: Site, declaring: Mapping[str, set[Cls | None]], undeclared: Undeclared, program: Program) -> bool:
    cls = _own_node(site, program) if site.form.reads else None
    name = _name(site)
    if cls is None or not name:
        return False
    lineage = {None, *program.ancestry(cls), *program.derived(cls)}
    return lineage.isdisjoint(declaring.get(name, ())) and not undeclared.takes_any(site.call.func)


def _name(site: Site) -> str:
    name = name_argument(site.form, site.call)
    return name.value if isinstance(name, Text) else ""


def _own_node(site: Site, program: Program) -> Cls | None:
    """Return the class of a node that calls for itself and of whose bases all are at hand: others may declare more."""
    cls = site.call.func.cls if site.call.receiver in {None, THIS} else None
    if cls is None:
        return None
    own = {each.fact.name for each in program.ancestry(cls)}
    others = [name for name in program.base_names(cls) if last_name(name) not in own]
    return cls if others and all(map(is_node_base, others)) else None
