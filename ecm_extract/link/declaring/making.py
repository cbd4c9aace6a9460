"""Which calls make objects of the classes of a tree."""

from __future__ import annotations

from collections.abc import Collection

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, takes_any
from ecm_extract.link.index.program import Program


class Making:
    """Tells of calls whether they make objects.

    Args:
        program: all that the tree declares.
        aliases: other names that stand for its classes.
    """

    def __init__(self, program: Program, aliases: Collection[str]) -> None:
        self.program = program
        self._aliases = aliases

    def makes(self, call: Invocation, cls: Cls) -> bool:
        """Tell whether a call makes an object of a class."""
        if call.receiver is not None or (call.last != cls.fact.name and call.last not in self._aliases):
            return False
        if not call.args and not call.keywords and not _default_constructible(cls):
            return False
        path = call.path.replace(".", "::") if call.func.file.language == "cpp" else call.path
        return self.program.class_named(path, call.func.file, call.func.scope) is cls

    def is_sure(self, cls: Cls) -> bool:
        """Tell whether each call of a class makes an object: a metaclass of Python may give one of before."""
        lineage = self.program.ancestry(cls)
        return not any("remade" in each.fact.traits and not each.fact.decorators for each in lineage)

    def is_base_of(self, call: Invocation, cls: Cls) -> bool:
        """Tell whether a call makes the base of a derived object, which is no object of its own."""
        maker = call.func.cls
        return call.statement.kind == "init" and maker is not None and cls in self.program.ancestry(maker)

    def made(self, call: Invocation, cls: Cls) -> Cls | None:
        """Return the class of which a call makes an object with the methods of a class: itself, or a derived one."""
        return next((each for each in (cls, *self.program.derived(cls)) if self.makes(call, each)), None)


def _default_constructible(cls: Cls) -> bool:
    """Tell whether a class can be made without arguments: no constructor at all, or one that needs none."""
    makers = [func for func in cls.methods if func.is_constructor]
    needed = ([entry for entry in maker.fact.params if entry.default is None] for maker in makers)
    return not makers or any(all(takes_any([entry]) for entry in params) for params in needed)
