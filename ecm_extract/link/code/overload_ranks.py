"""Which of several overloads of C++ is better for the arguments of a call, as far as their types are seen.

Source: [over.match.best] and [over.ics.rank] of the C++ standard: a text in quotes becomes a `bool` rather than a
`std::string`, as that is no conversion by a constructor; a template that fits is better than any conversion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Constant, Expr, Name, Number, Op, Text
from ecm_parsers.source.facts import Parameter

from ecm_extract.link.code.calls import Invocation, taken_by
from ecm_extract.link.code.numbers import NUMBERS
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Func

_EXACT: Final = 4
_PROMOTED: Final = 3
_CONVERTED: Final = 2
_MADE: Final = 1
"""By a constructor or a method of a class."""
_NONE: Final = 0
"""In no way."""
_KINDS: Final = MappingProxyType({**NUMBERS, "bool": "bool"})
"""Types of numbers with what they hold: what a literal is beside that, its suffix says."""
_TRUTHS: Final = frozenset({"!", "&&", "||", "==", "!=", "<", ">", "<=", ">="})
"""Operators that give a `bool` of built-in types."""
_CHARACTER: Final = "char"
_CHARACTERS: Final = "char *"
_TEXTS: Final = frozenset({"string", "string_view"})


def not_outranked(call: Invocation, funcs: Sequence[Func]) -> Sequence[Func]:
    """Return the functions that none of the same class, or of the others outside of classes, is better than for a call.

    Only C++ has several: those of one scope, and what directives bring there ([namespace.udir]).
    """
    if len(funcs) < 2 or call.func.file.language != "cpp" or not call.args:
        return funcs
    taken = {func: _taken(func, call) for func in funcs}
    rivals = [func for func in funcs if any(each.rank is not None for each in taken[func])]
    outranked = {func for func in rivals if any(_is_better(other, func, taken) for other in rivals)}
    return [func for func in funcs if func not in outranked]


def _taken(func: Func, call: Invocation) -> Sequence[_Taken]:
    """How a function takes the arguments of a call."""
    given = [_type_given(arg, call.func) for arg in taken_by(func, call)]
    return [_Taken.of(*pair, func) for pair in zip(given, func.params, strict=False)]


class _Taken(NamedTuple):
    """How a function takes one argument: by which type, how well, and whether as a template of any type."""

    type: str
    rank: int | None
    any_type: bool

    @classmethod
    def of(cls, given: str, parameter: Parameter, func: Func) -> _Taken:
        return cls(parameter.type, _rank(given, parameter, func), _is_of_template(parameter, func))


def _is_better(one: Func, other: Func, taken: Mapping[Func, Sequence[_Taken]]) -> bool:
    if one is other or one.cls is not other.cls:
        return False
    better = False
    for left, right in zip(taken[one], taken[other], strict=False):
        if left.type == right.type and not left.any_type and not right.any_type:
            continue
        if left.rank is None or right.rank is None or left.rank < right.rank:
            return False
        better = better or left.rank > right.rank or (right.any_type and not left.any_type)
    return better


def _type_given(arg: Expr, caller: Func) -> str:
    """The type of an argument, in a short form; empty where it is not seen."""
    if isinstance(arg, Text):
        return _CHARACTER if arg.is_character else _CHARACTERS
    if isinstance(arg, Number):
        return "int" if isinstance(arg.value, int) else "double"
    if isinstance(arg, Constant):
        return "" if arg.name == "null" else "bool"
    if isinstance(arg, Op) and arg.op in _TRUTHS:
        return "bool"
    if isinstance(arg, Call):
        return _short(_returned(arg.callee, caller))
    if not isinstance(arg, Name) or arg.id in caller.variously_typed:
        return ""
    member = caller.cls.fields.get(arg.id) if caller.cls is not None else None
    written = caller.written_types.get(arg.id, member.type if member is not None else "")
    last = last_name(plain(written))
    if last == "auto" and not written.endswith("&"):
        made = [each.value for each in caller.fact.body if each.target == arg and each.kind == "let"]
        return _type_given(made[0], caller) if len(made) == 1 and isinstance(made[0], Text | Number | Constant) else ""
    return _short(written)


def _returned(callee: Expr, caller: Func) -> str:
    """The type that a function is declared to return, as long as all of its name return that."""
    if not isinstance(callee, Name):
        return ""
    own = [each.fact.returns for each in caller.cls.methods if each.fact.name == callee.id] if caller.cls else []
    types = set(own) or caller.file.returned(callee.id, caller.scope)
    return next(iter(types)) if len(types) == 1 else ""


def _short(written: str) -> str:
    last = last_name(plain(written.partition("[")[0]))
    return _CHARACTERS if last == "char" and ("*" in written or "[" in written) else "" if "*" in written else last


def _rank(given: str, parameter: Parameter, func: Func) -> int | None:
    """How well a parameter takes what is of a type; None where that is not known."""
    if _is_of_template(parameter, func):
        return None if not given or _is_restricted(func) else _EXACT
    wanted = last_name(plain(parameter.type))
    if "*" in parameter.type or "[" in parameter.type:
        return _EXACT if wanted == "char" and given == _CHARACTERS else None
    if given in _KINDS:
        return _EXACT if _KINDS.get(wanted) == _KINDS[given] else _CONVERTED if wanted in _KINDS else None
    if given == _CHARACTER and wanted in _KINDS:
        return _PROMOTED if wanted == "int" else _CONVERTED
    if given == _CHARACTERS:
        return _CONVERTED if wanted == "bool" else _MADE if wanted in _TEXTS else None
    if given in _TEXTS and wanted in _KINDS:
        return _NONE
    return _EXACT if given and given == wanted else None


def _is_of_template(parameter: Parameter, func: Func) -> bool:
    """Whether a parameter is of the type that its argument has."""
    own = func.fact.template if func.fact.specializes is None else ()
    return (plain(parameter.type) in own or plain(parameter.type) == "auto") and "*" not in parameter.type


def _is_restricted(func: Func) -> bool:
    """Whether a template may not take all types: by parameters of it that no parameter of the function mentions."""
    text = " ".join(parameter.type for parameter in func.fact.params)
    unmentioned = any(not name or name not in text for name in func.own_template)
    return unmentioned or "enable_if" in f"{text} {func.fact.returns}" or "..." in text
