"""The vocabulary: kinds of names, and ways in which a name is used. A new kind or use is a row."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any, Literal

import msgspec

from ecm_checker.finding import Who

World = Literal["graph", "package"]
Breach = Literal["gone", "type", "qos", "claimed", "signature", "layout", "duty", "advice"]


class Kind(msgspec.Struct, frozen=True):
    """A kind of name that packages provide.

    Attributes:
        who: what breaks when it is gone.
        world: whether any package may provide a name (`graph`), or only the one that is named with it (`package`).
        silence: what happens when its loss is ignored.
        owned_by: kind of what tells all that it has of this kind; empty where any kind may.
        compared: whether releases are compared by it; else it only meets requirements.
    """

    who: Who
    world: World
    silence: str
    owned_by: str = ""
    compared: bool = True


class UseKind(msgspec.Struct, frozen=True, kw_only=True):
    """A way in which a line depends on a name.

    Attributes:
        of: kinds of names that it may mean.
        facet: of what is provided, where one direction only counts: who subscribes needs what is published.
        names: how the name that is used and the one that is provided compare; a row of `ecm_checker.match`.
        phrase: what the line does, with fields of the requirement in braces.
        breaches: what a provider can do to it: `gone`, another `type`, `signature` or `layout`; a new `duty`
            (an argument that must be given); another `default`; `advice` that it does not follow; `qos` that is less
            than what is asked for. `claimed` is what another consumer takes for itself.
        warned: whether a deprecation of the name concerns the line.
        stated: whether a name that its package does not tell is missing: a method that may override may also be new,
            and packages do not tell all their files.
        built: whether the line is compiled or interpreted together with what it uses, in its own package.
        tolerated: version of ROS that goes on when the name is not there; 0 for none.
        launched: whether it is asked of what one launch starts, under the names that it has there.
        exclusive: whether one consumer may have a name only.
    """

    of: tuple[str, ...]
    names: str
    phrase: str
    facet: str = ""
    breaches: tuple[Breach, ...] = ("gone",)
    warned: bool = True
    stated: bool = True
    built: bool = False
    tolerated: int = 0
    launched: bool = False
    exclusive: bool = False


@cache
def kinds() -> Mapping[str, Kind]:
    """Return the kinds of names by their word in documents."""
    return msgspec.convert(_table("kinds.toml"), dict[str, Kind])


@cache
def uses() -> Mapping[str, UseKind]:
    """Return the uses by their word in documents."""
    rows = _table("uses.toml") | _table("uses_of_launches.toml") | _table("uses_of_files.toml")
    return msgspec.convert(rows, dict[str, UseKind])


def _table(name: str) -> dict[str, Any]:
    return tomllib.loads(resources.files("ecm_checker.hub").joinpath(name).read_text("utf-8"))
