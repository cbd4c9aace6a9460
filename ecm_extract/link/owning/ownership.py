"""Which modules have what a site declares: those that have its unit and run the functions that it comes through."""

from __future__ import annotations

from typing import Final

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.client_libraries import is_client_library
from ecm_extract.link.declaring.site import Site, overrides
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.constructors import Constructors
from ecm_extract.link.owning.decided import Decided
from ecm_extract.link.owning.leads import mentions_of_constant
from ecm_extract.link.owning.made_classes import MadeClasses
from ecm_extract.link.owning.made_unseen import SeenMakers
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.owning.objects_made import ObjectsMade
from ecm_extract.link.owning.overridden import Overridden
from ecm_extract.link.owning.reach import Reach
from ecm_extract.link.owning.references import Unit
from ecm_extract.link.running.values import Hole, Value

_VIRTUAL: Final = frozenset({"virtual", "pure", "override"})


class Ownership:
    """Gives sites to modules."""

    def __init__(self, sites: Sites, modules: Modules, makers: SeenMakers) -> None:
        self.sites = sites
        self.program = sites.program
        self.modules = modules
        self.reach = Reach(self.program, modules.loaded, modules.references.registered)
        self.constructors = Constructors(sites.calls, makers)
        made = MadeClasses(sites, self.reach)
        self.objects = ObjectsMade(sites, made, makers)
        self.overridden = Overridden(sites, made)
        self.decided = Decided(sites, modules.references)

    def owners(self, unit: Unit, site: Site) -> tuple[Module, ...]:
        """Return the modules that have what a site declares in a unit.

        What none of them runs is the library's, and nobody's where its source is of programs only.
        """
        if self._is_only_offered(site):
            return self._library(unit)
        called = self._called_on(unit, site)
        if called is not None:
            return (called,)
        owners = [each for each in self.modules.owners(unit) if not _is_told_by_rows(site, each)]
        derived = [each for each in owners if self._derives(each, site) or self._is_base_only(each, site)]
        if derived and len(derived) == len(owners):
            return ()
        owners = [each for each in owners if each not in derived and self.objects.run(site, each)]
        owners = [each for each in owners if not self.overridden.hides(site, each)]
        line = [call.func for call in (*site.chain, site.call)]
        owners = [each for each in owners if all(self.modules.links(each, func) for func in line)]
        through = self._through(unit, site)
        unused = any(self.constructors.is_unused(func) for func in through) or self._is_hidden(site.root)
        reached = [] if unused else [each for each in owners if self.reach.reaches(each, through)]
        running = self._deciding(site, reached)
        if not owners or (running and running[0].kind != "library"):
            return running
        dead = self.modules.is_of_programs_only(site.root.file) and not _is_in_a_table(unit)
        return () if dead else self._library(unit)

    def _derives(self, module: Module, site: Site) -> bool:
        """Whether a module is a class that derives from the one of whose objects a site tells; it has its own."""
        cls, exact = module.cls, site.exact
        return cls is not None and exact is not None and cls is not exact and exact in self.program.ancestry(cls)

    def _is_base_only(self, module: Module, site: Site) -> bool:
        """Whether nobody makes an object of the class that a site tells of: a program has one that derives from it."""
        cls = site.exact
        if module.main is None or cls is None or not self.program.derived(cls):
            return False
        return next(self.modules.references.makers(cls), None) is None

    def _called_on(self, unit: Unit, site: Site) -> Module | None:
        """The node whose object a program calls by itself: `node->declare_parameter(...)` in `main`."""
        if isinstance(unit, Cls) or site.chain or site.call.receiver is None or not self.modules.is_program(unit):
            return None
        cls = self.sites.folder.objects.class_of(site.call.receiver, site.env)
        return self.modules.by_class.get(cls) if cls is not None else None

    def _deciding(self, site: Site, modules: list[Module]) -> tuple[Module, ...]:
        """Those of the modules whose arguments lead to a site, where arguments decide."""
        asked = len(modules) > 1 or (bool(modules) and not self._is_loaded(site))
        callers = self.decided.callers(site) if asked else None
        if callers is None:
            return tuple(modules)
        return tuple([each for each in modules if any(self.reach.reaches(each, [func]) for func in callers)])

    def _is_loaded(self, site: Site) -> bool:
        """Whether a class has a contract of its own, of which whoever loads it may make something else."""
        return site.root.cls is not None and self.modules.is_module(site.root.cls)

    def _library(self, unit: Unit) -> tuple[Module, ...]:
        """The library that has what no module runs; what a client library declares is told of whoever calls it."""
        return () if is_client_library(unit.file.package) else (self.modules.library(unit),)

    def _through(self, unit: Unit, site: Site) -> list[Func]:
        """The functions that a site comes through, from the first that the unit runs inwards."""
        calls = [call for call in (*site.chain, site.call) if not self.sites.is_held(call)]
        line = [call.func for call in calls]
        family = self.program.ancestry(unit) if isinstance(unit, Cls) else ()
        first = next((at for at, func in enumerate(line) if func is unit or func.cls in family), -1)
        return line[first:]

    def _is_hidden(self, func: Func) -> bool:
        """Tell whether nobody runs a function: a private method of C++ that no call and no callback names."""
        if func.cls is None or func.file.language != "cpp" or func.is_constructor or overrides(func):
            return False
        name, callers = func.fact.name, self.sites.folder.states.callers
        traits = {trait for each in func.cls.methods if each.fact.name == name for trait in each.fact.traits}
        if "private" not in traits or _VIRTUAL & traits or callers.may_be_called_outside(name, func.cls):
            return False
        return not self.sites.calls.get(name) and not self.modules.references.hands(name)

    def _is_only_offered(self, site: Site) -> bool:
        """A helper that nobody calls declares nothing in the modules that could; one that is handed over runs."""
        root = site.root
        if root.is_constructor or overrides(root) or site.form.fixed or site.form.items:
            return False
        given = self.sites.is_given(root) or self.modules.references.hands(root.fact.name)
        if given and not self.sites.callers(root):
            return False
        values = self.sites.names.of(site)
        return any(_is_passed(value, root) for value in values)


def _is_in_a_table(unit: Unit) -> bool:
    """Tell whether what stands outside of functions mentions a unit: a table of callbacks, a global object."""
    found = [mentions_of_constant(constant) for constant in unit.file.facts.constants]
    asked = {name for each in found for name in (*each.plain, *each.used)}
    asked.update(one.name for each in found for one in each.within)
    return unit.fact.name in asked.union(one.name for each in found for one in each.of_names)


def _is_told_by_rows(site: Site, module: Module) -> bool:
    """Tell whether a client library makes an endpoint for another module, whose call a row tells."""
    package = site.call.func.file.package
    return package != module.package and is_client_library(package)


def _is_passed(value: Value, func: Func) -> bool:
    """Tell whether a name is a parameter of a function, and no part of one."""
    given = {parameter.name for parameter in func.fact.params}
    holes = [part for part in value.parts if isinstance(part, Hole)]
    whole = any(hole.kind == "param" and hole.label in given and not hole.part for hole in holes)
    return whole and len(holes) == len(value.parts)
