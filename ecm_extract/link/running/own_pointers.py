"""Members that are pointers or references to other members of the same object: `Params & now_ = params_;`."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Op

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.units import Cls

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class OwnPointers:
    """Tells what members of C++ point into their own object; each is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[str, Cls], Set[str]] = {}

    def of(self, name: str, cls: Cls) -> Set[str]:
        """Return the members that a member of a class points, or refers, to: by its default, or by any method."""
        known = self._known.get((name, cls))
        if known is None:
            known = self._known[name, cls] = frozenset(self._found(name, cls))
        return known

    def _found(self, name: str, cls: Cls) -> Iterator[str]:
        field = next((each.fields[name] for each in self.folder.program.ancestry(cls) if name in each.fields), None)
        if field is None or not field.type.endswith(("*", "&")):
            return
        given: list[Expr | None] = [field.default]
        for method in cls.methods:
            given += [each.value for each in method.fact.body if each.kind != "let" and own_name(each.target) == name]
        for value in given:
            meant = value.operands[0] if isinstance(value, Op) and is_address(value) else value
            if own_name(meant) in cls.fields:
                yield own_name(meant)
