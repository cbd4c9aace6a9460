"""Rules that want the other side of a requirement say the same of stored documents as of sources, line for line."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import pytest
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_parsers.cmake_tokens import parse_commands
from lint_fixtures import FIXTURES

from ecm_extract.cli.run import run
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.lint.catalogue import catalogue
from ecm_extract.lint.known import Known
from ecm_extract.lint.rule import Entry
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.rule_pages import page_of
from ecm_extract.stored import package_of
from ecm_extract.tree import open_tree

TELLING = [entry for entry in catalogue() if entry.tell is not None]
MANIFEST = '<package format="3"><name>{0}</name><version>1.0.0</version>{1}</package>'
CALLS = """import rospy
from driver.srv import Move
rospy.init_node("user")
move = rospy.ServiceProxy("move", Move)
move(angel=1.0)
move(angle=1.0)
"""
MESHES = """<robot name="arm"><link name="a">
  <visual><geometry><mesh filename="package://driver/meshes/hand.dae"/></geometry></visual>
  <visual><geometry><mesh filename="package://driver/meshes/arm.dae"/></geometry></visual>
</link></robot>
"""
DRIVER = {
    "driver/package.xml": MANIFEST.format("driver", "<depend>rclcpp</depend>"),
    "driver/CMakeLists.txt": "project(driver)\nadd_executable(arm_driver a.cpp)\ninstall(TARGETS arm_driver)\n"
    "rosidl_generate_interfaces(driver msg/Grip.msg)\nament_package()\n",
    "driver/a.cpp": "int main() {}\n",
    "driver/msg/Grip.msg": "float64 width\n",
    "driver/srv/Move.srv": "float64 angle\n---\nbool done\n",
    "driver/meshes/arm.dae": "",
    "driver/config/arm.yaml": "a: 1\n",
}
USER = {
    "user/package.xml": MANIFEST.format("user", "<depend>driver</depend>"),
    "user/CMakeLists.txt": "project(user)\nament_package()\n",
    "user/launch/a.launch.xml": "<launch>\n  <node\n    pkg='driver'\n    exec='arm_drvier'/>\n"
    "  <node pkg='driver' exec='arm_driver'/>\n</launch>\n",
    "user/launch/b.launch.xml": "<launch>\n"
    "  <arg name='a' default='$(find-pkg-share driver)/config/am.yaml'/>\n"
    "  <arg name='b' default='$(find-pkg-share driver)/config/arm.yaml'/>\n</launch>\n",
    "user/scripts/a.py": "from driver.msg import Grip, Gripp\n",
    "user/scripts/b.py": CALLS,
    "user/urdf/a.urdf": MESHES,
    "user/msg/Hand.msg": "driver/Gripp left\ndriver/Grip right\n",
}

BUILT = {
    "arm_core/package.xml": MANIFEST.format("arm_core", "<buildtool_depend>catkin</buildtool_depend>"),
    "arm_core/CMakeLists.txt": "project(arm_core)\nadd_library(arm_kernel a.cpp)\n"
    "catkin_package(LIBRARIES arm_kernel)\n",
    "arm_core/launch/base.launch": "<launch>\n  <node pkg='arm_core' type='base' name='arm_base'/>\n</launch>\n",
}
BUILDS = """project(arm_user)
catkin_package(LIBRARIES arm_kernel arm_user)
install(DIRECTORY configs DESTINATION share)
install(DIRECTORY config DESTINATION share)
"""
DIAGNOSED = """analyzers:
  base:
    type: diagnostic_aggregator/GenericAnalyzer
    remove_prefix: arm_base
  hand:
    type: diagnostic_aggregator/GenericAnalyzer
    remove_prefix: arm_hand
