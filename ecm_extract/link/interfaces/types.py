"""Message, service and action types: from what the source writes to `package/kind/Name`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from ecm_checker.hub.roles import Role, roles
from ecm_checker.match.generated import snake
from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name, Op, Specialized, Text

from ecm_extract.link.code.calls import Invocation, placed_arguments, unseen_argument
from ecm_extract.link.code.spelling import plain, pointee, template_arguments
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.meant_names import spelled
from ecm_extract.link.interfaces.adapters import Adapters
from ecm_extract.link.interfaces.callbacks import callback_meant
from ecm_extract.link.interfaces.message_fields import MessageFields
from ecm_extract.link.interfaces.python_types import PythonTypes
from ecm_extract.link.interfaces.sent_as import sent_as
from ecm_extract.link.interfaces.type_found import ACTION, UNKNOWN_TYPE, TypeFound
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env

_KINDS = ("msg", "srv", "action")
_POINTER = re.compile(r"(?:::)?(?:Const)?(?:Shared|Unique)?(?:Const)?Ptr$")
_EVENT = re.compile(r"^(?:const\s+)?(?:ros::)?(?:Message|Service)Event\s*<(.*)>\s*&?$")
_REQUEST = re.compile(r"\b(\w+)Request\b(?!\s*::)")
"""ROS 1 generates `pkg::FooRequest` for the request of `pkg/Foo`, which is `FooRequest` in that namespace."""
_ACTION_PART = re.compile(r"Action$")


_FUNCTION = re.compile(r"\bfunction\s*<\s*void\s*\(([^()]+)\)\s*>")
"""The parameters of a callback that a variable holds: `std::function<void(const M &)>`."""


class Types:
    """Resolves types at call sites."""

    def __init__(self, folder: Folder, fields: MessageFields) -> None:
        self.folder = folder
        self.fields = fields
        self.program = folder.program
        self.python = PythonTypes(self)
        self.adapters = Adapters(self.program)

    def at(self, positions: str, call: Invocation, env: Env, role: Role) -> TypeFound:
        """Return the type that the first fitting position of a form's row gives."""
        if "/" in positions:
            return TypeFound(positions)
        for position in positions.split("|") if positions else ():
            kind, _, index = position.partition(":")
            found = self._position(kind, index, call, env, role)
            if found.name is not None or found.open:
                return found
        return self._unseen(positions, call, env)

    def _unseen(self, positions: str, call: Invocation, env: Env) -> TypeFound:
        """What callers know of a type that a call of Python may spread."""
        unseen = unseen_argument(call, "arg:" not in positions) if positions else None
        value = self.folder.fold(unseen, env)[0] if unseen is not None else None
        return TypeFound(None, value.open("param") | value.open("made")) if value is not None else UNKNOWN_TYPE

    def _position(self, kind: str, index: str, call: Invocation, env: Env, role: Role) -> TypeFound:
        if kind == "template":
            return self.written(call.types[int(index)], env, role) if int(index) < len(call.types) else UNKNOWN_TYPE
        if kind == "receiver":
            types = self._arguments(self.folder.objects.type_of(call.receiver, env), env) if call.receiver else ()
            return self.written(types[int(index)], env, role) if int(index) < len(types) else UNKNOWN_TYPE
        arg = dict(call.keywords).get(index) if kind == "kw" else _argument(call, int(index))
        if arg is None:
            return UNKNOWN_TYPE
        if kind in {"callback", "service_callback"}:
            return self._callback(arg, env, role, kind == "service_callback")
        if kind in {"variable", "request"}:
            held = self.folder.objects.type_of(arg, env)
            return self.written(_REQUEST.sub(r"\1", held) if kind == "request" else held, env, role)
        return self.expression(arg, env, role)

    def _arguments(self, text: str, env: Env) -> Sequence[str]:
        """The template arguments of a type, or of what it is another name for."""
        held = pointee(text)
        for _ in range(MAX_DEPTH):
            alias = self.program.alias(_bare(held), env.func.file, self._scope(env)) if "<" not in held else None
            if alias is None:
                break
            held = pointee(alias)
        return template_arguments(held)

    def expression(self, expr: Expr, env: Env, role: Role) -> TypeFound:
        """Return the type that an expression names: a Python class, or text `pkg/Name`."""
        if isinstance(expr, Text):
            return TypeFound(self.full(expr.value.replace("/", "::"), role))
        if env.func.file.language == "python" and isinstance(expr, Name | Member):
            return self.python.of(expr, env, role)
        if (chosen := self.python.of_choice(expr, env, role)) is not None:
            return chosen
        wrapped = self.python.wrapped(expr, env)
        if wrapped is not None:
            return self.expression(wrapped, env, role)
        given = self.python.returned(expr, env, role)
        if given.name is not None:
            return given
        bound = env.args.get(expr.id) if isinstance(expr, Name) else None
        if isinstance(expr, Op) and expr.op == "[]":
            bound = self.folder.tables.element(expr, env)
        if bound is not None and bound.env.depth <= MAX_DEPTH:
            return self.expression(bound.expr, bound.env, role)
        if isinstance(expr, Call | Member | Name | Op):
            values = self.folder.fold(expr, env)
            text = values[0].text
            if "/" in text and "{" not in text:
                return TypeFound(self.full(text.replace("/", "::"), role))
            return TypeFound(None, values[0].open("param") | values[0].open("made"))
        return UNKNOWN_TYPE

    def written(self, text: str, env: Env, role: Role, depth: int = 0) -> TypeFound:
        """Return the type that C++ source text means: aliases, template parameters and pointers resolved."""
        if depth > 6 or not text:
            return UNKNOWN_TYPE
        event = _EVENT.match(text.strip())
        if event:
            return self.written(template_arguments(text)[0], env, role, depth + 1)
        bare = _bare(text)
        bound = env.types.get(bare) or self.folder.objects.class_types(env).get(bare)
        if bound is not None and bound != bare:
            return self.written(bound, env, role, depth + 1)
        template = self._template_names(env)
        if bare in template:
            return TypeFound(None, frozenset({bare}))
        alias = (
            self.program.alias(bare, env.func.file, self._scope(env)) if "::" not in bare or _not_ros(bare) else None
        )
        if alias is not None and _bare(alias) != bare:
            return self.written(alias, env, role, depth + 1)
        sent = self._sent(bare, text, env) or self._adapted(bare, env)
        if sent:
            return TypeFound(sent) if "/" in sent else self.written(sent, env, role, depth + 1)
        return self._qualified(text, env, role, depth)

    def _sent(self, bare: str, text: str, env: Env) -> str:
        """The message that a type of a library is sent as, which `using namespace` may bring without its prefix."""
        brought = self._usings(env) if "::" not in bare else ()
        names = (bare, *(f"{namespace}::{bare}" for namespace in brought))
        return next(filter(None, (sent_as(name, text, env.func.file.ros) for name in names)), "")

    def _usings(self, env: Env) -> Iterator[str]:
        files = (env.func.file, *self.program.included(env.func.file))
        usings = (using for file in files for using in file.facts.usings)
        return (using.namespace for using in usings if using.holds_in(self._scope(env)))

    def _adapted(self, bare: str, env: Env) -> str:
        """The message of a type of the tree that ROS 2 is told how to send."""
        return self.adapters.message(bare, env.func.file, self._scope(env)) if env.func.file.ros != 1 else ""

    def _qualified(self, text: str, env: Env, role: Role, depth: int) -> TypeFound:
        """A type that is no alias as a whole, and whose first part may be one."""
        bare, template = _bare(text), self._template_names(env)
        head, _, tail = bare.partition("::")
        given = (env.types.get(head) or self.folder.objects.class_types(env).get(head)) if tail else None
        if given is not None and plain(given) != head:
            return self.written(f"{plain(given)}::{tail}", env, role, depth + 1)
        if head in template:
            return TypeFound(None, frozenset({head}))
        outer = (self.program.alias(head, env.func.file, self._scope(env)) or self._macro(head, env)) if tail else None
        if outer is not None and plain(outer) != head:
            return self.written(f"{_bare(outer)}::{tail}", env, role, depth + 1)
        if head in _KINDS and env.func.file.ros != 1:
            return self._in_namespace(bare, env, role)
        if bare.count("::") == 1 and not bare.endswith("_") and _is_template(text) and env.func.file.ros != 1:
            return UNKNOWN_TYPE  # `pcl::PointCloud<P>` is sent as a message, but is none
        owners = self.program.seen_classes(head, env.func.file) if tail and "::" not in tail else ()
        if owners:
            return self._of_classes(owners, tail, env, role, depth)
        full = self.full(bare, role) if "::" in bare else self._unqualified(bare, env, role)
        return TypeFound(full or self._in_lower_case(bare, env, role))

    def _of_classes(self, owners: Sequence[Cls], name: str, env: Env, role: Role, depth: int) -> TypeFound:
        """`Client::Output`: what a class of the tree calls a message; a class is no package, whatever it is called."""
        found = {self.program.alias(f"{cls.qualified}::{name}", cls.file) for cls in owners} - {None}
        target = found.pop() if len(found) == 1 else None
        return self.written(target, env, role, depth + 1) if target is not None else UNKNOWN_TYPE

    def _in_namespace(self, bare: str, env: Env, role: Role) -> TypeFound:
        """`msg::Name`: a namespace around it is the package; what is no name of a package is none in ROS 2."""
        whole = self.program.message_named(bare, env.func.file, self._scope(env)) or self._outermost(bare, env)
        return TypeFound(self.full(whole, role)) if whole is not None else UNKNOWN_TYPE

    def _outermost(self, bare: str, env: Env) -> str | None:
        """Generated types stand in the outermost namespace; a header that is not seen may bring them."""
        scope = env.func.cls.fact.scope if env.func.cls is not None else env.func.fact.scope
        outer = scope.removeprefix("::").partition("::")[0]
        return f"{outer}::{bare}" if outer and self.program.class_named(outer, env.func.file) is None else None

    def _macro(self, name: str, env: Env) -> str | None:
        """What `#define name other::name` stands for, as trees for two distributions rename packages."""
        if name not in self.program.constants:
            return None
        found = self.program.constant_named(name, env.func.file)
        if found is None or "define" not in found.constant.traits or not isinstance(found.constant.value, Name):
            return None
        return found.constant.value.id

    def _in_lower_case(self, bare: str, env: Env, role: Role) -> str | None:
        """`my_pkg::cloud_info`: a message named against the convention, told by the header that generation makes."""
        package, _, name = bare.partition("::")
        kind = roles()[role].shape
        if not name[:1].islower() or "::" in name or not kind:
            return None
        header = f"{package}/{name}.h"
        near = {env.func.file, *_callers(env)}
        files = (*near, *(file for each in near for file in self.program.included(each)))
        included = any(entry.module == header for file in files for entry in file.facts.imports)
        return f"{package}/{kind}/{_action(name, kind)}" if included else None

    def _unqualified(self, name: str, env: Env, role: Role) -> str | None:
        """A bare message name: its header says the package, else a `using namespace` of messages."""
        for file in (env.func.file, *self.program.included(env.func.file)):
            for entry in file.facts.imports:
                parts = entry.module.split("/")
                stem = parts[-1].rsplit(".", 1)[0]
                if len(parts) in {2, 3} and (stem == name or (len(parts) == 3 and stem == snake(name))):
                    return self.full("::".join([*parts[:-1], name]), role)
        for using in self._usings(env):
            if using.rsplit("::", 1)[-1] in _KINDS or using.endswith("_msgs"):
                return self.full(f"{using}::{name}", role)
        return None

    def _scope(self, env: Env) -> str:
        cls = env.func.cls
        return f"{cls.qualified}::{env.func.fact.name}" if cls is not None else env.scope

    def _template_names(self, env: Env) -> set[str]:
        names = set(env.func.fact.template)
        if env.func.cls is not None:
            names.update(env.func.cls.fact.template)
        return names - {""}

    def full(self, text: str, role: Role) -> str | None:
        """`sensor_msgs::msg::Imu`, `sensor_msgs::Imu_<A>`, `sensor_msgs::msg::dds_::Imu_` -> `sensor_msgs/msg/Imu`."""
        parts = [part for part in _whole(text).split("::") if part and part != "_" + part]
        if len(parts) >= 3 and parts[-2].startswith("_"):
            parts.pop(-2)
        for kind in _KINDS:
            if kind in parts[1:-1]:
                at = parts.index(kind, 1)
                name = parts[-1].rstrip("_") if len(parts) > at + 1 else ""
                if kind == "msg" and roles()[role].shape == ACTION:
                    kind, name = ACTION, _action(name, ACTION)  # ROS 1 generates actions as messages
                return f"{parts[at - 1]}/{kind}/{name}" if name[:1].isalpha() else None
        wanted = roles()[role].shape
        if not wanted or len(parts) != 2 or not parts[1][:1].isupper():
            return None
        return f"{parts[0]}/{wanted}/{_action(parts[1].rstrip('_'), wanted)}"

    def _callback(self, expr: Expr, env: Env, role: Role, service: bool) -> TypeFound:
        if isinstance(expr, Lambda):
            return self.written(expr.param_types[0], env, role) if expr.param_types else UNKNOWN_TYPE
        meant = callback_meant(expr)
        if meant is None:
            return UNKNOWN_TYPE
        if isinstance(meant, Lambda):
            return self._callback(meant, env, role, service)
        name, given = meant.id, self._given(meant, env)
        overloads = sorted(self._named(name, env), key=lambda func: _serves(func) is not service)
        for func in overloads:
            params = [p for p in func.fact.params if p.type]
            if params and (not given or func.takes(given)):
                types = {**env.types, **dict(zip(func.own_template, given, strict=False))}
                inner = Env(func, types=types, this=env.this, made=env.made)
                first = params[0].type.removesuffix("...")  # of a pack it is the first
                return self.written(_REQUEST.sub(r"\1", first) if service else first, inner, role)
        made = {self._callback(each.expr, each.env, role, service) for each in self._held(name, env)}
        if made:
            return made.pop() if len(made) == 1 else UNKNOWN_TYPE
        held = _FUNCTION.search(self.folder.objects.type_of(expr, env)) if isinstance(expr, Name | Member) else None
        return self.written(template_arguments(f"<{held[1]}>")[0], env, role) if held else UNKNOWN_TYPE

    def _given(self, meant: Name, env: Env) -> tuple[str, ...]:
        """The template arguments of a callback, as they are called at a place."""
        written = meant.types if isinstance(meant, Specialized) else ()
        outer = {**self.folder.objects.class_types(env), **env.types}
        return tuple(
            [outer.get(each) or self.program.alias(each, env.func.file, env.scope) or each for each in written]
        )

    def _held(self, name: str, env: Env) -> Sequence[Bound]:
        """What a variable may hold that is called like a callback, where all of it is known."""
        return self.folder.origins.makers(Name(name), env) or () if env.depth <= MAX_DEPTH else ()

    def _named(self, name: str, env: Env) -> list[Func]:
        name = spelled(name, env, self.folder.objects) or name
        last = name.rsplit("::", 1)[-1]
        candidates = self.program.functions.get(last, [])
        own = env.this or env.func.cls
        owner = self.program.class_named(name.rsplit("::", 1)[0], env.func.file, env.scope) if "::" in name else own
        lineage = self.program.ancestry(owner) if owner is not None else ()
        methods = [func for func in candidates if func.cls in lineage]
        near = [func for func in candidates if func.file is env.func.file]
        return [*methods, *near, *self.program.functions_named(name, env.func.file, env.scope)]


