"""What plugins are given by the hosts of the tree that load them."""

from __future__ import annotations

from typing import Any

import pytest

PLUGIN = """
#include <ros/ros.h>
class Part {{ public: virtual ~Part() {{}} virtual void start(ros::NodeHandle & nh, int rate) = 0; }};
class Sonar : public Part {{
 public:
  void start(ros::NodeHandle & given, int rate) {{
    below_ = ros::NodeHandle(given, "sonar");
    {base}
    given.param("range", range_, 2.0);
    pub_ = below_.advertise<std_msgs::String>("echo", rate);
  }}
 private:
  ros::NodeHandle below_;
  ros::Publisher pub_;
  double range_;
}};
PLUGINLIB_EXPORT_CLASS(Sonar, Part)
class Host {{
 public:
  explicit Host(const ros::NodeHandle & given) : nh_(given), other_("elsewhere") {{
    boost::shared_ptr<Part> part = loader_.createInstance("sonar");
    {call}
  }}
 private:
  ros::NodeHandle nh_, other_;
  pluginlib::ClassLoader<Part> loader_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "board"); ros::NodeHandle nh("~"); Host host(nh); ros::spin(); }}
"""
CASES = {
    "as the maker of the host says": ("part->start(nh_, 4);", "", "~/range", "~/sonar/echo"),
    "as the host makes it itself": ("part->start(other_, 4);", "", "/elsewhere/range", "/elsewhere/sonar/echo"),
    "two that agree": ("part->start(nh_, 4); part->start(nh_, 5);", "", "~/range", "~/sonar/echo"),
    "two that do not": (
        "part->start(nh_, 4); part->start(other_, 5);",
        "",
        "/{given}/range",
        "/{given}/sonar/echo",
    ),
    "nobody": ("", "", "/{given}/range", "/{given}/sonar/echo"),
    "its own base is no host": ("", "Part::start(given, rate);", "/{given}/range", "/{given}/sonar/echo"),
    "another method is not asked": ("part->begin(nh_, 4);", "", "/{given}/range", "/{given}/sonar/echo"),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_a_plugin_gets_the_handle_of_its_host(workspace: Any, case: tuple[str, ...]) -> None:
    """A call on the base class hands it over; hosts that do not agree, and no host at all, leave it unknown."""
    call, base, parameter, topic = case
    found = workspace.package({"src/board.cpp": PLUGIN.format(call=call, base=base)}, ros=1)
    assert found.only("parameter").name == parameter
    assert found.only("publisher").name == topic


def test_hosts_that_give_each_other_what_they_were_given_end(workspace: Any) -> None:
    """`start` of one part calls `start` of the next: nobody has made the handle."""
    chain = PLUGIN.format(call="", base="boost::shared_ptr<Part> next; next->start(given, rate);")
    found = workspace.package({"src/board.cpp": chain}, ros=1)
    assert found.only("parameter").name == "/{given}/range"
