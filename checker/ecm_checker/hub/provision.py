"""What a package provides: one public name, in a form that two releases can be compared by."""

from __future__ import annotations

from typing import Any, Final

import msgspec

from ecm_checker.contract import Confidence, Qos
from ecm_checker.hub.condition import Condition
from ecm_checker.hub.kinds import Kind, kinds
from ecm_checker.hub.roles import endpoint_kinds, module_kinds, value_kinds

HOLE: Final = "<*>"
"""A computed part of a name."""
ALIAS: Final = "alias"
"""Type of a class that only stands for another one."""
LAUNCHED: Final = "launched"
"""Facet of the name of a node that a launch file gives."""
SENT: Final = "sent"
"""Facet of a frame of which a program tells where it is."""
ABOVE: Final = "above"
"""Facet of a name that is none itself: names of its owner lie below it."""
Key = tuple[str, str, str, str, str]
Line = tuple[str, int]
"""A path and a line, 1-based."""


class Form(msgspec.Struct, frozen=True, gc=False):
    """One overload of a function or method.

    Attributes:
        types: of its parameters, without qualification, names, marks of by-value `const` and white space.
        required: how many parameters have no default.
        returns: return type in the same writing, for Python how many values where that is known; else empty.
        names: of the parameters; they count in Python only, where callers may name them.
        virtual: whether a consumer may override it. pure: whether a consumer must.
        override: whether a base class has it as well; such a form that is not virtual is final.
        deprecated: whether it is marked so.
        line: 1-based.
    """

    types: tuple[str, ...]
    required: int
    returns: str = ""
    names: tuple[str, ...] = ()
    virtual: bool = False
    pure: bool = False
    override: bool = False
    deprecated: bool = False
    line: int = 0

    @property
    def final(self) -> bool:
        """Whether it says itself that nobody may override it."""
        return self.override and not self.virtual

    @property
    def text(self) -> str:
        """The form as people write it."""
        shown = self.types if any(self.types) or not self.names else self.names
        arguments = ", ".join(item if index < self.required else f"{item} = ..." for index, item in enumerate(shown))
        return f"({arguments}) -> {self.returns}" if self.returns else f"({arguments})"


class Provision(msgspec.Struct, frozen=True, kw_only=True, gc=False):
    """One public name.

    Attributes:
        kind: a row of the vocabulary. package: that releases it.
        owner: module, class, message or file that has it; empty for what the package itself has.
        name: own name; computed parts are `<*>`.
        facet: what tells apart entities of one name: the direction of an endpoint.
        type: message type, parameter type, field type, or base class of a plugin.
        default: of a parameter, constant or launch argument, as data.
        forms: of a function or method.
        bases: of a class, qualified as far as the tree shows; of a node that a launch file names, what it runs;
            of a launch file, the programs, components and files of packages that it runs and includes.
        given: to each of its bases, the template arguments as `forms` write types; empty where none has any.
        qos: of a topic. ros: 1, 2 or None.
        deprecated: what its own source says about its end; None when it is not deprecated.
        path, line: where it is declared.
        node: name of the node that has an endpoint, None where no source says it; of a node, what owns its endpoints.
        sharers: owners beside `owner` that have an endpoint by the same line.
        others: message types that its owner has under that name as well, by a condition.
        confidence: how surely the name is known.
        advised: optional parameters of a function that it warns of when they are left out.
        open: whether it may have names below it that are not told, as a launch file that could not be read whole.
        written: hash of the line that declares it, without its name; empty where that says nothing.
        when: conditions under which it is there, as far as they are known; all of them hold then.
        needed: of a parameter, whether its module stops where nobody sets it.
        chain: the calls from the module to the one that makes it; more than one when a wrapper or library does.
    """

    kind: str
    package: str
    owner: str
    name: str
    path: str
    line: int
    facet: str = ""
    node: str | None = None
    sharers: tuple[str, ...] = ()
    others: tuple[str, ...] = ()
    chain: tuple[Line, ...] = ()
    type: str | None = None
    default: Any = None
    forms: tuple[Form, ...] = ()
    bases: tuple[str, ...] = ()
    given: tuple[tuple[str, ...], ...] = ()
    qos: Qos | None = None
    ros: int | None = None
    deprecated: str | None = None
    advised: tuple[str, ...] = ()
    confidence: Confidence = "literal"
    open: bool = False
    written: str = ""
    when: tuple[Condition, ...] = ()
    needed: bool = False

    @property
    def row(self) -> Kind:
        """What its kind is to others."""
        return kinds()[self.kind]

    @property
    def is_endpoint(self) -> bool:
        """Whether a module talks by it."""
        return self.kind in endpoint_kinds()

    @property
    def is_value(self) -> bool:
        """Whether a node keeps it, as a parameter."""
        return self.kind in value_kinds()

    @property
    def is_of_module(self) -> bool:
        """Whether a module has it by its code: an endpoint or a value."""
        return self.kind in module_kinds()

    @property
    def key(self) -> Key:
        """What makes it the same entity in another release."""
        return self.kind, self.package, self.owner, self.name, self.facet

    @property
    def is_python(self) -> bool:
        """Whether Python declares it."""
        return self.path.endswith(".py")

    @property
    def is_computed(self) -> bool:
        """Whether a part of its name is computed."""
        return HOLE in self.name

    @property
    def own_name(self) -> str:
        """Its name without the section of the interface that it is in."""
        return self.name.rpartition(".")[2]
