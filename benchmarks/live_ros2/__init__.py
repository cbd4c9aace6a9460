"""Real ROS 2 nodes of whichever ROS 2 is sourced, beside their contracts."""
