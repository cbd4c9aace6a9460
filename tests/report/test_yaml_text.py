"""The YAML writer for plain data."""

from __future__ import annotations

import time
from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.report.yaml_text import yaml_document

NUMBERS = "1 -1 +1 0 0x1F 0o17 017 1_000 1.5 .5 1. 1e5 1.0e+5 .inf -.inf inf .nan NaN nan 12:30:45 2001-01-01"
WORDS = "true True yes No on OFF y N null Null ~ << = ns::Class ~/topic {name}.plugin /x"
MARKS = "- ? ! & * @ ` # a#b a: :a a:b {a} [a] \"a\" 'a' %a |a >a --- ... --a"
LOOK_ALIKES = " ".join([NUMBERS, WORDS, MARKS]).split()
TRICKY = [
    "",
    " ",
    " a",
    "a ",
    "a  b",
    "a # b",
    "a: b",
    "a - b",
    "line\nline",
    "tab\tbell\a",
    "\x00",
    "\x7f",
    "\x85",
    "\u2028",
    "\ufeff",
    "🤖 ü",
    "\ud800",
    "a" * 300,
    "a" * 2000,
    "back\\slash",
    'quote"',
    "a, b",
]


@pytest.mark.parametrize("text", LOOK_ALIKES + TRICKY)
def test_a_string_stays_a_string(text: str) -> None:
    """As value, as key, in a line and in a block, whatever else it looks like."""
    data = {"value": text, text: [text], "map": {text: text}, "deep": [{text: [[text], {}]}]}
    assert yaml.safe_load(yaml_document(data)) == data


@pytest.mark.parametrize("number", [0, -1, 2**62, 1.5, 1e-05, 1e16, -2.5e300, 0.0, float("inf")])
def test_a_number_stays_a_number(number: float) -> None:
    """Also in the notations that YAML 1.1 takes for text."""
    loaded = yaml.safe_load(yaml_document({"n": number}))["n"]
    assert loaded == number
    assert type(loaded) is type(number)


def test_layout_is_that_of_a_person() -> None:
    """Sections in blocks, what is in a list on one line."""
    data = {"a": {"b": [{"name": "/x", "evidence": [{"path": "a.cpp", "line": 1}]}], "c": []}, "d": [1, 2]}
    assert yaml_document(data) == (
        "---\na:\n  b:\n  - {name: /x, evidence: [{path: a.cpp, line: 1}]}\n  c: []\nd: [1, 2]\n"
    )


scalars = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text()
data = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=20,
)


@settings(max_examples=50, deadline=None)
@given(st.dictionaries(st.text(), data, max_size=4))
def test_what_is_written_is_read_back(plain: dict[str, Any]) -> None:
    """PyYAML's safe loader gives back the data."""
    assert yaml.safe_load(yaml_document(plain)) == plain


def test_writing_is_fast() -> None:
    """A megabyte and a half of manifests is written within two seconds (a quarter of one on a desk machine)."""
    evidence = [{"path": f"src/file_{i}.cpp", "line": i} for i in range(3)]
    interface = {"role": "publisher", "name": "/a/b", "type": "std_msgs/msg/String", "evidence": evidence}
    plain = {"signature": {"interfaces": [{**interface, "raw_name": f"name_{i}"} for i in range(6500)]}}
    start = time.process_time()
    text = yaml_document(plain)
    assert len(text) > 1_200_000
    assert time.process_time() - start < 2.0


def test_a_long_endpoint_goes_on_below_itself() -> None:
    """Its lines are within the width, and a key never stands apart from its value."""
    endpoint = {"role": "publisher", "name": "/" + "a" * 60, "raw_name": "a" * 60, "qos": {"depth": 1}}
    lines = yaml_document({"signature": {"interfaces": [endpoint, endpoint]}}).splitlines()
    assert [line[:5] for line in lines[3:]] == ["  - {", "     ", "  - {", "     "]
    assert max(map(len, lines)) <= 110


def test_many_places_share_lines() -> None:
    """Twenty lines of evidence were twenty lines of the manifest, four times over."""
    places = [{"path": "src/driver.cpp", "line": number} for number in range(20)]
    text = yaml_document({"signature": {"x": {"value": {"a": {"b": 1}}, "evidence": places}}})
    assert len(text.splitlines()) < 14
