"""Calls that give a value: formats, parameter reads, functions with a return value."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from ecm_parsers.source.expr import (
    THIS,
    Call,
    Expr,
    Member,
    Name,
)

from ecm_extract.infer.compute import UNKNOWN, is_number, method, shown, truth
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.limits import limit
from ecm_extract.link.code.naming_calls import gives_name, is_resolver
from ecm_extract.link.code.numbers import NUMBERS, as_number
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.folding import formats
from ecm_extract.link.folding.conversions import converted
from ecm_extract.link.folding.fold_changes import STREAMS
from ecm_extract.link.folding.fold_parameters import PARAMETER_OBJECTS, value_of_parameter
from ecm_extract.link.folding.held_formats import with_format
from ecm_extract.link.folding.instances import is_instance
from ecm_extract.link.folding.meant_names import called
from ecm_extract.link.folding.names_of_nodes import resolved
from ecm_extract.link.folding.path_parts import PATH_FUNCTIONS
from ecm_extract.link.folding.placing import CAMERA_INFO, placed
from ecm_extract.link.folding.popped import POP
from ecm_extract.link.folding.text_functions import TEXT_FUNCTIONS
from ecm_extract.link.folding.tuple_parts import part_by_place
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.other_nodes import asks_another_node
from ecm_extract.link.running.own_names import node_namespace
from ecm_extract.link.running.values import (
    Hole,
    Value,
    alternatives,
    constant,
    data_in,
    demoted,
    is_proved,
    joined,
    literal,
    lowered,
    parameter,
    setting,
    unknown,
)
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TABLE = "link/code/library_values.toml"
_SAME = shipped_names(_TABLE, "conversions") | frozenset(NUMBERS)
_TOPIC_READS = frozenset({"get_topic_name", "getTopic", "get_service_name", "getService"})
_MAKES_TOPICS = frozenset(
    {"create_publisher", "create_subscription", "create_service", "create_client", "create_camera_publisher"}
    | {"create_camera_subscription", "advertise", "subscribe", "advertiseService", "serviceClient"}
    | {"advertiseCamera", "subscribeCamera"}
)
MAX_FILL = 256
_SIZES = frozenset({"len", "size", "length", "empty"})
_PYTHON_FUNCTIONS: Mapping[str, Callable[[list[Any]], Any]] = MappingProxyType(
    {
        "hex": lambda data: hex(data[0]) if len(data) == 1 and isinstance(data[0], int) else UNKNOWN,
        "oct": lambda data: oct(data[0]) if len(data) == 1 and isinstance(data[0], int) else UNKNOWN,
        "bin": lambda data: bin(data[0]) if len(data) == 1 and isinstance(data[0], int) else UNKNOWN,
        "bool": lambda data: truth(data[0], True) if len(data) == 1 else UNKNOWN,
        "abs": lambda data: abs(data[0]) if len(data) == 1 and is_number(data[0]) else UNKNOWN,
        "min": lambda data: min(data) if len(data) > 1 and all(map(is_number, data)) else UNKNOWN,
        "max": lambda data: max(data) if len(data) > 1 and all(map(is_number, data)) else UNKNOWN,
        **PATH_FUNCTIONS,
    }
)
_CPP_FUNCTIONS: Mapping[str, Callable[[list[Any]], Any]] = MappingProxyType(
    {"bool": lambda data: truth(data[0], False) if len(data) == 1 else UNKNOWN, **TEXT_FUNCTIONS}
)
_PATH_JOINS = shipped_names(_TABLE, "paths")
_PROPERTIES = shipped_names(_TABLE, "properties")
_ENVIRONMENT = shipped_names(_TABLE, "environment")
_PROPERTY_READS = shipped_names(_TABLE, "property_reads")


class CallFolder:
    """Folds calls."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def call(self, expr: Call, env: Env) -> tuple[Value, ...]:
        """String constructions, formats, parameter reads and functions that return a value."""
        call, env = self.folder.spreading.known(invocation_of(expr, env), env)
        meant = called(call.path, env, self.folder.objects) if call.receiver is None else call.path
        if not meant:
            return (parameter(call.path, made=True),)
        if meant != call.path:
            return self.call(Call(Name(meant), expr.args, expr.keywords, expr.types, expr.line), env)
        return self._of_function(call, expr, env)

    def _of_function(self, call: Invocation, expr: Call, env: Env) -> tuple[Value, ...]:
        """What a call gives by the name of its function."""
        if call.path.endswith("names::resolve") and len(call.args) == 1:
            return self._absolute(call.args[0], env.before(env.at))
        tidied = is_resolver(call.last) or gives_name(call.path)
        plainly = call.receiver is None and (call.path in _SAME or call.last in STREAMS)
        if tidied and call.args:
            return resolved(call, env.before(env.at), self.folder)
        if plainly:
            return self._same(call, env.before(env.at))
        if call.last == "getCameraInfoTopic" and call.args:
            images = self.folder.fold(call.args[0], env.before(env.at))
            return demoted(tuple([placed(value, CAMERA_INFO) for value in images]))
        read = self.folder.reads.read(call)
        if read is not None and asks_another_node(call, env, self.folder.objects):
            named = self.folder.fold(read.name, env.before(env.at))[0].text
            return (unknown(named.rpartition(".")[2].strip("{}") or call.last),)
        if read is not None:
            values = self.folder.parameters.read_value(read, env.before(env.at))
            return values if not self.folder.replaced.may_be(call, env) else (unknown(call.last),)
        if call.path in PARAMETER_OBJECTS:
            return self.folder.fold(value_of_parameter(call), env.before(env.at))
        if call.path in _PATH_JOINS and call.args and not call.keywords:
            return self._path(call, env.before(env.at))
        formatted = formats.formatted(with_format(call, env.before(env.at), self.folder))
        if formatted is not None:
            return joined(self.folded_parts(formatted, env))
        return self._computed(call, expr, env.before(env.at))

    def _attribute(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """`getattr(config, "topic")` of a name that is known."""
        names = self.folder.fold(call.args[1], env)
        name = data_in(names[0]) if len(names) == 1 and is_proved(names[0]) else None
        return self.folder.fold(Member(call.args[0], name), env) if isinstance(name, str) else (unknown("getattr"),)

    def _path(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """`os.path.join(a, "/b", c)` as Python joins it: a part from the root drops what stands before it."""
        options = [self.folder.fold(arg, env) for arg in call.args]
        if all(isinstance(data_in(value), str) for values in options for value in values):
            return self.folder.combined(options, lambda data: posixpath.join(*data), "join")
        rooted = [all(value.text.startswith("/") for value in values) for values in options]
        first = max((at for at, is_rooted in enumerate(rooted) if is_rooted), default=0)
        between = [[values, (literal("/"),)] for values in options[first:-1]]
        return joined([*(part for pair in between for part in pair), options[-1]])

    def _computed(self, call: Invocation, expr: Call, env: Env) -> tuple[Value, ...]:
        """Methods of texts, sizes, functions of the standard library, functions of the tree."""
        text = self.folder.texts.value(call, env)
        if text is not None:
            return text
        if call.receiver is not None and call.last in _TOPIC_READS:
            return self._topic(call.receiver, env) or (unknown(call.last),)
        if call.receiver is not None and call.last in _PROPERTY_READS:
            return self._property(call.receiver, env) or (unknown(call.last),)
        held = self.folder.optionals.called(call, env)
        if held is not None:
            return held
        if call.receiver is not None and call.last in formats.VALUE_READS:
            entry = self._element(call, env) if call.args else None  # `table.get(key)` is no read of a whole value
            return self._read_from(call.receiver, call.last, env) if entry is None else entry
        known = self._of_library(call, env)
        if known is not None:
            return known
        if call.path in _ENVIRONMENT:
            return self._of_environment(call, env)
        closure = self.folder.returns.closures.value(expr, call, env)
        if closure is not None:
            return closure
        return self.folder.guarded(_asked(expr, env), f"{call.path}()", lambda: self.folder.returns.values(call, env))

    def _read_from(self, receiver: Expr, name: str, env: Env) -> tuple[Value, ...]:
        """What a value of a parameter holds; of one that nothing shows it is what somebody sets."""
        values = self.folder.fold(receiver, env)
        if name not in formats.PARAMETER_READS:
            return values
        values = formats.read_as(name, values)
        return tuple([setting(value.text.strip("{}")) if _is_unknown(value) else value for value in values])

    def _same(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """Conversions: a text of what is passed, or a number; a value of no type where nothing is passed is neither."""
        if not call.args and call.last == "ParameterValue":
            return (unknown(call.last),)
        if not call.args:
            return (literal(""),) if call.path not in NUMBERS else (constant(as_number(0, call.path)),)
        if len(call.args) > 1:
            return self._repeated(call, env) if call.last == "string" else (unknown(call.last),)
        named = self.folder.enums.text(call.args[0], env, formats=False) if call.path == "str" else ()
        if named:
            return named
        values = self.folder.fold(call.args[0], env)
        python = env.func.file.language == "python"
        if call.path in {"str", "std::to_string", "String"}:
            if call.path == "std::to_string" and any(isinstance(data_in(value), str) for value in values):
                return (unknown(call.last),)  # a character is the number of its code
            return self._shown_items(call, env) or tuple([self._text_of(value, python) for value in values])
        return tuple([converted(value, call.path, python) for value in values]) if call.path in NUMBERS else values

    def _shown_items(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """`str(names)` of a list is nothing that anybody names things with."""
        listed = env.func.file.language == "python" and self.folder.lists.items(call.args[0], env) is not None
        return (unknown("value"),) if listed else ()

    def _text_of(self, value: Value, python: bool) -> Value:
        text = shown(value.data, python) if value.data is not None else ""
        return (
            value
            if value.data is None
            else unknown("value")
            if text is UNKNOWN
            else value._replace(parts=(text,), data=None)
        )

    def _repeated(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """`std::string(3, 'x')`, `std::string(text, 0, 4)`."""
        options = [self.folder.fold(arg, env) for arg in call.args]
        return self.folder.combined(options, _filled, "string")

    def _of_library(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """What the standard library gives for what is known; None for other functions."""
        python = env.func.file.language == "python"
        if python and call.path in {"getattr", "isinstance"} and len(call.args) == 2 and not call.keywords:
            return self._attribute(call, env) if call.path == "getattr" else is_instance(call, env, self.folder)
        if call.last in _SIZES and self._is_size(call, python):
            subject = call.args[0] if python else call.receiver
            items = self.folder.lists.items(subject, env)
            if items is not None:
                size = len(items)
                return (constant(size == 0 if call.last == "empty" else size)._replace(confidence="folded"),)
            if python and subject is not None:
                return self.folder.combined([self.folder.fold(subject, env)], _length, "len")
        searched = None if python else self.folder.searches.count(call, env)
        if searched is not None:
            return searched
        part = None if python else part_by_place(call, env, self.folder)
        if part is not None:
            return part
        bound = None if python else limit(call.path, call.types)
        if bound is not None:
            return (constant(bound),)
        table = _PYTHON_FUNCTIONS if python else _CPP_FUNCTIONS
        work = table.get(call.path) if call.receiver is None else None
        if work is not None and not call.keywords:
            return self.folder.combined([self.folder.fold(arg, env) for arg in call.args], work, call.last)
        if call.receiver is not None and call.last in {"at", "front", "back", "get", POP}:
            return self._element(call, env)
        return None

    def _is_size(self, call: Invocation, python: bool) -> bool:
        return call.path == "len" and len(call.args) == 1 if python else call.receiver is not None and not call.args

    def _element(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """`names.at(0)`, `names.back()`, `table.get(key, default)`, `table.pop(key, default)`."""
        receiver = call.receiver
        if call.last == POP:
            return self.folder.popped.value(call, env)
        if call.last in {"front", "back"} and not call.args:
            items = self.folder.lists.items(receiver, env)
            return demoted(self.folder.lists.fold(items[0 if call.last == "front" else -1], env)) if items else None
        if call.last == "at" and len(call.args) == 1:
            return self.folder.lists.elements(receiver, env, call.args[0])
        if receiver is None or call.last != "get" or not 1 <= len(call.args) <= 2:
            return None
        entries = self.folder.tables.entries(receiver, env)
        if entries is None:
            return self.folder.popped.of_giver(receiver, env)
        return self.folder.tables.entry_or(entries, call.args[0], call.args[1:], env)

    def _of_environment(self, call: Invocation, env: Env) -> tuple[Value, ...]:
        """What the environment gives, or what stands for it where that has nothing."""
        default = call.args[1] if len(call.args) > 1 else dict(call.keywords).get("default")
        values = self.folder.fold(default, env) if default is not None else ()
        return alternatives((*demoted(values), unknown(call.last)))

    def _absolute(self, name: Expr, env: Env) -> tuple[Value, ...]:
        """`ros::names::resolve(name)`: below the namespace of the node, whatever handle it is given to later."""
        values = self.folder.fold(name, env)
        if any(value.text.startswith(("/", "~")) or value.confidence == "pattern" for value in values):
            return values
        return joined([(node_namespace(),), (literal("/"),), values])

    def _topic(self, receiver: Expr, env: Env) -> tuple[Value, ...]:
        """The name that a publisher, subscription, service or client was made with."""
        return self._of_makers(receiver, env, _topic_of)

    def _property(self, receiver: Expr, env: Env) -> tuple[Value, ...]:
        """An rviz property `new XProperty("Topic", "/default", ...)` is read like a parameter with that default."""
        return lowered(self._of_makers(receiver, env, _text_of_property), "default")

    def _of_makers(self, receiver: Expr, env: Env, named: Callable[[Call, Env], Expr | None]) -> tuple[Value, ...]:
        """What the calls that may have made an object name it with; empty where one of them is not known."""
        found: list[Value] = []
        for made in self.folder.origins.makers(receiver, env) or ():
            name = named(made.expr, made.env) if isinstance(made.expr, Call) else None
            if name is None:
                return ()
            found += self.folder.fold(name, made.env)
        return alternatives(demoted(found)) if found else ()

    def folded_parts(self, parts: Sequence[Expr | str], env: Env) -> list[tuple[Value, ...]]:
        """Return the values of the pieces of a format, in order."""
        inner = env.before(env.at)
        return [(literal(part),) if isinstance(part, str) else self.folder.fold(part, inner) for part in parts]


def _topic_of(made: Call, env: Env) -> Expr | None:
    """The name in a call that makes an endpoint."""
    call = invocation_of(made, env)
    free = call.receiver is None and "::" in call.path
    position = 1 if free or call.args[:1] == (THIS,) else 0
    return call.args[position] if call.last in _MAKES_TOPICS and len(call.args) > position else None


def _text_of_property(made: Call, env: Env) -> Expr | None:
    """The text that a property of rviz begins with."""
    of_property = isinstance(made.callee, Name) and last_name(made.callee.id) in _PROPERTIES
    return made.args[1] if of_property and len(made.args) > 1 else None


def _is_unknown(value: Value) -> bool:
    return len(value.parts) == 1 and isinstance(value.parts[0], Hole) and value.parts[0].kind in {"unknown", "outside"}


def _asked(expr: Call, env: Env) -> tuple[object, ...]:
    """What tells a call with its arguments from the same call with others."""
    return "call", expr, env.func, env.at, env.state, tuple(env.args.values())


def _filled(data: list[object]) -> object:
    first, *rest = data
    if isinstance(first, int) and len(rest) == 1 and isinstance(rest[0], str) and 0 <= first <= MAX_FILL:
        return rest[0] * first
    if isinstance(first, str) and len(rest) == 2:
        return method("substr", first, rest, False)
    return UNKNOWN


def _length(data: list[object]) -> object:
    return len(data[0]) if isinstance(data[0], str) else UNKNOWN
