"""Fields of data classes as Python lists them: `fields(Config)`, `asdict(config)`.

Source: docs.python.org, "dataclasses". An element of `fields` has the name and the default of a field, whatever objects
hold; `asdict` gives what an object holds.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Opaque, Text
from ecm_parsers.source.python_dataclasses import DeclaredField, declared_fields

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, demoted, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_FIELD: Final = Name("*field")
"""Stands for what makes an element of `fields`; no class has such a name."""


class DataClasses:
    """Takes data classes apart."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def fields(self, call: Invocation, env: Env) -> list[Bound] | None:
        """Return the elements of `fields(Config)`, or of an object of it; None where they are not all known."""
        cls = self._class(call.args[0], env) if len(call.args) == 1 and not call.keywords else None
        declared = self._declared(cls) if cls is not None else None
        if cls is None or declared is None:
            return None
        place = self.folder.names.at_file(cls.file, env)
        return [Bound(Call(_FIELD, (Text(each.name), each.default or Opaque("default"))), place) for each in declared]

    def entries(self, call: Invocation, env: Env) -> list[tuple[str, Bound]] | None:
        """Return the entries of `asdict(config)`: what the object holds there."""
        given = call.args[0] if len(call.args) == 1 and not call.keywords else None
        cls = self.folder.objects.class_of(given, env) if isinstance(given, Name | Member) else None
        declared = self._declared(cls) if cls is not None else None
        if given is None or declared is None:
            return None
        return [(each.name, Bound(Member(given, each.name), env)) for each in declared]

    def of_field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return the name or the default of an element of `fields`; empty of anything else."""
        at = {"name": 0, "default": 1}.get(expr.name)
        if at is None or not isinstance(expr.base, Name) or env.func.file.language != "python":
            return ()
        helds = {held for way in self.folder.flow.ways(expr.base, env) for held in way}
        made = [held.expr for held in helds if held.how == "value" and isinstance(held.expr, Call)]
        place = next(iter(helds)).env if len(helds) == 1 else None
        if len(made) != 1 or place is None or made[0].callee != _FIELD:
            return ()
        given = made[0].args[at]
        if given == Opaque("default"):
            return (unknown("default"),)
        return demoted(self.folder.fold(given, place.deeper(max(env.depth, place.depth) + 1)))

    def _class(self, expr: Expr, env: Env) -> Cls | None:
        """The class that an expression names, or of which it is an object."""
        dotted = dotted_name(expr)
        named = self.folder.program.class_named(dotted, env.func.file, env.scope) if dotted else None
        return named or self.folder.objects.class_of(expr, env)

    def _declared(self, cls: Cls) -> Sequence[DeclaredField] | None:
        """The fields of a class that alone tells them: one with others around it may have more."""
        program = self.folder.program
        if len(program.ancestry(cls)) > 1 or program.derived(cls):
            return None
        return declared_fields(cls.fact, cls.file.facts.imports)
