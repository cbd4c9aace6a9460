"""Objects that read parameters below a handle, and put a prefix before the names that they are given."""

from __future__ import annotations

from typing import Any

import pytest

ROS1 = """
#include <ros/ros.h>
class Camera {{
 public:
  Camera() : nh_("~"), held_(nh_, "camera") {{
    mrs_lib::ParamLoader loader(nh_, "camera");
    {body}
  }}
  void change() {{ held_.setPrefix(given()); }}
  ros::NodeHandle nh_;
  mrs_lib::ParamLoader held_;
  double rate_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  Camera camera;
}}
"""
BODIES = [
    ('loader.loadParam("rate", rate_);', "/demo/rate", "double", None),
    ('loader.loadParam("rate", rate_, 2.5);', "/demo/rate", "double", 2.5),
    ('rate_ = loader.loadParam2<double>("rate", 2.5);', "/demo/rate", "double", 2.5),
    (
        'loader.setPrefix("a/"); loader.setPrefix("b/"); loader.loadParam("rate", rate_);',
        "/demo/b/rate",
        "double",
        None,
    ),
    ('std::string ns = "b/"; loader.setPrefix(ns); loader.loadParam("rate", rate_);', "/demo/b/rate", "double", None),
    ('loader.loadParam("rate", rate_); loader.setPrefix("a/");', "/demo/rate", "double", None),
    (
        'if (rate_ > 1.0) { loader.setPrefix("a/"); } loader.loadParam("rate", rate_);',
        "/demo/{prefix}rate",
        "double",
        None,
    ),
    ('held_.loadParam("rate", rate_);', "/demo/{prefix}rate", "double", None),
    ('loader.setPrefix("a/"); loader.addYamlFileFromParam("config");', "/demo/config", None, None),
]


@pytest.mark.parametrize(("body", "name", "kind", "default"), BODIES, ids=[row[0][:60] for row in BODIES])
def test_a_loader_reads_below_its_handle_and_prefix(
    workspace: Any, body: str, name: str, kind: str | None, default: object
) -> None:
    """The prefix is what was set last before the call; one that nobody can decide stays open."""
    entry = workspace.package({"src/demo.cpp": ROS1.format(body=body)}, 1).only("parameter")
    assert (entry.name, entry.type, entry.default) == (name, kind, default)


def test_a_method_of_that_name_elsewhere_reads_nothing(workspace: Any) -> None:
    """Only an object of the class reads parameters."""
    body = 'other.loadParam("rate", rate_);'
    assert workspace.package({"src/demo.cpp": ROS1.format(body=body)}, 1).interfaces() == []
