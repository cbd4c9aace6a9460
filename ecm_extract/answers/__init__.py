"""Findings that a person has answered: in a committed file, or by a comment beside what the finding is about."""
