#!/usr/bin/env python3
"""Count what a managed node says in each state: lifecycle_listener.py NODE TOPIC SECONDS; prints JSON."""

import json
import sys
import time

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from std_msgs.msg import String

ANSWER_S = 60.0


def changed(node, client, transition):
    request = ChangeState.Request()
    request.transition.id = transition
    future = client.call_async(request)
    rclpy.spin_until_future_complete(node, future, timeout_sec=ANSWER_S)
    return future.result() is not None and future.result().success


def heard(node, messages, seconds):
    """How many come within a time; what was under way before is not counted."""
    rclpy.spin_once(node, timeout_sec=0.5)
    messages.clear()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.05)
    return len(messages)


def main():
    name, topic, seconds = sys.argv[1], sys.argv[2], float(sys.argv[3])
    rclpy.init()
    node = rclpy.create_node("lifecycle_listener")
    messages = []
    node.create_subscription(String, topic, messages.append, 10)
    client = node.create_client(ChangeState, f"{name}/change_state")
    if not client.wait_for_service(ANSWER_S):
        sys.exit(f"{name} does not answer")
    found = {"unconfigured": heard(node, messages, seconds)}
    for state, transition in (
        ("inactive", Transition.TRANSITION_CONFIGURE),
        ("active", Transition.TRANSITION_ACTIVATE),
    ):
        if not changed(node, client, transition):
            sys.exit(f"{name} does not become {state}")
        found[state] = heard(node, messages, seconds)
    print(json.dumps(found), flush=True)


main()
