"""Variables of namespaces that `main` gives something before it calls who reads them."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
#include <std_srvs/Empty.h>
bool mock = true;
void work(Arm * arm) {{
  std_srvs::Empty request;
  if (mock) {{
    ros::Duration(1).sleep();
  }} else {{
    int code;
    for (int i = 0; i < 10; i++) {{ code = arm->pick(); }}
    if (code == 3) ros::service::call("/picked", request);
  }}
}}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  Arm arm;
  {given}
  while (ros::ok()) work(&arm);
}}
"""
CMAKE = "project(pkg)\nadd_executable(demo src/d.cpp)\n"
GIVEN = ['mock = Config::get()["mock"].as<bool>();', "mock = argc > 1;", "if (argc > 1) mock = false;", "mock = false;"]


@pytest.mark.parametrize("given", GIVEN)
def test_what_main_sets_counts_though_nobody_calls_main(workspace: Any, given: str) -> None:
    """What `main` changes is changed: a side of a branch is not left out for what the variable began with."""
    found = workspace.package({"src/d.cpp": TEXT.format(given=given), "CMakeLists.txt": CMAKE}, ros=1).only(
        "service_client"
    )
    assert (found.name, found.type) == ("/picked", "std_srvs/srv/Empty")
