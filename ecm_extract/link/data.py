"""Plain data from expressions: default values and parameter types."""

from __future__ import annotations

import math
from typing import Any

from ecm_parsers.numbers import INT_MAX, INT_MIN
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name, Number, Op, Text

from ecm_extract.link.env import Env, invocation_of
from ecm_extract.link.fold import Folder
from ecm_extract.link.numbers import NUMBERS, as_number
from ecm_extract.link.spelling import last_name

MAX_DEPTH = 12
MAX_POWER = 64
MAX_LENGTH = 16_384
"""Characters of a text that is put together."""
_CPP_TYPES = {
    "bool": "bool",
    **NUMBERS,
    "string": "string",
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
_WRAPPERS = frozenset({"ParameterValue", "string", "move", "Duration", "bool", "vector", *NUMBERS})
UNKNOWN = object()


def data_of(expr: Expr | None, env: Env, folder: Folder, depth: int = 0) -> Any:
    """Return the data that an expression is, `UNKNOWN` when the tree does not show it."""
    if expr is None or depth > MAX_DEPTH or not folder.steps.take(env):
        return UNKNOWN
    with folder.steps:
        return _data(expr, env, folder, depth)


def _data(expr: Expr, env: Env, folder: Folder, depth: int) -> Any:
    if isinstance(expr, Text | Number):
        return expr.value
    if isinstance(expr, Constant):
        return {"true": True, "false": False}.get(expr.name)
    if isinstance(expr, Items):
        items = [data_of(item, env, folder, depth + 1) for item in expr.items]
        return UNKNOWN if UNKNOWN in items else items
    if isinstance(expr, Op):
        return _operation(expr, env, folder, depth)
    if isinstance(expr, Call):
        return _call(expr, env, folder, depth)
    if isinstance(expr, Name | Member):
        return _variable(expr, env, folder, depth)
    return UNKNOWN


def _operation(expr: Op, env: Env, folder: Folder, depth: int) -> Any:
    operands = [data_of(operand, env, folder, depth + 1) for operand in expr.operands]
    if expr.op == "?:":
        return UNKNOWN
    if expr.op == "-" and len(operands) == 1 and isinstance(operands[0], int | float):
        return -operands[0]
    if len(operands) != 2 or any(operand is UNKNOWN for operand in operands):
        return UNKNOWN
    left, right = operands
    if expr.op == "+" and isinstance(left, str) and isinstance(right, str):
        return left + right if len(left) + len(right) <= MAX_LENGTH else UNKNOWN
    if not _numeric(left) or not _numeric(right):
        return UNKNOWN
    return _in_range(_computed(expr.op, left, right))


def _computed(operator: str, left: float, right: float) -> Any:
    if operator == "/":
        whole = isinstance(left, int) and isinstance(right, int)
        return UNKNOWN if right == 0 else left // right if whole else left / right
    work = {"+": left + right, "-": left - right, "*": left * right}
    return work.get(operator, UNKNOWN)


def _in_range(value: Any) -> Any:
    """A number that a parameter can hold: an integer of 64 bit, or finite."""
    if isinstance(value, int):
        return value if INT_MIN <= value <= INT_MAX else UNKNOWN
    return value if isinstance(value, float) and math.isfinite(value) else UNKNOWN


def _numeric(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _call(expr: Call, env: Env, folder: Folder, depth: int) -> Any:
    name = last_name(expr.callee.id) if isinstance(expr.callee, Name) else ""
    if name in {"vector"} and not expr.args:
        return []
    if name == "string" and not expr.args:
        return ""
    if name == "vector" and not (len(expr.args) == 1 and isinstance(expr.args[0], Items)):
        items = [data_of(arg, env, folder, depth + 1) for arg in expr.args]
        return UNKNOWN if UNKNOWN in items else items
    if name in _WRAPPERS and len(expr.args) == 1:
        return as_number(data_of(expr.args[0], env, folder, depth + 1), name)
    if name == "pow" and len(expr.args) == 2:
        return _power(*[data_of(arg, env, folder, depth + 1) for arg in expr.args])
    call = invocation_of(expr, env)
    read = folder.reads.read(call)
    if read is not None and read[1] is not None:
        return data_of(read[1], env, folder, depth + 1)
    if call.receiver is not None and call.last == "get" and isinstance(call.receiver, Call):
        return data_of(call.receiver, env, folder, depth + 1)
    values = folder.fold(expr, env)
    known = len(values) == 1 and values[0].confidence != "pattern"
    return values[0].text if known else UNKNOWN


def _power(base: Any, exponent: Any) -> Any:
    """`pow(0.03, 2)`, which is a double; small ones only, since the numbers are somebody else's."""
    if not _numeric(base) or not _numeric(exponent) or base <= 0 or max(base, abs(exponent)) > MAX_POWER:
        return UNKNOWN
    return float(base) ** exponent


def _variable(expr: Name | Member, env: Env, folder: Folder, depth: int) -> Any:
    if isinstance(expr, Name):
        if last_name(expr.id) == "M_PI":
            return 3.141592653589793
        bound = env.args.get(expr.id)
        if bound is not None:
            return data_of(bound.expr, bound.env, folder, depth + 1)
    for definition, inner in folder.lists.definitions(expr, env):
        if definition.statement.kind == "each":
            return UNKNOWN
        return data_of(definition.statement.value, inner, folder, depth + 1)
    name = expr.id if isinstance(expr, Name) else expr.name
    field = _field_default(name, env, folder)
    if field is not None:
        return data_of(field, env, folder, depth + 1)
    constant = folder.scope.constant(name, env)
    return data_of(constant[0], env, folder, depth + 1) if constant is not None else UNKNOWN


def _field_default(name: str, env: Env, folder: Folder) -> Expr | None:
    cls = env.this or env.func.cls
    for entry in folder.program.ancestry(cls) if cls is not None else ():
        if name in entry.fields:
            return entry.fields[name].default
    return None


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
        inner = type_of_data(value[0])
        return f"{inner}_array" if inner else None
    return None


__all__ = ["UNKNOWN", "data_of", "declared_type", "plain_type", "stated_type", "type_of_data"]
