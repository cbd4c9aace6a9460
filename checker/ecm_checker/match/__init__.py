"""Matching: every requirement against every provision. One engine for lint, diff, check and system (DESIGN §3)."""
