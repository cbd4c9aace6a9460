"""A parameter that is declared without a value has the type for which its node reads it elsewhere."""

from __future__ import annotations

from typing import Any

CPP = """
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{ {body} }}
  void later() {{ rate_ = this->get_parameter("rate").as_double(); other_->get_parameter("no").as_int(); }}
  double rate_; rclcpp::Node::SharedPtr other_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Demo>()); }}
"""
BODY = """
    declare_parameter("x"); declare_parameter("rate"); declare_parameter("both"); declare_parameter("no");
    auto x = get_parameter("x").as_double_array();
    auto one = get_parameter("both").as_int(); auto two = get_parameter("both").as_string();
"""
PYTHON = """
import rclpy
class Controller:
    def __init__(self, node):
        self._node = node
        self._node.declare_parameter("robot")
        self._node.declare_parameter("port")
        self.link = self._node.get_parameter("robot").get_parameter_value().string_value + "/base"
        self.port = self._node.get_parameter("port").value
def main():
    rclpy.init()
    node = rclpy.create_node("demo")
    Controller(node)
    rclpy.spin(node)
"""
SETUP = "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['demo = pkg.demo:main']})\n"


def _types(workspace: Any) -> dict[str, str | None]:
    return {each.name: each.type for each in workspace.interfaces() if each.role == "parameter"}


def test_a_read_of_cpp_tells_the_type(workspace: Any) -> None:
    """What is asked of another node, or for several types, tells nothing."""
    files = {"src/d.cpp": CPP.format(body=BODY), "CMakeLists.txt": "add_executable(d src/d.cpp)"}
    assert _types(workspace.package(files)) == {"x": "double_array", "rate": "double", "both": None, "no": None}


def test_a_read_of_python_tells_the_type(workspace: Any) -> None:
    """`.value` is of any type."""
    files = {"pkg/__init__.py": "", "pkg/demo.py": PYTHON, "setup.py": SETUP}
    assert _types(workspace.package(files)) == {"robot": "string", "port": None}


INTO = """
class Demo : public rclcpp::Node {
public:
  Demo() : Node("demo") {
    declare_parameter("file"); declare_parameter("list"); declare_parameter("both"); declare_parameter("no"); declare_parameter("one");
  }
  void later() {
    std::string text; int number;
    get_parameter("file", text);
    this->get_parameter("list", list_);
    get_parameter("both", text); get_parameter("both", number);
    other_->get_parameter("no", number);
    get_parameter("one", number); one_ = get_parameter("one").as_string();
  }
  std::vector<double> list_; std::string one_; rclcpp::Node::SharedPtr other_;
};
int main(int c, char ** v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<Demo>()); }
"""


def test_a_variable_that_another_method_reads_into_tells_the_type(workspace: Any) -> None:
    """Of variables of several types, and of another node, nothing is known."""
    files = {"src/d.cpp": INTO, "CMakeLists.txt": "add_executable(d src/d.cpp)"}
    types = {"file": "string", "list": "double_array", "both": None, "no": None, "one": None}
    assert _types(workspace.package(files)) == types
