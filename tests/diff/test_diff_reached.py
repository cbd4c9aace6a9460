"""Consumers that reach what changed by a base class, a call, a list, a package, a folder; and near-misses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from diff_repos import package, release, write

from ecm_extract.cli.run import run

HEADER = """#pragma once
namespace lib {{
struct Joint {{ double {member}; }};
class Arm {{
 public:
  virtual void {method}(int count);
 protected:
  std::vector<Joint> joints_;
  {held} node_;
}};
std::vector<Joint> read_all();
namespace old {{
{alias}
}}
enum class Code {{ GOOD, BAD }};
}}
"""
BEFORE = {"member": "angle", "method": "stop", "held": "std::shared_ptr<Node>", "alias": "using Code = lib::Code;"}
USER = """#include <lib/arm.hpp>
using namespace lib;
class Mine : public Arm {{
 public:
  void run() {{
    {line}
  }}
}};
"""
MAKE = "project(user)\nadd_library(user src/user.cpp)\n"
LINES: dict[str, tuple[dict[str, str], str, bool]] = {
    "element of a protected list": ({"member": "value"}, "use(joints_[0].angle);", True),
    "another member of the element": ({"member": "value"}, "use(joints_[0].name);", False),
    "element of a result": ({"member": "value"}, "for (auto & j : lib::read_all()) { use(j.angle); }", True),
    "result by a variable": ({"member": "value"}, "auto all = lib::read_all(); use(all[0].angle);", True),
    "own local of that name": ({"member": "value"}, "Other angle; use(angle.angle);", False),
    "method of the base": ({"method": "halt"}, "stop();", True),
    "method of the base by this": ({"method": "halt"}, "this->stop();", True),
    "method of the base of another name": ({"method": "halt"}, "start();", False),
    "what a member holds": ({"held": "std::weak_ptr<Node>"}, "node_->spin();", True),
    "a member that is handed on": ({"held": "std::weak_ptr<Node>"}, "use(node_);", False),
    "alias of an enumeration": ({"alias": ""}, "use(lib::old::Code::GOOD);", True),
    "the enumeration itself": ({"alias": ""}, "use(lib::Code::GOOD);", False),
}


def named(capsys: pytest.CaptureFixture[str], repo: Path, user: Path) -> list[str]:
    """Return path and line of what breaks in the consumer."""
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--consumer", str(user), "--format", "json"])
    found = json.loads(capsys.readouterr().out)["findings"]
    places = (at for each in found if each["rule"] == "VER001" for at in each["evidence"])
    return [f"{at['path']}:{at['line']}" for at in places if (user / at["path"]).is_file()]


@pytest.mark.parametrize(("change", "line", "breaks"), LINES.values(), ids=LINES)
def test_what_is_reached_through_another_package(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], change: dict[str, str], line: str, breaks: bool
) -> None:
    """The line is named, and only when what it reaches changed."""
    for tag, values in (("1.0.0", BEFORE), ("2.0.0", BEFORE | change)):
        files = {"package.xml": package("lib", tag), "CMakeLists.txt": "project(lib)\n"}
        release(tmp_path / "lib", {**files, "include/lib/arm.hpp": HEADER.format(**values)}, tag)
    user = tmp_path / "user"
    write(user, {"package.xml": package("user"), "CMakeLists.txt": MAKE, "src/user.cpp": USER.format(line=line)})
    assert ("src/user.cpp:6" in named(capsys, tmp_path / "lib", user)) is breaks


PLUGINS = '<library path="x"><class name="{name}" type="arm::Grip" base_class_type="c::C"/></library>\n'
CONTROLLERS = "manager:\n  ros__parameters:\n    grip:\n      type: arm_grip/Grip\n"
GRIPS = "project(arm_grip)\nrosidl_generate_interfaces(arm_grip msg/Grip.msg)\n"
DEPENDS = package("user").replace("rclcpp", "arm_grip")


def test_what_went_with_its_package_is_gone_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A dependency and a plugin of a package that left; one that stayed is nobody's concern."""
    kept: dict[str, str | None] = {"arm/package.xml": package("arm")}
    gone: dict[str, str | None] = {
        "grip/package.xml": package("arm_grip"),
        "grip/CMakeLists.txt": "project(arm_grip)\npluginlib_export_plugin_description_file(c plugins.xml)\n",
        "grip/plugins.xml": PLUGINS.format(name="arm_grip/Grip"),
    }
    release(tmp_path / "lib", kept | gone, "1.0.0")
    release(tmp_path / "lib", dict.fromkeys(gone), "2.0.0")
    user = tmp_path / "user"
    write(user, {"package.xml": DEPENDS, "config/controllers.yaml": CONTROLLERS})
    assert named(capsys, tmp_path / "lib", user) == ["config/controllers.yaml:4", "package.xml:3"]


