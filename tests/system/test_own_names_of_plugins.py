"""The names of a plugin in a system: below what the node's parameters call it, whatever its source calls that."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.extraction_model import Options
from ecm_extract.system.model import Given
from ecm_extract.system.system import read_system
from ecm_extract.tree import open_tree

MANIFEST = """<package format="3"><name>p</name><version>1.0.0</version>
<export><build_type>ament_cmake</build_type></export></package>"""
BUILD = """project(p)
add_executable(server src/server.cpp)
add_library(layer SHARED src/layer.cpp)
pluginlib_export_plugin_description_file(p plugins.xml)
"""
SERVER = """#include <rclcpp/rclcpp.hpp>
class Server : public rclcpp::Node {
public:
  Server() : Node("server") { declare_parameter("rate", 1); }
};
int main() { rclcpp::spin(std::make_shared<Server>()); }
"""
LAYER = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>
#include <p/base.hpp>
namespace p {{
class Layer : public p::Base {{
  void configure(rclcpp::Node::SharedPtr node, const std::string & {own}, const std::string & topic_name) override {{
    node->declare_parameter({own} + ".size", 3);
    node->declare_parameter("list." + topic_name, 3);
    grid_ = node->create_publisher<std_msgs::msg::Bool>({own} + "/grid", 1);
    other_ = node->create_publisher<std_msgs::msg::Bool>(topic_name, 1);
  }}
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr grid_, other_;
}};
}}
PLUGINLIB_EXPORT_CLASS(p::Layer, p::Base)
"""
PLUGINS = '<library path="layer"><class name="p::Layer" type="p::Layer" base_class_type="p::Base"/></library>'
LAUNCH = """<launch><node pkg="p" exec="server" name="server">
<param name="obstacles.plugin" value="p::Layer"/><param name="obstacles.size" value="4"/>
</node></launch>"""


@pytest.mark.parametrize("own", ["name", "label", "my_own_name"])
def test_a_plugin_is_below_the_name_that_it_is_loaded_under(tmp_path: Path, own: str) -> None:
    """Its parameters tell which of its names that is; another name that it is given stays open."""
    files = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": BUILD,
        "src/server.cpp": SERVER,
        "src/layer.cpp": LAYER.format(own=own),
        "plugins.xml": PLUGINS,
        "a.launch.xml": LAUNCH,
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    found = read_system(open_tree(str(tmp_path)), ["a.launch.xml"], Given(), Options(jobs=1, cache=False))
    (node,) = found.nodes
    assert {entry.name for entry in node.endpoints} == {"/obstacles/grid", "/{topic_name}"}
    parameters = {entry.name: entry.declared for entry in node.parameters}
    assert parameters["obstacles.size"] is True


BESIDE = """
namespace p {
class Plain : public p::Base {
  void configure(rclcpp::Node::SharedPtr node, const std::string & name, const std::string & topic_name) override {
    node->declare_parameter("speed", 3);
    own_ = node->create_publisher<std_msgs::msg::Bool>(name, 1);
    other_ = node->create_publisher<std_msgs::msg::Bool>(topic_name, 1);
  }
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr own_, other_;
};
}
PLUGINLIB_EXPORT_CLASS(p::Plain, p::Base)
"""


def test_a_plugin_without_parameters_of_its_own_is_named_as_others_of_its_base_are(tmp_path: Path) -> None:
    """One method of the base gives each its name: what it is for one of them it is for all; of other bases nothing."""
    plain = '<class name="p::Plain" type="p::Plain" base_class_type="p::Base"/></library>'
    for base, expected in (("p::Base", {"/front", "/{topic_name}"}), ("p::Other", {"/{name}", "/{topic_name}"})):
        files = {
            "package.xml": MANIFEST,
            "CMakeLists.txt": BUILD,
            "src/server.cpp": SERVER,
            "src/layer.cpp": LAYER.format(own="name") + BESIDE,
            "plugins.xml": PLUGINS.replace("</library>", plain.replace("p::Base", base)),
            "a.launch.xml": LAUNCH.replace("obstacles", "front").replace("p::Layer", "p::Plain"),
        }
        for name, text in files.items():
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).write_text(text)
        found = read_system(open_tree(str(tmp_path)), ["a.launch.xml"], Given(), Options(jobs=1, cache=False))
        (node,) = found.nodes
        assert {entry.name for entry in node.endpoints} == expected
