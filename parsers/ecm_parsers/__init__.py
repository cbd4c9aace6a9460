"""Readers of one artefact: bytes in, facts and diagnostics out. No I/O, no knowledge of other files."""
