"""Uses of consumers: where a changed entity is named, and whether the name still holds there."""
