"""From facts of single files to names, types and values: what each module's calls mean together."""
