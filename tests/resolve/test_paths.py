"""Paths from the root of a tree."""

from __future__ import annotations

from posixpath import join, normpath

from hypothesis import given
from hypothesis import strategies as st

from ecm_extract.resolve.paths import tree_path

_PARTS = st.lists(st.sampled_from(["a", "b.c", ".", "..", "", "d..e", ".f"]), max_size=4).map("/".join)


@given(_PARTS.filter(lambda text: not text.startswith("/")), _PARTS.filter(lambda text: not text.startswith("/")))
def test_a_path_is_that_of_posix_and_the_root_is_empty(folder: str, name: str) -> None:
    """Most paths are joined without a look at each part; the result is the same."""
    assert (tree_path(folder, name) or ".") == normpath(join(folder, name))
