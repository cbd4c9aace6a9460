"""A template of a launch file as text."""

from __future__ import annotations

from ecm_parsers.launch.model import Substitution, Template


def written(template: Template) -> str:
    """Return a text in one writing, whatever the syntax of the launch file: `$(find a)/b`."""
    return "".join(part if isinstance(part, str) else _substitution(part) for part in template)


def _substitution(part: Substitution) -> str:
    return f"$({' '.join([part.kind, *(written(arg) for arg in part.args)])})"
