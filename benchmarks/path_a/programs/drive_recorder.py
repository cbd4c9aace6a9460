#!/usr/bin/env python3
"""Print how far a base drives, and how often its commands turn round: drive_recorder.py SECONDS.

It begins when the base moves, or after ten seconds.
"""

import json
import sys
from itertools import pairwise

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

WARMUP = 10.0


def main():
    rospy.init_node("drive_recorder")
    ways, commands = [], []
    rospy.Subscriber("odom", Odometry, ways.append)
    rospy.Subscriber("cmd_vel", Twist, lambda message: commands.append(message.linear.x))
    end = rospy.get_time() + WARMUP
    while rospy.get_time() < end and not any(message.twist.twist.linear.x for message in ways):
        rospy.sleep(0.02)
    start, first = ways[-1].pose.pose.position.x, len(commands)
    rospy.sleep(float(sys.argv[1]))
    told = commands[first:]
    turns = sum(one * two < 0 for one, two in pairwise(told))
    print(json.dumps({"way": ways[-1].pose.pose.position.x - start, "commands": len(told), "turns": turns}))


main()
