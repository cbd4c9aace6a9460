"""Methods that have another's signature and none of its name."""

from __future__ import annotations

import pytest
from ecm_checker.hub.provision import Form, Provision

from ecm_extract.diff.same_form import only_ones


@pytest.mark.parametrize(
    ("path", "new", "count"),
    [
        ("arm/tree.py", "set_tick", 0),
        ("arm/tree.py", "load_file_of_tree", 1),
        ("include/arm/tree.hpp", "set_tick", 1),
    ],
)
def test_a_signature_of_python_says_little(path: str, new: str, count: int) -> None:
    """`(self, request)` is that of half of all methods, where C++ writes the types."""
    forms = (Form(types=("",), required=1, returns="", names=("request",)),)
    owner = "arm.Tree"
    old, came = (
        Provision(kind="method", package="arm", owner=owner, name=name, forms=forms, path=path, line=1)
        for name in ("load_tree_of_file", new)
    )
    assert len(list(only_ones([old], [came], None))) == count
