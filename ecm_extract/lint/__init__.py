"""Lint: what is wrong in a workspace, on the line that causes it."""
