"""Each section of a contract is filled with what an artefact shows, and with nothing else."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
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


Read = Callable[[Contract], Value | None]


@pytest.mark.parametrize(
    ("body", "read", "expected"),
    [
        ("create_wall_timer(100ms, [this]() {});", lambda c: c.behavior.rates, {"timer": 10.0}),
        ("create_wall_timer(std::chrono::milliseconds(500), f);", lambda c: c.behavior.rates, {"timer": 2.0}),
        (
            'double hz = declare_parameter<double>("loop", 4.0); create_wall_timer(std::chrono::duration<double>(1.0 / hz), f);',
            lambda c: c.behavior.rates,
            {"timer": 4.0},
        ),
        ("rclcpp::Rate rate(25);", lambda c: c.behavior.rates, {"rate": 25.0}),
        ('declare_parameter<double>("update_rate", 50.0);', lambda c: c.behavior.rates, {"update_rate": 50.0}),
        (
            'c_ = create_client<std_srvs::srv::Trigger>("stop"); c_->wait_for_service(1s);',
            lambda c: c.behavior.preconditions,
            ["service_available /stop"],
        ),
        (
            'buffer_->lookupTransform("map", "base_link", tf2::TimePointZero);',
            lambda c: c.behavior.preconditions,
            ["transform map <- base_link available"],
        ),
        (
            'create_subscription<sensor_msgs::msg::LaserScan>("scan", 10, f);',
            lambda c: c.resources.sensors,
            ["lidar"],
        ),
        (
            'create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 10);',
            lambda c: c.resources.actuators,
            ["mobile_base"],
        ),
        (
            'create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 10);',
            lambda c: c.permissions.physical,
            {"motion": True},
        ),
        (
            'create_publisher<std_msgs::msg::Bool>("a", 1); create_subscription<std_msgs::msg::Bool>("b", 1, f);',
            lambda c: c.permissions.data,
            ["read:/b", "write:/a"],
        ),
        ('declare_parameter<std::string>("robot_ip", "10.0.0.2");', lambda c: c.permissions.network, ["10.0.0.2"]),
        (
            'declare_parameter<int>("server_timeout", 20); create_service<std_srvs::srv::Trigger>("stop", f);',
            lambda c: c.signature.timeout_ms,
            20.0,
        ),
        (
            'create_subscription<geometry_msgs::msg::Twist>("commands/velocity", 10, f);',
            lambda c: c.resources.actuators,
            ["mobile_base"],
        ),
        (
            'create_publisher<geometry_msgs::msg::Twist>("commands/velocity", 10);',
            lambda c: c.resources.actuators,
            ["mobile_base"],
        ),
        (
            'create_publisher<trajectory_msgs::msg::JointTrajectory>("arm", 10);',
            lambda c: c.resources.actuators,
            ["joints"],
        ),
        (
            'declare_parameter<double>("cmd_vel_timeout", 0.5);',
            lambda c: c.recovery.safe_stop,
            ["stop after cmd_vel_timeout"],
        ),
        (
            'declare_parameter<int>("max_retries", 3);',
            lambda c: c.recovery.retry,
            {"max": 3, "parameter": "max_retries"},
        ),
        (
            'create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics", 1);',
            lambda c: c.recovery.escalation,
            ["failure -> /diagnostics"],
        ),
        ('declare_parameter<std::string>("frame_id", "odom");', lambda c: c.signature.coordinate_frame, "odom"),
        (
            'nav_msgs::msg::Odometry m; m.header.frame_id = "odom"; p_->publish(m);',
            lambda c: c.signature.coordinate_frame,
            "odom",
        ),
        (
            'create_service<std_srvs::srv::Trigger>("stop", f);',
            lambda c: c.signature.invocation_mode,
            "synchronous",
        ),
        (
            'create_service<std_srvs::srv::Trigger>("stop", f);',
            lambda c: c.behavior.completion_semantics,
            "response",
        ),
    ],
)
def test_field(body: str, read: Read, expected: object, workspace: Workspace) -> None:
    """The line that shows a field stands with its value."""
    assert value(read(contract(workspace, body))) == expected


@pytest.mark.parametrize(
    "body",
    [
        "",
        "create_wall_timer(period, f);",
        'create_publisher<geometry_msgs::msg::Twist>("display", 10);',
        'declare_parameter<std::string>("timeout_topic", "x");',
        'create_client<std_srvs::srv::Trigger>("stop");',
        'create_publisher<geometry_msgs::msg::TwistStamped>("imu/velocity", 10);',
        'create_subscription<geometry_msgs::msg::TwistStamped>("gnss/velocity", 10, f);',
        'create_publisher<geometry_msgs::msg::Twist>("measured_velocity", 10);',
        'c_ = create_client<A>("stop"); s_ = create_subscription<B>("go", 1, [this](B::SharedPtr) { c_->wait_for_service(1s); });',
    ],
)
def test_nothing_is_invented(body: str, workspace: Workspace) -> None:
    """What no artefact shows is undeclared, which is not the same as none."""
    found = contract(workspace, body)
    assert found.behavior.rates is None
    assert found.behavior.preconditions is None
    assert found.resources.actuators is None
    assert found.resources.exclusive_locks is None
    assert found.resources.compute is None
    assert found.permissions.physical is None
    assert found.signature.timeout_ms is None
    assert found.recovery == type(found.recovery)()


@pytest.mark.parametrize(
    "body",
    [
        'declare_parameter<double>("cmd_vel_timeout", 0.5); create_service<std_srvs::srv::Trigger>("stop", f);',
        'declare_parameter<double>("sync_timeout", 0.5);',
    ],
)
def test_a_timeout_of_something_else(body: str, workspace: Workspace) -> None:
    """A watchdog over commands is no time of a call, nor is any timeout of a module that is never called."""
    assert contract(workspace, body).signature.timeout_ms is None


@pytest.mark.parametrize(
    "body",
    [
        'if (enu) { declare_parameter("frame_id", "imu"); } else { declare_parameter("frame_id", "imu_ned"); }',
        'A a; a.header.frame_id = "map"; B b; b.header.frame_id = "odom"; declare_parameter("frame_id", "base");',
    ],
)
def test_a_frame_that_is_not_the_only_one(body: str, workspace: Workspace) -> None:
    """Of two defaults, or of two frames that are written, none is the frame of the module."""
    assert contract(workspace, body).signature.coordinate_frame is None


def test_a_default_that_another_default_overrides(workspace: Workspace) -> None:
    """Which of them holds is decided while the module runs, so neither is told."""
    found = contract(workspace, 'get_parameter_or<int>("depth", d, 1); get_parameter_or<int>("depth", d, 2);')
    assert [(each.name, each.default) for each in found.signature.interfaces] == [("depth", None)]


WAITS = """
class N : public rclcpp::Node {
public:
  N() : Node("n") {
    early_ = create_client<std_srvs::srv::Trigger>("early");
    late_ = create_client<std_srvs::srv::Trigger>("late");
    prepare();
    s_ = create_service<std_srvs::srv::Trigger>("go", std::bind(&N::go, this, _1, _2));
  }
  void prepare() { wait(); }
  void wait() { rclcpp::wait_for_message(m, node, "ready"); }
  void go(A a, B b) { rclcpp::wait_for_message(m, node, "later"); helper(); }
  void helper() { rclcpp::wait_for_message(m, node, "much_later"); }
};
"""
PYTHON_WAITS = """
import rospy
def on_scan(message):
    rospy.wait_for_service("late")
