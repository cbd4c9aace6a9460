"""A running ROS 2 graph by DDS alone, whatever the vendor of its peers: no rclpy, nothing written, called or set.

Needs the extra `dds` (Eclipse Cyclone DDS).
"""

from ecm_extract.observe.dds.session import watch_dds

__all__ = ["watch_dds"]
