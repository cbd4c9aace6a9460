"""What a simulator adds to a system: the endpoints that plugins and sensors of its robots make."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ecm_extract.description.model import Description
from ecm_extract.description.simulator import SimulatorEndpoint, simulator_endpoints
from ecm_extract.system.model import Instance, Place
from ecm_extract.system.node_model import Endpoint, SystemNode
from ecm_extract.system.programs import programs


def simulated_nodes(instances: Sequence[Instance], robots: Iterable[Description]) -> list[SystemNode]:
    """Return the nodes that a simulator makes, when one is started; a plugin of gz needs a bridge and is left out."""
    simulator = next((each for each in instances if _is_simulator(each)), None)
    if simulator is None:
        return []
    found: dict[str, list[Endpoint]] = {}
    for robot in robots:
        for entry in simulator_endpoints(robot, simulator.ros):
            if entry.transport == "ros":
                name = entry.node if entry.node.startswith("/") else f"/{entry.node or 'gazebo'}"
                found.setdefault(name, []).append(_endpoint(entry, name))
    return [_node(name, endpoints, simulator) for name, endpoints in found.items()]


def _is_simulator(instance: Instance) -> bool:
    words = {word.text for word in instance.arguments[:2]}
    known = programs().simulator
    return instance.package in known.packages or (instance.kind == "process" and bool(words & known.commands))


def _endpoint(entry: SimulatorEndpoint, node: str) -> Endpoint:
    return Endpoint(
        role=entry.role,
        name=entry.name,
        before=entry.name,
        type=entry.type,
        node=node,
        remap=None,
        parameters=(),
        known="{" not in entry.name,
        place=Place(*entry.where),
    )


def _node(name: str, endpoints: list[Endpoint], simulator: Instance) -> SystemNode:
    place = endpoints[0].place
    instance = Instance("simulated", simulator.package, "", "", name, "/", simulator.ros, place)
    instance.conditional = simulator.conditional
    return SystemNode(name, instance, endpoints=tuple(endpoints))
