"""Members: what the methods of a class give its data members, and fields of other objects."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import (
    Call,
    Expr,
    Member,
    Name,
)
from ecm_parsers.source.facts import Statement
from msgspec.structs import replace

from ecm_extract.link.calls import dotted_name
from ecm_extract.link.env import Env, Instance
from ecm_extract.link.formats import VALUE_READS
from ecm_extract.link.scope import Definition
from ecm_extract.link.spelling import last_name
from ecm_extract.link.units import Cls, Func
from ecm_extract.link.values import (
    MAX_ALTERNATIVES,
    Value,
    demoted,
    lowered,
    node_name,
    set_by,
    unique,
    unknown,
)
from ecm_extract.link.walk import expressions

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder

_NODES = frozenset({"Node", "LifecycleNode"})


class MemberFolder:
    """Folds `object.member`."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[int, str], tuple[Value, ...]] = {}

    def forget(self) -> None:
        """Drop remembered members, since more of the parameters is known now."""
        self._known.clear()

    def member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """`this->x`, `params_.x`, `module.CONSTANT`, `object.field`."""
        if expr.base == Name("this"):
            cls = env.this or env.func.cls
            found = self.member_value(expr.name, cls, env) if cls is not None else ()
            return found or (unknown(expr.name),)
        if expr.name in VALUE_READS:
            return self.folder.fold(expr.base, env.before(env.at))
        dotted = dotted_name(expr)
        found = self.folder.names.imported(dotted, env) if dotted and env.func.file.language == "python" else ()
        return found or self._field(expr, env) or self._option(expr, env) or (unknown(expr.name),)

    def _option(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """`args.name` of argparse: the option's default."""
        if env.func.file.language != "python" or not isinstance(expr.base, Name):
            return ()
        default = self.folder.scope.option(expr.name, env.func.file)
        return lowered(self.folder.fold(default, env.before(env.at)), "default") if default is not None else ()

    def _field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        default = self._library_parameter(expr, env)
        if default is not None:
            return default
        written = self.folder.fields.value(expr, env)
        if written:
            return written
        cls = self.folder.objects.class_of(expr.base, env)
        if cls is None:
            return ()
        return self.member_value(expr.name, cls, Env(env.func, env.at, depth=env.depth + 1, this=cls))

    def _library_parameter(self, expr: Member, env: Env) -> tuple[Value, ...] | None:
        """`params_.a.b` of generate_parameter_library: the default of parameter `a.b`."""
        path: list[str] = []
        node: Expr = expr
        while isinstance(node, Member) and node.base != Name("this"):
            path.insert(0, node.name)
            node = node.base
        root = node.id if isinstance(node, Name) else node.name if isinstance(node, Member) else ""
        if "param" not in root.lower() and not self.folder.scope.declared_type(root, env).endswith("Params"):
            return None
        name = ".".join(path)
        package = env.func.file.package
        if not self.folder.reads.is_declared(name, package):
            return None
        known = self.folder.reads.default(name, package)
        label = f"{package}.{name}"  # a default may be the parameter itself: declare_parameter("a", params_.a)
        values = self.folder.guarded(
            label, Env(env.func), lambda: self.folder.calls.default_value(name, known, None, env)
        )
        return set_by(name, values)

    def member_value(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        """Return the values that the methods of a class and its bases give one of its data members."""
        anyone = env.made is None or env.made.cls is not cls or not (env.made.args or env.made.types)
        known = self._known.get((id(cls), name)) if anyone else None
        if known is not None:
            return known
        cuts = self.folder.cuts
        label = f"{cls.qualified}.{name}"
        values = self.folder.guarded(label, Env(env.func), lambda: self._member_value(name, cls, env))
        if anyone and cuts == self.folder.cuts:
            self._known[id(cls), name] = values
        return values

    def _member_value(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        values: list[Value] = []
        for entry in self.folder.program.ancestry(cls):
            values += self._assigned(name, entry, cls, env)
            for method, at, read, default in self.folder.reads.members(entry, name):
                values += self.folder.calls.parameter_value(
                    read, default, self._method_env(Definition(method, at), cls, env)
                )
        fields = [entry.fields[name].default for entry in self.folder.program.ancestry(cls) if name in entry.fields]
        default = next((found for found in fields if found is not None), None)  # that of a derived class hides others
        if default is not None:
            values += demoted(self.folder.fold(default, Env(env.func, depth=env.depth + 1, this=cls)))
        filled = [value for value in values if value.text]
        return unique(filled or values) if values else ()

    def _assigned(self, name: str, entry: Cls, cls: Cls, env: Env) -> list[Value]:
        """What the methods of one class assign; `x = join(x)` takes the place of what its method assigned before."""
        found: list[tuple[Func, tuple[Value, ...]]] = []
        for definition in self.folder.scope.members(name, entry):
            if len(found) >= MAX_ALTERNATIVES or not self.folder.objects.runs(definition.func, env.made):
                continue
            inner = self._method_env(definition, cls, env)
            named = _is_name_of_node(definition)
            values = (node_name(),) if named else demoted(self.folder.fold(definition.statement.value, inner))
            if values and _rewrites(definition.statement, name):
                found = [(func, before) for func, before in found if func is not definition.func]
            found.append((definition.func, values))
        return [value for _, values in found for value in values][:MAX_ALTERNATIVES]

    def _method_env(self, definition: Definition, cls: Cls, env: Env) -> Env:
        made = env.made if env.made is not None and env.made.cls is cls else None
        return Env(definition.func, definition.at, this=cls, made=made or Instance(cls, {}, {}), depth=env.depth + 1)


def _rewrites(statement: Statement, name: str) -> bool:
    """Tell whether a statement that always runs makes a new value of a member from the one that it has."""
    own = (Name(name), Member(Name("this"), name))
    return statement.depth == 0 and any(expr in own for expr, _ in expressions(replace(statement, target=None)))


def _is_name_of_node(definition: Definition) -> bool:
    """Tell whether a constructor gives a member what it gives its node as a name: `Node(name), name_(name)`."""
    if definition.statement.kind != "init" or definition.statement.value is None:
        return False
    calls = (entry.value for entry in definition.func.fact.body if entry.kind == "init" and _is_node(entry.target))
    return any(isinstance(call, Call) and call.args[:1] == (_only(definition.statement.value),) for call in calls)


def _is_node(target: Expr | None) -> bool:
    return isinstance(target, Name) and last_name(target.id) in _NODES


def _only(value: Expr) -> Expr:
    """What an initialiser `x_(value)` holds."""
    return value.args[0] if isinstance(value, Call) and len(value.args) == 1 else value
