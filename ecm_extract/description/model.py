"""Facts of a robot description: links, joints, hardware with its interfaces, simulator plugins."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, NamedTuple


class Where(NamedTuple):
    """A line of a file: path in the tree, 1-based line."""

    path: str
    line: int


@dataclass(frozen=True, slots=True)
class Link:
    """A link, which is a frame."""

    name: str
    where: Where


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint of URDF; `limits` holds lower, upper, effort and velocity as numbers where they are written."""

    name: str
    kind: str
    parent: str
    child: str
    limits: dict[str, float]
    mimics: str | None
    where: Where


@dataclass(frozen=True, slots=True)
class HardwarePart:
    """A joint, sensor or GPIO of a `<ros2_control>` block with the interfaces that it offers."""

    kind: Literal["joint", "sensor", "gpio"]
    name: str
    command: tuple[str, ...]
    state: tuple[str, ...]
    where: Where

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
    """A ROS 1 transmission: its joints, each with the hardware interfaces that it offers."""

    name: str
    kind: str
    joints: tuple[tuple[str, tuple[str, ...]], ...]
    where: Where


@dataclass(frozen=True, slots=True)
class SimulatorPlugin:
    """A plugin of Gazebo or gz: its library and class, its parameters as text, the sensor and link it belongs to."""

    library: str
    name: str
    parameters: dict[str, str]
    remaps: tuple[tuple[str, str], ...]
    namespace: str
    reference: str
    where: Where


@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor of a link: its type (`camera`, `imu`, `ray` ...) and rate in hertz where it is written."""

    name: str
    kind: str
    link: str
    rate: float | None
    topic: str
    where: Where


@dataclass(slots=True)
class Description:
    """One robot description.

    Attributes:
        name: of the robot. path: of the file that was read. files: all files it consists of.
        problems: (path, line, message).
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
    problems: tuple[tuple[str, int, str], ...] = field(default_factory=tuple)
