"""The type of an rclpy parameter that only its descriptor names."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rcl_interfaces.msg import ParameterDescriptor, ParameterType

class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        kept = ParameterDescriptor(type=ParameterType.PARAMETER_STRING_ARRAY)
        self.declare_parameter({given})
"""
ROWS = [
    ('"p", descriptor=ParameterDescriptor(type=ParameterType.PARAMETER_DOUBLE)', "double"),
    ('name="p", descriptor=ParameterDescriptor(type=Parameter.Type.INTEGER.value)', "integer"),
    ('"p", None, ParameterDescriptor(type=Parameter.Type.BOOL)', "bool"),
    ('"p", descriptor=kept', "string_array"),
    ('"p", 1.5, ParameterDescriptor(type=ParameterType.PARAMETER_INTEGER)', "double"),
    ('"p", descriptor=ParameterDescriptor(description="a level")', None),
    ('"p", descriptor=ParameterDescriptor(type=given)', None),
    ('"p", descriptor=given', None),
]


@pytest.mark.parametrize(("given", "kind"), ROWS, ids=[row[0] for row in ROWS])
def test_a_descriptor_names_the_type(workspace: Any, given: str, kind: str | None) -> None:
    """A default comes first."""
    assert workspace.package({"pkg/demo.py": NODE.format(given=given)}).only("parameter").type == kind
