"""Which module an endpoint belongs to, and what the module is called."""

from __future__ import annotations

from typing import Any

from ecm_extract.extraction_model import Options
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import open_tree


def kinds(workspace: Any) -> dict[str, str]:
    return {name: module.ecm.kind for name, module in workspace.modules().items()}


def test_a_program_whose_node_has_no_class_is_a_module(workspace: Any) -> None:
    """The executable of CMake names it, the initialisation names its node."""
    main = 'int main(int c, char ** v) { ros::init(c, v, "talker_node"); ros::NodeHandle pnh("~"); auto p = pnh.advertise<std_msgs::String>("out", 1); }'
    workspace.package(
        {"src/main.cpp": main, "CMakeLists.txt": "project(pkg)\nadd_executable(talker src/main)\n"}, ros=1
    )
    assert kinds(workspace) == {"ecm.pkg.talker": "node"}
    assert workspace.only("publisher").name == "/talker_node/out"


def test_a_program_is_called_like_its_file(workspace: Any) -> None:
    """`OUTPUT_NAME` is what rosrun and launch files know, whatever the target is called, also where a macro sets it."""
    main = 'int main(int c, char ** v) { ros::init(c, v, "t"); ros::NodeHandle n; auto p = n.advertise<std_msgs::Bool>("o", 1); }'
    cmake = (
        "project(pkg)\nmacro(add_program name)\nadd_executable(${name}_exe src/${name}.cpp)\n"
        "SET_TARGET_PROPERTIES(${name}_exe PROPERTIES OUTPUT_NAME ${name})\nendmacro()\nadd_program(talker)\n"
    )
    launch = '<launch><node pkg="pkg" type="talker" name="a"/></launch>'
    files = {"src/talker.cpp": main, "CMakeLists.txt": cmake, "launch/a.launch": launch}
    assert kinds(workspace.package(files, ros=1)) == {"ecm.pkg.talker": "node"}
    assert "LNT003" not in {finding.rule for finding in findings_of(Workspace(open_tree(workspace.root), Options()))}


def test_registered_classes_are_components_and_plugins(workspace: Any) -> None:
    """Registration macros and build files make a class a module even when its base is not in the tree."""
    node = 'namespace n { class Comp : public rclcpp::Node { public: Comp(const rclcpp::NodeOptions & o) : Node("comp", o) {} }; class Layer : public other::Layer {}; }\nRCLCPP_COMPONENTS_REGISTER_NODE(n::Comp)\nPLUGINLIB_EXPORT_CLASS(n::Layer, other::Layer)\n'
    assert kinds(workspace.package({"src/c.cpp": node})) == {
        "ecm.pkg.comp": "component",
        "ecm.pkg.layer": "plugin",
    }


def test_a_registered_name_means_the_node(workspace: Any) -> None:
    """A plain structure of the same name in another header is not what is loaded."""
    plain = "namespace n { struct Comp { bool on; }; }"
    node = 'namespace n { class Comp : public rclcpp::Node { public: Comp(const rclcpp::NodeOptions & o) : Node("comp", o) { create_publisher<std_msgs::msg::Bool>("on", 1); } }; }\nRCLCPP_COMPONENTS_REGISTER_NODE(n::Comp)\n'
    cmake = (
        'project(pkg)\nadd_library(c src/c.cpp)\nrclcpp_components_register_node(c PLUGIN "n::Comp" EXECUTABLE comp)\n'
    )
    files = {"include/a.hpp": plain, "src/c.cpp": node, "CMakeLists.txt": cmake}
    assert kinds(workspace.package(files)) == {"ecm.pkg.comp": "component"}
    assert workspace.only("publisher").name == "/on"


def test_controllers_and_hardware_are_kinds(workspace: Any) -> None:
    """ros2_control bases decide the kind of their derived classes."""
    text = "class C : public controller_interface::ControllerInterface {};\nclass H : public hardware_interface::SystemInterface {};"
    assert kinds(workspace.package({"src/c.cpp": text})) == {
        "ecm.pkg.c": "controller",
        "ecm.pkg.h": "hardware",
    }


