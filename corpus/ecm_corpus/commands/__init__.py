"""Commands of the evaluation, one a file."""
