"""Values of ROS parameters: what is declared, what a call has instead, what somebody sets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Opaque

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, File
from ecm_extract.link.folding import formats
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.parameter_reads import ParameterRead
from ecm_extract.link.running.values import Value, alternatives, lowered, set_by, setting_of, unknown
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

PARAMETER_OBJECTS = shipped_names("link/code/library_values.toml", "parameter_objects")


class ParameterFolder:
    """Folds parameters."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def kept_value(self, name: Expr, kept: Sequence[Value], env: Env) -> tuple[Value, ...]:
        """Return what a variable keeps that a parameter is read into which is not set.

        Where that is another parameter, or the default of one, which of both it is depends on who sets them.
        """
        names = self.folder.fold(name, env)
        values = lowered(kept, "default")
        if names[0].confidence == "pattern":
            return values
        if any(value.parameter not in {"", names[0].text} for value in values):
            return alternatives((*values, unknown(names[0].text)))
        return set_by(names[0].text, values)

    def read_value(self, read: ParameterRead, env: Env) -> tuple[Value, ...]:
        """Return what a call gives that reads a parameter: a fallback only where its node does not declare that."""
        declared = read.is_fallback and self.is_declared(self.folder.fold(read.name, env), env)
        return self.parameter_value(read.name, None if declared else read.default, env)

    def is_declared(self, names: Sequence[Value], env: Env) -> bool:
        """Tell whether the class at hand, or the file of a function, declares a parameter of one of several names."""
        owners = self._lineage(env) or (env.func.file,)
        return any(self.folder.reads.default(name.text, "", owners) is not None for name in names)

    def _lineage(self, env: Env) -> Sequence[Cls]:
        owner = (env.this or env.func.cls) if env.func is not None else None
        return self.folder.program.ancestry(owner) if owner is not None else ()

    def owners(self, env: Env) -> tuple[Cls | File, ...]:
        """Return whose declarations count at a place: the class at hand, its bases, the file."""
        return (*self._lineage(env), env.func.file)

    def parameter_value(self, name: Expr, default: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the value of a ROS parameter: its default where the call or a declaration has one."""
        names = self.folder.fold(name, env)
        owners = self.owners(env)
        known = self.folder.reads.default(names[0].text, env.func.file.package, owners)
        stated = None if self.folder.reads.is_given_instead(names[0].text, owners) else default
        values = self.default_value(names[0].text, known, stated, env)
        return values if names[0].confidence == "pattern" else set_by(names[0].text, values)

    def default_value(
        self, name: str, known: tuple[Expr, Env] | Value | None, default: Expr | None, env: Env
    ) -> tuple[Value, ...]:
        """Return the values of a default: of the call, else of the declaration, else a hole."""
        values: tuple[Value, ...] = ()
        if default is not None and not formats.is_unset(default):
            values = lowered(self.folder.fold(default, env.before(env.at)), "default")
        elif isinstance(known, Value):
            values = lowered((known,), "default")
        elif known is not None and not formats.is_unset(known[0]):
            values = lowered(self.folder.fold(known[0], known[1].before(known[1].at)), "default")
        if values and (values[0].text or len(values) > 1):
            return values
        empty = "" if values and values[0].data is None else None
        return (setting_of(name, empty),)


def value_of_parameter(call: Invocation) -> Expr:
    """The value in `rclpy.Parameter("name", Parameter.Type.STRING, "value")`."""
    third = call.args[2] if len(call.args) > 2 else None
    return third or dict(call.keywords).get("value") or Opaque(call.last)
