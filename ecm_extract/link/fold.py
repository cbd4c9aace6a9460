"""Folding: the text an expression has, as far as the tree shows it.

Follows DESIGN §4: constants, concatenation, formats, members set in constructors, parameters with their
defaults, functions that return a value. Every result has a confidence; unknown parts stay as holes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Protocol

from ecm_parsers.source.expr import (
    Call,
    Constant,
    Expr,
    Items,
    Member,
    Name,
    Number,
    Op,
    Table,
    Template,
    Text,
)

from ecm_extract.link import formats
from ecm_extract.link.calls import Invocation, dotted_name
from ecm_extract.link.env import Bound, Env, Instance, bind, invocation_of
from ecm_extract.link.objects import Objects
from ecm_extract.link.program import Cls, Func, Program
from ecm_extract.link.scope import Definition, Scope
from ecm_extract.link.values import (
    MAX_ALTERNATIVES,
    Value,
    joined,
    literal,
    lowered,
    node_name,
    parameter,
    unique,
    unknown,
)

MAX_DEPTH = 24
_SAME = frozenset(
    {
        "std::string",
        "string",
        "str",
        "std::move",
        "String",
        "QString",
        "std::to_string",
        "rclcpp::ParameterValue",
    }
)
_READS = frozenset(
    {
        "as_string",
        "get_value",
        "value",
        "str",
        "c_str",
        "string",
        "string_value",
        "get_parameter_value",
        "strip",
    }
    | {
        "toStdString",
        "data",
        "as_string_array",
        "encode",
        "rstrip",
        "lstrip",
        "lower",
        "get",
        "to_string",
        "string_array_value",
    }
)


_STREAMS = frozenset({"stringstream", "ostringstream"})
_PROPERTY_READS = frozenset({"getStdString", "getTopicStd", "getString"})


class ParameterReads(Protocol):
    """What the linker knows of parameters: which call reads one, and the defaults that were declared."""

    def read(self, call: Invocation) -> tuple[Expr, Expr | None] | None:
        """Return (name, default) when a call gives the value of a parameter."""

    def written(self, func: Func, target: str) -> list[tuple[int, Expr, Expr | None]]:
        """Return (statement, name, default) of the calls of a function that write a parameter to a variable."""

    def forget(self) -> None:
        """Drop what was remembered, since more is known now."""

    def members(self, cls: Cls, target: str) -> list[tuple[Func, int, Expr, Expr | None]]:
        """Return (method, statement, name, default) of the calls of a class that write a parameter to a member."""

    def default(self, name: str, package: str, owners: Sequence[str] = ()) -> tuple[Expr, Env] | str | None:
        """Return the declared default of a parameter."""


class Folder:
    """Evaluates expressions of a program."""

    def __init__(self, program: Program, scope: Scope, reads: ParameterReads) -> None:
        self.program = program
        self.scope = scope
        self.objects = Objects(program, scope)
        self.reads = reads
        self.instances: Callable[[Cls], Sequence[Instance]] = lambda cls: ()
        self._active: set[tuple[int, str, int]] = set()
        self._members: dict[tuple[int, str], tuple[Value, ...]] = {}
        self._cuts = 0

    def fold(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the possible values of an expression, at least one."""
        if expr is None or env.depth > MAX_DEPTH:
            self._cuts += 1
            return (unknown("value"),)
        return self._by_kind(expr, env)

    def _by_kind(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        match expr:
            case Name():
                return self.name(expr, env)
            case Member():
                return self.member(expr, env)
            case Call():
                return self.call(expr, env)
            case Op():
                return self.op(expr, env)
            case Template():
                return joined(self.fold(part, env.before(env.at)) for part in expr.parts)
            case Text() | Number():
                return (literal(str(expr.value)),)
            case Constant():
                return (literal("" if expr.name == "null" else expr.name),)
        return (unknown("value"),)

    # --- names -----------------------------------------------------------------------------------

    def name(self, expr: Name, env: Env) -> tuple[Value, ...]:
        """A variable, a parameter, a member of `this`, or a constant."""
        return self._guarded(expr.id, env, lambda: self._name(expr.id, env))

    def _guarded(self, label: str, env: Env, work: Callable[[], tuple[Value, ...]]) -> tuple[Value, ...]:
        """Break cycles such as `x = f(x)` in a loop or members that are set from each other."""
        key = (id(env.func), label, env.at)
        if key in self._active or len(self._active) > 60:
            self._cuts += 1
            return (unknown(label),)
        self._active.add(key)
        try:
            return work()
        finally:
            self._active.discard(key)

    def _name(self, name: str, env: Env) -> tuple[Value, ...]:
        found = self._local(name, env)
        if found and self.scope.is_certain(name, env):
            return found
        base = self._given(name, env)
        if found or base:
            return unique((*base, *found))
        return self._outside(name, env) or (unknown(name),)

    def _given(self, name: str, env: Env) -> tuple[Value, ...]:
        """What a name is before the function assigns it: its parameter, or a member of the object."""
        if any(entry.name.lstrip("*") == name for entry in env.func.fact.params):
            return self._parameter(name, env)
        cls = env.this or env.func.cls
        if cls is None or env.func.file.language != "cpp":
            return ()
        return self.member_value(name, cls, env)

    def _local(self, name: str, env: Env) -> tuple[Value, ...]:
        values: list[Value] = []
        for definition in self.scope.local(name, env):
            values += self._defined(definition, env.before(definition.at))
        for at, read, default in self.reads.written(env.func, name):
            if at < env.at:
                values += self.parameter_value(read, default, env.before(at))
        return unique(values or self._by_reference(name, env)) if values or not env.args.get(name) else ()

    def _by_reference(self, name: str, env: Env) -> list[Value]:
        """What functions of the tree write to a local that they get by reference."""
        values: list[Value] = []
        for at, expr, index in self.scope.passed(env.func, name):
            callee = self.objects.callee(invocation_of(expr, env.before(at)), env.before(at)) if at < env.at else None
            if callee is None or callee is env.func or index >= len(callee.fact.params):
                continue
            target = callee.fact.params[index]
            if target.type.endswith("&") and "const" not in target.type:
                inner = Env(callee, this=env.this, made=env.made, depth=env.depth + 1)
                values += self._local(target.name, inner)
        return values

    def _defined(self, definition: Definition, env: Env) -> tuple[Value, ...]:
        statement = definition.statement
        if statement.kind == "each":
            return self.elements(statement.value, env)
        return _demoted(self.fold(statement.value, env))

    def _parameter(self, name: str, env: Env) -> tuple[Value, ...]:
        bound = env.args.get(name)
        if bound is not None:
            return _demoted(self.fold(bound.expr, bound.env.before(bound.env.at)))
        made = self._constructor_argument(name, env)
        if made:
            return made
        default = next((entry.default for entry in env.func.fact.params if entry.name == name), None)
        if default is not None and env.args:
            return lowered(self.fold(default, env.before(0)), "default")
        return (parameter(name, env.func.is_constructor, self._fallback(default, env)),)

    def _fallback(self, default: Expr | None, env: Env) -> str | None:
        """The text of a parameter's default, when it is one."""
        value = self.fold(default, Env(env.func, 0, depth=env.depth + 1))[0] if default is not None else None
        known = value is not None and value.confidence != "pattern" and value.text != "null"
        return value.text if value is not None and known else None

    def _constructor_argument(self, name: str, env: Env) -> tuple[Value, ...]:
        func = env.func
        if not func.is_constructor or env.made is None or func.cls is None:
            return ()
        instance = self.objects.part(env.made, func.cls)
        bound = instance.args.get(name) if instance is not None else None
        return _demoted(self.fold(bound.expr, bound.env.before(bound.env.at))) if bound is not None else ()

    # --- members ---------------------------------------------------------------------------------

    def member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """`this->x`, `params_.x`, `module.CONSTANT`, `object.field`."""
        if expr.base == Name("this"):
            cls = env.this or env.func.cls
            found = self.member_value(expr.name, cls, env) if cls is not None else ()
            return found or (unknown(expr.name),)
        if expr.name in _READS:
            return self.fold(expr.base, env.before(env.at))
        dotted = dotted_name(expr)
        found = self._imported(dotted, env) if dotted and env.func.file.language == "python" else ()
        return found or self._field(expr, env) or (unknown(expr.name),)

    def _field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        default = self._library_parameter(expr, env)
        if default is not None:
            return default
        cls = self.objects.class_of(expr.base, env)
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
        if "param" not in root.lower() and not self.scope.declared_type(root, env).endswith("Params"):
            return None
        name = ".".join(path)
        known = self.reads.default(name, env.func.file.package)
        return self._default_value(name, known, None, env) if known is not None else None

    def member_value(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        """Return the values that the methods of a class and its bases give one of its data members."""
        anyone = env.made is None or env.made.cls is not cls or not (env.made.args or env.made.types)
        known = self._members.get((id(cls), name)) if anyone else None
        if known is not None:
            return known
        cuts = self._cuts
        label = f"{cls.qualified}.{name}"
        values = self._guarded(label, Env(env.func), lambda: self._member_value(name, cls, env))
        if anyone and cuts == self._cuts:
            self._members[id(cls), name] = values
        return values

    def forget(self) -> None:
        """Drop remembered members, since more of the parameters is known now."""
        self._members.clear()
        self.reads.forget()

    def _member_value(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        values: list[Value] = []
        for entry in self.program.ancestry(cls):
            for definition in self.scope.members(name, entry):
                if len(values) < MAX_ALTERNATIVES and self.objects.runs(definition.func, env.made):
                    inner = self._method_env(definition, cls, env)
                    values += _demoted(self.fold(definition.statement.value, inner))
            for method, at, read, default in self.reads.members(entry, name):
                values += self.parameter_value(read, default, self._method_env(Definition(method, at), cls, env))
            field = entry.fields.get(name)
            if field is not None and field.default is not None:
                values += _demoted(self.fold(field.default, Env(env.func, depth=env.depth + 1, this=cls)))
        filled = [value for value in values if value.text]
        return unique(filled or values) if values else ()

    def _method_env(self, definition: Definition, cls: Cls, env: Env) -> Env:
        made = env.made if env.made is not None and env.made.cls is cls else None
        return Env(definition.func, definition.at, this=cls, made=made or Instance(cls, {}, {}), depth=env.depth + 1)

    # --- constants and imports ---------------------------------------------------------------------

    def _outside(self, name: str, env: Env) -> tuple[Value, ...]:
        constant = self.scope.constant(name, env)
        if constant is not None:
            expr, _, file = constant
            inner = Env(self._file_env(file, env).func, depth=env.depth + 1)
            return _demoted(self.fold(expr, inner))
        if env.func.file.language == "python":
            return self._imported(name, env)
        return ()

    def _file_env(self, file: object, env: Env) -> Env:
        func = next((f for f in self.program.functions.get("<module>", ()) if f.file is file), None)
        return Env(func) if func is not None else env

    def _imported(self, dotted: str, env: Env) -> tuple[Value, ...]:
        head, *rest = dotted.split(".")
        target = ".".join([env.func.file.imported.get(head, head), *rest])
        owner, _, last = target.rpartition(".")
        owner_last = owner.rsplit(".", 1)[-1]
        for file, constant in self.program.constants.get(last, ()):
            stem = file.path.rsplit("/", 1)[-1].removesuffix(".py")
            if (
                file.language == "python"
                and constant.value is not None
                and owner_last in {stem, constant.scope, ""}
                and owner_last
            ):
                return _demoted(self.fold(constant.value, Env(self._file_env(file, env).func, depth=env.depth + 1)))
        return ()

    # --- calls --------------------------------------------------------------------------------------

    def call(self, expr: Call, env: Env) -> tuple[Value, ...]:
        """String constructions, formats, parameter reads and functions that return a value."""
        call = invocation_of(expr, env)
        if call.path in _SAME or call.last in _STREAMS:
            return self.fold(call.args[0], env.before(env.at)) if call.args else (literal(""),)
        read = self.reads.read(call)
        if read is not None:
            return self.parameter_value(*read, env.before(env.at))
        if call.last == "join" and isinstance(call.receiver, Text) and call.args:
            return self._joined(call.receiver.value, call.args[0], env.before(env.at))
        formatted = formats.formatted(call)
        if formatted is not None:
            return joined(self._folded_parts(formatted, env))
        if call.receiver is not None and call.last in _PROPERTY_READS:
            return self._property(call.receiver, env) or (unknown(call.last),)
        if call.receiver is not None and call.last in _READS:
            return self.fold(call.receiver, env.before(env.at))
        return self._guarded(f"{call.path}()", env, lambda: self._returns(call, env))

    def _property(self, receiver: Expr, env: Env) -> tuple[Value, ...]:
        """An rviz property `new XProperty("Topic", "/default", ...)` is read like a parameter with that default."""
        for definition, inner in self.definitions(receiver, env):
            made = definition.statement.value
            if isinstance(made, Call) and isinstance(made.callee, Name) and made.callee.id.endswith("Property"):
                return lowered(self.fold(made.args[1], inner), "default") if len(made.args) > 1 else ()
        return ()

    def _joined(self, separator: str, expr: Expr, env: Env) -> tuple[Value, ...]:
        groups: list[tuple[Value, ...]] = []
        for bound in self.flat(expr, env):
            if groups:
                groups.append((literal(separator),))
            groups.append(self.fold(bound.expr, bound.env.before(bound.env.at)))
        return joined(groups)

    def flat(self, expr: Expr, env: Env) -> list[Bound]:
        """Return the elements of a sequence with spread and concatenated ones in place."""
        if env.depth > MAX_DEPTH:
            return [Bound(expr, env)]
        if isinstance(expr, Items):
            return [bound for item in expr.items for bound in self.flat(item, env.before(env.at))]
        if isinstance(expr, Op) and expr.op == "+":
            return [bound for operand in expr.operands for bound in self.flat(operand, env.before(env.at))]
        if isinstance(expr, Name) and expr.id in env.args:
            given = env.args[expr.id]
            return self.flat(given.expr, given.env.before(given.env.at))
        return [Bound(expr, env)]

    def _folded_parts(self, parts: Sequence[Expr | str], env: Env) -> list[tuple[Value, ...]]:
        inner = env.before(env.at)
        return [(literal(part),) if isinstance(part, str) else self.fold(part, inner) for part in parts]

    def _returns(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        callee = self.objects.callee(call, env)
        if callee is None:
            return (node_name(),) if _names_node(call) else (unknown(call.last),)
        returned = [
            (at, s.value) for at, s in enumerate(callee.fact.body) if s.kind == "return" and s.value is not None
        ]
        if not returned or len(returned) > 4:
            return (unknown(call.last),)
        this = env.this if call.receiver in {None, Name("this")} and callee.cls is not None else callee.cls
        made = env.made if this is env.this else None
        args = bind(callee, call, env)
        values = [
            self.fold(value, Env(callee, at, args, this=this, made=made, depth=env.depth + 1)) for at, value in returned
        ]
        return unique(_demoted(value for group in values for value in group))

    def parameter_value(self, name: Expr, default: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the value of a ROS parameter: its default where the call or a declaration has one."""
        names = self.fold(name, env)
        owner = (env.this or env.func.cls) if env.func is not None else None
        lineage = self.program.ancestry(owner) if owner is not None else ()
        known = self.reads.default(names[0].text, env.func.file.package, tuple([cls.qualified for cls in lineage]))
        return self._default_value(names[0].text, known, default, env)

    def _default_value(
        self, name: str, known: tuple[Expr, Env] | str | None, default: Expr | None, env: Env
    ) -> tuple[Value, ...]:
        values: tuple[Value, ...] = ()
        if default is not None:
            values = lowered(self.fold(default, env.before(env.at)), "default")
        elif isinstance(known, str):
            values = (Value((known,), "default"),)
        elif known is not None:
            values = lowered(self.fold(known[0], known[1].before(known[1].at)), "default")
        if values and (values[0].text or len(values) > 1):
            return values
        return (unknown(name.rsplit("/", 1)[-1].rsplit(".", 1)[-1].strip("~{}")),)

    # --- operators -----------------------------------------------------------------------------------

    def op(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """Concatenation, conditionals, `%` formats, subscripts."""
        inner = env.before(env.at)
        if expr.op == "+" and len(expr.operands) >= 2:
            return joined(self.fold(operand, inner) for operand in expr.operands)
        if expr.op == "?:":
            values = [value for operand in expr.operands[1:] for value in self.fold(operand, inner)]
            return unique(_demoted(values))
        if expr.op == "%" and isinstance(expr.operands[0], Text):
            return joined(self._folded_parts(formats.percent(expr.operands[0].value, expr.operands[1]), env))
        if expr.op in {"or", "||"}:
            return unique(value for operand in expr.operands for value in self.fold(operand, inner))
        if expr.op == "[]":
            return self.elements(expr.operands[0], inner, expr.operands[1])
        if expr.op == "&":
            return self.fold(expr.operands[0], inner)
        return (unknown("value"),)

    def elements(self, expr: Expr | None, env: Env, index: Expr | None = None) -> tuple[Value, ...]:
        """Return the values that the elements of a list, or one of them, can have."""
        items = self.items(expr, env)
        if items is None:
            return (unknown("item"),)
        if isinstance(index, Number) and isinstance(index.value, int) and -len(items) <= index.value < len(items):
            items = [items[index.value]]
        folded = [value for bound in items for value in self.fold(bound.expr, bound.env.before(bound.env.at))]
        return unique(_demoted(folded)) if folded else (unknown("item"),)

    def items(self, expr: Expr | None, env: Env) -> list[Bound] | None:
        """Return the elements of a list that an expression is, None when the tree does not show them."""
        if env.depth > MAX_DEPTH or expr is None:
            return None
        if isinstance(expr, Items):
            return [Bound(item, env) for item in expr.items]
        if isinstance(expr, Table):
            return [Bound(value, env) for _, value in expr.entries]
        if isinstance(expr, Call) and len(expr.args) == 1 and isinstance(expr.args[0], Items):
            return self.items(expr.args[0], env)
        if isinstance(expr, Call) and isinstance(expr.callee, Name) and "vector" in expr.callee.id:
            return [Bound(item, env) for item in expr.args]
        if isinstance(expr, Name) and expr.id in env.args:
            return self.items(env.args[expr.id].expr, env.args[expr.id].env.before(env.args[expr.id].env.at))
        for definition, inner in self.definitions(expr, env):
            value = definition.statement.value
            found = self.items(value, inner) if definition.statement.kind != "each" else None
            if found is not None:
                return found
        constant = self.scope.constant(expr.id, env) if isinstance(expr, Name) else None
        return self.items(constant[0], env.before(env.at)) if constant is not None else None

    def definitions(self, expr: Expr, env: Env) -> list[tuple[Definition, Env]]:
        """Return the assignments of a variable or of a member of `this`, with where each is evaluated."""
        name = (
            expr.id
            if isinstance(expr, Name)
            else expr.name
            if isinstance(expr, Member) and expr.base == Name("this")
            else ""
        )
        if not name:
            return []
        if isinstance(expr, Name):
            local = self.scope.local(name, env)
            if local:
                return [(definition, env.before(definition.at)) for definition in local]
        cls = env.this or env.func.cls
        found = []
        for entry in self.program.ancestry(cls) if cls is not None else ():
            for definition in self.scope.members(name, entry):
                if not self.objects.runs(definition.func, env.made):
                    continue
                found.append((definition, Env(definition.func, definition.at, this=cls, depth=env.depth + 1)))
        return found


def _names_node(call: Invocation) -> bool:
    """`get_name()` of a node and its ROS 1 counterparts; in-tree functions of that name were tried before."""
    return call.last in {"get_name", "get_fully_qualified_name"} or call.path in {
        "ros::this_node::getName",
        "rospy.get_name",
    }


def _demoted(values: Iterable[Value]) -> tuple[Value, ...]:
    """What went through a name is folded, not literal."""
    return lowered(values, "folded")
