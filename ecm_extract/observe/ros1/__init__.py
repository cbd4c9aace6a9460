"""A running ROS 1 graph, by XML-RPC and TCPROS alone: no rospy, nothing registered, published, called or set."""

from ecm_extract.observe.ros1.session import watch_ros1

__all__ = ["watch_ros1"]
