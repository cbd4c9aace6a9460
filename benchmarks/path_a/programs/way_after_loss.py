#!/usr/bin/env python3
"""Print how far a base drives on after its only commander was killed: way_after_loss.py PID SECONDS."""

import json
import os
import signal
import sys

import rospy
from nav_msgs.msg import Odometry


def main():
    rospy.init_node("way_after_loss")
    ways = []
    rospy.Subscriber(
        "odom", Odometry, lambda message: ways.append((message.pose.pose.position.x, message.twist.twist.linear.x))
    )
    end = rospy.get_time() + 10.0
    while rospy.get_time() < end and not any(speed for _, speed in ways):
        rospy.sleep(0.02)
    rospy.sleep(1.0)
    before = ways[-1][0]
    os.kill(int(sys.argv[1]), signal.SIGKILL)
    rospy.sleep(float(sys.argv[2]))
    print(json.dumps({"way": ways[-1][0] - before, "speed": ways[-1][1]}))


main()
