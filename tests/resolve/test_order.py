"""Contracts do not depend on the order in which files are read, nor on the name of a file that they do not need."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from order_of_files import ReadTree, differing, read_tree, shuffled, with_renamed

FIXTURES = Path(__file__).parents[2] / "fixtures"
TREES = ("arm_robot", "demo_robot", "path_a", "registry")


@cache
def tree(name: str) -> ReadTree:
    """A fixture, read once."""
    return read_tree(FIXTURES / name)


@pytest.mark.parametrize("name", TREES)
@settings(max_examples=5, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(seed=st.integers(0, 1_000_000))
def test_another_order_changes_nothing(name: str, seed: int) -> None:
    """Packages and files in any order give the same contracts (R8)."""
    assert differing(tree(name).contracts(), shuffled(tree(name), seed).contracts()) == []


@pytest.mark.parametrize("name", TREES)
def test_another_name_of_a_file_that_nothing_needs_changes_nothing(name: str) -> None:
    """A file without evidence that nothing names may be called anything (R8)."""
    first = tree(name).contracts()
    renamed = with_renamed(tree(name), first)
    assert renamed is None or differing(first, renamed[1].contracts()) == []


def test_classes_of_one_name_keep_apart_in_any_order(tmp_path: Path) -> None:
    """Two programs with a class of one name each have their own, whichever file is read first (R8)."""
    text = (
        'struct Part {{ Part(rclcpp::Node * n) {{ n->create_publisher<std_msgs::msg::Bool>("{0}", 1); }} }};\n'
        'int main(int c, char ** v) {{ auto n = std::make_shared<rclcpp::Node>("n"); Part part(n.get()); }}\n'
    )
    names = ("one", "two", "three")
    files = {f"src/{name}.cpp": text.format(name) for name in names}
    files["package.xml"] = "<package format='3'><name>pkg</name><version>1.0.0</version></package>"
    files["CMakeLists.txt"] = "project(pkg)\n" + "".join(f"add_executable({name} src/{name}.cpp)\n" for name in names)
    for path, content in files.items():
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_text(content, "utf-8")
    read = read_tree(tmp_path)
    first = read.contracts()
    topics = {name: {each for each in names if f'"/{each}"'.encode() in text} for name, text in first.items()}
    assert topics == {f"ecm.pkg.{name}": {name} for name in names}
    assert all(differing(first, shuffled(read, seed).contracts()) == [] for seed in range(6))
