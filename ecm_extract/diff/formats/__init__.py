"""Comparisons written down: for people, for programs, for a migration guide, for a pull request."""
