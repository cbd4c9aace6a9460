"""Findings for people and machines; each format is a file with `render(findings) -> str`."""
