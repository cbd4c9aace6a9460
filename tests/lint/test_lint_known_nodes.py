"""Rules that ask one evaluated launch for the other side know nodes of other packages by their documents."""

from __future__ import annotations

from pathlib import Path

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.report.places import Places, placed_for
from ecm_extract.stored import package_of
from ecm_extract.tree import open_tree

RULES = ("LNT005", "LNT006", "LNT015", "LNT045")
MANIFEST = """<package format="3"><name>{0}</name><version>1.0.0</version><depend>rclcpp</depend>
<depend>std_msgs</depend><export><build_type>ament_cmake</build_type></export></package>"""
BUILD = "project({0})\nadd_executable({0} src/main.cpp)\ninstall(TARGETS {0} DESTINATION lib/{0})\nament_package()\n"
NODE = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Main : public rclcpp::Node
{{
public:
  Main() : Node("{0}")
  {{
    {1}
  }}
}};
int main(int argc, char ** argv)
{{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Main>());
}}
"""
PUBLISHES = 'create_publisher<std_msgs::msg::String>("arm_states", 10); declare_parameter<double>("frame_rate", 1.0);'
SUBSCRIBES = 'create_subscription<std_msgs::msg::String>("arm_state", 10, f);'
LAUNCH = """<launch>
  <node pkg="driver" exec="driver">
    <param name="frame_rte" value="1.0"/>
    <remap from="arm_stats" to="b"/>
  </node>
  <node pkg="user" exec="user"/>
</launch>
"""


BELOW = """<launch>
  <group>
    <push-ros-namespace namespace="left"/>
    <node pkg="driver" exec="driver" name="driver"/>
  </group>
  <node pkg="user" exec="user">
    <remap from="arm_state" to="/driver/{0}"/>
  </node>
</launch>
"""


def package(folder: Path, name: str, body: str) -> None:
    files = {"package.xml": MANIFEST.format(name), "CMakeLists.txt": BUILD.format(name)}
    for path, text in (files | {"src/main.cpp": NODE.format(name, body)}).items():
        (folder / name / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / name / path).write_text(text)


def user(folder: Path, launch: str = LAUNCH) -> Path:
    package(folder, "user", SUBSCRIBES)
    (folder / "user" / "launch").mkdir()
    (folder / "user" / "launch" / "a.launch.xml").write_text(launch)
    return folder


def stored(folder: Path) -> list[Package]:
    found = extract(open_tree(folder), Options(jobs=1, hub=True))
    return [msgspec.json.decode(msgspec.json.encode(package_of(each)), type=Package) for each in found.packages]


def linted(folder: Path, *documents: Package) -> list[Finding]:
    return findings_of(Workspace(open_tree(folder), Options(jobs=1), stored=documents))


def rows(findings: list[Finding]) -> list[tuple[str, str, int]]:
    places = ((each.rule, each.evidence[0].path, each.evidence[0].line) for each in findings if each.rule in RULES)
    return sorted(places)


def test_nodes_are_known_by_documents(tmp_path: Path) -> None:
    """Of remaps documents do not tell enough: a helper whose text they do not hold may use the name."""
    package(tmp_path / "both", "driver", PUBLISHES)
    package(tmp_path / "driver", "driver", PUBLISHES)
    parameter, remap = ("LNT005", "user/launch/a.launch.xml", 3), ("LNT006", "user/launch/a.launch.xml", 4)
    topic = ("LNT015", "user/src/main.cpp", 8)
    assert rows(linted(user(tmp_path / "both"))) == [parameter, remap, topic]
    folder = user(tmp_path / "user")
    assert rows(linted(folder, *stored(tmp_path / "driver"))) == [parameter, topic]
    assert rows(linted(folder)) == []


def test_lines_of_documents_are_none_of_the_tree(tmp_path: Path) -> None:
    """Another tree may have a file of the same path: its lines are marked, and no code host is sent to them."""
    package(tmp_path / "driver", "driver", PUBLISHES)
    folder = user(tmp_path / "user")
    found = linted(folder, *stored(tmp_path / "driver"))
    assert {each.rule for each in found} >= {"LNT005", "LNT015"}
    assert all((folder / each.evidence[0].path).is_file() for each in found if each.evidence)
    others = {at.path for each in found for at in each.evidence if not (folder / at.path).is_file()}
    assert others == {"document:driver/driver/src/main.cpp"}
    places = Places(str(folder))
    for form, shown in (("json", others), ("text", others), ("sarif", set())):
        paths = (places.from_here(at).path for each in placed_for(form, found, places) for at in each.evidence)
        assert {path for path in paths if path.startswith("document:")} == shown


def test_names_of_a_node_in_a_namespace_are_known_by_its_document(tmp_path: Path) -> None:
    """Who remaps to a name that the node has nowhere means another node."""
    package(tmp_path / "driver", "driver", PUBLISHES)
    documents = stored(tmp_path / "driver")
    remap = [("LNT045", "user/launch/a.launch.xml", 7)]
    for name, known, unknown in (("arm_states", remap, remap), ("other", [], remap)):
        folder = user(tmp_path / name, BELOW.format(name))
        assert rows(linted(folder, *documents)) == known
        assert rows(linted(folder)) == unknown
