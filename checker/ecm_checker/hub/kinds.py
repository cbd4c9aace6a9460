"""The vocabulary: kinds of names, and ways in which a name is used. A new kind or use is a row."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from functools import cache
from importlib import resources
from typing import Any, Literal

import msgspec

from ecm_checker.finding import Who

World = Literal["graph", "package"]
Cause = Literal["package", "module", "program", "file"]
Breach = Literal["gone", "type", "qos", "claimed", "signature", "layout", "duty", "advice"]


class Kind(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A kind of name that packages provide.

    Attributes:
        who: what breaks when it is gone.
        world: whether any package may provide a name (`graph`), or only the one that is named with it (`package`).
        silence: what happens when its loss is ignored. gone: what is told of one that is gone.
        owned_by: kind of what tells all that it has of this kind; empty where any kind may.
        compared: whether releases are compared by it; else it only meets requirements.
        first: whether it reaches most people, so that its changes are told first, in the order of the rows.
        plural: where it is not the kind with an s.

        released: whether it is what is released: all other names go with it, and have it as their `package`.
        holds: whether others are parts of it, and go and come with it. part: whether it is such a part.
        symbol: whether C++ or Python declare it. included: whether they take it in by its name.
        is_file: whether it is a file, so that one that was there before is no new home of another.
        started: whether it is a program. runs: whether it is a process of the graph, which has endpoints.
        sets: whether it is a value that a file of parameters sets.
        policy: whether it is how an endpoint speaks, and no name of its own.
        called: whether it is called with arguments. inherited: whether a class has it by its bases as well.
        fixed: whether its value is what it means. default: whether it has a value where nobody gives one.
        duty: whether one without a value must be given one by who uses its owner.
        generated: whether builds make headers and modules of it. wire: whether both sides must have it alike.
        layout: whether one more or less alters the bytes of its owner.
        based: whether it is of a base class, which its name tells as well.

        qualified: whether its package or namespace is written before it.
        anywhere: whether it means the same wherever it is declared. of_file: whether each file has such for itself.
        common: whether others have the same name for other things. alone: whether only one has it, though any may.
        listed: whether all of a package stand in one file, so that its place tells nothing.
        own_copy: whether each owner has it for itself where a base declares it.
        by_line: whether the line that declares it tells what it is under another name.
        moves: whether one elsewhere may be the same.
        place: what stands before its own name, without which it is found elsewhere: a `scope`, `folder` or `section`.
        announced: where its end is told: at its `line`, the `head` of its file, a `comment` above it.
        keys: by what else requirements find it; a row of `ecm_checker.match`.
        explains: what is gone with it, so that what lies below needs no row of its own. below: what explains it.
        written_in: languages in which consumers write its name as it is.
    """

    who: Who
    world: World
    silence: str
    gone: str = "gone; code that uses it no longer builds"
    owned_by: str = ""
    compared: bool = True
    first: bool = False
    plural: str = ""
    released: bool = False
    holds: bool = False
    part: bool = False
    symbol: bool = False
    included: bool = False
    is_file: bool = False
    started: bool = False
    runs: bool = False
    sets: bool = False
    policy: bool = False
    called: bool = False
    inherited: bool = False
    fixed: bool = False
    default: bool = False
    duty: bool = False
    generated: bool = False
    wire: bool = False
    layout: bool = False
    based: bool = False
    qualified: bool = False
    anywhere: bool = False
    of_file: bool = False
    common: bool = False
    alone: bool = False
    listed: bool = False
    own_copy: bool = False
    by_line: bool = False
    moves: bool = True
    place: Literal["", "scope", "folder", "section"] = ""
    announced: Literal["", "line", "head", "comment"] = ""
    keys: str = ""
    explains: Cause | Literal[""] = ""
    below: tuple[Cause, ...] = ()
    written_in: tuple[str, ...] = ()

    @property
    def in_language(self) -> bool:
        """Whether it is of one language: nobody imports a header, or includes a module."""
        return self.symbol or self.included

    @property
    def is_placed(self) -> bool:
        """Whether some find it by its name and others by where it lies."""
        return self.is_file and self.holds

    @property
    def is_class(self) -> bool:
        """Whether it is a class."""
        return self.symbol and self.holds

    @property
    def contains(self) -> bool:
        """Whether what it has goes and comes with it."""
        return self.released or self.holds


class UseKind(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
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
        fit: how what is found under the name must fit; a row of `ecm_checker.match`, empty for no way.
        tells: what a file says by it of the names in it: a `header`, a `symbol` or a `module` that it takes in.
        leads: whether it gives a name another one. names_it: whether it gives what it starts a name.
        brings: whether it makes a package a dependency, with what that depends on.
        reads: whether it reads the value of what it means.
        same_ros: whether only a name of the same generation of ROS is meant.
        linted: whether rules of lint ask for it.
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
    fit: str = ""
    tells: Literal["", "header", "symbol", "module"] = ""
    leads: bool = False
    names_it: bool = False
    brings: bool = False
    reads: bool = False
    same_ros: bool = False
    linted: bool = False


@cache
def kinds() -> Mapping[str, Kind]:
    """Return the kinds of names by their word in documents."""
    return msgspec.convert(_table("kinds.toml"), dict[str, Kind])


@cache
def uses() -> Mapping[str, UseKind]:
    """Return the uses by their word in documents."""
    rows = _table("uses.toml") | _table("uses_of_launches.toml") | _table("uses_of_files.toml")
    return msgspec.convert(rows, dict[str, UseKind])


@cache
def _no_name() -> Kind:
    return Kind(who="source", world="package", silence="")


def row_of(kind: str) -> Kind:
    """Return the row of a kind; one that says nothing for what changes and is no name, as a field of a contract."""
    return kinds().get(kind) or _no_name()


def kinds_that(holds: Callable[[Kind], bool]) -> tuple[str, ...]:
    """Return the kinds of which something holds, in the order of the rows."""
    return tuple(word for word, row in kinds().items() if holds(row))


@cache
def containers() -> tuple[str, ...]:
    """Return the kinds with which others go and come, what is released first."""
    return kinds_that(lambda row: row.contains)


@cache
def linted_uses() -> frozenset[str]:
    """Return the uses that rules of lint ask for: what is read off sources for them."""
    return frozenset(word for word, row in uses().items() if row.linted)


def _table(name: str) -> dict[str, Any]:
    return tomllib.loads(resources.files("ecm_checker.hub").joinpath(name).read_text("utf-8"))
