"""What runs, seen from outside and compared with the contracts of what should run.

The way of the data: a source (`ros1`, `dds`, `bag`) fills one model (`model`), `watch` puts it beside contracts, rules
in `rules` find where the two differ, `evidence` writes down who saw what. Nothing here publishes, calls or sets.
"""
