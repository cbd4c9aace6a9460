"""The system document: everything about one launch as plain data (`ecm-extract/system/1`)."""

from __future__ import annotations

from typing import Any

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_checker.match.engine import Match

from ecm_extract.description.model import Description, Hardware
from ecm_extract.system.connections import connections
from ecm_extract.system.controllers import Controller
from ecm_extract.system.formats.json_values import json_value
from ecm_extract.system.graph import channels
from ecm_extract.system.model import Place
from ecm_extract.system.node_model import Endpoint, Parameter, SystemNode
from ecm_extract.system.system import System

SCHEMA = "ecm-extract/system/1"


def document(system: System) -> dict[str, Any]:
    """Return a system as plain data, in a stable order."""
    return {
        "schema": SCHEMA,
        "source": {"path": system.tree.label, "commit": system.tree.commit},
        "launch": _launch(system),
        "nodes": [_node(node) for node in system.nodes],
        "channels": [msgspec.to_builtins(channel) for channel in channels(system.nodes)],
        "connections": [_connection(each) for each in connections(system)],
        "frames": [
            {
                "parent": edge.parent,
                "child": edge.child,
                "fixed": edge.fixed,
                "source": edge.source,
                "evidence": place_data(edge.place),
            }
            for edge in system.frames
        ],
        "robots": [_robot(robot) for robot in system.robots],
        "controllers": [_controller(controller) for controller in system.controllers],
        "unread": [msgspec.to_builtins(entry) for entry in system.unread],
        "diagnostics": [msgspec.to_builtins(entry) for entry in system.diagnostics],
    }


def render(system: System) -> str:
    """Return the document as JSON text, indented by one space."""
    return msgspec.json.format(msgspec.json.encode(document(system)), indent=1).decode() + "\n"


def place_data(place: Place) -> dict[str, Any]:
    """Return a place as evidence."""
    return {"path": place.path, "line": place.line}


def _launch(system: System) -> dict[str, Any]:
    return {
        "complete": system.launched.is_complete,
        "files": system.launched.files,
        "arguments": [
            {
                "name": argument.name,
                "value": argument.value,
                "description": argument.description,
                "choices": list(argument.choices),
                "evidence": place_data(argument.place),
            }
            for argument in system.launched.arguments
        ],
    }


def _node(node: SystemNode) -> dict[str, Any]:
    instance = node.instance
    return {
        "name": node.name,
        "kind": instance.kind,
        "package": instance.package,
        "executable": instance.executable,
        "plugin": instance.plugin,
        "modules": [f"ecm.{entry.package}.{entry.name}" for entry in node.modules],
        "guessed": node.guessed,
        "ros": instance.ros,
        "container": instance.container,
        "conditional": instance.conditional or None,
        "respawn": instance.respawn,
        "evidence": place_data(instance.place),
        "remaps": [
            {"from": entry.source, "to": entry.target, "evidence": place_data(entry.place)} for entry in instance.remaps
        ],
        "endpoints": [_endpoint(entry) for entry in node.endpoints],
        "parameters": [_parameter(entry) for entry in node.parameters],
    }


def _endpoint(entry: Endpoint) -> dict[str, Any]:
    return {
        "role": entry.role,
        "name": entry.name,
        "type": entry.type,
        "before_remap": entry.before if entry.remap is not None else None,
        "parameters": list(entry.parameters),
        "known": entry.known,
        "qos": msgspec.to_builtins(entry.qos),
        "evidence": place_data(entry.place),
    }


def _connection(found: Match) -> dict[str, Any]:
    """What a node asks of the others; `conditions` must hold for it to be so, and nothing decides them yet."""
    wanted = found.requirement
    return {
        "node": wanted.by,
        "use": wanted.use,
        "kind": wanted.kind,
        "name": wanted.said,
        "type": wanted.type,
        "state": found.state,
        "breach": found.breach,
        "with": [_offer(each) for each in found.found],
        "conditions": [each.text for each in found.conditions],
        "evidence": [msgspec.to_builtins(at) for at in wanted.evidence],
    }


def _offer(entry: Provision) -> dict[str, Any]:
    return {"node": entry.owner, "type": entry.type, "evidence": {"path": entry.path, "line": entry.line}}


def _parameter(entry: Parameter) -> dict[str, Any]:
    return {
        "name": entry.name,
        "value": json_value(entry.value),
        "declared": entry.declared,
        "evidence": place_data(entry.place) if entry.place is not None else None,
    }


def _robot(robot: Description) -> dict[str, Any]:
    return {
        "name": robot.name,
        "path": robot.path,
        "links": len(robot.links),
        "joints": [{"name": joint.name, "type": joint.kind} for joint in robot.joints],
        "hardware": [_hardware(entry) for entry in robot.hardware],
    }


def _hardware(entry: Hardware) -> dict[str, Any]:
    return {
        "name": entry.name,
        "plugin": entry.plugin,
        "command_interfaces": [name for part in entry.parts for name in part.interfaces()],
        "state_interfaces": [f"{part.name}/{name}" for part in entry.parts for name in part.state],
        "evidence": {"path": entry.where.path, "line": entry.where.line},
    }


def _controller(entry: Controller) -> dict[str, Any]:
    return {
        "name": entry.name,
        "namespace": entry.namespace,
        "type": entry.type or None,
        "active": entry.active,
        "claims": None if entry.claims is None else list(entry.claims),
        "conditional": entry.conditional or None,
        "evidence": place_data(entry.place),
    }
