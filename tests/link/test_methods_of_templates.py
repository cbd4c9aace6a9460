"""Methods of class templates that are defined outside of their class are the methods of the class."""

from __future__ import annotations

from typing import Any

HEADER = """
template<typename ActionT>
class Server : public rclcpp::Node {
 public:
  explicit Server(const std::string & name) : rclcpp::Node(name) { open(); }
  std::string made(const std::string & name);
  void open();
};
template<typename ActionT>
std::string Server<ActionT>::made(const std::string & name) { return std::string(this->get_name()) + "/own/" + name; }
template<typename ActionT>
void Server<ActionT>::open() { create_service<std_srvs::srv::Trigger>(made("pause"), on_pause); }
"""
NODE = """
#include "pkg/server.hpp"
class Wait : public Server<nav2_msgs::action::Wait> { public: Wait() : Server<nav2_msgs::action::Wait>("wait") {} };
int main(int argc, char ** argv) { rclcpp::spin(std::make_shared<Wait>()); }
"""


def test_what_a_method_of_a_template_returns_is_known(workspace: Any) -> None:
    """Nobody writes the parameters of a class where he calls its methods: they are those of the object."""
    workspace.package({"include/pkg/server.hpp": HEADER, "src/wait.cpp": NODE})
    entry = workspace.only("service_server")
    assert (entry.name, entry.confidence) == ("/wait/own/pause", "folded")
