"""Under which conditions the actions of a launch file are taken, in the form that documents hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec
from ecm_checker.hub.condition import TRUE, Condition, Tested
from ecm_parsers.launch.model import Action, Argument, Group, Node
from ecm_parsers.launch.templates import plain_text, written
from ecm_parsers.template import Substitution, Template

_TESTED: Final[dict[str, Tested]] = {"arg": "argument", "env": "environment"}
_FALSE: Final = frozenset({"false", "0", "off", "no", ""})
_TRUE: Final = frozenset({"true", "1", "on", "yes"})


class Taken(msgspec.Struct, frozen=True):
    """An action with the conditions of the groups around it and its own."""

    action: Action
    when: tuple[Condition, ...]


def taken(actions: Iterable[Action], around: tuple[Condition, ...] = ()) -> Iterator[Taken]:
    """Yield all actions that can be taken, those of groups and the components of containers included."""
    for action in actions:
        own = conditions_of(action.condition)
        if own is None:
            continue
        when = together(around, own)
        yield Taken(action, when)
        if isinstance(action, Group):
            yield from taken(action.actions, when)
        elif isinstance(action, Node):
            yield from taken(action.components, when)


def arguments(actions: Iterable[Action]) -> Iterator[Argument]:
    """Yield all arguments that actions declare, those of groups included."""
    return (each.action for each in taken(actions) if isinstance(each.action, Argument))


def together(around: tuple[Condition, ...], own: tuple[Condition, ...]) -> tuple[Condition, ...]:
    """Return conditions that hold together, each once, outer ones first."""
    return tuple(dict.fromkeys((*around, *own)))


def conditions_of(template: Template | None) -> tuple[Condition, ...] | None:
    """Return what must hold for a condition of a launch file to hold; nothing for always, None for never."""
    if template is None:
        return ()
    text = plain_text(template)
    if text is not None and text.strip().lower() in _TRUE | _FALSE:
        return None if text.strip().lower() in _FALSE else ()
    if len(template) == 1 and isinstance(template[0], Substitution):
        return _of(template[0])
    return (Condition("expression", written(template)),)


def _of(part: Substitution) -> tuple[Condition, ...] | None:
    match part.kind:
        case "and":
            return _all([conditions_of(arg) for arg in part.args])
        case "not":
            return _opposite(conditions_of(part.args[0]), part)
        case "equals":
            return _equal(part)
    return (_tested(part, TRUE),)


def _all(parts: list[tuple[Condition, ...] | None]) -> tuple[Condition, ...] | None:
    known = [part for part in parts if part is not None]
    return tuple(each for part in known for each in part) if len(known) == len(parts) else None


def _opposite(inner: tuple[Condition, ...] | None, part: Substitution) -> tuple[Condition, ...] | None:
    """What holds where one condition does not; of several that is one or another of them."""
    if inner is None:
        return ()
    if not inner:
        return None
    return (inner[0].opposite,) if len(inner) == 1 else (Condition("expression", written((part,))),)


def _equal(part: Substitution) -> tuple[Condition, ...]:
    """An argument or variable that has a value; anything else is an expression."""
    first, second = part.args[:2]
    for side, other in ((first, second), (second, first)):
        value = plain_text(other)
        if value is not None and len(side) == 1 and isinstance(side[0], Substitution):
            return (_tested(side[0], value),)
    return (Condition("expression", written((part,))),)


def _tested(part: Substitution, wanted: str) -> Condition:
    tests = _TESTED.get(part.kind)
    name = plain_text(part.args[0]) if tests is not None and part.args else None
    if tests is None or name is None:
        return Condition("expression", written((part,)), wanted)
    return Condition(tests, name, wanted)
