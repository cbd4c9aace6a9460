"""Packages that only lie in one folder have nothing to do with each other, and cost no more than each alone."""

from __future__ import annotations

import cProfile
import pstats
from pathlib import Path
from typing import Any

import pytest
from workspaces import MANIFESTS, Workspace

from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

_MANY = 24
_PYTHON = """
from rclpy.node import Node
class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.helper = make_helper()
        self.helper.start(self, "{topic}")
"""
_HELPER = """
class Helper:
    def start(self, node, topic):
        self.pub = node.create_publisher(String, topic, 1)
    def stop(self):
        self.pub.publish(String())
"""
_CPP = """
class Driver : public rclcpp::Node {{
 public:
  Driver() : Node("driver") {{ auto helper = find(); helper->start("{topic}"); update(); }}
  void start(const std::string & topic) {{ pub_ = create_publisher<std_msgs::msg::String>(topic, 1); }}
  void update() {{ start("x"); }}
}};
"""


def _package(workspace: Workspace, name: str) -> None:
    files = {
        "src/driver.cpp": _CPP.format(topic=f"{name}_cpp"),
        f"{name}/driver.py": _PYTHON.format(topic=f"{name}_python"),
        f"{name}/helper.py": _HELPER,
    }
    workspace.package(files, name=name)


def _steps(root: Path) -> int:
    """The function calls that linking a folder takes: the same in every run."""
    packages = Reader(open_tree(root), False, (), None).read(1, None)
    forms = form_table()
    profile = cProfile.Profile()
    profile.runcall(Linker(packages, forms).link)
    return int(pstats.Stats(profile).total_calls)  # type: ignore[attr-defined]


@pytest.mark.parametrize("text", [_CPP.format(topic="left"), _PYTHON.format(topic="left")], ids=["C++", "Python"])
def test_an_object_of_unknown_type_is_of_a_package_that_is_seen(workspace: Any, text: str) -> None:
    """A call on an object of unknown type can mean a method of a package in sight only."""
    source = "src/left.cpp" if "rclcpp" in text else "left/left.py"
    workspace.package({source: text}, name="left")
    workspace.package({"src/right.cpp": _CPP.format(topic="right"), "right/helper.py": _HELPER}, name="right")
    for module in workspace.modules().values():
        assert {place.path.split("/")[0] for entry in module.signature.interfaces for place in entry.evidence} <= {
            module.ecm.package
        }


@pytest.mark.parametrize("link", ["<depend>util</depend>", ""], ids=["manifest", "include"])
def test_what_a_manifest_or_an_include_names_is_seen(workspace: Any, link: str) -> None:
    """A helper in another package is found by the manifest's word, the include's, or where no word can be read."""
    helper = "struct Util { void open(rclcpp::Node * n, const std::string & t) { n->create_publisher<A>(t, 1); } };"
    workspace.package({"include/util.hpp": helper}, name="util")
    include = '#include "util.hpp"\n' if not link else ""
    node = 'class D : public rclcpp::Node { D() : Node("d") { auto u = get(); u->open(this, "scan"); } };'
    workspace.package({"src/d.cpp": include + node, "CMakeLists.txt": "project(pkg)\n"})
    manifest = workspace.root / "pkg/package.xml"
    manifest.write_text(MANIFESTS[2].format(name="pkg").replace("<export>", f"{link}<export>"), "utf-8")
    assert "/scan" in {entry.name for entry in workspace.interfaces() if entry.role == "publisher"}


def test_what_lies_beside_costs_nothing(tmp_path: Path) -> None:
    """Linking many packages side by side takes as many steps as linking each alone, up to a tenth."""
    (tmp_path / "one").mkdir()
    _package(Workspace(tmp_path / "one"), "alone")
    (tmp_path / "many").mkdir()
    for index in range(_MANY):
        _package(Workspace(tmp_path / "many"), f"p{index}")
    assert _steps(tmp_path / "many") < 1.1 * _MANY * _steps(tmp_path / "one")


def test_a_module_inside_another_python_package_is_not_imported_by_its_last_name(workspace: Any) -> None:
    """`import logging` means the library, not `right.logging` of a package that happens to lie beside."""
    workspace.package({"left/left.py": "import logging\n" + _PYTHON.format(topic="left")}, name="left")
    workspace.package({"right/__init__.py": "", "right/logging.py": _HELPER}, name="right")
    interfaces = workspace.interfaces()
    assert {place.path for entry in interfaces for place in entry.evidence} <= {"right/right/logging.py"}
    assert "/left" not in {entry.name for entry in interfaces}
