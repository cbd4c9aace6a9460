"""YAML as a bounded tree with lines."""

import math
import time

import pytest
from diagnosed import is_told
from ecm_parsers.result import Parsed
from ecm_parsers.yaml_scalar import typed
from ecm_parsers.yaml_tree import MAX_BYTES, MAX_DEPTH, Mapping, Node, Scalar, Sequence, parse_yaml, plain
from hypothesis import given, settings
from hypothesis import strategies as st


def codes(parsed: Parsed[tuple[Node, ...]]) -> list[str]:
    return [diagnostic.code for diagnostic in parsed.diagnostics]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("-7", -7),
        ("0x1F", 31),
        ("0b101", 5),
        ("017", 15),
        ("1.5", 1.5),
        ("1e-5", 1e-5),
        (".5", 0.5),
        ("5.", 5.0),
        ("-.inf", -math.inf),
        ("yes", True),
        ("Off", False),
        ("~", None),
        ("", None),
        ("1.2.3", "1.2.3"),
        ("$(var x)", "$(var x)"),
        ("1" * 5000, "1" * 5000),
        ("0x_", "0x_"),
    ],
)
def test_plain_scalars_are_typed(text: str, value: object) -> None:
    """A plain scalar has the type that the ROS readers give it."""
    assert typed(text) == value
    assert type(typed(text)) is type(value)


def test_lines_and_values() -> None:
    """Every key, item and value knows its 1-based line."""
    (root,) = parse_yaml(b"a: 1\nb:\n  - x\n  - 'yes'\nc: {d: on}\n").facts
    assert isinstance(root, Mapping)
    assert plain(root) == {"a": 1, "b": ["x", "yes"], "c": {"d": True}}
    assert [entry.line for entry in root.entries] == [1, 2, 5]
    items = root.get("b")
    assert isinstance(items, Sequence)
    assert [item.line for item in items.items] == [3, 4]


def test_documents_before_an_error_are_kept() -> None:
    """An error loses neither earlier documents nor what was read of the broken one."""
    parsed = parse_yaml(b"a: 1\n---\nb: 2\nc: [3, 4\nd: }\n")
    assert plain(parsed.facts[0]) == {"a": 1}
    assert plain(parsed.facts[1])["b"] == 2
    assert codes(parsed) == ["yaml-syntax"]
    assert parsed.diagnostics[0].line in {4, 5}


def test_duplicate_keys_are_reported_with_both_lines() -> None:
    """Duplicate keys are diagnosed, all kept, and read as the last one."""
    parsed = parse_yaml(b"a: 1\nb: 2\na: 3\n")
    (root,) = parsed.facts
    assert isinstance(root, Mapping)
    assert plain(root) == {"a": 3, "b": 2}
    assert len(root.entries) == 3
    assert [entry.line for entry in root.unique()] == [3, 2]
    assert (parsed.diagnostics[0].code, parsed.diagnostics[0].line) == ("yaml-duplicate-key", 3)


def test_object_tags_stay_plain() -> None:
    """No tag makes an object; the value is kept and the tag reported."""
    parsed = parse_yaml(b"a: !!python/object/apply:os.system ['ls']\nb: !angle 1.0\nc: !degrees 90\nd: !!str 1\n")
    assert plain(parsed.facts[0]) == {"a": ["ls"], "b": "1.0", "c": 90, "d": "1"}
    assert codes(parsed) == ["yaml-unknown-tag", "yaml-unknown-tag"]
    degrees = parsed.facts[0].get("c") if isinstance(parsed.facts[0], Mapping) else None
    assert isinstance(degrees, Scalar)
    assert degrees.tag == "!degrees"


def test_aliases_and_merge_keys() -> None:
    """Aliases repeat their anchor; a merge key fills in what is not set."""
    parsed = parse_yaml(b"base: &b {x: 1, y: 2}\nmore:\n  <<: *b\n  y: 3\nsame: *b\n")
    assert plain(parsed.facts[0]) == {
        "base": {"x": 1, "y": 2},
        "more": {"y": 3, "x": 1},
        "same": {"x": 1, "y": 2},
    }
    assert codes(parsed) == []


def test_alias_without_anchor() -> None:
    """An unknown alias, and one inside its own anchor, is null with a diagnostic."""
    parsed = parse_yaml(b"a: *nope\nb: &c [*c]\n")
    assert plain(parsed.facts[0]) == {"a": None, "b": [None]}
    assert codes(parsed) == ["yaml-unknown-alias"] * 2


def bomb(levels: int) -> bytes:
    lines = ["a0: &a0 [x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, levels)]
    return "\n".join(lines).encode()


def deep_alias(levels: int) -> bytes:
    lines = ["a0: &a0 [x]"] + [f"a{n}: &a{n} [*a{n - 1}]" for n in range(1, levels)]
    return "\n".join(lines).encode()


@pytest.mark.parametrize(
    "data",
    [
        bomb(30),
        deep_alias(500),
        b"[" * 10_000,
        b"[" * 10_000 + b"]" * 10_000,
        b"{a: " * 10_000,
        b"- " * 10_000,
        b"? " * 10_000,
        b"- a\n" * 300_000,
    ],
    ids=["bomb", "deep-alias", "open", "nested", "maps", "dashes", "keys", "many"],
)
def test_bombs_end_quickly_with_a_diagnostic(data: bytes) -> None:
    """Alias bombs, deep nesting and endless lists stop at a bound, in about a second."""
    start = time.process_time()
    parsed = parse_yaml(data)
    assert time.process_time() - start < 3
    assert set(codes(parsed)) & {"yaml-limit", "yaml-syntax"}
    for document in parsed.facts:
        plain(document)


def test_size_and_depth_bounds() -> None:
    """A file that is too large is not read at all; nesting up to the bound is."""
    assert codes(parse_yaml(b" " * (MAX_BYTES + 1))) == ["yaml-too-large"]
    nested = parse_yaml(b"[" * MAX_DEPTH + b"]" * MAX_DEPTH)
    assert codes(nested) == []


def test_complex_keys_are_skipped() -> None:
    """A key that is a collection is reported; template braces do not stop the reader."""
    parsed = parse_yaml(b"{{ name }}: 1\nb: 2\n")
    assert plain(parsed.facts[0]) == {"b": 2}
    assert set(codes(parsed)) == {"yaml-complex-key"}


@settings(max_examples=50, deadline=None)
@given(
    st.one_of(
        st.binary(max_size=200),
        st.text(alphabet="ab:-[]{}&*!<>|'\"\n #?,\t\x00", max_size=80).map(str.encode),
    )
)
def test_never_raises(data: bytes) -> None:
    """Any bytes give a tree or diagnostics."""
    parsed = parse_yaml(data)
    assert is_told(data, parsed)
    assert all(repr(plain(document)) == repr(plain(document)) for document in parsed.facts)
