"""What a Python launch file makes where a condition decides that is known at launch only: actions carry it."""

from __future__ import annotations

from ecm_parsers.launch.model import Action, Group
from ecm_parsers.launch.values import actions_of, guarded, starts_something
from ecm_parsers.python.calls import Returned
from ecm_parsers.python.values import Condition, Object, Text, Unknown, Value, template_of
from ecm_parsers.template import Substitution, Template, negated


def choice(holds: Template, first: Value, second: Value) -> Value:
    """Return a value that depends on a condition; lists are joined, since all their items can occur."""
    if isinstance(first, list) and isinstance(second, list):
        return [*first, *(item for item in second if not any(item is known for known in first))]
    if isinstance(first, Action) and (second is None or isinstance(second, Action)):
        either = (*guarded((first,), holds, first.line), *guarded(actions_of(second), negated(holds), first.line))
        return Group(line=first.line, actions=either, scoped=False)
    if isinstance(first, dict) and isinstance(second, dict):
        return {**second, **first}
    if all(isinstance(value, str | Text | int | float | bool) for value in (first, second)):
        return Text((Substitution("if", (holds, template_of(first), template_of(second))),))
    if isinstance(first, Condition) or isinstance(second, Condition):
        return first if isinstance(first, Condition) else second
    return first if not isinstance(first, Unknown | type(None)) else second


def under(guard: Template | None, value: Value, line: int) -> Value:
    """Return a value whose actions are taken under a condition."""
    if isinstance(value, list | tuple):
        return [under(guard, item, line) for item in value]
    if not isinstance(value, Action | Object):
        return value
    found = guarded(actions_of(value), guard, line)
    return found[0]


def returned_value(returned: Returned, line: int) -> Value:
    """Return what a function gives that returns in several places."""
    if not returned:
        return None
    if len(returned) == 1:
        return returned[0][1]
    if any(starts_something(value) for _, value in returned):
        return [action for guard, value in returned for action in guarded(actions_of(value), guard, line)]
    result = returned[-1][1]
    for guard, value in reversed(returned[:-1]):
        result = value if guard is None else choice(guard, value, result)
    return result
