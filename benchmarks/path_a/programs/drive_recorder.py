#!/usr/bin/env python3
"""Print how far a base drives: drive_recorder.py SECONDS, from the moment at which it moves or WARMUP has passed."""

import json
import sys

import rospy
from nav_msgs.msg import Odometry

WARMUP = 10.0


def main():
    rospy.init_node("drive_recorder")
    ways = []
    rospy.Subscriber(
        "odom", Odometry, lambda message: ways.append((message.pose.pose.position.x, message.twist.twist.linear.x))
    )
    end = rospy.get_time() + WARMUP
    while rospy.get_time() < end and not any(speed for _, speed in ways):
        rospy.sleep(0.02)
    start = ways[-1][0] if ways else 0.0
    rospy.sleep(float(sys.argv[1]))
    print(json.dumps({"way": ways[-1][0] - start if ways else 0.0, "messages": len(ways)}))


main()
