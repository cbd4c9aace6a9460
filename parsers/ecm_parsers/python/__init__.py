"""Python that is read and not run: one domain of values and one interpreter for every file that declares something."""
