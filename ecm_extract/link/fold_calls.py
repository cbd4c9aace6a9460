"""Calls that give a value: formats, parameter reads, functions with a return value."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import (
    Call,
    Expr,
    Name,
    Text,
)

from ecm_extract.link import formats
from ecm_extract.link.calls import Invocation
from ecm_extract.link.env import Env, bind, invocation_of
from ecm_extract.link.numbers import NUMBERS
from ecm_extract.link.values import (
    PARENT_NAMESPACE,
    Value,
    below_namespace,
    demoted,
    joined,
    literal,
    lowered,
    node_name,
    node_namespace,
    set_by,
    unique,
    unknown,
)

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder

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
) | frozenset(NUMBERS)
_TIDIED = ("names::clean", "names::remap")
"""Functions that give a name as it is passed, but for slashes and remaps."""
RESOLVERS = frozenset(
    {"resolve_topic_or_service_name", "resolve_topic_name", "resolve_service_name", "resolveName", "resolve_name"}
    | {"expand_topic_or_service_name"}
)
"""Functions that apply remaps and namespaces at run time: the name itself is what was passed."""
_NAMES = frozenset({"ros::this_node::getName", "rospy.get_name"})
_NAMESPACES = frozenset({"ros::this_node::getNamespace", "rospy.get_namespace"})
_LAST_SLASH = frozenset({"rfind", "find_last_of"})
_STREAMS = frozenset({"stringstream", "ostringstream"})
_TOPIC_READS = frozenset({"get_topic_name", "getTopic", "get_service_name", "getService"})
_MAKES_TOPICS = frozenset(
    {"create_publisher", "create_subscription", "create_service", "create_client", "create_camera_publisher"}
    | {"create_camera_subscription", "advertise", "subscribe", "advertiseService", "serviceClient"}
    | {"advertiseCamera", "subscribeCamera"}
)
_PROPERTY_READS = frozenset({"getStdString", "getTopicStd", "getString"})


class CallFolder:
    """Folds calls."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def call(self, expr: Call, env: Env) -> tuple[Value, ...]:
        """String constructions, formats, parameter reads and functions that return a value."""
        call = invocation_of(expr, env)
        if call.path.endswith("names::resolve") and len(call.args) == 1:
            return self._absolute(call.args[0], env.before(env.at))
        tidied = call.last in RESOLVERS or call.path.endswith(_TIDIED)
        if call.path in _SAME or call.last in _STREAMS or (tidied and call.args):
            return self.folder.fold(call.args[0], env.before(env.at)) if call.args else (literal(""),)
        if call.last == "getCameraInfoTopic" and call.args:
            return self._beside(call.args[0], "camera_info", env.before(env.at))
        read = self.folder.reads.read(call)
        if read is not None:
            return self.parameter_value(*read, env.before(env.at))
        formatted = formats.formatted(call)
        if formatted is not None:
            return joined(self.folded_parts(formatted, env))
        text = self._of_text(call, env.before(env.at))
        if text is not None:
            return text
        if call.receiver is not None and call.last in _TOPIC_READS:
            return self._topic(call.receiver, env) or (unknown(call.last),)
        if call.receiver is not None and call.last in _PROPERTY_READS:
            return self._property(call.receiver, env) or (unknown(call.last),)
        if call.receiver is not None and call.last in formats.VALUE_READS:
            return self.folder.fold(call.receiver, env.before(env.at))
        return self.folder.guarded(f"{call.path}()", env, lambda: self._returns(call, env))

    def _absolute(self, name: Expr, env: Env) -> tuple[Value, ...]:
        """`ros::names::resolve(name)`: below the namespace of the node, whatever handle it is given to later."""
        values = self.folder.fold(name, env)
        if any(value.text.startswith(("/", "~")) or value.confidence == "pattern" for value in values):
            return values
        return joined([(node_namespace(),), (literal("/"),), values])

    def _of_text(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """Methods of texts: what is appended, joined or cut off; None for other calls."""
        if call.receiver is None:
            return None
        if call.last == "append" and len(call.args) == 1:
            return joined([self.folder.fold(part, env) for part in (call.receiver, call.args[0])])
        if call.last == "join" and isinstance(call.receiver, Text) and call.args:
            return self._joined(call.receiver.value, call.args[0], env)
        return (self._above(call.receiver, env) or (unknown(call.last),)) if _is_above(call) else None

    def _beside(self, expr: Expr, leaf: str, env: Env) -> tuple[Value, ...]:
        """Return names in the namespace of other names: image_transport puts `camera_info` beside each image."""
        texts = [value.text.rpartition("/") for value in self.folder.fold(expr, env) if value.confidence != "pattern"]
        return tuple([Value((f"{head}{slash}{leaf}",), "folded") for head, slash, _ in texts]) or (unknown(leaf),)

    def _topic(self, receiver: Expr, env: Env) -> tuple[Value, ...]:
        """The name that a publisher, subscription, service or client was made with."""
        for definition, inner in self.folder.lists.definitions(receiver, env):
            made = definition.statement.value
            if isinstance(made, Call):
                call = invocation_of(made, inner)
                free = call.receiver is None and "::" in call.path
                position = 1 if free or call.args[:1] == (Name("this"),) else 0
                named = call.last in _MAKES_TOPICS and len(call.args) > position
                return demoted(self.folder.fold(call.args[position], inner)) if named else ()
        return ()

    def _property(self, receiver: Expr, env: Env) -> tuple[Value, ...]:
        """An rviz property `new XProperty("Topic", "/default", ...)` is read like a parameter with that default."""
        for definition, inner in self.folder.lists.definitions(receiver, env):
            made = definition.statement.value
            if isinstance(made, Call) and isinstance(made.callee, Name) and made.callee.id.endswith("Property"):
                return lowered(self.folder.fold(made.args[1], inner), "default") if len(made.args) > 1 else ()
        return ()

    def _above(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        """The namespace above that of the node, or above a name that is known."""
        values = self.folder.fold(expr, env)
        if node_namespace().parts in {value.parts for value in values}:
            return (node_namespace(PARENT_NAMESPACE),)
        known = [value for value in values if value.confidence != "pattern"]
        return tuple([Value((value.text.rpartition("/")[0],), "folded") for value in known])

    def _joined(self, separator: str, expr: Expr, env: Env) -> tuple[Value, ...]:
        groups: list[tuple[Value, ...]] = []
        for bound in self.folder.lists.flat(expr, env):
            if groups:
                groups.append((literal(separator),))
            groups.append(self.folder.fold(bound.expr, bound.env.before(bound.env.at)))
        return joined(groups)

    def folded_parts(self, parts: Sequence[Expr | str], env: Env) -> list[tuple[Value, ...]]:
        """Return the values of the pieces of a format, in order."""
        inner = env.before(env.at)
        return [(literal(part),) if isinstance(part, str) else self.folder.fold(part, inner) for part in parts]

    def _returns(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        callee = self.folder.objects.callee(call, env)
        if callee is None:
            return (_of_node(call) or unknown(call.last),)
        returned = [
            (at, s.value) for at, s in enumerate(callee.fact.body) if s.kind == "return" and s.value is not None
        ]
        if not returned or len(returned) > 4:
            return (unknown(call.last),)
        inside = callee.cls is not None or "lambda" in callee.fact.traits
        this = env.this if call.receiver in {None, Name("this")} and inside else callee.cls
        made = env.made if this is env.this else None
        args = bind(callee, call, env)
        values = [
            self.folder.fold(value, Env(callee, at, args, this=this, made=made, depth=env.depth + 1))
            for at, value in returned
        ]
        return unique(demoted(_beside_joined([value for group in values for value in group])))

    def parameter_value(self, name: Expr, default: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the value of a ROS parameter: its default where the call or a declaration has one."""
        names = self.folder.fold(name, env)
        owner = (env.this or env.func.cls) if env.func is not None else None
        lineage = self.folder.program.ancestry(owner) if owner is not None else ()
        known = self.folder.reads.default(names[0].text, env.func.file.package, (*lineage, env.func.file))
        values = self.default_value(names[0].text, known, default, env)
        return values if names[0].confidence == "pattern" else set_by(names[0].text, values)

    def default_value(
        self, name: str, known: tuple[Expr, Env] | str | None, default: Expr | None, env: Env
    ) -> tuple[Value, ...]:
        """Return the values of a default: of the call, else of the declaration, else a hole."""
        values: tuple[Value, ...] = ()
        if default is not None:
            values = lowered(self.folder.fold(default, env.before(env.at)), "default")
        elif isinstance(known, str):
            values = (Value((known,), "default"),)
        elif known is not None:
            values = lowered(self.folder.fold(known[0], known[1].before(known[1].at)), "default")
        if values and (values[0].text or len(values) > 1):
            return values
        return (unknown(name.rsplit("/", 1)[-1].rsplit(".", 1)[-1].strip("~{}")),)


def _beside_joined(values: list[Value]) -> list[Value]:
    """Drop `x` beside `namespace + "/x"`: what a helper joins when it is relative it hands back when it is absolute."""
    joined_texts = {text for value in values if (text := below_namespace(value)) is not None}
    return [value for value in values if value.text not in joined_texts or value.text.startswith("/")]


def _of_node(call: Invocation) -> Value | None:
    """`get_name()`, `get_namespace()` of a node and ROS 1 counterparts; functions of the tree were tried before."""
    if call.last in {"get_name", "get_fully_qualified_name"} or call.path in _NAMES:
        return node_name()
    return node_namespace() if call.last == "get_namespace" or call.path in _NAMESPACES else None


def _is_above(call: Invocation) -> bool:
    """`text.substr(0, text.rfind("/"))`: what is above the last part of a name."""
    end = call.args[1] if call.last == "substr" and len(call.args) == 2 else None
    return isinstance(end, Call) and getattr(end.callee, "name", "") in _LAST_SLASH and Text("/") in end.args
