"""Values of ROS parameters: what is declared, what a call has instead, what somebody sets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Opaque

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, File
from ecm_extract.link.folding import formats
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.parameter_reads import ParameterRead
from ecm_extract.link.running.values import (
    Value,
    alternatives,
    constant,
    is_proved,
    lowered,
    set_by,
    setting_of,
    unknown,
)
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
        if read.tells and env.func.file.ros == 2:
            return self._is_there(read, env)
        declared = read.is_fallback and self.is_declared(self.folder.fold(read.name, env), env)
        return self.parameter_value(read.name, None if declared else read.default, env)

    def _is_there(self, read: ParameterRead, env: Env) -> tuple[Value, ...]:
        """Whether a parameter of ROS 2 has a value: one that is declared with a default has, whoever sets it."""
        named = self.folder.fold(read.name, env)[0]
        known = self.folder.reads.default(named.text, env.func.file.package, self.owners(env))
        if not read.plainly or known is None or (not isinstance(known, Value) and formats.is_unset(known[0])):
            return (setting_of(named.text, None),)
        surely = is_proved(named) and not isinstance(known, Value) and _is_before(known[1], env, read.node)
        return lowered((constant(True),), "folded" if surely else "default")

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


def _is_before(one: Env, other: Env, node: Expr | None) -> bool:
    """Whether a call on a node has surely run where another is run: earlier in its function, and in no block."""
    if one.func is not other.func or not 0 <= one.at < min(other.at, len(one.func.calls)):
        return False
    body = one.func.fact.flow or tuple(range(len(one.func.fact.body)))
    return one.at in body and any(_called_on(call) == _same_object(node) for call in one.func.calls[one.at])


def _called_on(call: Call) -> Expr | None:
    return _same_object(call.callee.base) if isinstance(call.callee, Member) else None


def _same_object(expr: Expr | None) -> Expr | None:
    return None if expr == THIS else expr


def value_of_parameter(call: Invocation) -> Expr:
    """The value in `rclpy.Parameter("name", Parameter.Type.STRING, "value")`."""
    third = call.args[2] if len(call.args) > 2 else None
    return third or dict(call.keywords).get("value") or Opaque(call.last)
