"""RViz configurations: the display, panel and tool classes that they name.

Source: rviz and rviz_common load `Class: package/Name` by pluginlib.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.yaml_tree import Entry, Mapping, Node, Scalar, Sequence, parse_yaml

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import Tree

SUFFIX: Final = ".rviz"
_KEY: Final = "Class"
_CLASS: Final = re.compile(r"[A-Za-z_]\w*/\w+")


def rviz_requirements(tree: Tree, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield the plugins that the RViz configurations of a package name; those of tests are left out."""
    listed = (entry.path for entry in facts.root.files if entry.path.endswith(SUFFIX))
    paths = sorted(path for path in listed if not is_test_path(path, facts.root.path))
    for path, data in tree.read_many(paths) if paths else ():
        for document in parse_yaml(data).facts:
            for entry in _entries(document):
                if entry.key == _KEY and isinstance(entry.value, Scalar) and _CLASS.fullmatch(entry.value.text):
                    yield required("loads_plugin", entry.value.text, Place(path, entry.line, f"file {path}"))


def _entries(node: Node) -> Iterator[Entry]:
    """All entries of a document, whatever holds them."""
    if isinstance(node, Mapping):
        for entry in node.entries:
            yield entry
            yield from _entries(entry.value)
    elif isinstance(node, Sequence):
        for item in node.items:
            yield from _entries(item)
