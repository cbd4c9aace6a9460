#!/usr/bin/env python3
"""The pairs of the fixture qos_pairs as real nodes: ros2_pairs.py write|read PACKAGE_FOLDER SAMPLES; prints JSON."""

import json
import sys
import time

import rclpy
from geometry_msgs.msg import Twist

WAIT_S = 60.0
GAP_S = 0.01
QUIET_S = 3.0


def write(samples):
    from qos_pairs.writer import Writer

    node = Writer()
    ends, limit = list(node.publishers), time.monotonic() + WAIT_S
    pairs = [end for end in ends if end.msg_type is Twist]
    while not any(end.get_subscription_count() for end in pairs) and time.monotonic() < limit:
        rclpy.spin_once(node, timeout_sec=0.1)
    for _ in range(20):
        rclpy.spin_once(node, timeout_sec=0.1)
    for _ in range(samples):
        for end in pairs:
            end.publish(Twist())
        rclpy.spin_once(node, timeout_sec=GAP_S)
    time.sleep(QUIET_S)


def read(samples):
    """Until nothing new comes; counts by topic."""
    from qos_pairs.reader import Reader

    node, counts = Reader(), {}
    for end in node.subscriptions:
        if end.msg_type is Twist:
            counts[end.topic_name] = 0
            end.callback = counting(counts, end.topic_name)
    limit, last, known = time.monotonic() + WAIT_S, time.monotonic(), 0
    while time.monotonic() < limit and (not known or time.monotonic() - last < QUIET_S):
        rclpy.spin_once(node, timeout_sec=0.05)
        if sum(counts.values()) != known:
            known, last = sum(counts.values()), time.monotonic()
    print(json.dumps(counts), flush=True)


def counting(counts, topic):
    def count(_message):
        counts[topic] += 1

    return count


def main():
    what, folder, samples = sys.argv[1:]
    sys.path.insert(0, folder)
    rclpy.init()
    {"write": write, "read": read}[what](int(samples))


main()
