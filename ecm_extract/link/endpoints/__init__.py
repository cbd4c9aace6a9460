"""What is told of an endpoint or a parameter: its type, QoS, default, and the conditions that it has."""
