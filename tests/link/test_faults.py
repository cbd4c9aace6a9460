"""An error that nobody expected costs what one function declares, and that is said."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.infer.interpreter import Interpreter
from ecm_extract.link.running.faults import CODE
from ecm_extract.tree import open_tree

SOURCE = """
#include <rclcpp/rclcpp.hpp>
std::string broken(std::string name) { name += "_x"; return name; }
int main() {
  auto node = std::make_shared<rclcpp::Node>("demo");
  node->declare_parameter(broken("rate"), 10);
  node->declare_parameter("size", 10);
}
"""


@pytest.fixture
def stumbling(monkeypatch: pytest.MonkeyPatch) -> None:
    """An interpreter that fails in one function."""
    result = Interpreter.result

    def fails(self: Interpreter) -> Any:
        if self.frame.env.func.fact.name == "broken":
            raise IndexError
        return result(self)

    monkeypatch.setattr(Interpreter, "result", fails)
    monkeypatch.delenv("ECM_DEBUG", raising=False)


@pytest.mark.usefixtures("stumbling")
def test_a_fault_costs_one_function_and_is_a_gap(workspace: Any) -> None:
    """The other parameter is told, the file is not read to its end."""
    workspace.package({"src/d.cpp": SOURCE, "CMakeLists.txt": "add_executable(d src/d.cpp)"})
    found = extract(open_tree(workspace.root), Options(jobs=1))
    names = {
        each.name for package in found.packages for module in package.modules for each in module.signature.interfaces
    }
    assert "size" in names
    assert "rate_x" not in names
    (told,) = [each for each in found.diagnostics if each.code == CODE]
    assert (told.path, told.line) == ("pkg/src/d.cpp", 3)
    assert [(each.path, each.reason) for each in found.unread] == [("pkg/src/d.cpp", "stopped")]


@pytest.mark.usefixtures("stumbling")
def test_who_looks_for_it_gets_the_error(workspace: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """With ECM_DEBUG nothing is caught."""
    monkeypatch.setenv("ECM_DEBUG", "1")
    workspace.package({"src/d.cpp": SOURCE, "CMakeLists.txt": "add_executable(d src/d.cpp)"})
    with pytest.raises(IndexError):
        extract(open_tree(workspace.root), Options(jobs=1))
