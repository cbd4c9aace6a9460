"""Objects of C++ are values: who changes one changes no other that was made of it, and nobody looks for such."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.infer.sharing import Sharing

SOURCE = """
#include <rclcpp/rclcpp.hpp>
struct Settings {
  void recover(int more) { rate += more; }
  int rate = 1;
};
int main() {
  auto node = std::make_shared<rclcpp::Node>("planner");
  Settings given;
  Settings settings = given;
  settings.recover(1);
  settings.rate += 1;
  node->declare_parameter("p" + std::to_string(settings.rate) + std::to_string(given.rate), 1);
}
"""


def test_nobody_looks_for_who_shares_a_value(workspace: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """What an object held in all the rounds of a loop was looked through in each of them: minutes for one function."""

    def never(*_: object) -> set[str]:
        pytest.fail("objects of C++ were looked through for others that share what they hold")

    monkeypatch.setattr(Sharing, "holding", never)
    package = workspace.package({"src/d.cpp": SOURCE, "CMakeLists.txt": "add_executable(d src/d.cpp)"})
    assert [entry.name[0] for entry in package.interfaces() if entry.role == "parameter"] == ["p"]