"""
OF_BUILDS = {
    "arm_user/package.xml": MANIFEST.format("arm_user", "<buildtool_depend>catkin</buildtool_depend>"),
    "arm_user/CMakeLists.txt": BUILDS,
    "arm_user/config/diagnostics.yaml": DIAGNOSED,
    "arm_user/launch/a.launch": "<launch>\n  <include file='$(find arm_core)/launch/base.launch'/>\n"
    "  <node pkg='diagnostic_aggregator' type='aggregator_node' name='all'>\n"
    "    <rosparam command='load' file='$(find arm_user)/config/diagnostics.yaml'/>\n  </node>\n</launch>\n",
}


def told(known: Known) -> list[Finding]:
    return [finding for entry in TELLING if entry.tell is not None for finding in entry.tell(known)]


def stored(folder: Path) -> list[Package]:
    """The packages of a folder as documents on a disk hold them."""
    found = extract(open_tree(folder), Options(jobs=1, hub=True))
    return [msgspec.json.decode(msgspec.json.encode(package_of(each)), type=Package) for each in found.packages]


def written(folder: Path, *packages: dict[str, str]) -> Path:
    for path, text in (item for package in packages for item in package.items()):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return folder


@pytest.mark.parametrize("name", sorted(f"{each.parent.name}/{each.name}" for each in FIXTURES.glob("*/*")))
def test_documents_give_what_sources_give(name: str, apart: Path) -> None:
    """Over the fixtures of all rules."""
    folder = apart / name
    workspace = Workspace(open_tree(folder), Options(jobs=1))
    documents = stored(folder)
    for part in workspace.parts:
        own = [each for each in documents if each.name in part.by_name]
        assert told(part.known) == told(Known(own, elsewhere=part.known.elsewhere))


def test_another_package_is_known_by_its_document(tmp_path: Path) -> None:
    """The findings on a consumer are the same, lines included, whether its provider is a source or a document."""
    both = Workspace(open_tree(written(tmp_path / "both", DRIVER, USER)), Options(jobs=1))
    documents = stored(written(tmp_path / "driver", DRIVER))
    alone = Workspace(open_tree(written(tmp_path / "user", USER)), Options(jobs=1), stored=documents)
    found = told(alone.known)
    assert found == [each for each in told(both.known) if each.subjects == ("user",)]
    assert [(each.rule, each.evidence[0].line, each.about.new if each.about else "") for each in found] == [
        ("LNT001", 2, ""),
        ("LNT003", 4, "arm_driver"),
        ("LNT010", 1, "Grip"),
        ("LNT017", 1, "driver/Grip"),
        ("LNT025", 2, ""),
        ("LNT031", 5, "angle"),
    ]


def test_what_is_not_known_is_not_missing(tmp_path: Path) -> None:
    """Without the document of the provider nothing is said of it."""
    alone = Workspace(open_tree(written(tmp_path, USER)), Options(jobs=1))
    assert {each.rule for each in told(alone.known)} <= {"LNT055"}


def test_documents_are_named_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a launch file starts is looked for there, and one name that is not there is one finding."""
    provider, user = written(tmp_path / "driver", DRIVER), written(tmp_path / "user", USER)
    assert run(["extract", str(provider), "-o", str(tmp_path / "documents")]) == 0
    assert run(["lint", str(user), "--format", "json"]) == 0
    capsys.readouterr()
    status = run(["lint", str(user), "--format", "json", "--documents", str(tmp_path / "documents")])
    out, err = capsys.readouterr()
    found = [each for each in json.loads(out)["findings"] if each["about"]["kind"] == "executable"]
    assert (status, [each["rule"] for each in found]) == (1, ["LNT003"])
    assert found[0]["edit"] == {"kind": "rename", "old": "arm_drvier", "new": "arm_driver"}
    assert "known from documents: 1 packages" in err
    assert "not asked of documents: LNT021, LNT037, LNT041" in err
    assert "asked of sources alone: LNT006 (remaps of nodes), LNT049 (sizes of meshes)" in err


def test_a_launch_file_that_is_not_there_is_told_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By the rule that evaluates the launch, and not again as a name that the document of its package lacks."""
    core = {
        "core/package.xml": MANIFEST.format("core", ""),
        "core/CMakeLists.txt": "project(core)\ninstall(DIRECTORY launch DESTINATION share/core)\n",
        "core/launch/there.launch": "<launch/>\n",
    }
    include = "<launch><include file='$(find core)/launch/includes/gone.launch'/></launch>\n"
    user = {
        "user/package.xml": MANIFEST.format("user", "<depend>core</depend>"),
        "user/launch/a.launch": include,
    }
    assert run(["extract", str(written(tmp_path / "core", core)), "-o", str(tmp_path / "documents")]) == 0
    capsys.readouterr()
    documents = ["--documents", str(tmp_path / "documents")]
    run(["lint", str(written(tmp_path / "user", user)), "--format", "json", *documents])
    found = json.loads(capsys.readouterr().out)["findings"]
    assert [each["rule"] for each in found if each["evidence"][0]["path"].endswith("a.launch")] == ["LNT001"]


def test_a_package_for_tests_that_is_named_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is left out of its tree, which only its document tells here."""
    (written(tmp_path / "all", DRIVER) / "driver").rename(tmp_path / "all/test_driver")
    assert run(["extract", str(tmp_path / "all"), "-o", str(tmp_path / "documents")]) == 0
    capsys.readouterr()
    run(["lint", str(tmp_path / "all/test_driver"), "--documents", str(tmp_path / "documents")])
    assert "judged because it is named: driver, which is for tests by its folder" in capsys.readouterr().err


