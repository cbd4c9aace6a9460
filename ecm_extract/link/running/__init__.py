"""What runs of the code make true: what variables hold at a place, by which calls, on which routes."""
