"""Signatures in one writing, and when a call or override written for the old one still holds."""

from __future__ import annotations

import pytest
from ecm_checker.hub.provision import Form
from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.diff.conversions import takes
from ecm_extract.diff.effects import accepts
from ecm_extract.entities.signatures import normal_type


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("const std::vector<int> &", "std::vector<int> const&"),
        ("rclcpp::Node::SharedPtr", "std::shared_ptr<rclcpp::Node>"),
        ("const int", "int"),
        ("boost::shared_ptr<kin::Sampler>", "kin::SamplerPtr"),
        ("hardware_interface::HardwareInfo const &", "const HardwareInfo&"),
        ("std::unique_ptr< a::B >", "a::B::UniquePtr"),
    ],
)
def test_two_ways_to_write_one_type_are_equal(one: str, other: str) -> None:
    """A change of spelling is no change of a signature."""
    assert normal_type(one) == normal_type(other)


@pytest.mark.parametrize(
    ("one", "other"), [("const int &", "int &"), ("int *", "int"), ("std::vector<int>", "std::vector<double>")]
)
def test_other_types_stay_other(one: str, other: str) -> None:
    """What a compiler tells apart is told apart."""
    assert normal_type(one) != normal_type(other)


@settings(max_examples=50)
@given(st.text(max_size=80))
def test_any_text_is_normalised(text: str) -> None:
    """Text that is no type gives a text, never an error."""
    assert isinstance(normal_type(text), str)


OLD = Form(types=("int",), required=1, returns="void")


@pytest.mark.parametrize(
    ("new", "old", "fits"),
    [
        (Form(types=("int", "bool"), required=1, returns="void"), OLD, True),
        (Form(types=("int", "bool"), required=2, returns="void"), OLD, False),
        (Form(types=("int",), required=1, returns="int"), OLD, True),
        (Form(types=("int",), required=1, returns="void"), Form(types=("int",), required=1, returns="int"), False),
        (
            Form(types=("int",), required=1, returns="int", virtual=True),
            Form(types=("int",), required=1, returns="void", virtual=True),
            False,
        ),
        (
            Form(types=("int", "bool"), required=1, virtual=True),
            Form(types=("int",), required=1, virtual=True),
            False,
        ),
        (Form(types=("", ""), required=1, names=("a", "b")), Form(types=("",), required=1, names=("a",)), True),
        (Form(types=("",), required=1, names=("b",)), Form(types=("",), required=1, names=("a",)), False),
    ],
)
def test_a_new_form_fits_old_users_or_not(new: Form, old: Form, fits: bool) -> None:
    """A new default argument breaks no caller, but every class that overrides the method."""
    assert accepts(new, old) is fits


def _form(returns: str, *types: str) -> Form:
    return Form(types=types, required=len(types), returns=returns)


@pytest.mark.parametrize(
    ("new", "old", "fits"),
    [
        (_form("$A", "$B", "const vector<$A>&"), _form("uint8_t", "int", "const vector<uint8_t>&"), True),
        (_form("$A", "$B", "const vector<$A>&"), _form("int", "int", "const vector<uint8_t>&"), False),
        (_form("void", "Grid<$A>&", "vector<$A>"), _form("void", "Grid<int>&", "vector<int>"), True),
        (_form("void", "Grid<$A>&", "vector<$A>"), _form("void", "Grid<int>&", "vector<bool>"), False),
        (_form("void", "map<$A,$B>"), _form("void", "map<int,pair<int,bool>>"), True),
        (_form("void", "Grid<$A>&"), _form("void", "Grid<int,bool>&"), False),
        (_form("void", "Grid<$A>&"), _form("void", "Map<int>&"), False),
        (_form("void", "Grid<$A>&"), _form("void", "const Grid<int>&"), False),
        (_form("void", "Grid<$1>&"), _form("void", "Grid<int>&"), False),
        (_form("void", "const A&"), _form("void", "const Pose&"), False),
    ],
)
def test_a_template_fits_what_it_can_be_deduced_from(new: Form, old: Form, fits: bool) -> None:
    """Who called a function may call the template that took its place, where one argument each fits its parameters."""
    assert accepts(new, old) is fits


@pytest.mark.parametrize(
    ("new", "old", "fits"),
    [
        ("const uint8_t&", "const bool&", True),
        ("bool", "uint8_t", False),
        ("double", "float", True),
        ("float", "double", False),
        ("int64_t", "long", True),
        ("int", "uint32_t", False),
        ("uint32_t", "int", False),
        ("int&", "bool", False),
        ("const Image<int64_t>&", "Image<long>", True),
        ("const WorldConstPtr&", "WorldPtr", True),
        ("WorldPtr", "WorldConstPtr", False),
        ("WorldPtr&", "WorldPtr", False),
        ("const Model*", "Model*", True),
        ("Model*", "const Model*", False),
        ("long double", "double", False),
    ],
)
def test_a_parameter_takes_what_the_old_one_took(new: str, old: str, fits: bool) -> None:
    """A wider number, an integer by its other name and a pointer to const need no change of the caller."""
    assert takes(new, old) is fits