@pytest.mark.parametrize("entry", [each for each in catalogue() if each.rule.of_one_tree or each.rule.of_sources])
def test_what_documents_do_not_answer_stands_in_the_page(entry: Entry) -> None:
    """Of a rule that is not asked of documents, or of sources alone in part."""
    assert "`--documents`" in page_of(entry.rule.id)


def test_libraries_and_nodes_of_another_package_are_known_by_its_document(tmp_path: Path) -> None:
    """LNT040, LNT044 and LNT059 say of a consumer alone what they say of it beside the source of its provider."""
    both = Workspace(open_tree(written(tmp_path / "both", BUILT, OF_BUILDS)), Options(jobs=1))
    documents = stored(written(tmp_path / "provider", BUILT))
    folder = written(tmp_path / "user", OF_BUILDS)
    found = told(Workspace(open_tree(folder), Options(jobs=1), stored=documents).known)
    assert found == [each for each in told(both.known) if each.subjects == ("arm_user",)]
    assert by_line(found) == [("LNT040", 5), ("LNT044", 2), ("LNT059", 3)]
    assert [each.about.old for each in found if each.rule == "LNT044" and each.about] == ["arm_user"]
    without = told(Workspace(open_tree(folder), Options(jobs=1)).known)
    assert by_line(without) == [("LNT044", 2), ("LNT044", 2), ("LNT059", 3)]


MODULES = {
    "arm_core/package.xml": MANIFEST.format("arm_core", "<buildtool_depend>catkin</buildtool_depend>"),
    "arm_core/CMakeLists.txt": "project(arm_core)\nadd_library(arm_kernel a.cpp)\ncatkin_package()\n",
    "arm_core/a.cpp": "PLUGINLIB_EXPORT_CLASS(arm_core::Grip, arm_core::Base)\n",
    "arm_core/src/arm_core/__init__.py": "",
    "arm_core/src/arm_core/pose.py": "import math\n\n\ndef _turned():\n    return math.pi\n",
    "arm_core/launch/base.launch": "<launch>\n  <arg name='rate'/>\n  <arg name='port'/>\n"
    "  <param name='r' value='$(arg rate)'/>\n  <param name='p' value='$(arg port)'/>\n</launch>\n",
    "arm_core/scripts/gps.py": "import rospy\nfrom sensor_msgs.msg import NavSatFix\nrospy.init_node('gps')\n"
    "p = rospy.Publisher('/pilot/global/fix', NavSatFix, queue_size=1)\n",
}
OF_MODULES = {
    "arm_user/package.xml": MANIFEST.format("arm_user", "<depend>arm_core</depend>"),
    "arm_user/CMakeLists.txt": "project(arm_user)\ncatkin_package()\n",
    "arm_user/scripts/a.py": "from arm_core.pose import _turned, turned\nfrom arm_core import shape\n"
    "import arm_core.poses\nimport arm_core.pose as pose\n"
    "print(_turned, turned, shape, arm_core, pose.math, pose.made)\n",
    "arm_user/scripts/fix.py": "import rospy\nfrom sensor_msgs.msg import NavSatFix\nrospy.init_node('fix')\n"
    "rospy.Subscriber('/pilot/gps/fix', NavSatFix, print)\n",
    "arm_user/launch/a.launch": "<launch>\n  <include file='$(find arm_core)/launch/base.launch'>\n"
    "    <arg name='rate' value='1'/>\n    <arg name='speed' value='1'/>\n  </include>\n</launch>\n",
}


