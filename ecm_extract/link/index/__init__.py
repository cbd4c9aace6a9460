"""All code of a tree at hand: its declarations by name, its calls, and what kinds of modules its classes are."""
