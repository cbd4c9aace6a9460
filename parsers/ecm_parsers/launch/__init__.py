"""Launch files of ROS 1 and ROS 2, in XML, YAML and Python, as one vocabulary of actions; nothing is run."""
