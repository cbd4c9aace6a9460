"""Objects of which classes a module makes: a method that all of them have another one for runs on none of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_parsers.source.expr import THIS

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.dispatching import is_early
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.made_classes import MadeClasses
from ecm_extract.link.owning.made_unseen import SeenMakers
from ecm_extract.link.owning.modules import Module
from ecm_extract.link.running.early_binding import is_virtual


class ObjectsMade:
    """Tells whether the objects of modules run what a site comes through."""

    def __init__(self, sites: Sites, made: MadeClasses, makers: SeenMakers) -> None:
        self.sites = sites
        self.program = sites.program
        self.made = made
        self.makers = makers

    def run(self, site: Site, module: Module) -> bool:
        """Tell whether an object that a module makes runs the methods of C++ by which a site is reached."""
        cls = self._class_of(site)
        methods = [each for each in self._by_name(site) if is_virtual(each, self.program)]
        made = self._made_by(module, cls) if cls is not None and methods else ()
        runs = self.sites.dispatching.runs
        runs_root = not made or any(all(runs(method, each) for method in methods) for each in made)
        return runs_root and all(self._is_had(method, module) for method in self._of_others(site))

    def _of_others(self, site: Site) -> Iterator[Func]:
        """The virtual methods on the way that are called on other objects, of whichever class these are."""
        inwards = (call.func for call in (*site.chain[1:], site.call))
        for call, method in zip(site.chain, inwards, strict=False):
            is_other = call.receiver is not None and call.receiver != THIS
            if is_other and method.cls is not None and is_virtual(method, self.program):
                yield method

    def _is_had(self, method: Func, module: Module) -> bool:
        """Whether a program can have an object that runs a method: it makes one, or the tree does not show who does."""
        cls = method.cls
        if cls is None or module.main is None:
            return True
        family = (cls, *self.program.derived(cls))
        shown = all(map(self.makers.are_named, family)) and any(map(self.sites.makers, family))
        runs = self.sites.dispatching.runs
        return not shown or any(runs(method, each) for each in self.made.of(module, cls))

    def _class_of(self, site: Site) -> Cls | None:
        """The class of the object that runs the outermost function of a site."""
        return self.sites.folder.nesting.object_of(site.root)

    def _by_name(self, site: Site) -> Iterator[Func]:
        """The methods on the way that the object itself tells: none that somebody calls by the name of its class."""
        for method in self.sites.dispatching.on_object(site):
            if method is not site.root or not self._is_called_early(method):
                yield method

    def _is_called_early(self, method: Func) -> bool:
        return any(is_early(call) for call in self.sites.calls.get(method.fact.name, ()))

    def _made_by(self, module: Module, cls: Cls) -> Sequence[Cls]:
        """The classes of a family of which a module makes objects; none where it may make some that nothing names."""
        family = (cls, *self.program.derived(cls))
        return self.made.of(module, cls) if module.cls in family or all(map(self.makers.are_named, family)) else ()
