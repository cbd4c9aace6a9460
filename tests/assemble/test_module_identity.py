"""What a module is called and of which kind it is."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from ecm_checker.contract import Contract, Identity, Source
from hypothesis import given
from hypothesis import strategies as st
from workspaces import Workspace

from ecm_extract.assemble.distinct_names import distinct

LAUNCH = "<launch><node pkg='nav' exec='nav'/></launch>"
CMAKE = "project(pkg)\nadd_library(pkg src/helper.cpp)\n"


def module(name: str, path: str, kind: str = "node") -> Contract:
    return Contract(Identity(f"ecm.pkg.{name}", "pkg", kind, None, Source(None, None, path), 2))


def ids(*contracts: Contract) -> dict[str, str]:
    return {each.ecm.source.path: each.ecm.module_id.removeprefix("ecm.pkg.") for each in distinct(contracts)}


@pytest.mark.parametrize(
    ("contracts", "names"),
    [
        ([module("talker", "src/a.cpp"), module("ear", "src/b.cpp")], ["talker", "ear"]),
        ([module("talker", "src/a.cpp"), module("talker", "src/b.cpp")], ["talker", "talker_b"]),
        ([module("talker", "a.hpp", "library"), module("talker", "b.hpp")], ["talker_a", "talker"]),
        ([module("talker", "a/talker.py"), module("talker", "b/talker.py")], ["talker", "talker_b_talker"]),
        ([module("t", "a.py"), module("t", "b.py"), module("t_b", "c.py")], ["t", "t_2", "t_b"]),
    ],
)
def test_modules_that_share_a_name(contracts: list[Contract], names: list[str]) -> None:
    """A number told nobody which one it is, and changed with every file that came before."""
    found = ids(*contracts)
    assert [found[each.ecm.source.path] for each in contracts] == names


@given(st.lists(st.tuples(st.sampled_from(["a", "a_b", "a_b_b"]), st.sampled_from(["b.py", "a.py", "b/b.py", "."]))))
def test_every_id_is_its_own(entries: list[tuple[str, str]]) -> None:
    """No module is lost, whatever the names are."""
    found = [each.ecm.module_id for each in distinct(module(name, path) for name, path in entries)]
    assert len(found) == len(set(found)) == len(entries)


@pytest.mark.parametrize(
    ("files", "kind"),
    [
        ({"launch/robot.launch.xml": LAUNCH}, "launch"),
        ({"launch/robot_launch.py": "def generate_launch_description():\n    return None\n"}, "launch"),
        (
            {
                "launch/robot.launch.xml": LAUNCH,
                "setup.py": "from setuptools import setup\nsetup()\n",
                "pkg/__init__.py": "",
            },
            "launch",
        ),
        ({"launch/robot.launch.xml": LAUNCH, "pkg/helper.py": "def help():\n    pass\n"}, "library"),
        ({"launch/robot.launch.xml": LAUNCH, "msg/A.msg": "int32 a\n"}, "interface"),
        ({"CMakeLists.txt": CMAKE, "src/helper.cpp": "int help() { return 1; }\n"}, "library"),
        ({"urdf/robot.urdf": "<robot name='r'/>"}, "library"),
    ],
)
def test_what_a_package_without_programs_is(files: Mapping[str, str], kind: str, workspace: Workspace) -> None:
    """A package of launch files has nothing but these to offer, and misses nothing of what only a node can declare."""
    (found,) = workspace.package(files).modules().values()
    assert found.ecm.kind == kind
    assert found.missing == ("versioning.compat_level",)
