"""What a name means: build targets, include folders, namespaces and the Python path -> declarations of the tree.

A look-up ends in one declaration, in several that may be meant (`Ambiguous`), or outside the tree (`External`); the
nearest of that name never counts, and neither does the order in which files are read.
"""
