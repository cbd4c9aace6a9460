"""Trees and stores for tests of the cache."""

from __future__ import annotations

from pathlib import Path

from ecm_extract.cache.store import Store
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Extraction, Options
from ecm_extract.report.json_document import json_document
from ecm_extract.tree import open_tree

NODE = """#include <rclcpp/rclcpp.hpp>
class A : public rclcpp::Node {
 public:
  A() : Node("a") { pub_ = create_publisher<std_msgs::msg::String>("%s", 1); }
};
"""
MANIFEST = (
    '<package format="3"><name>pkg</name><version>1.0.0</version>'
    "<export><build_type>ament_cmake</build_type></export></package>"
)


def package(folder: Path, topic: str = "chatter") -> Path:
    """Write a package with one node, one Python node and one script that is not Python."""
    files = {
        "package.xml": MANIFEST,
        "src/a.cpp": NODE % topic,
        "scripts/run": "#!/bin/sh\n",
        "pkg/b.py": "import rclpy\nnode = rclpy.create_node('b')\nnode.create_client(T, 's')\n",
    }
    for path, text in files.items():
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, "utf-8")
    (folder / "scripts/run").chmod(0o755)
    return folder


def document(folder: Path, cache: bool = True) -> bytes:
    """The extract document of a folder."""
    return json_document(extraction(folder, cache))


def extraction(folder: Path, cache: bool = True) -> Extraction:
    """The extraction of a folder."""
    return extract(open_tree(folder), Options(jobs=1, cache=cache))


def keys(store: Store) -> list[str]:
    """First words of the keys that a store holds, sorted."""
    import sqlite3
    from contextlib import closing

    from ecm_extract.cache.store import FILE_NAME

    file = store.folder / FILE_NAME
    if not file.exists():
        return []
    with closing(sqlite3.connect(file)) as connection:
        return sorted(key.split()[0] for (key,) in connection.execute("SELECT key FROM entries"))
