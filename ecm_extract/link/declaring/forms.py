"""The table of forms: which call declares what, and where its type, name, QoS and default stand.

Rows live in `forms/<framework>.toml`; users add rows in `ecm.toml`. A position is `arg:N` (from 0), `kw:NAME`,
`template:N`, `callback:N` (the message type of the callback in argument N), `field:N.a.b` (a field of argument N) or
several joined by `|`.
"""

from __future__ import annotations

import re
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Literal

import msgspec
from ecm_checker.hub.roles import Role, RoleKind, roles
from ecm_parsers.source.expr import Name

_POSITION = re.compile(
    r"(?:arg|text|template|callback|service_callback|receiver|variable|request):\d+|kw:\w+|field:\d+(?:\.\w+)+"
)

Match = Literal["method", "function", "construct"]


class Form(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One row.

    Attributes:
        callee: method or function name, or a qualified function or class name (`::` in C++, dots in Python).
        role: what the call makes of its module.
        match: `method` of any object, `function` by qualified name, `construct` for objects of a class.
        language: `cpp` or `python`. ros: 1, 2 or 0 for both.
        name: position of the ROS name. type: position of the type, or a fixed `package/kind/Name`; of a parameter of
            rclpy the position of its descriptor.
        qos: position of the QoS profile or queue size. default: position of a parameter's default.
        fallback: the default holds only for a parameter that the node does not declare, and is nobody else's.
        out: position of the variable that receives a parameter's value. given: position of the value that it is set to.
        receiver: last names of the classes whose objects have the method, qualified ones where others are called alike;
            empty for any.
        below: the member of its object that stands before the name, with a point between them.
        gives: what the method returns, as a qualified class name: a sign of the class of an object of unknown type.
        node: position of the node or node handle when it is an argument.
        interfaces: how many interfaces of a node may stand in place of the node, in front of the name.
        fixed: the name, when the form implies it; `~/x` is private, or below the handle at `node` where one is given.
        place: what the endpoint is called where the name that is given is not its own: `{name}/get`,
            `{parent}/info`; `~/{name}` is private where no handle is given.
        beside: the row holds in addition to the one that a call is.
        flag: position of what has to be true for the row to hold.
        profile: preset of the QoS, when the form implies it.
        items: position of a list of (name, default) pairs, for calls that declare many.
        min_args: fewer positional arguments are another function.
        frame: positions of frames, for transforms.
        prefix: the method that gives the object a prefix for the names of its later calls.
        latch: position of the flag that keeps the last message for who comes later (ROS 1).
        undeclared: the row holds only where the node takes parameters that it does not declare.
        reads: the call declares nothing, and its row holds only where somebody does or the node takes any.
        asks: the call that only tells whether the parameter is set; both may stand in a test that ends the node.
        transport: position of the transport of a subscription, or `hints` where an object among the arguments has it.
        needed: a call without a default (C++: with a template argument) stops the node where nobody sets the parameter.
    """

    callee: str
    role: Role
    match: Match = "method"
    language: Literal["cpp", "python"] = "cpp"
    ros: Literal[0, 1, 2] = 0
    name: str = ""
    type: str = ""
    qos: str = ""
    default: str = ""
    fallback: bool = False
    out: str = ""
    given: str = ""
    receiver: tuple[str, ...] = ()
    below: str = ""
    gives: str = ""
    node: str = ""
    interfaces: int = 0
    fixed: str = ""
    place: str = ""
    beside: bool = False
    flag: str = ""
    profile: str = ""
    items: str = ""
    min_args: int = 0
    frame: str = ""
    prefix: str = ""
    latch: str = ""
    undeclared: bool = False
    reads: bool = False
    needed: bool = False
    asks: str = ""
    transport: str = ""

    def __post_init__(self) -> None:
        """Refuse positions that mean nothing, so that a misspelt one is an error and not a form without effect."""
        columns = (
            self.name,
            self.type,
            self.qos,
            self.default,
            self.out,
            self.given,
            self.items,
            self.node,
            self.frame,
            self.latch,
            self.flag,
        )
        for column in columns:
            if column and not _is_position(column):
                known = "arg:N, kw:NAME, text:N, template:N, callback:N or field:N.a.b"
                message = f"'{column}' is no position: write {known}"
                raise ValueError(message)

    @property
    def row(self) -> RoleKind:
        """What its role is to others."""
        return roles()[self.role]

    @property
    def implied(self) -> Name | None:
        """The QoS preset that its call implies, as an expression."""
        return Name(self.profile) if self.profile else None

    @property
    def last(self) -> str:
        """Last part of the callee's name."""
        return self.callee.replace("::", ".").rsplit(".", 1)[-1]


FormTable = Mapping[str, Sequence[Form]]


@cache
def bundled_forms() -> tuple[Form, ...]:
    """Return the rows that ship with the package."""
    folder = resources.files("ecm_extract.link.declaring") / "forms"
    names = sorted(entry.name for entry in folder.iterdir() if entry.name.endswith(".toml"))
    return tuple(form for name in names for form in _rows((folder / name).read_text("utf-8")))


def _rows(text: str) -> list[Form]:
    return msgspec.convert(tomllib.loads(text)["form"], list[Form])


def form_table(extra: Iterable[Form] = ()) -> FormTable:
    """Return all rows by the last part of their callee, the user's first."""
    table: dict[str, list[Form]] = defaultdict(list)
    for form in (*extra, *bundled_forms()):
        table[form.last].append(form)
    return table


def _is_position(column: str) -> bool:
    return "/" in column or all(_POSITION.fullmatch(part) for part in column.split("|"))
