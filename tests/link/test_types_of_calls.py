"""A parameter whose value is not known has the type that the call says which gives its default."""

from __future__ import annotations

from typing import Any

CPP = """
class Demo : public rclcpp::Node {
public:
  Demo() : Node("demo") {
    YAML::Node file = YAML::LoadFile("a.yaml");
    declare_parameter("model", file["model"].as<std::string>());
    declare_parameter("list", file["list"].as<std::vector<double>>());
    auto held = file["held"].as<bool>();
    declare_parameter("held", held);
    declare_parameter("own", read<int>(file));
  }
  template <typename T> std::string read(YAML::Node file) { return file["own"].as<std::string>(); }
};
int main(int c, char ** v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<Demo>()); }
"""
PYTHON = """
import rclpy
import outside
from rclpy.node import Node
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        text = str(outside.path())
        self.declare_parameter("text", text)
        self.declare_parameter("file", str(outside.path()))
        self.declare_parameter("rate", float(outside.rate))
        self.declare_parameter("unknown", outside.str(1))
def main():
    rclpy.init()
    rclpy.spin(Demo())
"""
SETUP = "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['demo = pkg.demo:main']})\n"


def _types(workspace: Any) -> dict[str, str | None]:
    return {each.name: each.type for each in workspace.interfaces() if each.role == "parameter"}


def test_reads_of_libraries_say_what_they_give(workspace: Any) -> None:
    """Of what the tree has itself a template argument says nothing."""
    files = {"src/d.cpp": CPP, "CMakeLists.txt": "add_executable(d src/d.cpp)"}
    types = {"model": "string", "list": "double_array", "held": "bool", "own": None}
    assert _types(workspace.package(files)) == types


def test_classes_of_python_say_what_they_make(workspace: Any) -> None:
    """A function of another module that is called like one says nothing."""
    files = {"pkg/__init__.py": "", "pkg/demo.py": PYTHON, "setup.py": SETUP}
    types = {"text": "string", "file": "string", "rate": "double", "unknown": None}
    assert _types(workspace.package(files)) == types
