#!/usr/bin/env python3
"""Publish or receive a message whose type is made of text: renamed_field.py write|read FILE.msg TYPE COUNT.

The reader prints how many came and what rospy said of the connection.
"""

import json
import logging
import sys
from pathlib import Path

import rospy
from genpy.dynamic import generate_dynamic


class Said(logging.Handler):
    """Keeps what rospy says."""

    def __init__(self):
        super().__init__()
        self.lines = []

    def emit(self, record):
        self.lines.append(record.getMessage())


def main():
    role, file, name, count = sys.argv[1], Path(sys.argv[2]), sys.argv[3], int(sys.argv[4])
    kind = generate_dynamic(name, file.read_text())[name]
    rospy.init_node(role)
    said = Said()
    logging.getLogger("rosout").addHandler(said)
    if role == "write":
        write(kind, count, said)
    else:
        read(kind)


def write(kind, count, said):
    publisher = rospy.Publisher("limit", kind, queue_size=count)
    rospy.sleep(1.5)
    for number in range(count):
        publisher.publish(kind(float(number)))
        rospy.sleep(0.02)
    rospy.sleep(0.5)
    refused = [line for line in said.lines if "md5sum" in line]
    print(json.dumps({"said": refused[0] if refused else ""}))


def read(kind):
    got = []
    rospy.Subscriber("limit", kind, got.append)
    rospy.sleep(5.0)
    print(json.dumps({"got": len(got)}))


main()
