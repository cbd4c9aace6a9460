"""Real ROS 1 nodes under a real master, beside their contracts."""
