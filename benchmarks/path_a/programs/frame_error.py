#!/usr/bin/env python3
"""Print where a point of one frame lies in another by tf2, and how far off its raw numbers are there.

frame_error.py PARENT CHILD X Y YAW POINT_X: the child stands at X, Y with a turn of YAW in the parent.
"""

import json
import math
import sys

import rospy
import tf2_geometry_msgs
import tf2_py
from geometry_msgs.msg import PointStamped, TransformStamped


def main():
    parent, child = sys.argv[1:3]
    x, y, yaw, point_x = map(float, sys.argv[3:7])
    sent = TransformStamped()
    sent.header.frame_id, sent.child_frame_id = parent, child
    sent.transform.translation.x, sent.transform.translation.y = x, y
    sent.transform.rotation.z, sent.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    buffer = tf2_py.BufferCore(rospy.Duration(10))
    buffer.set_transform_static(sent, "path_a")
    point = PointStamped()
    point.header.frame_id, point.point.x = parent, point_x
    there = tf2_geometry_msgs.do_transform_point(
        point, buffer.lookup_transform_core(child, parent, rospy.Time(0))
    ).point
    off = math.dist((there.x, there.y, there.z), (point_x, 0.0, 0.0))
    print(json.dumps({"x": round(there.x, 6), "y": round(there.y, 6), "z": round(there.z, 6), "off": round(off, 6)}))


main()
