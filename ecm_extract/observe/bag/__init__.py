"""A recording as an observation: ROS 1 bags, and ROS 2 bags in sqlite3 or mcap."""

from ecm_extract.observe.bag.read import observe_bags

__all__ = ["observe_bags"]