def prepare():
    rospy.wait_for_service("early")
def main():
    rospy.init_node("n")
    prepare()
    rospy.Subscriber("scan", LaserScan, on_scan)
    rospy.Subscriber("other", LaserScan, lambda message: rospy.wait_for_service("lambda"))
if __name__ == "__main__":
    main()
"""


def test_a_wait_in_a_callback_is_no_precondition(workspace: Workspace) -> None:
    """The module is active by then; what its constructor reaches by calls is waited for before."""
    found = workspace.package({"src/n.cpp": INCLUDE + WAITS}).modules()["ecm.pkg.n"]
    assert value(found.behavior.preconditions) == ["message_received ready"]


def test_a_wait_in_a_callback_of_python(workspace: Workspace) -> None:
    """Functions and lambdas that are handed on run later."""
    found = workspace.package({"scripts/n.py": PYTHON_WAITS}, ros=1).modules()
    (node,) = (each for each in found.values() if each.behavior.preconditions is not None)
    assert value(node.behavior.preconditions) == ["service_available early"]


def test_lifecycle_node_works_when_active(workspace: Workspace) -> None:
    """A managed node has a state to be in, and one to go back to."""
    found = contract(workspace, "", "rclcpp_lifecycle::LifecycleNode")
    assert value(found.behavior.preconditions) == ["lifecycle_state == active"]
    assert value(found.recovery.rollback_state) == "inactive"


@pytest.mark.parametrize("imported", ["LifecycleNode", "LifecycleNode as Node", "Node"])
def test_lifecycle_node_of_python(workspace: Workspace, imported: str) -> None:
    """rclpy gives the class two names."""
    name = imported.rpartition(" ")[2]
    text = f"import rclpy\nfrom rclpy.lifecycle import {imported}\n\nclass N({name}):\n"
    text += "    def __init__(self):\n        super().__init__('n')\n"
    found = workspace.package({"pkg/n.py": text}).modules()["ecm.pkg.n"]
    assert value(found.behavior.preconditions) == ["lifecycle_state == active"]


def test_a_plain_node_of_python_has_no_state(workspace: Workspace) -> None:
    text = "import rclpy\nfrom rclpy.node import Node\n\nclass N(Node):\n"
    text += "    def __init__(self):\n        super().__init__('n')\n"
    assert workspace.package({"pkg/n.py": text}).modules()["ecm.pkg.n"].behavior.preconditions is None


def test_action_result_constants_are_failure_modes(workspace: Workspace) -> None:
    """Except those that mean success; units come from the comments of the message."""
    action = "float64 speed  # m/s\n---\nuint16 NONE=0\nuint16 BLOCKED=1\nuint16 code\n---\n"
    body = 'rclcpp_action::create_server<pkg::action::Go>(this, "go", a, b, c);'
    modules = workspace.package({"action/Go.action": action, "src/n.cpp": _node(body)}).modules()
    go = modules["ecm.pkg.n"]
    assert value(go.recovery.failure_modes) == ["blocked"]
    assert value(go.signature.input_schema) == {"/go": {"type": "pkg/action/Go#goal", "units": {"speed": "m/s"}}}


@pytest.mark.parametrize(
    ("body", "modes"),
    [
        ('stat.summary(diagnostic_msgs::msg::DiagnosticStatus::ERROR, "No data");', {"no_data": "error"}),
        ('stat.summary(1, "Voltage is low!");', {"voltage_is_low": "warn"}),
        ('stat.mergeSummaryf(DiagnosticStatus::STALE, "%d of %d lost", a, b);', {"of_lost": "stale"}),
        ('status.message = "Hot"; status.level = DiagnosticStatus::WARN;', {"hot": "warn"}),
        ('stat.summary(DiagnosticStatus::OK, "Fine");', None),
        ('stat.summary(level, "Depends");', None),
        ("stat.summary(DiagnosticStatus::ERROR, text_of(x));", None),
        ('first.level = 2; second.message = "Of another";', None),
        ("model.summary(10, 20);", None),
    ],
)
def test_diagnostics_are_failure_modes(body: str, modes: object, workspace: Workspace) -> None:
    """What is reported as no longer OK is a way to fail, graded as the report grades it."""
    found = contract(workspace, body).recovery
    assert (None if found.failure_modes is None else value(found.failure_modes)) == modes
    assert (None if found.escalation is None else value(found.escalation)) == (modes and ["failure -> /diagnostics"])


def test_diagnostics_of_python(workspace: Workspace) -> None:
    """Both ways to fill a status; what an action names beside it has no level."""
    source = """#!/usr/bin/env python3
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from pkg.srv import Go
class Watch(rclpy.node.Node):
    def __init__(self):
        super().__init__("watch")
        self.create_service(Go, "go", self.go)
    def check(self, stat):
        stat.summary(DiagnosticStatus.WARN, "Queue is long")
        status = DiagnosticStatus()
        status.level = DiagnosticStatus.ERROR
        status.name = "driver"
        status.message = "No connection"
