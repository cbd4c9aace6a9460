"""Names that code makes of the namespace of its node, in the graph."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.extraction_model import Options
from ecm_extract.system.model import Given
from ecm_extract.system.node_model import Endpoint
from ecm_extract.system.system import read_system
from ecm_extract.tree import open_tree

MANIFEST = "<package format='3'><name>p</name><version>1.0.0</version><export><build_type>ament_cmake</build_type></export></package>"
LAYER = """
#include <rclcpp/rclcpp.hpp>
#include <nav_msgs/msg/occupancy_grid.hpp>
class Layer : public rclcpp::Node {
public:
  Layer() : Node("layer") {
    map_topic_ = declare_parameter<std::string>("map_topic", "map");
    map_topic_ = beside(map_topic_);
    map_ = create_subscription<nav_msgs::msg::OccupancyGrid>(map_topic_, 1, [](nav_msgs::msg::OccupancyGrid) {});
    own_ = create_publisher<nav_msgs::msg::OccupancyGrid>(std::string(get_namespace()) + "/own", 1);
  }
  std::string beside(const std::string & topic) {
    if (topic[0] != '/') {
      std::string space = get_namespace();
      std::string above = space.substr(0, space.rfind("/"));
      return above + "/" + topic;
    }
    return topic;
  }
  std::string map_topic_;
  rclcpp::Subscription<nav_msgs::msg::OccupancyGrid>::SharedPtr map_;
  rclcpp::Publisher<nav_msgs::msg::OccupancyGrid>::SharedPtr own_;
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Layer>()); }
"""


def endpoints(folder: Path, source: str, launch: str) -> list[Endpoint]:
    """The endpoints of what a launch file starts of a package with one program."""
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": "project(p)\nadd_executable(layer src/layer.cpp)\n",
        "src/layer.cpp": source,
        "launch/a.launch.xml": launch,
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    system = read_system(open_tree(str(folder)), ["launch/a.launch.xml"], Given(), Options())
    return [entry for node in system.nodes for entry in node.endpoints]


@pytest.mark.parametrize(
    ("space", "topic", "names"),
    [
        ("", "", {"/map", "/own"}),
        ("costmap", "", {"/map", "/costmap/own"}),
        ("/robot/costmap", "", {"/robot/map", "/robot/costmap/own"}),
        ("/robot/costmap", "grid", {"/robot/grid", "/robot/costmap/own"}),
        ("/robot/costmap", "/grid", {"/grid", "/robot/costmap/own"}),
    ],
)
def test_names_beside_the_namespace_of_a_node(tmp_path: Path, space: str, topic: str, names: set[str]) -> None:
    """What a helper puts beside the namespace is not below it, whatever the launch says."""
    given = f"<param name='map_topic' value='{topic}'/>" if topic else ""
    launch = f"<launch><node pkg='p' exec='layer' namespace='{space}'>{given}</node></launch>"
    assert {entry.name for entry in endpoints(tmp_path, LAYER, launch)} == names


def test_a_managed_node_offers_its_state(tmp_path: Path) -> None:
    """A manager that asks for it finds somebody."""
    managed = LAYER.replace("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode")
    launch = "<launch><node pkg='p' exec='layer' namespace='space'/></launch>"
    services = {entry.name: entry.type for entry in endpoints(tmp_path, managed, launch) if "service" in entry.role}
    assert services == {
        "/space/layer/change_state": "lifecycle_msgs/srv/ChangeState",
        "/space/layer/get_state": "lifecycle_msgs/srv/GetState",
    }


NAMED = """
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <std_srvs/srv/empty.hpp>
class Map : public rclcpp_lifecycle::LifecycleNode {
 public:
  Map() : LifecycleNode("map"), name_("map"), other_("map_server") {
    clear_ = create_service<std_srvs::srv::Empty>("clear_" + name_, [](int, int) {});
    load_ = create_service<std_srvs::srv::Empty>("load_" + other_, [](int, int) {});
  }
  std::string name_, other_;
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Map>()); }
"""


def test_a_member_that_holds_the_name_of_its_node(tmp_path: Path) -> None:
    """It is that of the node, however a launch calls it; what only looks alike is its own."""
    launch = "<launch><node pkg='p' exec='layer' name='floor'/></launch>"
    names = {entry.name for entry in endpoints(tmp_path, NAMED, launch)}
    state = {"/floor/change_state", "/floor/get_state", "/floor/transition_event"}
    assert names == {"/clear_floor", "/load_map_server", *state}


OWN = """
#include <rclcpp/rclcpp.hpp>
class Arm : public rclcpp::Node {
public:
  Arm() : Node("arm", "robot") {
    create_publisher<std_msgs::msg::Bool>("out", 1);
    create_publisher<std_msgs::msg::Bool>("~/own", 1);
    create_publisher<std_msgs::msg::Bool>("/abs", 1);
  }
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Arm>()); }
"""


@pytest.mark.parametrize(
    ("space", "names"),
    [
        ("", {"/robot/out", "/robot/arm/own", "/abs"}),
        ("left", {"/left/out", "/left/arm/own", "/abs"}),
    ],
)
def test_a_namespace_that_code_gives_is_replaced_by_that_of_a_launch(
    tmp_path: Path, space: str, names: set[str]
) -> None:
    """`__ns` takes the place of the namespace in the constructor; without it that one holds."""
    launch = f"<launch><node pkg='p' exec='layer' namespace='{space}'/></launch>"
    assert {entry.name for entry in endpoints(tmp_path, OWN, launch)} == names
