"""Sources beside the packages are read for the targets that are made of them: what they make was told nowhere."""

from __future__ import annotations

from typing import Any

CMAKE = """
set(SHARED ${CMAKE_CURRENT_SOURCE_DIR}/../shared)
add_executable(n src/n.cpp ${SHARED}/worker.cpp)
target_include_directories(n PUBLIC ${SHARED})
"""
MAIN = """
#include "worker.hpp"
class N : public rclcpp::Node {
public:
  N() : Node("n") { worker_ = std::make_unique<Worker>(this); }
  std::unique_ptr<Worker> worker_;
};
int main(int c, char ** v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<N>()); }
"""
HEADER = """
#include "topic.hpp"
class Worker { public: explicit Worker(rclcpp::Node * node); };
"""
WORKER = """
#include "worker.hpp"
Worker::Worker(rclcpp::Node * node) { auto p = node->create_publisher<std_msgs::msg::String>(kTopic, 10); }
"""
TOPIC = 'constexpr const char * kTopic = "found";\n'
OTHER = 'void other(rclcpp::Node * node) { node->declare_parameter("nobody", 1); }\n'


def _shared(folder: Any) -> None:
    folder.mkdir(parents=True)
    files = {"worker.hpp": HEADER, "worker.cpp": WORKER, "topic.hpp": TOPIC, "other.cpp": OTHER}
    for name, text in files.items():
        (folder / name).write_text(text)


def _names(workspace: Any) -> list[tuple[str, str]]:
    package = workspace.package({"src/n.cpp": MAIN, "CMakeLists.txt": CMAKE}, name="p")
    return [(each.role, each.name) for each in package.interfaces() if each.role in {"publisher", "parameter"}]


def test_a_source_beside_the_package_is_read_with_its_headers(workspace: Any) -> None:
    """The headers bring the class and the topic; what no target is made of is not read."""
    _shared(workspace.root / "shared")
    assert _names(workspace) == [("publisher", "/found")]


def test_what_the_project_leaves_out_is_not_read(workspace: Any) -> None:
    """A source that is left out stays out, wherever it lies."""
    _shared(workspace.root / "shared")
    (workspace.root / "ecm.toml").write_text('[extract]\nexclude = ["shared/*"]\n')
    assert _names(workspace) == []
