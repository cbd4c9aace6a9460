"""What a module holds, needs and may touch: locks of command interfaces, processors, policies."""

from __future__ import annotations

import pytest
from section_contracts import node, value
from workspaces import Workspace

CONTROLLER = """
#include "controller_interface/controller_interface.hpp"
class C : public controller_interface::ControllerInterface {
public:
  controller_interface::InterfaceConfiguration command_interface_configuration() const override {
    controller_interface::InterfaceConfiguration config;
    config.type = controller_interface::interface_configuration_type::{kind};
    {body}
    return config;
  }
};
"""


@pytest.mark.parametrize(
    ("kind", "body", "locks"),
    [
        ("NONE", "", []),
        ("ALL", "", ["*"]),
        ("INDIVIDUAL", 'config.names.push_back("arm/" + std::string("position"));', ["arm/position"]),
        (
            "INDIVIDUAL",
            'config.names.push_back(std::string("arm/") + hardware_interface::HW_IF_EFFORT);',
            ["arm/effort"],
        ),
        (
            "INDIVIDUAL",
            'for (const auto & joint : joints_) { config.names.push_back(joint + "/velocity"); }',
            ["{item}/velocity"],
        ),
    ],
)
def test_command_interfaces_are_exclusive_locks(kind: str, body: str, locks: list[str], workspace: Workspace) -> None:
    """A controller that claims nothing says so: an empty list, not an undeclared field."""
    source = CONTROLLER.replace("{kind}", kind).replace("{body}", body)
    (module,) = workspace.package({"src/c.cpp": source}).modules().values()
    found = module.resources.exclusive_locks
    assert found is not None
    assert found.value == locks


def test_cuda_in_the_build_is_a_need_for_a_gpu(workspace: Workspace) -> None:
    """What the build asks for, the computer must have."""
    files = {"CMakeLists.txt": "project(pkg)\nfind_package(CUDA REQUIRED)\n", "src/n.cpp": node("")}
    found = workspace.package(files).modules()["ecm.pkg.n"]
    assert value(found.resources.compute) == {"gpu": True}


TREE = '<root><BehaviorTree ID="A"><RecoveryNode number_of_retries="{}"/></BehaviorTree></root>'


def test_retries_of_behavior_trees(workspace: Workspace) -> None:
    """Only the module that is given trees tries again, as often as the most patient node."""
    files = {"bt/a.xml": TREE.format(2), "bt/b.xml": TREE.format(6)}
    given = workspace.package(
        {**files, "src/n.cpp": node('declare_parameter<std::string>("default_bt_xml", "a.xml");')}
    )
    found = given.modules()["ecm.pkg.n"].recovery.retry
    assert value(found) == {"max": 6, "strategy": "behavior_tree"}
    other = workspace.package({**files, "src/n.cpp": node("")}).modules()["ecm.pkg.n"]
    assert other.recovery.retry is None


def test_policy_tells_what_a_node_may_touch(workspace: Workspace) -> None:
    """A policy says more than the sources: what it allows, not what is used."""
    policy = (
        '<policy version="0.2.0"><enclaves><enclave path="/"><profiles><profile ns="/" node="n">'
        '<topics publish="ALLOW"><topic>odom</topic></topics><topics subscribe="DENY"><topic>x</topic></topics>'
        "</profile></profiles></enclave></enclaves></policy>"
    )
    found = workspace.package({"policies/p.xml": policy, "src/n.cpp": node("")}).modules()["ecm.pkg.n"]
    assert value(found.permissions.data) == ["write:/odom"]


def test_controller_yaml_tells_which_joints_are_locked(workspace: Workspace) -> None:
    """One configuration gives the names; with two of them only a launch tells which one holds."""
    body = 'for (const auto & joint : joints_) { config.names.push_back(joint + "/velocity"); }'
    member = 'void init() { joints_ = auto_declare<std::vector<std::string>>("joints", joints_); } std::vector<std::string> joints_;'
    source = CONTROLLER.replace("{kind}", "INDIVIDUAL").replace("{body}", body).replace("public:", f"public: {member}")
    plugin = '<library path="c"><class name="pkg/C" type="C" base_class_type="controller_interface::ControllerInterface"/></library>'
    yaml = "controller_manager:\n  ros__parameters:\n    {0}: {{type: pkg/C}}\n{0}:\n  ros__parameters: {{joints: [left, right]}}\n"
    cmake = "project(pkg)\npluginlib_export_plugin_description_file(controller_interface plugins.xml)\n"
    files = {"src/c.cpp": source, "plugins.xml": plugin, "CMakeLists.txt": cmake, "config/a.yaml": yaml.format("base")}
    (module,) = workspace.package(files).modules().values()
    assert module.resources.exclusive_locks is not None
    assert module.resources.exclusive_locks.value == ["left/velocity", "right/velocity"]
    (module,) = workspace.package({**files, "config/b.yaml": yaml.format("other")}).modules().values()
    assert module.resources.exclusive_locks is not None
    assert module.resources.exclusive_locks.value == ["{joints}/velocity"]


def test_recorders_and_aggregators_use_names(workspace: Workspace) -> None:
    """What a bag records, and what diagnostics are expected, depends on names of others."""
    recorder = "recorder:\n  ros__parameters:\n    record: {topics: [/scan, /odom]}\n"
    modules = workspace.package({"config/record.yaml": recorder}).modules()
    assert [use.name for module in modules.values() for use in module.versioning.uses] == ["/scan", "/odom"]
