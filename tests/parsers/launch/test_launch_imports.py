"""Python launch files follow what they import from the tree: functions, classes, modules by path."""

from __future__ import annotations

import pytest
from ecm_parsers.launch.model import Action, Group, Node, Unread
from ecm_parsers.launch.python import parse_launch_python
from ecm_parsers.python.sources import NoSources
from ecm_parsers.template import Template

HELPERS = """
from launch_ros.actions import Node
from launch.actions import ExecuteProcess
from .names import PACKAGE

def made(name, package=PACKAGE):
    return Node(package=package, executable='e', name=name)

class Made:
    prefix = 'm_'

    @staticmethod
    def plain(name):
        return made(name)

    @classmethod
    def prefixed(cls, name):
        return made(cls.prefix + name)

class Longer(Made):
    prefix = 'l_'

class Driver(Node):
    def __init__(self, name, **kwargs):
        super().__init__(package='p', executable='e', name=name, **kwargs)
        self.helper = made(name + '_helper')

class Second(Driver):
    def __init__(self):
        super().__init__('second')

class Old(Node):
    def __init__(self):
        Node.__init__(self, package='p', executable='e', name='old')

class Bare(Node):
    pass

class Robot:
    def __init__(self, name):
        self.name = name

    @property
    def driver(self):
        return made(self.name)

    def start(self):
        return [self.driver]

class Spaced(Substitution):
    def __init__(self, space, name):
        self.__space = space
        self.__name = name

    def perform(self, context=None):
        space = str(self.__space.perform(context)) if isinstance(self.__space, Substitution) else str(self.__space)
        if space == '':
            return self.__name
        return space + '_' + self.__name

@dataclass
class Given:
    name: str
    package: str = 'p'
"""
MODULES = {"robot.helpers": HELPERS, "robot.names": "PACKAGE = 'p'\n"}


class Tree(NoSources):
    """A tree with two modules, which stand at paths too."""

    def module(self, name: str) -> bytes | None:
        return MODULES[name].encode() if name in MODULES else None

    def file(self, path: Template) -> bytes | None:
        return (
            MODULES["robot.helpers"].replace(".names", "robot.names").encode() if path == ("lib/helpers.py",) else None
        )


def actions(text: str) -> tuple[Action, ...]:
    parsed = parse_launch_python(text.encode(), Tree())
    assert parsed.facts is not None
    assert parsed.diagnostics == ()
    return parsed.facts.actions


def flat(found: tuple[Action, ...]) -> list[Action]:
    return [each for action in found for each in (flat(action.actions) if isinstance(action, Group) else [action])]


@pytest.mark.parametrize(
    ("imported", "expression", "names"),
    [
        ("from robot.helpers import made", "made('a')", ["a"]),
        ("from robot.helpers import made as build", "build('a')", ["a"]),
        ("from robot import helpers", "helpers.made('a')", ["a"]),
        ("import robot.helpers", "robot.helpers.made('a')", ["a"]),
        ("import robot.helpers as h", "h.made(name='a')", ["a"]),
        ("from robot.helpers import *", "made('a')", ["a"]),
        ("from robot.helpers import Made", "Made.plain('a')", ["a"]),
        ("from robot.helpers import Made", "Made.prefixed('a')", ["m_a"]),
        ("from robot.helpers import Longer", "Longer.prefixed('a')", ["l_a"]),
        ("from robot.helpers import Driver", "Driver('a')", ["a"]),
        ("from robot.helpers import Driver", "Driver('a').helper", ["a_helper"]),
        ("from robot.helpers import Second", "Second()", ["second"]),
        ("from robot.helpers import Old", "Old()", ["old"]),
        ("from robot.helpers import Bare", "Bare(package='p', executable='e', name='a')", ["a"]),
        ("from robot.helpers import Robot", "Robot('a').driver", ["a"]),
        ("from robot.helpers import Robot", "*Robot('a').start()", ["a"]),
        (
            "from robot.helpers import Given\ngiven = Given('a')",
            "Node(package=given.package, executable='e', name=given.name)",
            ["a"],
        ),
        ("from robot.helpers import Spaced", "Node(package='p', executable='e', name=Spaced('s', 'a'))", ["s_a"]),
        ("from robot.helpers import Spaced", "Node(package='p', executable='e', name=Spaced('', 'a'))", ["a"]),
        ("lib = load_python_launch_file_as_module('lib/helpers.py')", "lib.made('a')", ["a"]),
        ("lib = load_python_launch_file_as_module('lib/helpers.py')", "getattr(lib, 'made')('a')", ["a"]),
        (
            "spec = spec_from_file_location('lib', 'lib/helpers.py')\nlib = importlib.util.module_from_spec(spec)",
            "lib.made('a')",
            ["a"],
        ),
        ("lib = SourceFileLoader('lib', 'lib/helpers.py').load_module()", "lib.made('a')", ["a"]),
    ],
)
def test_what_a_launch_file_imports_is_read(imported: str, expression: str, names: list[str]) -> None:
    """A node that a helper of the tree makes is started like one that stands in the file, and placed at the call."""
    before = f"from launch_ros.actions import Node\n{imported}\n"
    found = flat(actions(f"{before}def generate_launch_description():\n    return LaunchDescription([{expression}])\n"))
    assert [action.name for action in found if isinstance(action, Node)] == [(name,) for name in names]
    assert {action.package for action in found if isinstance(action, Node)} == {("p",)}
    assert {action.line for action in found} == {before.count("\n") + 2}


def test_call_that_cannot_be_read_is_kept_and_placed() -> None:
    """What an unknown function adds is not lost without a word; what starts nothing is."""
    body = "return LaunchDescription([LogInfo(msg='x'), EmitEvent(event=Shutdown()), os.remove('a'), build('a')])"
    (found,) = actions(f"from other import build\ndef generate_launch_description():\n    {body}\n")
    assert found == Unread(line=3, text="build('a')")


@pytest.mark.parametrize(
    "text",
    [
        "class A(A):\n    pass\n",
        "class A:\n    def __init__(self):\n        super().__init__()\n        self.a = A()\nA()\n",
        "class A:\n    @property\n    def a(self):\n        return self.a\nA().a\n",
        "super().x()\n",
        "from . import x\nfrom ... import y\n",
        "import robot.helpers\nrobot.helpers.nothing.at.all()\n",
        "class A(B, *C, metaclass=D):\n    x = y = 1\n",
    ],
)
def test_odd_classes_and_imports_end(text: str) -> None:
    """Classes that make themselves and imports of nothing do not break the reader."""
    assert actions(f"{text}def generate_launch_description():\n    return LaunchDescription([])\n") == ()
