"""Fields of a plain structure that nothing but a parameter is assigned to, handed on through a base that is a template."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
template<typename ParamsT>
class Handler {{
public:
  ParamsT * getParams() {{ return &params_; }}
protected:
  ParamsT params_;
}};
namespace own {{
struct Parameters {{ {field} double frequency; }};
class ParameterHandler : public Handler<Parameters> {{
public:
  explicit ParameterHandler(rclcpp::Node * node) {{
    params_.topic = node->declare_parameter("topic", std::string("asked"));
    params_.frequency = node->declare_parameter("frequency", 20.0);
    {more}
  }}
  void updated(const std::vector<rclcpp::Parameter> & parameters) {{
    for (const auto & parameter : parameters) {{
      if (parameter.get_name() == "topic") {{ params_.topic = parameter.as_string(); }}
    }}
  }}
}};
}}
class Listener {{
public:
  template<typename NodeT>
  explicit Listener(const NodeT & parent, const std::string & topic = "unasked") {{
    sub_ = parent->template create_subscription<std_msgs::msg::String>(topic, 1, [](std_msgs::msg::String) {{}});
  }}
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr sub_;
}};
class D : public rclcpp::Node {{
public:
  D() : Node("d") {{
    handler_ = std::make_unique<own::ParameterHandler>(this);
    params_ = handler_->getParams();
    listener_ = std::make_unique<Listener>(this, params_->topic);
  }}
  std::unique_ptr<own::ParameterHandler> handler_;
  own::Parameters * params_;
  std::unique_ptr<Listener> listener_;
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<D>()); }}
"""
ROWS = [
    ("read alone", "std::string topic;", "", "/asked", "default"),
    ("begun alike", 'std::string topic{"asked"};', "", "/asked", "default"),
    ("begun otherwise", 'std::string topic{"begun"};', "", "", "pattern"),
    ("given otherwise", "std::string topic;", 'params_.topic = "given";', "", "pattern"),
    ("given unseen", "std::string topic;", "params_.topic = chosen();", "", "pattern"),
    (
        "read from two",
        "std::string topic;",
        'params_.topic = node->declare_parameter("other", std::string("other"));',
        "",
        "pattern",
    ),
]


@pytest.mark.parametrize(
    ("field", "more", "name", "confidence"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS]
)
def test_a_field_has_the_default_of_the_parameter_that_is_read_into_it(
    workspace: Any, field: str, more: str, name: str, confidence: str
) -> None:
    """A field is told where only one parameter is assigned to it, and what a callback sets later."""
    found = workspace.package({"src/d.cpp": NODE.format(field=field, more=more)}).only("subscriber")
    assert (found.name if "{" not in found.name else "", found.confidence) == (name, confidence)
