"""Numbers among the parameters of generate_parameter_library: they are depths as declared ones are."""

from __future__ import annotations

from typing import Any

import pytest

FILES = {
    "CMakeLists.txt": "project(pkg)\ngenerate_parameter_library(demo_parameters src/demo.yaml)\n",
    "src/demo.yaml": "demo:\n  topic:\n    type: string\n    default_value: joy\n  queue:\n    type: int\n    default_value: 7\n",
}
DEMO = """
#include "demo_parameters.hpp"
class Demo : public rclcpp::Node {{
  Demo() : Node("demo") {{
    listener_ = std::make_shared<demo::ParamListener>(get_node_parameters_interface());
    params_ = listener_->get_params();
    create_publisher<std_msgs::msg::String>(params_.topic, {qos});
  }}
  std::shared_ptr<demo::ParamListener> listener_;
  demo::Params params_;
}};
"""


@pytest.mark.parametrize("qos", ["params_.queue", "rclcpp::QoS(params_.queue)"])
def test_the_default_of_a_generated_parameter_is_a_depth(workspace: Any, qos: str) -> None:
    """Without its number nothing of the profile was known."""
    found = workspace.package({**FILES, "src/demo.cpp": DEMO.format(qos=qos)}).only("publisher")
    assert (found.name, found.qos.reliability, found.qos.history, found.qos.depth) == (
        "/joy",
        "reliable",
        "keep_last",
        7,
    )


WRITTEN = [("double", "1000", 1000.0), ("double_array", "[1, 0x10]", [1.0, 16.0]), ("int", "7", 7)]


@pytest.mark.parametrize(("kind", "written", "default"), WRITTEN, ids=[row[0] for row in WRITTEN])
def test_a_default_is_a_number_of_its_type(workspace: Any, kind: str, written: str, default: object) -> None:
    """YAML reads whole numbers where the parameter has fractions."""
    settings = f"demo:\n  rate:\n    type: {kind}\n    default_value: {written}\n"
    text = DEMO.replace("params_.topic, {qos}", '"out", 1').replace("{{", "{").replace("}}", "}")
    entry = workspace.package({**FILES, "src/demo.yaml": settings, "src/demo.cpp": text}).only("parameter")
    assert repr(entry.default) == repr(default)
