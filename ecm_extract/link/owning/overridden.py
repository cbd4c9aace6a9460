"""Methods of Python that no object of a module runs: of each class that it makes another one has their names."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import THIS

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.own import is_super
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.made_classes import MadeClasses
from ecm_extract.link.owning.modules import Module
from ecm_extract.link.running.class_lines import ahead


class Overridden:
    """Tells whether a site stands in one."""

    def __init__(self, sites: Sites, made: MadeClasses) -> None:
        self.sites = sites
        self.program = sites.program
        self.made = made

    def hides(self, site: Site, module: Module) -> bool:
        """Tell whether no object that a module makes runs the methods by which a site is reached."""
        cls = self.sites.folder.nesting.object_of(site.root)
        if cls is None or cls.file.language != "python" or (module.main is None and module.cls is None):
            return False
        methods = [each for each in self._by_name(site) if self._may_be_hidden(each)]
        made = self.made.of(module, cls) if methods else ()
        return bool(made) and not any(all(self._runs(method, each) for method in methods) for each in made)

    def _by_name(self, site: Site) -> Iterator[Func]:
        """The methods that the object at hand runs by their names, from the outermost one inwards."""
        yield site.root
        line = [*site.chain[1:], site.call]
        for call, following in zip(site.chain, line, strict=False):
            if call.receiver != THIS:
                return
            yield following.func

    def _may_be_hidden(self, method: Func) -> bool:
        """Whether objects may have another method of a name, and nobody calls this one for its class."""
        if method.cls is None or method.is_constructor:
            return False
        name = method.fact.name
        others = (each.fact.name for cls in ahead(method.cls, self.program) for each in cls.methods)
        return name in others and not any(self._names_class(call) for call in self.sites.callers(method))

    def _names_class(self, call: Invocation) -> bool:
        """Whether a call means the method of a class, whatever an object has: `super().name()`, `Base.name(it)`."""
        written = dotted_name(call.receiver).replace(".", "::") if call.receiver is not None else ""
        named = self.program.class_named(written, call.func.file, call.func.scope) if written else None
        return is_super(call.receiver) or named is not None

    def _runs(self, method: Func, cls: Cls) -> bool:
        """Whether an object of just this class has a method by its name."""
        named = (each for entry in self.program.ancestry(cls) for each in entry.methods)
        nearest = next((each for each in named if each.fact.name == method.fact.name), None)
        return nearest is None or nearest.cls is method.cls
