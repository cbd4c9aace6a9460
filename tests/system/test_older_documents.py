"""Documents of older versions: names for any namespace and node in one text each."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from ecm_checker.hub.local_name import LocalName, OpenPart
from workspaces import Workspace

from ecm_extract.cli.run import run
from ecm_extract.system.names import Around, resolve

NODE = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>
#include <p/base.hpp>
class Arm : public rclcpp::Node {
public:
  Arm() : Node("arm", "left") {
    topic_ = declare_parameter<std::string>("topic", "state");
    state_ = create_publisher<std_msgs::msg::Bool>(topic_, 1);
    own_ = create_publisher<std_msgs::msg::Bool>(std::string(get_name()) + "/own", 1);
    above_ = create_publisher<std_msgs::msg::Bool>(std::string(get_namespace()) + "/beside", 1);
  }
  std::string topic_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr state_, own_, above_;
};
namespace p {
class Grip : public p::Base {
  void configure(rclcpp::Node::SharedPtr node, const std::string & label) override {
    node->declare_parameter(label + ".force", 3);
    done_ = node->create_publisher<std_msgs::msg::Bool>(label + "/done", 1);
  }
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr done_;
};
}
PLUGINLIB_EXPORT_CLASS(p::Grip, p::Base)
int main() { rclcpp::spin(std::make_shared<Arm>()); }
"""
BUILD = "project(pkg)\nadd_executable(arm src/arm.cpp)\npluginlib_export_plugin_description_file(p plugins.xml)\n"
PLUGINS = '<library path="pkg"><class name="p::Grip" type="p::Grip" base_class_type="p::Base"/></library>'
LAUNCH = """<launch>
<node pkg="pkg" exec="arm" name="first"><param name="hand.plugin" value="p::Grip"/></node>
<node pkg="pkg" exec="arm" name="second" namespace="right"><param name="topic" value="there"/></node>
</launch>"""
_TOLD = {"node": "{node}", "namespace": "{node namespace}", "above": "{parent namespace}"}


def _text(name: Any) -> str:
    if isinstance(name, str):
        return name
    space = f"{{in {name['space']}}}" if name.get("space") else ""
    return space + "".join(_part(part) for part in name["parts"])


def _part(part: Any) -> str:
    if isinstance(part, str):
        return part
    label, default = part.get("label", ""), "".join(map(_part, part.get("default", ())))
    return f"${{{label}={default}}}" if part["of"] == "parameter" else _TOLD.get(part["of"], f"{{{label}}}")


def _aged(document: Path) -> Path:
    """Write a document as older versions did."""
    data = json.loads(document.read_text("utf-8"))
    for endpoint in (
        each for package in data["packages"] for module in package["running"]["modules"] for each in module["endpoints"]
    ):
        local = [_text(name) for name in endpoint.pop("local", ())]
        if local and local != [endpoint["name"]]:
            endpoint["local"] = local
    old = document.with_name("old.json")
    old.write_text(json.dumps(data), "utf-8")
    return old


@pytest.fixture
def document(workspace: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    files = {"src/arm.cpp": NODE, "CMakeLists.txt": BUILD, "plugins.xml": PLUGINS, "launch/a.launch.xml": LAUNCH}
    workspace.package(files, 2)
    assert run(["extract", str(workspace.root), "--quiet", "--format", "json", "-o", "-"]) == 0
    new = tmp_path / "new.json"
    new.write_text(capsys.readouterr().out, "utf-8")
    return new


def test_an_older_document_tells_what_a_new_one_does(document: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The namespace that code gives a node, what parameters give, and the name of a plugin, which it does not say."""
    said = []
    for each in (document, _aged(document)):
        assert run(["system", str(each), "pkg/a.launch.xml", "--format", "json"]) == 0
        said.append(capsys.readouterr().out)
    names = {channel["name"] for channel in json.loads(said[0])["channels"]}
    assert names >= {"/left/state", "/right/there", "/left/first/own", "/right/second/own", "/hand/done"}
    assert said[0] == said[1]


def test_a_document_says_in_fields_who_tells_a_part(document: Path) -> None:
    """Which part is the plugin's own name is a word of the document, nothing to be read off other names."""
    modules = [
        each
        for package in json.loads(document.read_text("utf-8"))["packages"]
        for each in package["running"]["modules"]
    ]
    local = {(module["name"], each["name"]): each.get("local") for module in modules for each in module["endpoints"]}
    assert local["arm", "/left/state"] == [
        {"parts": [{"of": "parameter", "label": "topic", "default": ["state"]}], "space": "left"}
    ]
    assert local["grip", "{label}.force"] == [{"parts": [{"of": "plugin", "label": "label"}, ".force"]}]
    assert local["grip", "/{label}/done"] == [{"parts": [{"of": "plugin", "label": "label"}, "/done"]}]


@pytest.mark.parametrize("text", ["{in arm}out", "${topic=odom}", "{node}/x"])
def test_a_text_means_no_more_than_it_says(text: str) -> None:
    """Names are put together of fields, so braces that a source writes are braces of the name."""
    around = Around("/space", "node", (), lambda name: None)
    names = [each.name for each in resolve(LocalName((text, OpenPart("parameter", "p", (text,)))), around)]
    assert names == [f"/space/{text}{text}"]
