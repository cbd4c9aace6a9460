"""What the readers of launch markup share: templates from attributes, conditions, parameters as text."""

from __future__ import annotations

from ecm_parsers.launch.entity import Entity
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.result import Diagnostic
from ecm_parsers.template import Substitution, Template


def template(entity: Entity, *names: str) -> Template:
    """Return the first of these attributes as a template, empty when none is given."""
    return parse_template(entity.get(*names))


def optional(entity: Entity, *names: str) -> Template | None:
    """Return the first of these attributes as a template, None when none is given."""
    text = entity.get(*names)
    return None if text is None else parse_template(text)


def condition(entity: Entity) -> Template | None:
    """Return what must hold for an element with `if` or `unless`."""
    wanted, unwanted = optional(entity, "if"), optional(entity, "unless")
    if unwanted is None:
        return wanted
    negated = Substitution("not", (unwanted,))
    return (negated,) if wanted is None else (Substitution("and", (wanted, (negated,))),)


def words(text: str | None) -> tuple[Template, ...]:
    """Return a command line as the words that blanks outside substitutions separate."""
    found: list[Template] = []
    current: list[str | Substitution] = []
    for part in parse_template(text):
        if isinstance(part, Substitution):
            current.append(part)
            continue
        first, *rest = part.split(" ")
        current += [first] if first else []
        for word in rest:
            if current:
                found.append(tuple(current))
            current = [word] if word else []
    if current:
        found.append(tuple(current))
    return tuple(found)


def incomplete(entity: Entity, needed: str) -> Diagnostic:
    """The diagnostic for an element without an attribute that it needs."""
    message = f"<{entity.tag}> has no `{needed}` and is skipped. Add it."
    return Diagnostic("warning", "launch-incomplete", entity.line, message)
