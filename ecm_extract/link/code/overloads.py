"""Overload choice: which function of a name a call can mean, by count and apparent type of its arguments."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ecm_parsers.source.expr import Call, Constant, Expr, Lambda, Name, Number, Text
from ecm_parsers.source.facts import Parameter

from ecm_extract.link.code.calls import Invocation, declared_type, gives_others, spreads, taken_by
from ecm_extract.link.code.numbers import kind_of_type, type_of_number
from ecm_extract.link.code.overload_ranks import not_outranked
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.templates import unified
from ecm_extract.link.code.units import Func

_NUMERIC = frozenset({"int", "double", "float", "bool", "unsigned", "long", "short", "char", "size_t"})
_OF_NUMBERS = frozenset({"QoS"})
"""Library classes that a number is converted to, and no function: rclcpp/qos.hpp, `QoS(size_t history_depth)`."""
NO = -1


def score(call: Invocation, func: Func) -> int:
    """Return how well a call fits a function; `NO` when it cannot mean it."""
    if call.func.file.language != func.file.language or not is_countable(call, func):
        return NO
    if func.file.language == "python":
        return 0
    if gives_others(func, call) or not _deducible(call, func) or not _is_specialized_so(call, func):
        return NO
    total = 1 if "declaration" not in func.fact.traits else 0
    for arg, parameter in zip(taken_by(func, call), func.params, strict=False):
        fit = _fit(arg, parameter, call.func, func)
        if fit == NO:
            return NO
        total += fit
    return total


def scored(call: Invocation, funcs: Iterable[Func]) -> dict[Func, int]:
    """Return the functions that a call can mean, with how well it fits them."""
    return {func: fit for func in funcs if (fit := score(call, func)) != NO}


def fitting(call: Invocation, funcs: Iterable[Func]) -> list[Func]:
    """Return the functions with a body that a call can mean, best first."""
    scores = scored(call, filter(_has_body, funcs))
    return sorted(not_outranked(call, list(scores)), key=lambda func: -scores[func])


def best(call: Invocation, scores: Mapping[Func, int]) -> list[Func]:
    """Return the functions that a call fits best, of those that it can mean."""
    found = not_outranked(call, list(scores))
    most = max((scores[func] for func in found), default=NO)
    return [func for func in found if scores[func] == most]


def _has_body(func: Func) -> bool:
    """Whether it is seen what a function does, be it nothing."""
    return bool(func.fact.body) or not {"declaration", "pure", "deleted"} & set(func.fact.traits)


def is_countable(call: Invocation, func: Func) -> bool:
    """Tell whether a call may give as many arguments as a function takes."""
    least, most = func.arity
    return spreads(call) or least <= len(taken_by(func, call)) + len(call.keywords) <= most


def _has_too_few(call: Invocation, func: Func) -> bool:
    """Whether a call names more types than a template has parameters, which it cannot mean ([temp.arg.explicit])."""
    is_constructor = func.cls is not None and func.fact.name == func.cls.fact.name
    if not func.own_template or is_constructor or "variadic" in func.fact.traits:
        return False
    invented = sum("auto" in parameter.type.split() for parameter in func.fact.params)  # [dcl.fct]: each is one more
    named = [written for written in call.types if "..." not in written]  # what a pack holds may be nothing
    return len(named) > len(func.own_template) + invented


def _deducible(call: Invocation, func: Func) -> bool:
    """A template parameter that no function parameter mentions must be given at the call; those of its class are."""
    own = func.own_template
    if call.types or not own:
        return not _has_too_few(call, func)
    text = " ".join(parameter.type for parameter in func.fact.params)
    return not any(name and name not in text for name in own[:1])


def _is_specialized_so(call: Invocation, func: Func) -> bool:
    """Of a template and its specializations only one is meant; which one a template that calls it need not know."""
    if not call.types:
        types = _deduced(call, func)
        is_other_name = bool(func.specialized) and not all(map(_is_plain_type, func.specialized))
        return not types or is_other_name or func.takes(types)
    open_ = {*call.func.fact.template, *(call.func.cls.fact.template if call.func.cls is not None else ())}
    return not open_.isdisjoint(call.types) or func.takes(call.types)


def _deduced(call: Invocation, func: Func) -> Sequence[str]:
    """The types for which a call means a template by its variables that are numbers or texts; else nothing."""
    general = func.general
    if general is None:
        return ()
    found: dict[str, str] = {}
    for arg, parameter in zip(taken_by(general, call), general.params, strict=False):
        written = _declared(arg.id, call.func) if isinstance(arg, Name) else ""
        if written and not _is_address(written):
            found = {**unified(parameter.type, written, general.fact.template), **found}
    types = [found.get(name, "") for name in general.fact.template]
    return types if all(map(_is_plain_type, types)) else ()


def _is_plain_type(written: str) -> bool:
    """Whether a type is written as a number or a text; another word may be another name of one."""
    return bool(kind_of_type(written) or type_of_number(written))


def _fit(arg: Expr, parameter: Parameter, caller: Func, func: Func) -> int:
    wanted = plain(parameter.type)
    if not wanted or wanted in func.fact.template or wanted == "auto":
        return 0
    last = wanted.rsplit("::", 1)[-1]
    if last in _OF_NUMBERS and isinstance(arg, Number | Lambda | Text):
        return 1 if isinstance(arg, Number) else NO
    if isinstance(arg, Text):
        return _character_fit(last, parameter.type) if arg.is_character else _text_fit(last, parameter.type)
    if isinstance(arg, Number) or (isinstance(arg, Constant) and arg.name != "null"):
        return 2 if last in _NUMERIC or last.endswith("_t") else NO if "string" in last or last[:1].isupper() else 0
    if isinstance(arg, Lambda):
        return NO if "string" in last or last in _NUMERIC else 0
    if isinstance(arg, Name):
        return _variable_fit(arg.id, parameter, caller)
    made = arg.callee.id if isinstance(arg, Call) and isinstance(arg.callee, Name) else ""
    return 2 if made and made.rsplit("::", 1)[-1] == last else 0


def _character_fit(last: str, written: str) -> int:
    return NO if "string" in last or _is_address(written) else 2 if last == "char" else 0


def _is_address(written: str) -> bool:
    return "*" in written or "[" in written


def _text_fit(last: str, written: str) -> int:
    if "string" in last or (last == "char" and _is_address(written)):
        return 2
    if last == "bool":
        return 0  # an address is true
    return NO if last in _NUMERIC or last[:1].isupper() else 0


def _declared(name: str, caller: Func) -> str:
    """The type that a variable or member is declared with; empty where that is not seen, or is that of a template."""
    declared = declared_type(name, caller)
    is_open = name in caller.variously_typed or plain(declared) in {"auto", *caller.fact.template}
    return "" if is_open else declared


def _variable_fit(name: str, parameter: Parameter, caller: Func) -> int:
    declared = _declared(name, caller)
    if not declared:
        return 0
    last = plain(parameter.type).rsplit("::", 1)[-1]
    if _is_address(parameter.type) and not _is_address(declared) and plain(declared) in _NUMERIC:
        return NO  # a number is no address
    if "char[" in declared:
        return _text_fit(last, parameter.type)
    actual = plain(declared).rsplit("::", 1)[-1]
    if actual == last:
        return 2
    return (
        NO
        if ("string" in actual) != ("string" in last) and {actual, last} & {"string"} and _plain_type(actual, last)
        else 0
    )


def _plain_type(actual: str, last: str) -> bool:
    other = last if "string" in actual else actual
    return other in _NUMERIC or other in {"ParameterDescriptor", "Logger", "QoS"}
