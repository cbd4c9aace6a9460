"""Each section of a contract is filled with what an artefact shows, and with nothing else."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from ecm_checker.contract import Contract, Value
from section_contracts import contract, node, value
from workspaces import Workspace

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
    reads = 'get_parameter_or<int>("depth", d, 1); get_parameter_or<int>("depth", d, 2);'
    found = contract(workspace, f'declare_parameter<int>("depth"); {reads}')
    assert [(each.name, each.default) for each in found.signature.interfaces] == [("depth", None)]


def test_action_result_constants_are_failure_modes(workspace: Workspace) -> None:
    """Except those that mean success; units come from the comments of the message."""
    action = "float64 speed  # m/s\n---\nuint16 NONE=0\nuint16 BLOCKED=1\nuint16 code\n---\n"
    body = 'rclcpp_action::create_server<pkg::action::Go>(this, "go", a, b, c);'
    modules = workspace.package({"action/Go.action": action, "src/n.cpp": node(body)}).modules()
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
