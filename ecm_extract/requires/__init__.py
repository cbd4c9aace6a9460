"""What packages require of others, read off one linked tree: one file for each artefact that depends on names."""
