"""Fields of objects of Python that something else than an assignment gives: properties, and who names no field."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_extract.infer.places import ALL_FIELDS
from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_SETS: Final = "__setattr__"
_ANY: Final = (_SETS, "__getattribute__")
"""Methods that make what they like of every field: docs.python.org, Data model."""


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
        return any(f"{name}.setter" in each.fact.decorators for each in setters)

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
