"""What a package requires: one place that depends on a name which somebody, mostly another package, provides."""

from __future__ import annotations

from typing import Any, Final

import msgspec

from ecm_checker.contract import Evidence, Qos
from ecm_checker.finding import Certainty
from ecm_checker.hub.condition import Condition, text_of
from ecm_checker.hub.kinds import UseKind, uses

ONE_VALUE: Final = "1 value"


class Given(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """How a name is used: what has to fit what its provider takes and gives.

    Attributes:
        count: of positional arguments of a call; None where it is no call, or they cannot be counted.
        names: arguments that are given by name.
        takes: of a result: `2 values`, `1 value`.
        types: parameter types of an overriding method, as a provider's form has them. returns: its return type.
        forwarded: whether arguments of the surrounding file are handed on as well.
        inside: whether something inside of a member is used, so that it must stay of its type.
    """

    count: int | None = None
    names: tuple[str, ...] = ()
    takes: str = ""
    types: tuple[str, ...] | None = None
    returns: str = ""
    forwarded: bool = False
    inside: bool = False


class Requirement(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, gc=False):
    """One name that a package depends on.

    Attributes:
        use: what the line does with it; a row of the vocabulary, which tells the kinds that it may mean.
        kind: of the name, where one is meant; else the first of its use.
        name: as it is used, resolved as far as its own package tells. Computed parts are `{hole}`.
        package: that must provide it; None where any may.
        owner: of the name: a node or pattern of nodes, a message, a class, a launch file.
        scope: namespace or class in which C++ looks the owner up; empty where it is written in full.
        plugin: of a parameter, the class whose block it stands in; empty where it stands in none.
        target: of a remap the name that it leads to, of a component that of its container in full; of an include the
            path of the file, as written.
        type: message type, type of a given value.
        value: that is given, as data.
        qos: that is asked for, or offered.
        given: how it is called.
        ros: whose rules decide, 1 or 2; None where both do.
        certainty: `proved` where names are literal and resolved, `likely` where they may mean something else.
        conditions: under which the line runs, as written. when: the same by what is tested.
        by: who requires it: `node talker`, `launch_file bringup.launch.py`.
        said: what else the phrase of the use needs; nothing is decided by it.
        kept_for: the distribution whose folder the file lies in, beside the same file for all others; empty for none.
        ignored: words of comments on the line that answer breaks of it; an empty word answers any.
        evidence: the line first; of one name that a file uses in several lines all of them.
    """

    use: str
    kind: str
    package: str | None
    owner: str
    name: str
    type: str | None
    certainty: Certainty
    conditions: tuple[str, ...]
    by: str
    evidence: tuple[Evidence, ...]
    scope: str = ""
    plugin: str = ""
    target: str = ""
    value: Any = None
    qos: Qos | None = None
    given: Given | None = None
    ros: int | None = None
    said: str = ""
    kept_for: str = ""
    ignored: tuple[str, ...] = ()
    when: tuple[Condition, ...] = ()

    @property
    def row(self) -> UseKind:
        """What its use is."""
        return uses()[self.use]

    @property
    def phrase(self) -> str:
        """What the line does, in words, and under which condition."""
        does = self.row.phrase.format(
            name=self.name,
            owner=self.owner,
            package=self.package,
            target=self.target,
            said=self.said,
            last=self.name.rpartition(".")[2],
        )
        return f"{does} if {text_of(self.when)}" if self.when else does

    @property
    def needs(self) -> Certainty:
        """How surely the line needs the name: no more than `likely` below a condition that is not decided."""
        return "likely" if self.when and self.certainty == "proved" else self.certainty
