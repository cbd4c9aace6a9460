"""Defaults that no call states: what a variable holds when its parameter is not set."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
class Demo {{
 public:
  Demo() : pnh_("~"), initialised_(3) {{
    {body}
  }}
  void later() {{ elsewhere_ = 4; }}
  ros::NodeHandle pnh_;
  int member_ = 2, initialised_, elsewhere_, plain_;
  double wide_;
  std::string text_;
  Config config_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "demo"); Demo demo; }}
"""
ROWS = [
    ('if (!pnh_.getParam("p", plain_)) plain_ = 5;', "integer", 5),
    ('if (!pnh_.getParam("p", text_)) { ROS_WARN("unset"); text_ = "map"; }', "string", "map"),
    ('if (pnh_.getParam("p", plain_) == false) { plain_ = 6; }', "integer", 6),
    ('if (!pnh_.getParam("p", wide_)) wide_ = 1;', "double", 1),
    ('double rate = 0.5; pnh_.getParam("p", rate);', "double", 0.5),
    ('pnh_.getParam("p", member_);', "integer", 2),
    ('pnh_.getParam("p", initialised_);', "integer", 3),
    ('double rate; pnh_.getParam("p", rate);', "double", None),
    ('pnh_.getParam("p", elsewhere_);', "integer", None),
    ('pnh_.getParam("p", config_.member_);', None, None),
    ('int must = 1; if (!pnh_.getParam("p", must)) { return; }', "integer", None),
    ('int both = 1; bool ok = pnh_.getParam("p", both) && other();', "integer", None),
    ('if (!pnh_.getParam("p", plain_) || !ready()) { plain_ = 7; }', "integer", None),
    ('if (!pnh_.getParam("p", plain_)) { warn(); } plain_ = 8;', "integer", None),
    ('pnh_.param("p", wide_, grid_->resolution());', "double", None),
]


@pytest.mark.parametrize(("body", "kind", "default"), ROWS, ids=[row[0] for row in ROWS])
def test_what_a_variable_holds_is_the_default(workspace: Any, body: str, kind: str | None, default: object) -> None:
    """`if (!getParam(x)) x = 5;` and a value given before are defaults; what may have happened otherwise is none."""
    found = workspace.package({"src/d.cpp": TEXT.format(body=body)}, ros=1).only("parameter")
    assert (found.type, found.default) == (kind, default)
