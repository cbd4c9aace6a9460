"""Texts of which parts are known only when what they stand in is run: at launch, or where a file is taken into use."""

from __future__ import annotations

from functools import cached_property
from typing import TypeAlias

import msgspec

MAX_SIZE = 5_000
"""Parts of a template, each counted as often as it is evaluated."""
MAX_DEPTH = 40
"""Substitutions inside each other."""


class Substitution(msgspec.Struct, frozen=True, tag=True, dict=True):
    """A part of a text that is not known yet.

    Attributes:
        kind: `arg` (name, default?), `env` (name, default?), `find` (package), `find_prefix` (package),
            `eval` (expression text), `dirname`, `anon` (name), `command` (words), `not`, `and`, `or`, `equals`, `in`,
            `lower`, `if` (condition, then, else), `has_parameters` (file, node), `file` (path), `yaml` (path),
            `files` (pattern), `unknown` (source text), or `too_large`, which stands for more than is read.
        args: templates, in the order above.
    """

    kind: str
    args: tuple[Template, ...] = ()

    @cached_property
    def size(self) -> int:
        """Parts on all levels, counted as often as they are evaluated; what is built of a cut text is too large too."""
        if self.kind == "too_large":
            return MAX_SIZE + 1
        return 1 + sum(part.size if isinstance(part, Substitution) else 1 for arg in self.args for part in arg)

    @cached_property
    def depth(self) -> int:
        """Levels of substitutions, this one included."""
        inner = (part.depth for arg in self.args for part in arg if isinstance(part, Substitution))
        return 1 + max(inner, default=0)


Template: TypeAlias = tuple[str | Substitution, ...]
TOO_LARGE: Template = (Substitution("too_large"),)
"""What stands for a template that is too large to be evaluated."""


def bounded(template: Template) -> Template:
    """Return a template, or `TOO_LARGE` where it has more parts or levels than a launch file needs."""
    found = [part for part in template if isinstance(part, Substitution)]
    fits = all(part.depth <= MAX_DEPTH for part in found)
    size = len(template) + sum(part.size for part in found)
    return template if fits and size <= MAX_SIZE else TOO_LARGE


def negated(condition: Template) -> Template:
    """Return the condition that holds where another does not."""
    return (Substitution("not", (condition,)),)


def both(first: Template | None, second: Template | None) -> Template | None:
    """Return the condition that two conditions make together."""
    if first is None or second is None:
        return first if second is None else second
    return (Substitution("and", (first, second)),)
