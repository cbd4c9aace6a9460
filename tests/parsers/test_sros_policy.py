"""Security policies: who may do what."""

from __future__ import annotations

import pytest
from diagnosed import is_told
from ecm_parsers.sros_policy import MAX_DIAGNOSTICS, is_policy, parse_policy
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

    assert {(grant.namespace, grant.enclave) for grant in parsed.facts} == {("/robot", "/talker")}
    assert [grant.kind for grant in parsed.facts] == ["topic", "topic", "topic", "service", "action"]


PROFILE = '<profile ns="/" node="a"><topics publish="ALLOW" subscribe="DENY"><topic>x</topic></topics></profile>'


@pytest.mark.parametrize(
    "text",
    [
        f'<policy version="0.1.0"><profiles>{PROFILE}</profiles></policy>',
        f'<?xml version="1.0"?><profiles>{PROFILE}</profiles>',
    ],
)
def test_old_format(text: str) -> None:
    """Version 0.1.0 has the profiles at the root or right below; one list can grant in two ways."""
    assert is_policy(text.encode())
    parsed = parse_policy(text.encode())
    assert parsed.diagnostics == ()
    assert [(grant.node, grant.access, grant.allowed, grant.name, grant.enclave) for grant in parsed.facts] == [
        ("/a", "publish", True, "/x", ""),
        ("/a", "subscribe", False, "/x", ""),
    ]


@pytest.mark.parametrize("tag", ["enclave", "context"])
def test_enclaves(tag: str) -> None:
    """Enclaves were named contexts at first."""
    text = f'<policy version="0.2.0"><{tag}s><{tag} path="/e"><profiles>{PROFILE}</profiles></{tag}></{tag}s></policy>'
    assert is_policy(text.encode())
    assert {grant.enclave for grant in parse_policy(text.encode()).facts} == {"/e"}


def test_include_inside_a_list() -> None:
    """An include among topics is named once, with the part that it asks for."""
    text = (
        '<policy version="0.2.0" xmlns:xi="http://www.w3.org/2001/XInclude"><profiles><profile ns="/" node="a">\n'
        '<topics publish="ALLOW"><topic>x</topic>\n<xi:include href="c.xml" xpointer="xpointer(/a/*)"/></topics>'
        "</profile></profiles></policy>"
    )
    parsed = parse_policy(text.encode())
    assert [(found.code, found.line) for found in parsed.diagnostics] == [("policy-include", 3)]
    assert "xpointer(/a/*)" in parsed.diagnostics[0].message
    assert [grant.name for grant in parsed.facts] == ["/x"]


@pytest.mark.parametrize(
    ("profile", "code"),
    [
        ('<profile ns="/"><topics publish="ALLOW"><topic>x</topic></topics></profile>', "policy-no-node"),
        (
            '<profile ns="/" node="a"><topics publish="MAYBE"><topic>x</topic></topics></profile>',
            "policy-bad-permission",
        ),
        ('<profile ns="/" node="a"><topics publish="ALLOW"><topic/></topics></profile>', "policy-bad-entry"),
        (
            '<profile ns="/" node="a"><topics publish="ALLOW"><service>x</service></topics></profile>',
            "policy-bad-entry",
        ),
    ],
)
def test_what_grants_nothing_is_told(profile: str, code: str) -> None:
    """A mistake that takes a permission away is a diagnostic, not silence."""
    parsed = parse_policy(f"<policy><profiles>{profile}</profiles></policy>".encode())
    assert parsed.facts == ()
    assert [found.code for found in parsed.diagnostics] == [code]


def test_other_files() -> None:
    """Profiles of a DDS implementation are no policy, and another root is told."""
    assert not is_policy(b'<profiles xmlns="http://x"><participant profile_name="a"/></profiles>')
    assert [found.code for found in parse_policy(b"<robot/>").diagnostics] == ["policy-wrong-root"]


def test_diagnostics_are_bounded() -> None:
    """A file of mistakes does not fill the report."""
    text = b"<policy><profiles>" + b"<profile/>" * 1000 + b"</profiles></policy>"
    assert len(parse_policy(text).diagnostics) == MAX_DIAGNOSTICS


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=80))
def test_never_raises(data: bytes) -> None:
    """No bytes break the parser."""
    for text in (data, b"<policy><profile>" + data + b"</profile></policy>"):
        assert is_told(text, parse_policy(text))
        assert is_policy(text) in {True, False}