def _callers(env: Env) -> Iterable[File]:
    """Files in which arguments stand: what a template is given is written there."""
    made = env.made.args.values() if env.made is not None else ()
    return (bound.env.func.file for bound in (*env.args.values(), *made))


def _is_template(text: str) -> bool:
    return "<" in pointee(text)


def _serves(func: Func) -> bool:
    """Tell whether a function takes the request of a service and not a message."""
    first = next((parameter.type for parameter in func.fact.params if parameter.type), "")
    return "::Request" in first


def _bare(text: str) -> str:
    """The type's name without pointers, references and template arguments of pointers."""
    words = text.replace("&", " ").replace("*", " ").split()
    written = " ".join(word for word in words if word not in {"const", "typename", "template"})
    stripped = _whole(written.replace(" ::", "::").replace(":: ", "::"))
    inner = pointee(stripped)
    inner = " ".join(word for word in inner.split() if word not in {"const", "typename"})
    head = inner.split("<", 1)[0].strip()
    return _whole(head).strip().removeprefix("::")


def _whole(text: str) -> str:
    """The type that a pointer is to, and the service or action that a part such as `::Request` is of."""
    text = _POINTER.sub("", text)
    head, _, last = text.rpartition("::")
    owner = head.rpartition("::")[2]
    if last in {"Request", "Response"} and owner not in {"", *_KINDS}:
        return head
    return head if last in {"Goal", "Result", "Feedback"} and owner[:1].isupper() else text


def _not_ros(name: str) -> bool:
    return not any(f"::{kind}::" in name for kind in _KINDS)


def _action(name: str, kind: str) -> str:
    return _ACTION_PART.sub("", name) if kind == ACTION and name != "Action" else name


def _argument(call: Invocation, index: int) -> Expr | None:
    placed = placed_arguments(call)
    return placed[index] if index < len(placed) else None
