"""The contract of a node whose body is given."""

from __future__ import annotations

from typing import Any

from ecm_checker.contract import Contract, Value
from workspaces import Workspace

INCLUDE = '#include <rclcpp/rclcpp.hpp>\n#include "rclcpp_lifecycle/lifecycle_node.hpp"\nusing namespace std::chrono_literals;\n'


def contract(workspace: Workspace, body: str, base: str = "rclcpp::Node") -> Contract:
    """The contract of a node with this constructor body."""
    source = f'{INCLUDE}class N : public {base} {{ public: N() : {base.rsplit("::")[-1]}("n") {{ {body} }} }};\n'
    return workspace.package({"src/n.cpp": source}).modules()["ecm.pkg.n"]


def value(found: Value | None) -> Any:
    assert found is not None
    assert found.origin == "inferred"
    assert found.evidence
    return found.value


def node(body: str) -> str:
    return f'{INCLUDE}class N : public rclcpp::Node {{ public: N() : Node("n") {{ {body} }} }};\n'
