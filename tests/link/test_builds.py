"""What a build makes of sources: which of them are programs, and which header an #include means."""

from __future__ import annotations

from typing import Any

MAIN = """#include "pkg/node.hpp"
int main(int c, char ** v) {{ auto n = std::make_shared<rclcpp::Node>("{0}"); n->create_publisher<std_msgs::msg::Bool>("{0}_topic", 1); }}
"""
WINDOW = 'struct Window {{ void open(rclcpp::Node * n) {{ n->create_publisher<std_msgs::msg::Bool>("{0}", 1); }} }};\n'
USER = """#include "{}"
int main(int c, char ** v) {{ auto n = std::make_shared<rclcpp::Node>("n"); Window w; w.open(n.get()); }}
"""


def endpoints(workspace: Any) -> dict[str, set[str]]:
    """Names of the endpoints of each module."""
    return {
        name.removeprefix("ecm.pkg."): {entry.name for entry in module.signature.interfaces}
        for name, module in workspace.modules().items()
    }


def test_only_what_a_target_builds_is_a_program(workspace: Any) -> None:
    """A second `main` that lies beside, and that CMake does not name, is no program."""
    cmake = "project(pkg)\nadd_executable(driver src/main.cpp)\n# add_executable(old src/old_main.cpp)\n"
    files = {"CMakeLists.txt": cmake, "src/main.cpp": MAIN.format("new"), "src/old_main.cpp": MAIN.format("old")}
    assert endpoints(workspace.package(files)) == {"driver": {"/new_topic"}}


def test_a_source_that_may_be_built_is_kept(workspace: Any) -> None:
    """Where a command from elsewhere may build it, nothing is left out."""
    cmake = "project(pkg)\nadd_executable(driver src/main.cpp)\nmy_programs(old)\n"
    files = {"CMakeLists.txt": cmake, "src/main.cpp": MAIN.format("new"), "src/old_main.cpp": MAIN.format("old")}
    assert endpoints(workspace.package(files)) == {"driver": {"/new_topic"}, "old_main": {"/old_topic"}}


def test_a_source_that_is_included_is_kept(workspace: Any) -> None:
    """Templates may stand in a `.cpp` that a header includes."""
    cmake = "project(pkg)\nadd_executable(driver src/main.cpp)\n"
    files = {"CMakeLists.txt": cmake, "src/main.cpp": USER.format("window.cpp"), "src/window.cpp": WINDOW.format("w")}
    assert endpoints(workspace.package(files)) == {"driver": {"/w"}}


def test_a_header_of_the_same_folder_is_meant(workspace: Any) -> None:
    """Two programs have a header of one name each, beside their sources."""
    cmake = "project(pkg)\nadd_executable(one src/one/main.cpp)\nadd_executable(two src/two/main.cpp)\n"
    files = {"CMakeLists.txt": cmake}
    for name in ("one", "two"):
        files |= {f"src/{name}/main.cpp": USER.format("window.hpp"), f"src/{name}/window.hpp": WINDOW.format(name)}
    assert endpoints(workspace.package(files)) == {"one": {"/one"}, "two": {"/two"}}


def test_a_header_of_the_folders_of_the_target_is_meant(workspace: Any) -> None:
    """Each target looks in its own folders."""
    cmake = "project(pkg)\n" + "".join(
        f"add_executable({name} src/{name}.cpp)\ntarget_include_directories({name} PRIVATE inc/{name})\n"
        for name in ("one", "two")
    )
    files = {"CMakeLists.txt": cmake}
    for name in ("one", "two"):
        files |= {f"src/{name}.cpp": USER.format("window.hpp"), f"inc/{name}/window.hpp": WINDOW.format(name)}
    assert endpoints(workspace.package(files)) == {"one": {"/one"}, "two": {"/two"}}


def test_programs_of_included_macros_have_their_names(workspace: Any) -> None:
    """CMake's own way to say the same for many programs."""
    macros = "macro(program name)\nadd_executable(${name}_node src/${name}.cpp)\nendmacro()\n"
    cmake = "project(pkg)\nforeach(f programs)\ninclude(cmake/${f}.cmake)\nendforeach()\nprogram(arm)\n"
    files = {"CMakeLists.txt": cmake, "cmake/programs.cmake": macros, "src/arm.cpp": MAIN.format("arm")}
    assert endpoints(workspace.package(files)) == {"arm_node": {"/arm_topic"}}


UNUSED = """#include <ros/ros.h>
class Robot {
 public:
  Robot() { pub_ = nh_.advertise<std_msgs::String>("used", 1); }
  void back() { sub_ = nh_.subscribe("unused", 1, &Robot::take, this); }
  void take(const std_msgs::StringConstPtr & message) {}
  ros::NodeHandle nh_;
  ros::Publisher pub_;
  ros::Subscriber sub_;
};
"""
MAIN_OF_ROBOT = 'int main(int c, char ** v) { ros::init(c, v, "n"); Robot robot; ros::spin(); }\n'


def test_what_no_program_runs_is_nobodys_where_only_programs_compile_it(workspace: Any) -> None:
    """A method that nobody calls makes nothing; where others can link or include it, it is the library's."""
    both = {"src/main.cpp": '#include "robot.hpp"\n' + MAIN_OF_ROBOT, "src/robot.hpp": UNUSED}
    only = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(robot src/main.cpp)\n",
        "src/main.cpp": UNUSED + MAIN_OF_ROBOT,
    }
    assert endpoints(workspace.package(only, ros=1, name="only")) == {"ecm.only.robot": {"/used"}}
    found = endpoints(workspace.package(both, ros=1))
    assert {"/unused"} in [names for module, names in found.items() if module != "ecm.only.robot"]


TABLE = """#include <ros/ros.h>
ros::NodeHandle * handle;
struct Limit { void (*set)(Limit &) = nullptr; double most; };
void set_limit(Limit & limit) { limit.most = handle->param("most", 2.0); }
std::map<std::string, Limit> limits{{"speed", {&set_limit}}};
int main(int c, char ** v) {
  ros::init(c, v, "n");
  handle = new ros::NodeHandle("/limits");
  for (auto & limit : limits) { limit.second.set(limit.second); }
  ros::spin();
}
"""


def test_what_a_table_of_functions_holds_is_told_though_nobody_calls_it(workspace: Any) -> None:
    """A function whose address stands outside of functions can run."""
    files = {"CMakeLists.txt": "project(pkg)\nadd_executable(robot src/main.cpp)\n", "src/main.cpp": TABLE}
    assert set.union(*endpoints(workspace.package(files, ros=1)).values()) == {"/limits/most"}
