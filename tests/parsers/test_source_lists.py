"""Lists of repositories that workspaces bring in from source."""

from __future__ import annotations

import pytest
from ecm_parsers.source_lists import Listed, parse_source_list
from hypothesis import given
from hypothesis import strategies as st

WSTOOL = b"""- git:
    local-name: src/arm
    uri: 'https://example.org/a/arm_driver.git'
- other: {local-name: ../old}
- setup-file: {local-name: /opt/setup.sh}
"""
VCSTOOL = b"""repositories:
  arm/driver:
    type: git
    url: https://example.org/a/arm_driver.git   # the driver
  empty:
"""
ROWS = [
    (WSTOOL, [("src/arm", "https://example.org/a/arm_driver.git"), ("../old", ""), ("/opt/setup.sh", "")]),
    (VCSTOOL, [("arm/driver", "https://example.org/a/arm_driver.git"), ("empty", "")]),
    (b"- git: src\n- 1\n", []),
    (b"repositories: [a]\n", []),
    (b"", []),
]


@pytest.mark.parametrize(("data", "expected"), ROWS)
def test_lists(data: bytes, expected: list[tuple[str, str]]) -> None:
    assert parse_source_list(data).facts == tuple(Listed(*each) for each in expected)


@given(st.binary(max_size=200))
def test_any_content_is_read(data: bytes) -> None:
    """A parser never raises on content."""
    assert isinstance(parse_source_list(data).facts, tuple)
