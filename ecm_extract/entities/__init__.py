"""Public entities: the names that others can depend on, of every kind, read off one tree."""
