"""What a launch file says: actions in order, with substitutions left for whoever knows the arguments.

Sources: wiki.ros.org/roslaunch/XML, design.ros2.org "ROS 2 Launch", the `launch` and `launch_ros` packages.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from ecm_parsers.template import Template

Data: TypeAlias = Template | bool | int | float | list["Data"] | None
"""A parameter's value: a text with substitutions is a tuple, a list is a list."""


class _Action(msgspec.Struct, frozen=True, kw_only=True, tag=True):
    """Base of all actions.

    Attributes:
        line: 1-based.
        condition: holds when the action is taken; None for always.
    """

    line: int
    condition: Template | None = None


class Argument(_Action, frozen=True, kw_only=True):
    """A launch argument; `value` cannot be overridden, `default` can."""

    name: str
    default: Template | None = None
    value: Template | None = None
    description: str = ""
    choices: tuple[str, ...] = ()


class SetConfiguration(_Action, frozen=True, kw_only=True):
    """Gives a launch configuration or, with `environment`, an environment variable a value."""

    name: Template
    value: Template
    environment: bool = False


class PushNamespace(_Action, frozen=True, kw_only=True):
    """Later actions of the scope are below this namespace."""

    namespace: Template


class Remap(_Action, frozen=True, kw_only=True):
    """One name becomes another, for all later nodes of the scope or for the node that holds it."""

    source: Template
    target: Template


Typing: TypeAlias = Literal["yaml", "auto", "str", "bare", "int", "double", "bool"]
"""How a text becomes a parameter: as PyYAML reads it, by the rule of roslaunch, or as the type that is asked for.

`str` is the text as it is, `bare` the text without the blanks around it, which roslaunch takes off.
"""


class ParameterValue(_Action, frozen=True, kw_only=True):
    """One parameter; in ROS 2 `a.b`, in ROS 1 `a/b`. YAML of ROS 1 may give several below `name`."""

    name: Template
    value: Data = None
    typing: Typing = "yaml"


class ParameterFile(_Action, frozen=True, kw_only=True):
    """A parameter file.

    Attributes:
        path: of the file.
        namespace: below which its parameters are put.
        rewrites: (key, value): values that replace those of the file wherever the last part of a name is the key.
        converts: a value that replaces another may be a number, as `convert_types` asks.
        substitutes: `$(...)` in the file is replaced when it is read.
        plain: the data of the file are parameters as they stand, below `prefix`, with no node around them (ROS 2).
    """

    path: Template
    namespace: Template = ()
    rewrites: tuple[tuple[Template, Template], ...] = ()
    converts: bool = False
    substitutes: bool = False
    plain: bool = False
    prefix: Template = ()


ParameterSource: TypeAlias = ParameterValue | ParameterFile
NodeKind: TypeAlias = Literal["node", "lifecycle_node", "container", "component", "process"]


class Node(_Action, frozen=True, kw_only=True):
    """A program, or a component that a container loads.

    Attributes:
        kind: what it is. package, executable: whose program; empty for a component.
        plugin: class of a component or nodelet.
        name, namespace: given ones; None keeps the program's own.
        remaps: (from, to). parameters: in the order in which they apply.
        loaded: what `<rosparam>` sets in a node of ROS 1, which applies before everything else.
        arguments: words of its command line.
        target: name of the container that loads the component; None when it stands in one.
        components: what a container loads. respawn: whether it is started again.
        required: whether the system stops with it.
    """

    kind: NodeKind
    package: Template = ()
    executable: Template = ()
    plugin: Template = ()
    name: Template | None = None
    namespace: Template | None = None
    remaps: tuple[Remap, ...] = ()
    parameters: tuple[ParameterSource, ...] = ()
    loaded: tuple[ParameterSource, ...] = ()
    arguments: tuple[Template, ...] = ()
    target: Template | None = None
    components: tuple[Node, ...] = ()
    respawn: Template | None = None
    required: Template | None = None

    @property
    def sources(self) -> tuple[ParameterSource, ...]:
        """Everything that sets its parameters."""
        return (*self.loaded, *self.parameters)


class Include(_Action, frozen=True, kw_only=True):
    """Another launch file.

    Attributes:
        path: of the file. arguments: (name, value) that it is given.
        argument_lines: their 1-based lines; empty where they have none of their own.
        argument_conditions: under which each is given; empty where none has one.
        namespace: below which it runs; empty for none. pass_all: it sees all arguments of this file.
    """

    path: Template
    arguments: tuple[tuple[str, Template], ...] = ()
    argument_lines: tuple[int, ...] = ()
    argument_conditions: tuple[Template | None, ...] = ()
    namespace: Template = ()
    pass_all: bool = False


class Group(_Action, frozen=True, kw_only=True):
    """Actions with a condition or a scope of their own; those taken `later`, on an event, are outside of groups."""

    actions: tuple[Action, ...] = ()
    scoped: bool = True
    later: bool = False


class Unread(_Action, frozen=True, kw_only=True):
    """What a file adds here cannot be read; `text` is the call as written."""

    text: str


Action: TypeAlias = (
    Argument
    | SetConfiguration
    | PushNamespace
    | Remap
    | ParameterValue
    | ParameterFile
    | Node
    | Include
    | Group
    | Unread
)


class Tested(msgspec.Struct, frozen=True):
    """A launch argument whose text a file in Python asks whether it holds, and the line."""

    name: str
    line: int


class LaunchFile(msgspec.Struct, frozen=True):
    """The actions of one file; `ros` tells by which rules its names and parameters resolve.

    `texts_tested` are the arguments whose text a file in Python tests.
    """

    ros: Literal[1, 2]
    actions: tuple[Action, ...] = ()
    texts_tested: tuple[Tested, ...] = ()
