"""Fields of objects of Python that something else than an assignment gives: properties, and who names no field."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call

from ecm_extract.infer.places import ALL_FIELDS
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import dotted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_SETS: Final = "__setattr__"
_ANY: Final = (_SETS, "__getattribute__", "__init_subclass__")
"""Methods that make what they like of every field, or of every class that derives: docs.python.org, Data model."""

_ASKED: Final = frozenset({"__get__", "__set__"})
"""Methods of objects that are asked in the place of an attribute: docs.python.org, Descriptor Guide."""


class PythonFields:
    """Tells of which fields that is so; each class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._any: dict[Cls, bool] = {}

    def has_setter(self, name: str, method: Func | None) -> bool:
        """Tell whether objects have a property that a method sets: that of a method, None for any object."""
        lineage = self.folder.program.ancestry(method.cls) if method is not None and method.cls is not None else None
        if any(each.fact.name == _SETS for entry in lineage or () for each in entry.methods):
            return True
        setters = (
            each for each in self.folder.program.functions.get(name, ()) if lineage is None or each.cls in lineage
        )
        if any(f"{name}.setter" in each.fact.decorators for each in setters):
            return True
        return any(lineage is None or each in lineage for each in self._described.get(name, ()))

    @cached_property
    def _described(self) -> Mapping[str, Sequence[Cls]]:
        """Attribute -> the classes in which an object of another class of the tree says what it is: a descriptor."""
        found: dict[str, list[Cls]] = defaultdict(list)
        classes = (cls for group in self.folder.program.classes.values() for cls in group)
        for cls in (cls for cls in classes if cls.file.language == "python"):
            for name, value in self.folder.begun_objects.attributes.of(cls).items():
                if isinstance(value, Call) and self._describes(value, cls):
                    found[name].append(cls)
        return found

    def _describes(self, made: Call, cls: Cls) -> bool:
        """Whether an object is one that is asked in the place of an attribute."""
        program = self.folder.program
        kind = program.class_named(dotted(made.callee) or "", cls.file, cls.qualified)
        lineage = program.ancestry(kind) if kind is not None else ()
        return any(method.fact.name in _ASKED for entry in lineage for method in entry.methods)

    def any_is_given(self, cls: Cls) -> bool:
        """Tell whether a method of a class may give any field of its object anything: `setattr(self, name, value)`."""
        known = self._any.get(cls)
        if known is None:
            lineage = self.folder.program.ancestry(cls) if cls.file.language == "python" else ()
            own = any(method.fact.name in _ANY for entry in lineage for method in entry.methods)
            known = self._any[cls] = own or any(self._gives_any(entry) for entry in lineage)
        return known

    def _gives_any(self, cls: Cls) -> bool:
        methods = self.folder.scope.changing(ALL_FIELDS, cls)
        return any(f".{ALL_FIELDS}" in self.folder.flow.outline(method).changes for method in methods)
