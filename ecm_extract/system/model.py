"""What a launch file starts: instances with the names, remaps and parameters that the launch gives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, NamedTuple


class Place(NamedTuple):
    """A line of a file: path in the tree, 1-based line."""

    path: str
    line: int


class Text(NamedTuple):
    """A text after substitution.

    Attributes:
        text: as it is. known: whether no part is `{name}`, which stands for what only the launch knows.
        emptied: a substitution gave nothing to it, as a default does that waits for somebody to fill it in.
    """

    text: str
    known: bool = True
    emptied: bool = False

    def __bool__(self) -> bool:
        """Whether there is any text."""
        return bool(self.text)


class Given(NamedTuple):
    """What a person gives a launch: arguments and environment variables by name."""

    arguments: Mapping[str, str] = MappingProxyType({})
    environment: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Remapping:
    """One name becomes another for an instance; both as written after substitution."""

    source: str
    target: str
    place: Place


@dataclass(frozen=True, slots=True)
class Setting:
    """A parameter that an instance is given.

    Attributes:
        name: `a.b` in ROS 2, absolute `/ns/node/a/b` in ROS 1.
        value: plain data; text may hold `{name}` where the launch decides.
        place: of the line that sets it, in a launch or parameter file.
        node: name pattern of the parameter file's section; None where the launch names the node.
    """

    name: str
    value: Any
    place: Place
    node: str | None = None


@dataclass(slots=True)
class Instance:
    """One node that a launch starts.

    Attributes:
        kind: node, lifecycle_node, container, component, nodelet, controller or process.
        package, executable, plugin: whose code it is; empty where it does not apply.
        name: of the node; None when the program itself decides.
        namespace: absolute.
        remaps: in the order in which they are tried. settings: later ones win.
        container: name of the container that loads it.
        conditional: condition that is known at launch only; empty when it is started for sure.
        respawn, required: as the launch says; None when it does not say.
        arguments: its command line. place: of the action that starts it.
        ros: 1 or 2. missing_files: parameter files that are not in the tree.
    """

    kind: str
    package: str
    executable: str
    plugin: str
    name: str | None
    namespace: str
    ros: int
    place: Place
    remaps: tuple[Remapping, ...] = ()
    settings: tuple[Setting, ...] = ()
    container: str | None = None
    conditional: str = ""
    respawn: bool | None = None
    required: bool | None = None
    arguments: tuple[Text, ...] = ()
    missing_files: tuple[str, ...] = ()

    @property
    def full_name(self) -> str | None:
        """Absolute name of the node, None when the program decides it."""
        return None if self.name is None else join(self.namespace, self.name)


@dataclass(frozen=True, slots=True)
class LaunchArgument:
    """An argument of the launch file that was started, with its value here."""

    name: str
    value: str | None
    description: str
    choices: tuple[str, ...]
    place: Place


@dataclass(slots=True)
class Launched:
    """Everything that launch files start, and what could not be known.

    Attributes:
        files: launch files that were read, in order.
        globals: ROS 1 parameters outside of nodes.
        is_complete: False when something was left out for its size or since it is malformed; the diagnostics say what.
        is_closed: False when more is started than is known, as by a file outside of the tree.
    """

    files: list[str] = field(default_factory=list)
    arguments: list[LaunchArgument] = field(default_factory=list)
    instances: list[Instance] = field(default_factory=list)
    globals: list[Setting] = field(default_factory=list)
    is_complete: bool = True
    is_closed: bool = True


def join(namespace: str, name: str) -> str:
    """Return a name below a namespace, absolute; an absolute name stays."""
    full = name if name.startswith("/") else f"{namespace}/{name}"
    while "//" in full:
        full = full.replace("//", "/")
    full = full if full.startswith("/") else f"/{full}"
    return full if full == "/" else full.rstrip("/")
