"""String formats of both languages, taken apart into literal and computed pieces."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ecm_parsers.source.expr import Call, Expr, Items, Name, Op, Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.running.values import Value, setting
from ecm_extract.shipped import shipped, shipped_names

_TABLE = "link/code/library_values.toml"
PARAMETER_READS = shipped_names(_TABLE, "parameter_texts")
"""Members and methods that give the text of a value of a parameter."""
_TEXT_READS = shipped_names(_TABLE, "parameter_texts_only")
VALUE_READS = PARAMETER_READS | shipped_names(_TABLE, "texts")
"""Members and methods that give the text of what they are called on."""
_JOINING = shipped_names(_TABLE, "slashes")
BRACED = frozenset({"format", "format_map"})
"""Methods of texts of Python that fill braces: docs.python.org, str.format."""
FORMATTING = frozenset({"fmt::format", "std::format"})
"""Functions of C++ that fill braces: en.cppreference.com, std::format; fmt.dev."""
_MAX_INDEX = 6
"""Digits of an index that are read: no call has as many arguments."""
_PERCENT = re.compile(r"%(?:\((\w+)\))?[-+ #0-9.]*(?:hh|h|ll|l|z)?[a-zA-Z]")
_NUMBERED = re.compile(r"%(\d{1,6})%")
_BRACES = re.compile(r"\{([^{}:!]*)((?:![a-z])?)(?::([^{}]*))?\}")


def read_as(name: str, values: Sequence[Value]) -> tuple[Value, ...]:
    """Return what a read gives of the values of a parameter: one that reads a text has nothing of a number."""
    kind = shipped(_TABLE).get("parameter_data", {}).get(name, "")
    if name not in _TEXT_READS and not kind:
        return tuple(values)
    return tuple([value if _is_of(kind, value) else setting(value.parameter or name) for value in values])


def _is_of(kind: str, value: Value) -> bool:
    return value.confidence == "pattern" or (type(value.data).__name__ if value.data is not None else "") == kind


def is_unset(default: Expr) -> bool:
    """Tell whether a default is a value of a parameter that is not set: `rclcpp::ParameterValue()`."""
    return (
        isinstance(default, Call)
        and not default.args
        and isinstance(default.callee, Name)
        and last_name(default.callee.id) == "ParameterValue"
    )


def formatted(call: Invocation) -> list[Expr | str] | None:
    """Return the pieces of a formatting call, None when it is no such call."""
    receiver, args = call.receiver, call.args
    if call.last == "format" and isinstance(receiver, Text):
        return braces(receiver.value, args, dict(call.keywords))
    if call.path in FORMATTING and args and isinstance(args[0], Text):
        return braces(args[0].value, args[1:], {})
    if call.last == "format_map" and isinstance(receiver, Text) and len(args) == 1:
        named: dict[str, Expr] = {
            match[1]: Op("[]", (args[0], Text(match[1]))) for match in _BRACES.finditer(receiver.value)
        }
        return braces(receiver.value, (), named)
    if call.path in _JOINING or call.path.endswith("names::append"):
        return _with_separator(args, "/")
    if call.last == "joinpath" and receiver is not None:
        return _with_separator((receiver, *args), "/")
    printed = args[0] if call.path == "boost::str" and len(args) == 1 else receiver if call.last == "str" else None
    if isinstance(printed, Op) and printed.op == "%":
        return _of_boost(printed)
    if call.path == "absl::StrCat":
        return [_as_streamed(each) for each in args]
    return list(args) if call.last == "concat" else None


def _as_streamed(value: Expr) -> Expr:
    """Return the text that a stream of C++ makes of a value: `1` of what is true, `2` of `2.0`."""
    return Op("+", (Text(""), Text(""), value))


def percent(text: str, operand: Expr) -> list[Expr | str]:
    """Take a printf-style format apart."""
    if "%%" in text:
        return [Name("value")]
    values = list(operand.items) if isinstance(operand, Items) else [operand]
    pieces: list[Expr | str] = []
    position = 0
    for match in _PERCENT.finditer(text):
        pieces.append(text[position : match.start()])
        value = values.pop(0) if values and not match.group(1) else Name(match.group(1) or "value")
        spec = match.group().replace(f"({match.group(1)})", "") if match.group(1) else match.group()
        pieces.append(Op("format", (value, Text(spec))))
        position = match.end()
    return [*pieces, text[position:]]


def _of_boost(printed: Expr) -> list[Expr | str] | None:
    """Take `boost::format("%1%/%2%") % a % b` apart; None of another object."""
    values: list[Expr] = []
    while isinstance(printed, Op) and printed.op == "%" and len(printed.operands) == 2:
        printed, value = printed.operands
        values.insert(0, value)
    made = printed.args if isinstance(printed, Call) and printed.callee == Name("boost::format") else ()
    if len(made) != 1 or not isinstance(made[0], Text):
        return None
    text = made[0].value
    if _NUMBERED.search(text) is None:
        return percent(text, Items(tuple(values)))
    pieces = _NUMBERED.split(text)
    known = [values[int(at) - 1] if 0 < int(at) <= len(values) else Name("value") for at in pieces[1::2]]
    found: list[Expr | str] = [*pieces[:1]]
    for value, rest in zip(known, pieces[2::2], strict=True):
        found += [_as_streamed(value), rest]
    return found if not any("%" in each for each in pieces[::2]) else [Name("value")]


def braces(text: str, args: Sequence[Expr], keywords: dict[str, Expr]) -> list[Expr | str]:
    """Take a brace format apart; one with a brace too many is an error in both languages."""
    if not {"{", "}"}.isdisjoint(_BRACES.sub("", text)):
        return [Name("value")]
    pieces: list[Expr | str] = []
    position, count = 0, 0
    for match in _BRACES.finditer(text):
        pieces.append(text[position : match.start()])
        key = match.group(1)
        index = int(key[:_MAX_INDEX]) if key.isdecimal() else count
        count += not key
        known = keywords.get(key) if key and not key.isdecimal() else args[index] if index < len(args) else None
        value = known if known is not None else Name(key or "value")
        spec = match.group(2) + (match.group(3) or "")
        pieces.append(Op("format", (value, Text(spec))))
        position = match.end()
    return [*pieces, text[position:]]


def _with_separator(items: Sequence[Expr], separator: str) -> list[Expr | str]:
    pieces: list[Expr | str] = []
    for index, item in enumerate(items):
        pieces += [separator, item] if index else [item]
    return pieces
