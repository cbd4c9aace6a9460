"""Under what a name is there, or a line runs: what is tested, and the value that is wanted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final, Literal

import msgspec

Tested = Literal["argument", "environment", "option", "expression", "parameter", "listeners", "macro"]
TRUE: Final = "true"
_SAID: Final = {"parameter": "parameter {}", "listeners": "listeners of {}"}
"""How what is tested is called; what is not named here is told by its name alone."""
_TRUE: Final = frozenset({"true", "1", "on", "yes"})
_FALSE: Final = frozenset({"false", "0", "off", "no"})


class Condition(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """One thing that must hold; several of a row must hold together.

    Attributes:
        tests: a launch or xacro `argument`, an `environment` variable, an `option` of the build, a ROS `parameter` of
            the module, whether a topic has `listeners`, a `macro` of the preprocessor, or an `expression`.
        name: of what is tested; of an expression its text as written; of listeners the topic.
        wanted: the value that it must have; `true` stands for every way to write it.
        negated: whether it must not have it.
    """

    tests: Tested
    name: str
    wanted: str = TRUE
    negated: bool = False

    def __post_init__(self) -> None:
        """Hold the default itself, which msgspec leaves out by identity: equal conditions are equal bytes."""
        if self.wanted == TRUE:
            msgspec.structs.force_setattr(self, "wanted", TRUE)

    @property
    def text(self) -> str:
        """The condition in words."""
        tested = _SAID.get(self.tests, "{}").format(self.name)
        if self.wanted == TRUE:
            return f"{'not ' if self.negated else ''}{tested}"
        wanted = self.wanted or '""'
        return f"{tested} {'!=' if self.negated else '='} {wanted}"

    @property
    def opposite(self) -> Condition:
        """What holds where this does not."""
        return msgspec.structs.replace(self, negated=not self.negated)

    def holds(self, given: Mapping[str, str], tests: Tested = "argument") -> bool | None:
        """Whether it holds; None where what is given does not tell.

        Args:
            given: values by name.
            tests: what they are values of.
        """
        value = given.get(self.name) if self.tests == tests else None
        same = None if value is None else _same(value, self.wanted)
        return None if same is None else same is not self.negated


def text_of(conditions: Iterable[Condition]) -> str:
    """Return conditions that hold together in words."""
    return " and ".join(each.text for each in conditions)


def all_hold(conditions: Iterable[Condition], given: Mapping[str, str]) -> bool | None:
    """Whether all conditions hold: False where one surely does not, None where one is not decided."""
    found = {each.holds(given) for each in conditions}
    return False if False in found else None if None in found else True


def _same(value: str, wanted: str) -> bool | None:
    """Whether a value is the one that is wanted; None for a text where a truth value is."""
    plain = value.strip().lower()
    if wanted == TRUE:
        return True if plain in _TRUE else False if plain in _FALSE else None
    return value.strip() == wanted
