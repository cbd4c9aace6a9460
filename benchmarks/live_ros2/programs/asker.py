#!/usr/bin/env python3
"""What a ROS 2 graph says of its nodes, by the calls behind `ros2 node info`, `topic info -v` and `param dump`.

asker.py SECONDS: waits until a node is there and nothing new comes, at most so long; prints JSON.
"""

import json
import sys
import time

import rclpy
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.parameter import parameter_value_to_python

OWN = "_live_ros2_asker"
QUIET_S = 3.0
ANSWER_S = 15.0
ROLES = {
    "publisher": "get_publisher_names_and_types_by_node",
    "subscriber": "get_subscriber_names_and_types_by_node",
    "service_server": "get_service_names_and_types_by_node",
    "service_client": "get_client_names_and_types_by_node",
}
INFINITE_NS = 9_000_000_000 * 10**9


def nodes_of(asker):
    names = asker.get_node_names_and_namespaces()
    return sorted({(name, namespace) for name, namespace in names if not name.startswith("_")})


def ends_of(asker, name, namespace):
    return {
        role: [[topic, kind] for topic, kinds in getattr(asker, call)(name, namespace) for kind in kinds]
        for role, call in ROLES.items()
    }


def settled(asker, seconds):
    start, known, since = time.monotonic(), None, time.monotonic()
    while True:
        now = {node: ends_of(asker, *node) for node in nodes_of(asker)}
        if now != known:
            known, since = now, time.monotonic()
        if (known and time.monotonic() - since > QUIET_S) or time.monotonic() - start > seconds:
            return known
        rclpy.spin_once(asker, timeout_sec=0.2)


def milliseconds(duration):
    told = duration.nanoseconds
    return None if told == 0 or told >= INFINITE_NS else told / 1e6


def policies(profile):
    return {
        "reliability": profile.reliability.name.lower(),
        "durability": profile.durability.name.lower(),
        "history": profile.history.name.lower(),
        "depth": profile.depth,
        "deadline_ms": milliseconds(profile.deadline),
        "lifespan_ms": milliseconds(profile.lifespan),
        "liveliness": profile.liveliness.name.lower(),
        "lease_ms": milliseconds(profile.liveliness_lease_duration),
    }


def qos_of(asker, role, topic):
    call = asker.get_publishers_info_by_topic if role == "publisher" else asker.get_subscriptions_info_by_topic
    for info in call(topic):
        node = f"{info.node_namespace.rstrip('/')}/{info.node_name}"
        yield {"role": role, "name": topic, "node": node, "type": info.topic_type, **policies(info.qos_profile)}


def answer(asker, kind, name, request):
    client = asker.create_client(kind, name)
    try:
        if not client.wait_for_service(ANSWER_S):
            return None
        future = client.call_async(request)
        rclpy.spin_until_future_complete(asker, future, timeout_sec=ANSWER_S)
        return future.result()
    finally:
        asker.destroy_client(client)


def parameters_of(asker, node):
    """None when the node does not answer."""
    listed = answer(asker, ListParameters, f"{node}/list_parameters", ListParameters.Request())
    if listed is None:
        return None
    names = list(listed.result.names)
    got = answer(asker, GetParameters, f"{node}/get_parameters", GetParameters.Request(names=names))
    values = map(parameter_value_to_python, got.values) if got is not None else ()
    return {name: plain(value) for name, value in zip(names, values, strict=False)}


def plain(value):
    return list(map(plain, value)) if not isinstance(value, (str, bool, int, float, type(None))) else value


def main():
    rclpy.init()
    asker = rclpy.create_node(OWN, enable_rosout=False, start_parameter_services=False)
    found = settled(asker, float(sys.argv[1]))
    topics = sorted(
        {(role, end[0]) for ends in found.values() for role in ("publisher", "subscriber") for end in ends[role]}
    )
    names = {node: f"{node[1].rstrip('/')}/{node[0]}" for node in found}
    document = {
        "nodes": {names[node]: ends for node, ends in found.items()},
        "qos": [end for role, topic in topics for end in qos_of(asker, role, topic)],
        "parameters": {name: parameters_of(asker, name) for name in names.values()},
    }
    print(json.dumps(document), flush=True)


main()
