"""Which declaration a Python name means: the path of the program, imports, re-exports, attributes of modules."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.tree import open_tree

CONTEXT = """
from std_msgs.msg import Bool
class Context:
    def __init__(self, node):
        node.create_publisher(Bool, '{topic}', 1)
"""
SCRIPT = """#!/usr/bin/env python3
import rclpy
{imports}
def main():
    rclpy.init()
    node = rclpy.create_node('n')
    {made}(node)
main()
"""
SETUP = "from setuptools import setup\nsetup(name='{0}', packages=[{1}], package_dir={{'': '{2}'}})\n"


def script(imports: str, made: str) -> str:
    """A program that makes an object."""
    return SCRIPT.format(imports=imports, made=made)


def published(workspace: Any) -> set[str]:
    """Topics that the program publishes."""
    found = workspace.modules().get("ecm.pkg.run")
    entries = found.signature.interfaces if found is not None else ()
    return {entry.name for entry in entries if entry.role == "publisher"}


def test_a_name_of_an_external_module_is_external(workspace: Any) -> None:
    """`rclpy.Context` is none of the tree, whatever a file beside is called (R2)."""
    files = {"scripts/run.py": script("", "rclpy.Context"), "scripts/context.py": CONTEXT.format(topic="own")}
    assert published(workspace.package(files)) == set()


def test_a_module_that_the_path_has_not_is_external(workspace: Any) -> None:
    """`from lie import Context` is an installed library, though a file of the tree is called like the name (R3)."""
    files = {
        "scripts/run.py": script("from lie import Context", "Context"),
        "util/Context.py": CONTEXT.format(topic="own"),
    }
    assert published(workspace.package(files)) == set()


def test_the_folder_of_the_script_comes_first(workspace: Any) -> None:
    """A module beside the script wins over one that another package installs (R4)."""
    workspace.package(
        {"src/context.py": CONTEXT.format(topic="other"), "setup.py": SETUP.format("other", "'context'", "src")},
        name="other",
    )
    files = {
        "scripts/run.py": script("from context import Context", "Context"),
        "scripts/context.py": CONTEXT.format(topic="own"),
    }
    workspace.package(files)
    manifest = workspace.root / "pkg/package.xml"
    text = manifest.read_text("utf-8")
    manifest.write_text(text.replace("<export>", "<depend>other</depend><export>"), "utf-8")
    assert published(workspace) == {"/own"}


def test_a_module_of_another_package_is_found_where_it_is_installed(workspace: Any) -> None:
    """What the setup.py of a package in sight installs is on the path; a file that it does not install is not."""
    files = {
        "src/helpers/__init__.py": "",
        "src/helpers/IO.py": CONTEXT.format(topic="io"),
        "setup.py": SETUP.format("other", "'helpers'", "src"),
    }
    workspace.package(files, name="other")
    workspace.package({"scripts/run.py": script("from helpers import IO", "IO.Context")})
    assert published(workspace) == {"/io"}


INIT = "from .context import Context\nfrom . import context as module\n"
IMPORTS = {
    "module attribute": ("from helpers import context, other", "context.Context"),
    "whole path": ("import helpers.context", "helpers.context.Context"),
    "other name of a module": ("import helpers.context as c", "c.Context"),
    "re-export": ("from helpers import Context", "Context"),
    "re-export under a module": ("import helpers", "helpers.Context"),
    "re-exported module": ("from helpers import module", "module.Context"),
    "star": ("from helpers import *", "Context"),
    "star of a module": ("from helpers.context import *", "Context"),
    "other name": ("from helpers.context import Context as C", "C"),
}


@pytest.mark.parametrize(("imports", "made"), IMPORTS.values(), ids=IMPORTS)
def test_an_attribute_is_followed_through_modules(workspace: Any, imports: str, made: str) -> None:
    """Modules, re-exports of `__init__.py` and star imports lead to the same class (R6)."""
    files = {
        "scripts/helpers/__init__.py": INIT,
        "scripts/helpers/context.py": CONTEXT.format(topic="own"),
        "lib/context.py": CONTEXT.format(topic="other"),
        "scripts/run.py": script(imports, made),
    }
    assert published(workspace.package(files)) == {"/own"}


def test_a_relative_import_means_the_package_around_it(workspace: Any) -> None:
    """One dot is the own package, two the one around it."""
    files = {
        "scripts/a/__init__.py": "",
        "scripts/a/context.py": CONTEXT.format(topic="outer"),
        "scripts/a/b/__init__.py": "from ..context import Context\n",
        "scripts/a/b/context.py": CONTEXT.format(topic="inner"),
        "scripts/run.py": script("from a.b import Context", "Context"),
    }
    assert published(workspace.package(files)) == {"/outer"}


def test_a_path_that_the_program_edits_may_lead_anywhere_once(workspace: Any) -> None:
    """Where the path is edited a module is looked for in the whole package, and counts if it is the only one."""
    imports = "import sys\nsys.path.append('../lib')\nfrom context import Context"
    files = {"scripts/run.py": script(imports, "Context"), "lib/context.py": CONTEXT.format(topic="lib")}
    assert published(workspace.package(files)) == {"/lib"}
    assert published(workspace.package({"more/context.py": CONTEXT.format(topic="more")})) == set()


def test_a_global_of_another_module_is_none_of_the_program(workspace: Any) -> None:
    """A global is that of the module, or one that it imports."""
    text = "import rclpy\nfrom std_msgs.msg import Bool\n{0}\ndef main():\n    node = rclpy.create_node('n')\n"
    text += "    node.create_publisher(Bool, TOPIC, 1)\nmain()\n"
    files = {"scripts/run.py": text.format(""), "scripts/other.py": "TOPIC = 'other'\n"}
    assert published(workspace.package(files)) == {"/{TOPIC}"}
    assert published(workspace.package({"scripts/run.py": text.format("from other import TOPIC")})) == {"/other"}


def test_a_static_method_is_called_through_its_class(workspace: Any) -> None:
    """`Context.open(node)` of an imported class runs that method."""
    text = "from std_msgs.msg import Bool\nclass Context:\n    @staticmethod\n    def open(node):\n"
    text += "        node.create_publisher(Bool, 'own', 1)\n"
    files = {"scripts/run.py": script("from context import Context", "Context.open"), "scripts/context.py": text}
    assert published(workspace.package(files)) == {"/own"}


def test_a_tree_that_is_a_package_itself_has_an_end(workspace: Any) -> None:
    """`__init__.py` at the root of the tree leaves no folder around it that could be asked."""
    script_text = script("from util.context import Context", "Context")
    files = {
        "__init__.py": "",
        "run.py": script_text,
        "setup.py": SETUP.format("pkg", "'util'", "."),
        "util/__init__.py": "",
    }
    workspace.package({**files, "util/context.py": CONTEXT.format(topic="own")})
    extraction = extract(open_tree(workspace.root / "pkg"), Options(jobs=1))
    modules = [module for package in extraction.packages for module in package.modules]
    assert "/own" in {entry.name for module in modules for entry in module.signature.interfaces}
