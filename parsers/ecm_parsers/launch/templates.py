"""Templates and actions of launch files, as those need them that read the files and do not evaluate them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec

from ecm_parsers.launch.model import Action, Group, Node
from ecm_parsers.template import Substitution, Template

HOLE: Final = "{}"


class Found(msgspec.Struct, frozen=True):
    """A substitution, the line of the action that holds it, and whether no condition is around it."""

    line: int
    substitution: Substitution
    is_sure: bool


def written(template: Template) -> str:
    """Return a text in one writing, whatever the syntax of the launch file: `$(find a)/b`."""
    return "".join(part if isinstance(part, str) else _substitution(part) for part in template)


def _substitution(part: Substitution) -> str:
    return f"$({' '.join([part.kind, *(written(arg) for arg in part.args)])})"


def plain_text(template: Template | None) -> str | None:
    """Return a template that holds no substitution as text, None for any other."""
    if template is None or not all(isinstance(part, str) for part in template):
        return None
    return "".join(part for part in template if isinstance(part, str))


def holed(template: Template) -> str:
    """Return a template with `{}` for each substitution."""
    return "".join(part if isinstance(part, str) else HOLE for part in template)


def all_actions(actions: Iterable[Action]) -> Iterator[Action]:
    """Yield actions with those in groups and the components of containers, in order."""
    for action in actions:
        yield action
        if isinstance(action, Group):
            yield from all_actions(action.actions)
        elif isinstance(action, Node):
            yield from action.components


def substitutions(value: object, line: int = 0, *, is_sure: bool = True) -> Iterator[Found]:
    """Yield every substitution below a value; `line` is that of the action around it."""
    if isinstance(value, Substitution):
        yield Found(line, value, is_sure)
        value = value.args
    if isinstance(value, tuple | list):
        for item in value:
            yield from substitutions(item, line, is_sure=is_sure)
    elif isinstance(value, msgspec.Struct):
        line = getattr(value, "line", line)
        inside = is_sure and getattr(value, "condition", None) is None
        for name in value.__struct_fields__:
            yield from substitutions(getattr(value, name), line, is_sure=is_sure if name == "condition" else inside)
