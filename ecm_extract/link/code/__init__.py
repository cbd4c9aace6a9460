"""The code of a tree as it is written: its units, their calls, types and texts, and what names they mention."""
