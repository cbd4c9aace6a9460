"""Which method an object of C++ runs by a name: that of the nearest class of its own that has one.

Source: [class.virtual] and [class.cdtor] of the C++ standard. A call that names the class of a method, and one of a
constructor, mean the method that stands there, whatever derived classes have.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.running.early_binding import is_virtual
from ecm_extract.link.running.env import Env, Instance
from ecm_extract.link.running.pointed_classes import PointedClasses

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Dispatching:
    """Tells which methods the objects of classes run."""

    def __init__(self, folder: Folder, loaded: Collection[Cls] = ()) -> None:
        self.folder = folder
        self.program = folder.program
        self.loaded = loaded
        self._pointed = PointedClasses(folder)

    def may_mean(self, call: Invocation, method: Func, static: Cls) -> bool:
        """Tell whether a call on an object of which only the type is known may run a method.

        What hosts of plugins call on those is not among it: they name an object by what a configuration says.
        """
        cls, ancestry = method.cls, self.program.ancestry
        related = cls is not None and (cls in ancestry(static) or static in ancestry(cls))
        objects = self._objects(call, method, static) if related else ()
        asked = (each for each in objects if each is static or is_own(call) or not self._is_loaded(each))
        return any(self.runs(method, each) for each in asked)

    def _is_loaded(self, cls: Cls) -> bool:
        return any(each in self.loaded for each in (cls, *self.program.derived(cls)))

    def _objects(self, call: Invocation, method: Func, static: Cls) -> Sequence[Cls]:
        """The classes of which the object of a call may be."""
        is_open = is_virtual(method, self.program) and not is_early(call)
        return (static, *self.program.derived(static)) if is_open else (static,)

    def runs(self, method: Func, cls: Cls) -> bool:
        """Tell whether an object of a class, and of no derived one, has a method where its name is called."""
        found = self._nearest(method, cls)
        return found is not None and found.cls is method.cls

    def _nearest(self, method: Func, cls: Cls) -> Func | None:
        lineage = (entry for entry in self.program.ancestry(cls) if method.cls in self.program.ancestry(entry))
        alike = (each for entry in lineage for each in entry.methods if _is_alike(each, method))
        return next(alike, None)

    def through(self, site: Site, call: Invocation, env: Env) -> bool | None:
        """Tell whether each object that a call may mean comes to a site by it; None where no object does."""
        methods = [each for each in self.on_object(site) if is_virtual(each, self.program)]
        methods = [each for each in methods if not (each is site.root and is_named(call))]
        if not methods or is_own(call):
            return True
        static = self.folder.objects.class_of(call.receiver, env) if call.receiver is not None else None
        if static is None:
            return True
        exact = self._exact(call, static, env)
        objects = (exact,) if exact is not None else self._objects(call, methods[0], static)
        made = [each for each in objects if not self._is_abstract(each, methods)]
        found = [each for each in made if all(self.runs(method, each) for method in methods)]
        return len(found) == len(made) if found else None

    def is_seen_elsewhere(self, site: Site) -> bool:
        """Tell whether the objects that a site needs are seen to be made by now, and to have other methods."""
        steps = list(site.steps())
        return any(self._runs_others(call, env, to.func) for (call, env), (to, _) in pairwise(steps))

    def _runs_others(self, call: Invocation, env: Env, method: Func) -> bool:
        if call.receiver is None or is_own(call) or is_named(call) or not is_virtual(method, self.program):
            return False
        classes = self._pointed.of(call.receiver, env)
        return bool(classes) and not any(self.runs(method, cls) for cls in classes)

    def at_hand(self, method: Func, call: Invocation, env: Env) -> Env:
        """Return the place of a call that means a method: in a base of its class the object at hand is of that."""
        cls = method.holder
        if cls is None or env.this is None or not is_own(call) or env.this not in self.program.ancestry(cls)[1:]:
            return env
        return replace(env, this=cls, made=Instance(cls, {}, {}))

    def _exact(self, call: Invocation, static: Cls, env: Env) -> Cls | None:
        """The class of the object of a call, where no object of a derived one can be meant."""
        receiver, folder = call.receiver, self.folder
        if receiver is None or folder.objects.is_value(folder.objects.type_of(receiver, env), env):
            return static
        return folder.redefined.of_pointed(receiver, env)

    def _is_abstract(self, cls: Cls, methods: Collection[Func]) -> bool:
        found = (self._nearest(method, cls) for method in methods)
        return any(each is not None and "pure" in each.fact.traits for each in found)

    def on_object(self, site: Site) -> Iterator[Func]:
        """Yield the methods that the object of the outermost function runs by their names, on the way to a site."""
        line = [call.func for call in (*site.chain, site.call)]
        if line[0].cls is not None and line[0].file.language == "cpp":
            yield line[0]
        for call, func in zip(site.chain, line[1:], strict=True):
            if not is_own(call) or (func.cls is not None and call.last != func.fact.name):
                return  # on another object, or the object is made here
            if func.cls is not None and not is_early(call) and not func.is_constructor:
                yield func


def is_own(call: Invocation) -> bool:
    """Tell whether a call is one of the object at hand, as far as it says."""
    return call.receiver is None or call.receiver == THIS


def is_named(call: Invocation) -> bool:
    """Tell whether a call names the class whose method it means."""
    return "::" in call.path


def is_early(call: Invocation) -> bool:
    """Tell whether a call means the method that stands there, whatever the object has."""
    return is_named(call) or (is_own(call) and call.func.is_constructor and not call.statement.deferred)


def _is_alike(one: Func, other: Func) -> bool:
    return one.fact.name == other.fact.name and len(one.fact.params) == len(other.fact.params)
