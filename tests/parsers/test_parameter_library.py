"""Declarations of generate_parameter_library."""

from diagnosed import is_told
from ecm_parsers.parameter_library import parse_parameter_library
from hypothesis import given, settings
from hypothesis import strategies as st

DECLARATIONS = b"""\
arm_controller:
  joints: {type: string_array, read_only: true, validation: {unique<>: null, "my::check": [1]}}
  gains:
    __map_joints:
      p: {type: double, default_value: 0.0, description: "Gain", validation: {bounds<>: [0.0, 9.0]}}
  type:
    type: string
    default_value: fast
    validation:
      one_of<>: [[fast, slow]]
    additional_constraints: "only once"
  pose: {type: double_array_fixed_6, default_value: null}
  odd: {type: quaternion}
  stray: 5
"""


def test_declarations_are_typed_leaves() -> None:
    """A map with a textual `type` is a parameter; nested maps are dotted names, `__map_x` is a hole."""
    parsed = parse_parameter_library(DECLARATIONS)
    (namespace,) = parsed.facts
    assert (namespace.name, namespace.line) == ("arm_controller", 1)
    found = {p.name: p for p in namespace.parameters}
    assert list(found) == ["joints", "gains.{joints}.p", "type", "pose", "odd"]
    assert found["joints"].read_only
    assert not found["joints"].has_default
    assert found["joints"].validation == {"unique": None, "my::check": [1]}
    gain = found["gains.{joints}.p"]
    assert (gain.type, gain.default, gain.has_default, gain.description, gain.line) == (
        "double",
        0.0,
        True,
        "Gain",
        5,
    )
    assert gain.validation == {"bounds": [0.0, 9.0]}
    assert found["type"].validation == {"one_of": [["fast", "slow"]]}
    assert found["type"].additional_constraints == "only once"
    assert found["pose"].has_default


def test_what_is_no_parameter_is_reported() -> None:
    """Unknown types and stray values are diagnosed with their line."""
    parsed = parse_parameter_library(DECLARATIONS)
    assert [(d.code, d.line) for d in parsed.diagnostics] == [
        ("gpl-unknown-type", 13),
        ("gpl-not-a-parameter", 14),
    ]
    assert parse_parameter_library(b"- a\n").diagnostics[0].code == "gpl-not-a-map"


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="ab:{}[],type \n", max_size=60).map(str.encode))
def test_never_raises_on_declarations(data: bytes) -> None:
    """Any YAML gives declarations or diagnostics."""
    assert is_told(data, parse_parameter_library(data))