def test_a_helper_belongs_to_every_module_that_uses_it(workspace: Any) -> None:
    """Endpoints of a class that is no module are those of its users."""
    text = """
class Helper { public: Helper(rclcpp::Node * node) { node->create_client<std_srvs::srv::Empty>("reset"); } };
class A : public rclcpp::Node { public: A() : Node("a") { helper_ = std::make_shared<Helper>(this); } std::shared_ptr<Helper> helper_; };
class B : public rclcpp::Node { public: B() : Node("b"), helper_(this) {} Helper helper_; };
class C : public rclcpp::Node { public: C() : Node("c") {} };"""
    modules = workspace.package({"src/x.cpp": text}).modules()
    users = {name for name, module in modules.items() if module.signature.interfaces}
    assert users == {"ecm.pkg.a", "ecm.pkg.b"}
    assert modules["ecm.pkg.a"].signature.interfaces[0].inherited_from == "Helper"


def test_what_a_base_has_from_a_helper_its_derived_classes_have(workspace: Any) -> None:
    """A node class that is made itself and derived from: what it calls declares for both (C++ class.derived)."""
    text = """
void declare(rclcpp::Node & node) { node.declare_parameter("mode", "off"); }
class Base : public rclcpp::Node { public: explicit Base(const std::string & name) : Node(name) { declare(*this); } };
class Derived : public Base { public: Derived() : Base("derived") {} };
RCLCPP_COMPONENTS_REGISTER_NODE(Derived)
int main(int c, char ** v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<Base>("base")); }
"""
    files = {"src/base.cpp": text, "CMakeLists.txt": "add_executable(base src/base.cpp)\n"}
    found = workspace.package(files).modules()
    having = {
        name for name, module in found.items() if [entry.name for entry in module.signature.interfaces] == ["mode"]
    }
    assert having == {"ecm.pkg.base", "ecm.pkg.derived"}


def test_python_entry_points_and_scripts_are_modules(workspace: Any) -> None:
    """A console script and a shebang script without a suffix are programs."""
    node = "import rclpy\nfrom std_msgs.msg import String\ndef main():\n    node = rclpy.create_node('n')\n    node.create_publisher(String, 'a', 1)\n"
    setup = "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['talk = pkg.talker:main']})\n"
    script = "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\nnode = rclpy.create_node('s')\nnode.create_publisher(String, 'b', 1)\n"
    workspace.package({"pkg/talker.py": node, "pkg/__init__.py": "", "setup.py": setup, "scripts/say": script})
    (workspace.root / "pkg/scripts/say").chmod(0o755)
    assert kinds(workspace) == {"ecm.pkg.talk": "script", "ecm.pkg.say": "script"}


def test_code_that_nobody_uses_is_the_library(workspace: Any) -> None:
    """An endpoint is never lost: without a user it stands in the library of its package."""
    text = 'void attach(rclcpp::Node * node) { node->create_client<std_srvs::srv::Empty>("reset"); }'
    assert kinds(workspace.package({"src/lib.cpp": text})) == {"ecm.pkg.pkg": "library"}


def test_generated_parameters_belong_to_the_class_with_the_listener(workspace: Any) -> None:
    """generate_parameter_library YAML is the declaration, tied by CMake and by the type of a member."""
    files = {
        "src/c.cpp": "class C : public controller_interface::ControllerInterface { std::shared_ptr<ctl::ParamListener> listener_; };",
        "src/p.yaml": "ctl:\n  gains:\n    p:\n      type: double\n      default_value: 2.0\n",
        "CMakeLists.txt": "project(pkg)\ngenerate_parameter_library(ctl_parameters src/p.yaml)\n",
    }
    entry = workspace.package(files).only("parameter")
    assert (entry.name, entry.type, entry.default, entry.evidence[0].line) == ("gains.p", "double", 2.0, 3)


def test_test_code_is_left_out(workspace: Any) -> None:
    """What stands in test folders is no contract."""
    text = 'class T : public rclcpp::Node { public: T() : Node("t") {} };'
    assert list(workspace.package({"test/t.cpp": text}).modules()) == ["ecm.pkg.pkg"]


def test_two_modules_of_one_name_are_both_kept(workspace: Any) -> None:
    """A second module of the same id takes the name of its file to its own."""
    text = 'class {0} : public rclcpp::Node {{ public: {0}() : Node("same") {{}} }};'
    workspace.package({"src/a.cpp": text.format("A"), "src/b.cpp": text.format("B")})
    assert sorted(workspace.modules()) == ["ecm.pkg.same", "ecm.pkg.same_b"]
