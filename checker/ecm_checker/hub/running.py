"""What launch files of any package need of a package to tell what runs: its modules, programs, plugins and files.

The contracts of its modules say what a name is in the namespace `/`; these rows say what it is anywhere.
"""

from __future__ import annotations

from typing import Any

import msgspec

from ecm_checker.contract import Qos
from ecm_checker.hub.local_name import LocalName, shown
from ecm_checker.hub.name_notation import read_name
from ecm_checker.hub.roles import Role, RoleKind, roles


class RunningEndpoint(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """An endpoint or parameter of a module, wherever it is started.

    Attributes:
        role: as in the contract. name: in the namespace `/`; raw: as written, where that is another.
        local: names for any namespace and node, where they are not `name`; one without open parts as a text. Documents
            of older versions hold all of them as texts (`ecm_checker.hub.name_notation`).
        type: `package/msg|srv|action/Name`, or the type of a parameter; None when not known.
        default: of a parameter, as data. frame: of a transform `parent <- child`.
        path, line: where it is declared.
    """

    role: Role
    name: str
    path: str
    line: int
    raw: str | None = None
    local: tuple[str | LocalName, ...] = ()
    type: str | None = None
    qos: Qos | None = None
    default: Any = None
    frame: str | None = None

    @property
    def row(self) -> RoleKind:
        """What its role is to others."""
        return roles()[self.role]

    @property
    def raw_name(self) -> str:
        """The name as written."""
        return self.name if self.raw is None else self.raw

    @property
    def local_names(self) -> tuple[LocalName, ...]:
        """Its names for any namespace and node."""
        return tuple(as_local(each) for each in self.local) or (LocalName((self.name,)),)


def as_local(written: str | LocalName) -> LocalName:
    """Return a name as it is written in a document."""
    return read_name(written) if isinstance(written, str) else written


def as_written(name: LocalName) -> str | LocalName:
    """Return how a document holds a name: a text where nothing of it is open, and nothing looks as if it were."""
    is_open = name.space or any(not isinstance(part, str) or "{" in part for part in name.parts)
    return name if is_open else shown(name.parts)


class Part(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """A module that runs in a program or inside another module.

    Attributes:
        package: of the module. at: its place among the modules of that package.
        name: what its maker calls its node; None when the module itself decides.
        nested: whether its node is in a namespace of that name.
    """

    package: str
    at: int
    name: str | None = None
    nested: bool = False


class RunningModule(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """A module as it is started.

    Attributes:
        package, name: as in its contract, unless two of one name are told apart there.
        path, line: where it is declared.
        cls: qualified name of its class; empty for a program or library. is_program: whether it has a main function.
        node: name of its node, as the module itself says it. lifecycle: whether it works when active only.
        endpoints: and parameters. claims: command interfaces that it claims, as `local` of endpoints; None for no
            controller.
        parts: modules that it makes inside itself. loads: base classes of which it loads every plugin.
    """

    package: str
    name: str
    path: str
    line: int
    cls: str = ""
    is_program: bool = False
    node: str | None = None
    lifecycle: bool = False
    endpoints: tuple[RunningEndpoint, ...] = ()
    claims: tuple[str | LocalName, ...] | None = None
    parts: tuple[Part, ...] = ()
    loads: tuple[str, ...] = ()


class DeclaredPlugin(msgspec.Struct, frozen=True, gc=False):
    """A class that a plugin description declares: lookup name, class and base class as written there."""

    lookup: str
    cls: str
    base: str


class CopiedPath(msgspec.Struct, frozen=True, gc=False):
    """A path as it is named in the share folder, taken for the folder of the package, and what is copied there."""

    named: str
    source: str


class Running(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What of a package runs, and the files that launch files read.

    Attributes:
        modules: in a stable order, which `Part.at` counts from 0.
        programs: by the name of the executable what runs in it.
        plugins: that it declares. copied: files that its share folder has from elsewhere in the tree.
        texts: content of launch files, parameter files and descriptions, and of modules that launch files import.
    """

    modules: tuple[RunningModule, ...] = ()
    programs: dict[str, tuple[Part, ...]] = {}
    plugins: tuple[DeclaredPlugin, ...] = ()
    copied: tuple[CopiedPath, ...] = ()
    texts: dict[str, str] = {}
