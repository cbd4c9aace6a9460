"""Security policies: who may do what."""

from __future__ import annotations

import time

from ecm_parsers.sros_policy import is_policy, parse_policy
from hypothesis import given, settings
from hypothesis import strategies as st

POLICY = b"""<policy version="0.2.0" xmlns:xi="http://www.w3.org/2001/XInclude">
  <enclaves><enclave path="/talker"><profiles><profile ns="/robot" node="base">
    <xi:include href="common.xml"/>
    <topics publish="ALLOW"><topic>odom</topic><topic>/tf</topic></topics>
    <topics subscribe="DENY"><topic>~/debug</topic></topics>
    <services reply="ALLOW"><service>~/stop</service></services>
    <actions call="ALLOW"><action>dock</action></actions>
  </profile></profiles></enclave></enclaves>
</policy>"""


def test_grants() -> None:
    """Names are resolved for their node; an include is named, not followed."""
    assert is_policy(POLICY)
    parsed = parse_policy(POLICY)
    assert [entry.code for entry in parsed.diagnostics] == ["policy-include"]
    assert [(grant.access, grant.allowed, grant.name, grant.line) for grant in parsed.facts] == [
        ("publish", True, "/robot/odom", 4),
        ("publish", True, "/tf", 4),
        ("subscribe", False, "/robot/base/debug", 5),
        ("reply", True, "/robot/base/stop", 6),
        ("call", True, "/robot/dock", 7),
    ]
    assert {grant.node for grant in parsed.facts} == {"/robot/base"}


def test_old_format() -> None:
    """Version 0.1.0 has the profiles at the root."""
    profile = b'<profile ns="/" node="a"><topics publish="ALLOW"><topic>x</topic></topics></profile>'
    text = b'<policy version="0.1.0"><profiles>' + profile + b"</profiles></policy>"
    assert [(grant.node, grant.name) for grant in parse_policy(text).facts] == [("/a", "/x")]


def test_hostile() -> None:
    """Entities and deep nesting cost less than a second."""
    started = time.perf_counter()
    parse_policy(b'<!DOCTYPE r [<!ENTITY a "b">]><policy>&a;</policy>')
    parse_policy(b"<policy>" + b"<profile>" * 10_000)
    assert time.perf_counter() - started < 1


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=80))
def test_never_raises(data: bytes) -> None:
    """No bytes break the parser."""
    is_policy(data)
    parse_policy(data)
    parse_policy(b"<policy><profile>" + data + b"</profile></policy>")
