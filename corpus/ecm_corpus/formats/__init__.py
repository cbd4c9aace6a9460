"""The score in words, as data, and as a plot."""
