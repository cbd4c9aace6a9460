"""The instance graph for people and machines; each format is a file with `render(system) -> str`."""
