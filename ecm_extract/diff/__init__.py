"""Comparison of two releases: entities paired, changes named, consumers that break, the verdict."""
