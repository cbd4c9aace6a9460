"""The cache: what was parsed or extracted before, kept as data by its content; losing it costs only time."""
