"""The hub: what a package provides, what it requires, and the document that holds both.

Paper, section "Contract Model"; DESIGN §3 and §6. Whatever diff, lint, check and the registry ask of a package is in
its document, so that a stored document answers like the sources.
"""