@pytest.mark.parametrize(("after", "told"), [(None, False), (package("arm_hand"), True)], ids=["left", "renamed"])
def test_a_release_that_depends_on_what_left_it_takes_it_from_elsewhere(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], after: str | None, told: bool
) -> None:
    """A package that a repository gave away is still there; one that it renamed is not, and the line was forgotten."""
    arm = package("arm").replace("rclcpp", "arm_grip")
    message = {"grip/msg/Grip.msg": "bool closed\n", "grip/CMakeLists.txt": GRIPS}
    release(tmp_path / "lib", {"arm/package.xml": arm, "grip/package.xml": package("arm_grip"), **message}, "1.0.0")
    moved = {"grip/CMakeLists.txt": GRIPS.replace("arm_grip", "arm_hand")} if after else dict.fromkeys(message)
    release(tmp_path / "lib", {"grip/package.xml": after, **moved}, "2.0.0")
    run(["diff", "1.0.0", "2.0.0", "--repo", str(tmp_path / "lib"), "--format", "json"])
    found = [at["path"] for each in json.loads(capsys.readouterr().out)["findings"] for at in each["evidence"]]
    assert ("arm/package.xml" in found) is told


@pytest.mark.parametrize(
    ("path", "breaks"), [("$(find arm)/launch/includes/arm.launch", True), ("$(find arm)/launch/top/arm.launch", False)]
)
def test_an_include_by_a_path_that_a_launch_file_left(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], path: str, breaks: bool
) -> None:
    """Only who names the folder that it lay in."""
    text = "<launch/>\n"
    manifest = {"package.xml": package("arm")}
    release(tmp_path / "arm", {**manifest, "launch/includes/arm.launch": text}, "1.0.0")
    release(tmp_path / "arm", {"launch/includes/arm.launch": None, "launch/arm/arm.launch": text}, "2.0.0")
    user = tmp_path / "user"
    include = f'<launch>\n<include file="{path}"/>\n</launch>\n'
    write(user, {"package.xml": package("user"), "launch/user.launch": include})
    assert ("launch/user.launch:2" in named(capsys, tmp_path / "arm", user)) is breaks


LAYER = """#include <rclcpp/rclcpp.hpp>
namespace lib {{
class Layer {{
 public:
  void init(rclcpp::Node * node) {{ node->declare_parameter(name_ + ".{parameter}", 1.0); }}
  std::string name_;
}};
}}
"""
BLOCK = "map:\n  ros__parameters:\n    layer:\n      plugin: {plugin}\n      range: 2.0\n"


@pytest.mark.parametrize(("plugin", "breaks"), [("lib::Layer", True), ("other::Layer", False)])
def test_a_parameter_in_the_block_of_another_plugin_is_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], plugin: str, breaks: bool
) -> None:
    """A computed name fits any block; the plugin that the block names tells whose it is."""
    make = "project(lib)\nadd_library(layer SHARED src/layer.cpp)\ninstall(TARGETS layer DESTINATION lib)\n"
    make += "pluginlib_export_plugin_description_file(c plugins.xml)\n"
    described = '<library path="layer"><class name="lib::Layer" type="lib::Layer" base_class_type="c::C"/></library>\n'
    for tag, name in (("1.0.0", "range"), ("2.0.0", "max_range")):
        files = {"package.xml": package("lib", tag), "CMakeLists.txt": make, "plugins.xml": described}
        header = {"include/lib/layer.hpp": LAYER.format(parameter=name)}
        release(tmp_path / "lib", {**files, **header, "src/layer.cpp": "#include <lib/layer.hpp>\n"}, tag)
    user = tmp_path / "user"
    write(user, {"package.xml": package("user"), "config/map.yaml": BLOCK.format(plugin=plugin)})
    assert ("config/map.yaml:5" in named(capsys, tmp_path / "lib", user)) is breaks
