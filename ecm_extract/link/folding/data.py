"""Plain data from expressions: default values and parameter types."""

from __future__ import annotations

from collections.abc import Sequence, Set
from math import isfinite
from typing import Any

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.infer.compute import NULL, UNKNOWN, is_number
from ecm_extract.link.code.numbers import NUMBERS, as_number
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.fold_parameters import PARAMETER_OBJECTS, value_of_parameter
from ecm_extract.link.running.env import Bound, Env, invocation_of
from ecm_extract.link.running.values import Enumerator, Value, data_in

MAX_DEPTH = 12
MAX_POWER = 64
_CPP_TYPES = {
    "bool": "bool",
    **NUMBERS,
    "string": "string",
    "str": "string",
    "PARAMETER_BOOL": "bool",
    "PARAMETER_INTEGER": "integer",
    "PARAMETER_DOUBLE": "double",
    "PARAMETER_STRING": "string",
    "PARAMETER_BOOL_ARRAY": "bool_array",
    "PARAMETER_INTEGER_ARRAY": "integer_array",
    "PARAMETER_DOUBLE_ARRAY": "double_array",
    "PARAMETER_STRING_ARRAY": "string_array",
    "PARAMETER_BYTE_ARRAY": "byte_array",
}
_PYTHON_TYPES = {
    "BOOL",
    "INTEGER",
    "DOUBLE",
    "STRING",
    "BOOL_ARRAY",
    "INTEGER_ARRAY",
    "DOUBLE_ARRAY",
    "STRING_ARRAY",
    "BYTE_ARRAY",
}
_WRAPPERS = frozenset({"ParameterValue", "string", "move", "Duration", "bool", *NUMBERS})


def data_of(expr: Expr | None, env: Env, folder: Folder, depth: int = 0) -> Any:
    """Return the data that an expression is, `UNKNOWN` when the tree does not show it or shows several."""
    if expr is None or depth > MAX_DEPTH or not folder.steps.take(env):
        return UNKNOWN
    with folder.steps:
        return _data(expr, env, folder, depth)


def _data(expr: Expr, env: Env, folder: Folder, depth: int) -> Any:
    if isinstance(expr, Call) and isinstance(expr.callee, Name) and len(expr.args) == 1:
        kind = last_name(expr.callee.id)
        if kind in _WRAPPERS:  # `ParameterValue(x)`, `double(x)`
            given = data_of(expr.args[0], env, folder, depth + 1)
            return _number_in(given, kind) if kind in NUMBERS and isinstance(given, str) else as_number(given, kind)
    if isinstance(expr, Op) and expr.op == "?:" and folder.flow.truth(expr.operands[0], env) is None:
        return UNKNOWN
    items = _items(expr, env, folder)
    if items is not None:
        found = [data_of(item.expr, item.env.deeper(env.depth + 1), folder, depth + 1) for item in items]
        return UNKNOWN if UNKNOWN in found else found
    if isinstance(expr, Call):
        found_ = _call(expr, env, folder, depth)
        if found_ is not None:
            return found_
    return _known(folder.fold(expr, env))


def _items(expr: Expr, env: Env, folder: Folder) -> Sequence[Bound] | None:
    named = isinstance(expr, Call) and isinstance(expr.callee, Name) and last_name(expr.callee.id) == "string"
    is_table = env.func.file.language == "python" and folder.tables.entries(expr, env) is not None
    return None if named or is_table else folder.lists.items(expr, env)


def _known(values: Sequence[Value]) -> Any:
    """The data of one value that is known, of a parameter its default."""
    if len(values) != 1 or values[0].confidence in {"pattern", "one_of"}:
        return UNKNOWN
    data = data_in(values[0])
    if data is NULL or isinstance(data, Enumerator):
        return None if data is NULL else UNKNOWN
    return data


def _call(expr: Call, env: Env, folder: Folder, depth: int) -> Any:
    name = last_name(expr.callee.id) if isinstance(expr.callee, Name) else ""
    if name == "pow" and len(expr.args) == 2:
        return _power(*[data_of(arg, env, folder, depth + 1) for arg in expr.args])
    call = invocation_of(expr, env)
    read = folder.reads.read(call)
    if read is not None and read.default is not None and not read.tells:
        return data_of(read.default, env, folder, depth + 1)
    if call.path in PARAMETER_OBJECTS:
        return data_of(value_of_parameter(call), env, folder, depth + 1)
    if call.receiver is not None and call.last == "get" and isinstance(call.receiver, Call):
        return data_of(call.receiver, env, folder, depth + 1)
    return None


def _number_in(text: str, kind: str) -> Any:
    """What Python makes of a text: `float("2.5")`; of one that is no number, or none that has an end, nothing."""
    try:
        number = int(text) if kind == "int" else float(text)
    except ValueError:
        return UNKNOWN
    return number if isfinite(number) else UNKNOWN


def _power(base: Any, exponent: Any) -> Any:
    """`pow(0.03, 2)`, which is a double; small ones only, since the numbers are somebody else's."""
    if not is_number(base) or not is_number(exponent) or base <= 0 or max(base, abs(exponent)) > MAX_POWER:
        return UNKNOWN
    return float(base) ** exponent


def plain_type(written: str) -> str:
    """Return a type as written without `const`, references and pointers."""
    return " ".join(word for word in written.replace("&", " ").replace("*", " ").split() if word != "const")


def declared_type(written: str) -> str | None:
    """Return the parameter type that a C++ template argument or `PARAMETER_*` constant means."""
    text = written.replace("rclcpp::", "").replace("std::", "").strip()
    if text.startswith("vector<"):
        inner = declared_type(text[7:].rstrip("> "))
        return f"{inner}_array" if inner else None
    return _CPP_TYPES.get(last_name(text.split()[0])) if text else None


def stated_type(expr: Expr | None) -> str | None:
    """Return the type when a default only names one: `rclcpp::PARAMETER_STRING`, `Parameter.Type.STRING`."""
    if isinstance(expr, Call) and len(expr.args) == 1 and last_name(getattr(expr.callee, "id", "")) == "ParameterValue":
        return stated_type(expr.args[0])
    name = last_name(expr.id) if isinstance(expr, Name) else expr.name if isinstance(expr, Member) else ""
    if name in _PYTHON_TYPES and not isinstance(expr, Name):
        return name.lower()
    return _CPP_TYPES.get(name) if name.startswith("PARAMETER_") else None


def type_of_data(value: Any) -> str | None:
    """Return the parameter type of a default."""
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, int):
        return "integer"
    if isinstance(value, float):
        return "double"
    if isinstance(value, str):
        return "string"
    if isinstance(value, list) and value:
        inner = _common({type_of_data(each) for each in value})
        return f"{inner}_array" if inner else None
    return None


def _common(kinds: Set[str | None]) -> str | None:
    """The type of all elements of a list: whole numbers may stand among fractions; others make a list of no type."""
    if kinds == {"integer", "double"}:
        return "double"
    return next(iter(kinds)) if len(kinds) == 1 else None


__all__ = ["UNKNOWN", "data_of", "declared_type", "plain_type", "stated_type", "type_of_data"]
