"""Fields of objects behind pointers that a member has: what one method gives them is what the next one finds."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <memory>
#include <ros/ros.h>
#include <std_msgs/String.h>
struct Settings {{ std::string topic = "begun"; bool on = false; const int * given = nullptr; }};
class Demo {{
public:
  Demo() : settings_(new Settings()) {{}}
  void begin(const int & number) {{ {change} }}
  void ask() {{ ros::NodeHandle nh; pub_ = nh.advertise<std_msgs::String>({name}, 1); }}
  std::string chosen() {{ if (!settings_->on) {{ return "off"; }} return "on"; }}
  std::string known() {{ if (!settings_->given) {{ return "off"; }} return "on"; }}
  {member} settings_;
  ros::Publisher pub_;
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "n"); Demo demo; demo.begin(argc); ros::spin(); }}
"""
SET = 'settings_->topic = "set"; ask();'
CHANGES = [
    ("a unique pointer", "std::unique_ptr<Settings>", SET, "settings_->topic", {"/begun", "/set"}),
    ("a shared pointer", "std::shared_ptr<Settings>", SET, "settings_->topic", {"/begun", "/set"}),
    ("a raw pointer", "Settings *", SET, "settings_->topic", {"/begun", "/set"}),
    ("a test", "std::unique_ptr<Settings>", "settings_->on = true; ask();", "chosen()", {"/off", "/on"}),
    (
        "only meanwhile",
        "Settings *",
        "settings_->on = true; ask(); settings_->on = false;",
        "chosen()",
        {"/off", "/on"},
    ),
    ("an address meanwhile", "Settings *", "settings_->given = &number; ask();", "known()", {"/off", "/on"}),
    ("left alone", "std::unique_ptr<Settings>", "ask();", "settings_->topic", {"/begun"}),
]


@pytest.mark.parametrize(
    ("member", "change", "name", "told"), [row[1:] for row in CHANGES], ids=[row[0] for row in CHANGES]
)
def test_a_method_finds_what_another_one_gave(
    workspace: Any, member: str, change: str, name: str, told: set[str]
) -> None:
    """That its object was made with something else is not all that is known of it."""
    text = SOURCE.format(member=member, change=change, name=name)
    found = [each for each in workspace.package({"src/n.cpp": text}, ros=1).interfaces() if each.role == "publisher"]
    assert {each.name for each in found} == told
    assert all(each.confidence == "one_of" for each in found) or len(told) == 1


EMPTIED = """
#include <ros/ros.h>
#include <std_msgs/String.h>
struct Settings {{ std::string space{begun}; Settings() {{}} void load() {{ space = "{given}"; }} }};
Settings made() {{ Settings settings; settings.load(); return settings; }}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "n");
  Settings settings = made();
  ros::NodeHandle nh(settings.space);
  ros::Publisher pub = nh.advertise<std_msgs::String>("a", 1);
  ros::spin();
}}
"""


@pytest.mark.parametrize(
    ("begun", "given", "told"),
    [(' = "first"', "", {"/a", "/first/a"}), ("", "first", {"/first/a"})],
    ids=["emptied", "filled"],
)
def test_a_text_that_a_method_empties_may_be_empty(workspace: Any, begun: str, given: str, told: set[str]) -> None:
    """One that begins empty is of use only when it is filled; one that begins with something is not that any more."""
    found = workspace.package({"src/n.cpp": EMPTIED.format(begun=begun, given=given)}, ros=1).interfaces()
    assert {each.name for each in found if each.role == "publisher"} == told
