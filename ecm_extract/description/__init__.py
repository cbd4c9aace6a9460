"""Robot descriptions: xacro expanded without running it, then URDF, SRDF, ros2_control and simulator plugins."""
