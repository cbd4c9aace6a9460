"""Messages named from inside a namespace that their package generates."""

from __future__ import annotations

from typing import Any

import pytest

MESSAGE = "float64 value\n"
NODE = """#include <robot/msg/temperature.hpp>
#include <robot/srv/reset.hpp>
{head}
namespace robot {{
class Driver : public rclcpp::Node {{
 public:
  Driver() : Node("driver") {{ {body} }}
}};
}}
RCLCPP_COMPONENTS_REGISTER_NODE(robot::Driver)
"""
FORMS = {
    "publisher": ("", 'create_publisher<msg::Temperature>("t", 1);', "robot/msg/Temperature"),
    "callback": (
        "",
        'create_subscription<msg::Temperature>("t", 1, [](const msg::Temperature & m) {});',
        "robot/msg/Temperature",
    ),
    "service": ("", 'create_client<srv::Reset>("t");', "robot/srv/Reset"),
    "of another package": ("", 'create_publisher<std_msgs::msg::Bool>("t", 1);', "std_msgs/msg/Bool"),
    "nested": (
        "namespace robot { namespace base { struct A {}; } }",
        'create_publisher<robot::msg::Temperature>("t", 1);',
        "robot/msg/Temperature",
    ),
}


@pytest.mark.parametrize(("head", "body", "kind"), FORMS.values(), ids=FORMS)
def test_a_message_is_looked_up_through_enclosing_namespaces(workspace: Any, head: str, body: str, kind: str) -> None:
    """`msg::Temperature` inside `namespace robot` is the message of `robot` (R5)."""
    files = {
        "msg/Temperature.msg": MESSAGE,
        "srv/Reset.srv": "---\n",
        "src/driver.cpp": NODE.format(head=head, body=body),
    }
    workspace.package(files, name="robot")
    workspace.package({"msg/Temperature.msg": MESSAGE}, name="msg")
    assert [entry.type for entry in workspace.interfaces()] == [kind]


def test_a_message_of_another_package_is_told_by_its_header(workspace: Any) -> None:
    """The package may stand outside the tree: the header that is included shows that it has the message."""
    text = NODE.format(head="", body='create_publisher<msg::Temperature>("t", 1);')
    assert workspace.package({"src/driver.cpp": text}).only("publisher").type == "robot/msg/Temperature"


def test_a_name_that_no_namespace_has_is_what_it_says(workspace: Any) -> None:
    """Without a header or definition in the namespace the first part of the name is the package."""
    text = NODE.format(head="", body='create_publisher<other::Temperature>("t", 1);')
    assert workspace.package({"src/driver.cpp": text}).only("publisher").type == "other/msg/Temperature"


def test_a_message_is_looked_up_through_a_directive(workspace: Any) -> None:
    """`using namespace robot` brings what `robot` has; a kind alone is the name of no package in ROS 2."""
    head = "#include <robot/msg/temperature.hpp>\n{0}\nclass Driver : public rclcpp::Node {{ public: Driver() : Node("
    head += '"d") {{ create_publisher<msg::Temperature>("t", 1); }} }};\nRCLCPP_COMPONENTS_REGISTER_NODE(Driver)\n'
    used = workspace.package({"src/driver.cpp": head.format("using namespace robot;")}).only("publisher")
    assert used.type == "robot/msg/Temperature"
    assert workspace.package({"src/driver.cpp": head.format("")}).only("publisher").type is None


def test_a_template_of_a_library_is_no_message(workspace: Any) -> None:
    """`pcl::PointCloud<P>` is turned into a message when it is sent: no package `pcl` has one of that name."""
    text = NODE.format(head="", body='create_publisher<pcl::PointCloud<pcl::PointXYZ>>("t", 1);')
    assert workspace.package({"src/driver.cpp": text}).only("publisher").type is None
