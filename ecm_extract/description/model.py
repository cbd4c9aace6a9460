"""Facts of a robot description: links, joints, hardware with its interfaces, simulator plugins."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, NamedTuple


class Where(NamedTuple):
    """A line of a file: path in the tree, 1-based line."""

    path: str
    line: int


ProblemKind = Literal["macro", "file", "chosen_file", "argument", "late", "unread", "other"]
"""Of a problem: a macro or file that is not there, a file that an argument chooses, an argument that is left out, what
only the launch knows, a file that is there and cannot be read, anything else."""


@dataclass(frozen=True, slots=True)
class Problem:
    """What could not be expanded; `about` is the macro, file or argument, empty for none."""

    path: str
    line: int
    message: str
    kind: ProblemKind = "other"
    about: str = ""


@dataclass(frozen=True, slots=True)
class Link:
    """A link, which is a frame."""

    name: str
    where: Where


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint of URDF; `limits` holds lower, upper, effort and velocity as numbers where they are written.

    `origin` is where the child sits in the frame of its parent: x, y, z in metres, then roll, pitch and yaw in radians;
    None where one of them is no number.
    """

    name: str
    kind: str
    parent: str
    child: str
    limits: dict[str, float]
    mimics: str | None
    where: Where
    origin: tuple[float, ...] | None = None


@dataclass(frozen=True, slots=True)
class HardwarePart:
    """A joint, sensor or GPIO of a `<ros2_control>` block with the interfaces that it offers.

    `limits` holds lowest and highest command by interface, where they are written.
    """

    kind: Literal["joint", "sensor", "gpio"]
    name: str
    command: tuple[str, ...]
    state: tuple[str, ...]
    where: Where
    limits: dict[str, tuple[float | None, float | None]] = field(default_factory=dict)
    parameters: dict[str, str] = field(default_factory=dict)

    def interfaces(self) -> tuple[str, ...]:
        """Full names of its command interfaces, `part/interface`."""
        return tuple(f"{self.name}/{name}" for name in self.command)


@dataclass(frozen=True, slots=True)
class Hardware:
    """A `<ros2_control>` block: `kind` is system, actuator or sensor, `plugin` the class of its driver."""

    name: str
    kind: str
    plugin: str
    parameters: dict[str, str]
    parts: tuple[HardwarePart, ...]
    conditional: str
    where: Where


@dataclass(frozen=True, slots=True)
class Transmission:
    """A transmission: its joints, each with the hardware interfaces of ROS 1 that it offers, and its actuators."""

    name: str
    kind: str
    joints: tuple[tuple[str, tuple[str, ...]], ...]
    where: Where
    actuators: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class SimulatorPlugin:
    """A plugin of Gazebo or gz: its library and its name, which in ROS 2 is that of its node.

    Attributes:
        parameters: as text; the last one of a repeated parameter.
        files: parameter files for the nodes in it, in their order.
        remaps: of its `<ros>` block. namespace: of that block, in ROS 1 of `<robotNamespace>`.
        reference: the link it belongs to, empty for none. sensor, sensor_kind: the sensor around it.
        native: it has a `<ros>` block, which only ROS 2 knows.
    """

    library: str
    name: str
    parameters: dict[str, str]
    remaps: tuple[tuple[str, str], ...]
    namespace: str
    reference: str
    where: Where
    sensor: str = ""
    sensor_kind: str = ""
    native: bool = False
    files: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor of a link: its type (`camera`, `imu`, `ray` ...) and rate in hertz where it is written, its plugins.

    `frame` is that of its messages where gz is told one.
    """

    name: str
    kind: str
    link: str
    rate: float | None
    topic: str
    where: Where
    plugins: tuple[str, ...] = ()
    frame: str = ""


@dataclass(frozen=True, slots=True)
class PlanningGroup:
    """A group of an SRDF: its joints, links, chains as (base, tip), and the groups inside it."""

    name: str
    joints: tuple[str, ...]
    links: tuple[str, ...]
    chains: tuple[tuple[str, str], ...]
    groups: tuple[str, ...]
    where: Where


@dataclass(frozen=True, slots=True)
class EndEffector:
    """An end effector of an SRDF: its group, and the link that it is fixed to."""

    name: str
    group: str
    parent_link: str
    parent_group: str
    where: Where


@dataclass(frozen=True, slots=True)
class VirtualJoint:
    """A virtual joint of an SRDF, which ties the robot to a frame of the world."""

    name: str
    kind: str
    parent_frame: str
    child_link: str
    where: Where


@dataclass(frozen=True, slots=True)
class Semantics:
    """What an SRDF declares; `states` are (group, state), `disabled_pairs` counts link pairs without collision."""

    groups: tuple[PlanningGroup, ...]
    end_effectors: tuple[EndEffector, ...]
    virtual_joints: tuple[VirtualJoint, ...]
    passive_joints: tuple[str, ...]
    states: tuple[tuple[str, str], ...]
    disabled_pairs: int


@dataclass(slots=True)
class Description:
    """One robot description.

    Attributes:
        name: of the robot. path: of the file that was read. files: all files it consists of.
        problems: what could not be expanded. semantics: of an SRDF.
    """

    name: str
    path: str
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    hardware: tuple[Hardware, ...] = ()
    transmissions: tuple[Transmission, ...] = ()
    plugins: tuple[SimulatorPlugin, ...] = ()
    sensors: tuple[Sensor, ...] = ()
    files: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()
    semantics: Semantics | None = None
