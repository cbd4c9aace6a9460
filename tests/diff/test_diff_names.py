"""Names across namespaces, wildcards and computed parts."""

from __future__ import annotations

import pytest
from ecm_checker.match.spelling import graph_name_matches, node_matches, parameter_name_matches


@pytest.mark.parametrize(
    ("offered", "used", "same"),
    [
        ("~/gps/fix", "/mavros/gps/fix", True),
        ("~/gps/fix", "/uav1/mavros/gps/fix", True),
        ("~/gps/fix", "/gps/fix", False),
        ("~/gps/fix", "/mavros/global/fix", False),
        ("/scan", "/robot1/scan", True),
        ("/scan", "/laserscan", False),
        ("/scan", "/{ns}", False),
        ("/<*>/odom", "/left/odom", True),
        ("/a.b", "/axb", False),
    ],
)
def test_graph_names_match_by_their_end(offered: str, used: str, same: bool) -> None:
    """Private and relative names hang below any namespace; a name that is all hole matches nothing."""
    assert graph_name_matches(offered, used) is same


@pytest.mark.parametrize(
    ("declared", "given", "same"),
    [
        ("a.b", "a.b", True),
        ("<*>.max_vel", "FollowPath.max_vel", True),
        ("<*>.max_vel", "max_vel", False),
        ("a.b", "x.a.b", False),
        ("~/conn/heartbeat", "conn/heartbeat", True),
        ("~/conn/heartbeat", "mavros/conn/heartbeat", True),
    ],
)
def test_parameters_match_by_name(declared: str, given: str, same: bool) -> None:
    """A computed prefix fits any plugin name, a literal one only itself."""
    assert parameter_name_matches(declared, given) is same


@pytest.mark.parametrize(
    ("node", "same"), [("/**", True), ("/ns/arm", True), ("/*/arm", True), ("/leg", False), ("", True)]
)
def test_wildcards_reach_the_node(node: str, same: bool) -> None:
    """`/**` sets parameters of every node."""
    assert node_matches("arm", node) is same
