"""How often a node acts, where the time stands in a variable: what it may hold, and nothing that it may not."""

from __future__ import annotations

import pytest
from section_contracts import INCLUDE
from workspaces import Workspace

SOURCE = """
class N : public rclcpp::Node {{
 public:
  N() : Node("n") {{
    {body}
    sub_ = create_subscription<Settings>("settings", 1, std::bind(&N::got, this, _1));
    start();
  }}
  void tick() {{}}
  void got(const Settings & settings) {{ {callback} }}
  void start() {{ {start} }}
  std::chrono::milliseconds period_;
  double hz_;
  rclcpp::Subscription<Settings>::SharedPtr sub_;
}};
"""
ROWS = [
    ("a constant", "auto p = 100ms; create_wall_timer(p, [this]() {});", "", "", 10.0),
    ("one of two", "auto p = 100ms; if (fast()) { p = 50ms; } create_wall_timer(p, [this]() {});", "", "", None),
    ("or not known", "auto p = 100ms; if (fast()) { p = asked(); } create_wall_timer(p, [this]() {});", "", "", None),
    ("overwritten", "auto p = 100ms; p = 50ms; create_wall_timer(p, [this]() {});", "", "", 20.0),
    ("a member", "period_ = 100ms;", "", "create_wall_timer(period_, [this]() {});", 10.0),
    (
        "a callback sets it",
        "hz_ = 10.0;",
        "hz_ = settings.hz; start();",
        "create_wall_timer(std::chrono::duration<double>(1 / hz_), [this]() {});",
        None,
    ),
    (
        "a callback sets a period",
        "period_ = 100ms;",
        "period_ = settings.period; start();",
        "create_wall_timer(period_, [this]() {});",
        None,
    ),
    ("set after", "period_ = 100ms;", "period_ = settings.period;", "create_wall_timer(period_, [this]() {});", 10.0),
    ("of a rate", "rclcpp::Rate r(5.0); create_wall_timer(r.period(), [this]() {});", "", "", 5.0),
    (
        "of one of two rates",
        "rclcpp::Rate r(5.0); if (fast()) { r = rclcpp::Rate(8.0); } create_wall_timer(r.period(), [this]() {});",
        "",
        "",
        None,
    ),
]


@pytest.mark.parametrize(
    ("body", "callback", "start", "hertz"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS]
)
def test_a_time_is_told_where_it_is_known(
    workspace: Workspace, body: str, callback: str, start: str, hertz: float | None
) -> None:
    """What another method may set is not known where the timer is made."""
    source = INCLUDE + SOURCE.format(body=body, callback=callback, start=start)
    rates = workspace.package({"src/n.cpp": source}).modules()["ecm.pkg.n"].behavior.rates
    assert (rates.value if rates is not None else {}).get("timer") == hertz
