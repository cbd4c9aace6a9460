"""What the plugins and sensors of a simulator create in the ROS graph, by a table of plugins."""

from __future__ import annotations

import functools
import posixpath
import re
from collections.abc import Iterator
from typing import Literal

import msgspec
from ecm_checker.hub.roles import Role

from ecm_extract.description.model import Description, Sensor, SimulatorPlugin, Where
from ecm_extract.shipped import shipped_as

_LIBRARY = re.compile(r"(?:.*/)?(?:lib)?(?P<name>[^/]+?)(?:\.so)?")
_PARAMETER = re.compile(r"\{(?P<name>\w+)\|(?P<default>[^}]*)\}")
_OWNER = re.compile(r"@(?P<name>plugin|sensor|link|robot|world)\b")
_TRUE = frozenset({"true", "1"})
Transport = Literal["ros", "gz"]


class SimulatorEndpoint(msgspec.Struct, frozen=True):
    """An endpoint that a simulator makes for a robot.

    Attributes:
        role: publisher, subscriber, service_server or tf_broadcast.
        name: absolute; `{world}` stands for what the description does not know.
        type: `package/msg/Name`; for gz the type that ros_gz_bridge gives it.
        frame: of the message; for tf_broadcast the parent. child: child frame, empty for none.
        transport: `ros`, or `gz` when a bridge is needed. source: library, or `sensor TYPE`. node: empty for gz.
    """

    role: Role
    name: str
    type: str
    frame: str
    child: str
    transport: Transport
    source: str
    node: str
    where: Where


class _Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One row of the table; see its head."""

    library: tuple[str, ...]
    role: Role
    topic: str
    type: str
    ros: int = 0
    sensor: str = ""
    frame: str = ""
    child: str = ""
    when: str = "true"
    transport: Transport = "ros"


class _SensorRow(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a sensor of gz publishes."""

    kind: tuple[str, ...]
    topic: str
    type: str


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    endpoint: tuple[_Row, ...]
    sensor: tuple[_SensorRow, ...]


def simulator_endpoints(description: Description, ros: int) -> list[SimulatorEndpoint]:
    """Return the endpoints that the simulator makes for a robot.

    Args:
        description: of the robot.
        ros: 1 or 2, for plugins that both know; a `<ros>` block in the plugin tells more.
    """
    made = [entry for plugin in description.plugins for entry in _of_plugin(plugin, description.name, ros)]
    return made + [entry for sensor in description.sensors for entry in _of_sensor(sensor, description.name)]


def library_name(filename: str) -> str:
    """Return the name of a plugin library without folder, `lib` and `.so`."""
    match = _LIBRARY.fullmatch(filename)
    return match["name"] if match else filename


@functools.cache
def _table() -> _Table:
    return shipped_as("description/simulator.toml", _Table)


def _of_plugin(plugin: SimulatorPlugin, robot: str, ros: int) -> Iterator[SimulatorEndpoint]:
    library = library_name(plugin.library)
    release = 2 if plugin.native else ros
    owners = {"plugin": plugin.name, "sensor": plugin.sensor, "link": plugin.reference, "robot": robot}
    for row in _table().endpoint:
        if library not in row.library or row.ros not in {0, release} or row.sensor not in plugin.sensor_kind:
            continue
        when, topic, kind, frame, child = (
            _filled(text, plugin.parameters, owners) for text in (row.when, row.topic, row.type, row.frame, row.child)
        )
        if topic and (when.lower() in _TRUE or when.startswith("{")):
            name = _named(plugin, topic) if row.transport == "ros" else _absolute("", topic)
            node = plugin.name if row.transport == "ros" else ""
            yield SimulatorEndpoint(
                row.role, name, _full_type(kind), frame, child, row.transport, library, node, plugin.where
            )


def _of_sensor(sensor: Sensor, robot: str) -> Iterator[SimulatorEndpoint]:
    """Yield what a sensor publishes by itself; one with a plugin of ROS speaks through that."""
    if sensor.plugins or not sensor.topic:
        return
    owners = {"sensor": sensor.name, "link": sensor.link, "robot": robot}
    parameters = {"topic": sensor.topic}
    for row in _table().sensor:
        if sensor.kind in row.kind:
            name = _absolute("", _filled(row.topic, parameters, owners))
            source = f"sensor {sensor.kind}"
            frame = sensor.frame or sensor.link
            yield SimulatorEndpoint("publisher", name, row.type, frame, "", "gz", source, "", sensor.where)


def _filled(text: str, parameters: dict[str, str], owners: dict[str, str]) -> str:
    """Fill in parameters, then the names of what the plugin belongs to; what is not known stays `{name}`."""
    with_defaults = _PARAMETER.sub(lambda match: parameters.get(match["name"]) or match["default"], text)
    return _OWNER.sub(lambda match: owners.get(match["name"]) or "{" + match["name"] + "}", with_defaults)


def _named(plugin: SimulatorPlugin, topic: str) -> str:
    """Return the absolute name after the remaps of the plugin."""
    name = _absolute(plugin.namespace, topic, plugin.name)
    for source, target in plugin.remaps:
        if _absolute(plugin.namespace, source, plugin.name) == name:
            return _absolute(plugin.namespace, target, plugin.name)
    return name


def _absolute(namespace: str, topic: str, node: str = "") -> str:
    space = "/" + namespace.strip("/")
    if topic.startswith("~"):
        topic = f"{node}/{topic[1:].lstrip('/')}"
    joined = topic if topic.startswith("/") else f"{space}/{topic}"
    return "/" + posixpath.normpath(joined).strip("/")


def _full_type(kind: str) -> str:
    """`sensor_msgs/LaserScan` is how plugins are given a type."""
    package, _, name = kind.rpartition("/")
    return f"{package}/msg/{name}" if package and "/" not in package else kind