def test_modules_arguments_and_endpoints_of_another_package_are_known_by_its_document(tmp_path: Path) -> None:
    """LNT011, LNT029 and LNT056 say of a consumer alone what they say of it beside the source of its provider."""
    both = Workspace(open_tree(written(tmp_path / "both", MODULES, OF_MODULES)), Options(jobs=1))
    documents = stored(written(tmp_path / "provider", MODULES))
    folder = written(tmp_path / "user", OF_MODULES)
    found = told(Workspace(open_tree(folder), Options(jobs=1), stored=documents).known)
    of_user = [each for each in told(both.known) if each.subjects == ("arm_user",)]
    assert [own(each) for each in found] == [own(each) for each in of_user]
    assert {at.path.partition("/")[0] for each in found for at in each.evidence} == {"arm_user"}
    assert by_line(found) == [("LNT011", 1), ("LNT011", 2), ("LNT011", 3), ("LNT029", 4), ("LNT056", 2), ("LNT056", 2)]
    assert by_line(told(Workspace(open_tree(folder), Options(jobs=1)).known)) == []


def own(finding: Finding) -> tuple[str, str, list[int]]:
    """What is said of the consumer: lines of its provider are of another tree."""
    return finding.rule, finding.message, [at.line for at in finding.evidence if at.path.startswith("arm_user")]


def by_line(findings: list[Finding]) -> list[tuple[str, int]]:
    return sorted((each.rule, each.evidence[0].line) for each in findings if each.rule != "LNT055")


def test_build_files_are_parsed_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """However many rules and requirements want the words of a build file."""
    seen: list[bytes] = []

    def parsed(data: bytes) -> object:
        seen.append(data)
        return parse_commands(data)

    monkeypatch.setattr("ecm_extract.lint.workspace.parse_commands", parsed)
    workspace = Workspace(open_tree(written(tmp_path, BUILT, OF_BUILDS)), Options(jobs=1))
    assert "LNT059" in {each.rule for each in findings_of(workspace, ("LNT044", "LNT059"))}
    assert len(seen) == len(set(seen)) == 2


def test_a_header_that_only_a_document_includes(tmp_path: Path) -> None:
    """LNT058: who includes a header that is not installed may be known by a document; its line is marked."""
    build = "project(driver)\nadd_library(a a.cpp)\ninstall(TARGETS a DESTINATION lib)\nament_package()\n"
    provider = {
        "driver/package.xml": MANIFEST.format("driver", "<buildtool_depend>ament_cmake</buildtool_depend>"),
        "driver/CMakeLists.txt": build,
        "driver/include/driver/arm.hpp": "class Arm {};\n",
    }
    user = {"user/package.xml": MANIFEST.format("user", ""), "user/src/a.cpp": "#include <driver/arm.hpp>\n"}
    both = Workspace(open_tree(written(tmp_path / "both", {**provider, **user})), Options(jobs=1))
    documents = stored(written(tmp_path / "user", user))
    alone = Workspace(open_tree(written(tmp_path / "driver", provider)), Options(jobs=1), stored=documents)
    lines = [
        [(at.path, at.line) for each in findings_of(one, ("LNT058",)) for at in each.evidence] for one in (both, alone)
    ]
    assert lines[0] == [("driver/CMakeLists.txt", 1), ("user/src/a.cpp", 1)]
    assert lines[1] == [("driver/CMakeLists.txt", 1), ("document:user/user/src/a.cpp", 1)]


FILTERS = {
    "filters/package.xml": MANIFEST.format("filters", ""),
    "filters/include/estimation/filter.hpp": "class Filter {};\n",
    "filters/include/filters/plain.hpp": "class Plain {};\n",
}
FILTERED = {
    "robot/package.xml": MANIFEST.format("robot", ""),
    "robot/src/a.cpp": "#include <estimation/filter.hpp>\n#include <filters/plain.hpp>\n#include <other/x.hpp>\n",
}


def test_headers_of_documents_belong_to_their_package(tmp_path: Path) -> None:
    """A package that only its document tells of is not named by package.xml either (LNT020)."""
    documents = stored(written(tmp_path / "filters", FILTERS))
    alone = Workspace(open_tree(written(tmp_path / "robot", FILTERED)), Options(jobs=1), stored=documents)
    together = Workspace(open_tree(written(tmp_path / "both", {**FILTERS, **FILTERED})), Options(jobs=1))
    found, expected = ([each for each in findings_of(space) if each.rule == "LNT020"] for space in (alone, together))
    assert [each.message.partition(":")[0] for each in found] == [
        "robot uses filters, which its package.xml does not name"
    ]
    assert [at.line for at in found[0].evidence] == [1, 2]
    assert [each.message for each in expected] == [each.message for each in found]
