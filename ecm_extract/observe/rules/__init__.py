"""One file per rule; the file is named after the id. Adding a rule is adding a file."""
