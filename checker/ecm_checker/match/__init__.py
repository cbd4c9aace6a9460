"""Matching: every requirement against every provision (DESIGN §3).

One engine for diff, check, the registry, system and the rules of lint that ask for the other side. What one launch
starts is asked under the names that it has there: `ecm_extract.system` evaluates launch files, and gives what they
start as provisions and requirements of the engine.
"""
