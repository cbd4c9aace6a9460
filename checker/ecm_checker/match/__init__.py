"""Matching: every requirement against every provision (DESIGN §3).

One engine for diff, check, the registry and the rules of lint that ask packages for the other side. What one system of
nodes has, by the names that its launch files give, is decided where these are evaluated: `ecm_extract.system`.
"""