if __name__ == "__main__":
    rclpy.spin(Watch())
"""
    files = {"scripts/watch.py": source, "srv/Go.srv": "---\nuint8 BLOCKED=1\nuint8 code\n"}
    (watch,) = [each for each in workspace.package(files).modules().values() if each.ecm.kind == "node"]
    modes = {"blocked": "unknown", "no_connection": "error", "queue_is_long": "warn"}
    assert value(watch.recovery.failure_modes) == modes


def _node(body: str) -> str:
    return f'{INCLUDE}class N : public rclcpp::Node {{ public: N() : Node("n") {{ {body} }} }};\n'


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
    files = {"CMakeLists.txt": "project(pkg)\nfind_package(CUDA REQUIRED)\n", "src/n.cpp": _node("")}
    found = workspace.package(files).modules()["ecm.pkg.n"]
    assert value(found.resources.compute) == {"gpu": True}


TREE = '<root><BehaviorTree ID="A"><RecoveryNode number_of_retries="{}"/></BehaviorTree></root>'


def test_retries_of_behavior_trees(workspace: Workspace) -> None:
    """Only the module that is given trees tries again, as often as the most patient node."""
    files = {"bt/a.xml": TREE.format(2), "bt/b.xml": TREE.format(6)}
    given = workspace.package(
        {**files, "src/n.cpp": _node('declare_parameter<std::string>("default_bt_xml", "a.xml");')}
    )
    found = given.modules()["ecm.pkg.n"].recovery.retry
    assert value(found) == {"max": 6, "strategy": "behavior_tree"}
    other = workspace.package({**files, "src/n.cpp": _node("")}).modules()["ecm.pkg.n"]
    assert other.recovery.retry is None


def test_policy_tells_what_a_node_may_touch(workspace: Workspace) -> None:
    """A policy says more than the sources: what it allows, not what is used."""
    policy = (
        '<policy version="0.2.0"><enclaves><enclave path="/"><profiles><profile ns="/" node="n">'
        '<topics publish="ALLOW"><topic>odom</topic></topics><topics subscribe="DENY"><topic>x</topic></topics>'
        "</profile></profiles></enclave></enclaves></policy>"
    )
    found = workspace.package({"policies/p.xml": policy, "src/n.cpp": _node("")}).modules()["ecm.pkg.n"]
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
