"""Names of nodes, where a constructor or an initialisation call fixes them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from ecm_checker.contract import Evidence
from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Items, Member, Name, Table
from ecm_parsers.source.facts import Statement
from msgspec import structs

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import names_in
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.index.library_functions import library_function
from ecm_extract.link.index.module_kinds import is_node_base
from ecm_extract.link.naming.handles import NODE_NAME, space_given
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, Instance
from ecm_extract.link.running.values import Value, is_known, unknown

_INITS = {"ros::init": 2, "rospy.init_node": 0, "rclpy.create_node": 0}
_ANONYMOUS = {"ros::init": "arg:3", "rospy.init_node": "arg:2|kw:anonymous"}
"""Where ROS 1 is told to add to a name what no other node has."""
_ADDS = "AnonymousName"
_SPACELESS = frozenset({"ros::init", "rospy.init_node"})
"""Those of ROS 1, where only a launch file gives a node its namespace."""
_OPEN_SPACE: Final = "{namespace}"
_OPEN: Final = "{name}"
"""Stands for the name of a node of which only the namespace is of use."""
_NAMING = ("init", "init_node", "create_node", "Node", "LifecycleNode", "make_shared")


@dataclass(frozen=True, slots=True)
class NodeName:
    """The name that a node gives itself, the line that says it, and the namespace that it puts itself in.

    An anonymous one has a name of its own each time it runs, which begins with the text.
    """

    text: str
    at: Evidence
    space: str = ""
    is_anonymous: bool = False

    @property
    def full(self) -> str:
        """Return the name with the namespace before it."""
        return f"{self.space}/{self.text}" if self.space else self.text

    @property
    def in_graph(self) -> str | None:
        """Return the name that the node has in the graph; None where that is another one each time."""
        return None if self.is_anonymous else self.full

    @property
    def is_open(self) -> bool:
        """Whether not all of it is known."""
        return "{" in self.full


@dataclass(frozen=True, slots=True)
class Given:
    """What a node is made with: its name, and what may be its namespace."""

    name: Expr
    space: Expr | None


class NodeNames:
    """Finds the name that a class or program gives its node."""

    def __init__(self, folder: Folder, sites: Sites) -> None:
        self.folder = folder
        self.sites = sites
        self._free: dict[File, list[Invocation]] | None = None

    def of_class(self, cls: Cls) -> NodeName | None:
        """Return the name that the class passes to its node base, None when it is not fixed."""
        found = self._passed_on(Instance(cls, {}, {}))
        if found is not None and not found.is_open:
            return found
        made = self._makings(cls)
        told = _agreed(made) or self._left_to_another(cls) or self._by_default(cls) or found
        others = {name.space for name in made if name is not None}
        return replace(told, space=_OPEN_SPACE) if told is not None and others - {told.space} else told

    def _by_default(self, cls: Cls) -> NodeName | None:
        """The name that a class gives its node where nobody is seen to give it arguments."""
        makers = [func for func in cls.methods if func.is_constructor and "declaration" not in func.fact.traits]
        given = [_by_default(func) for func in makers]
        made = [Instance(cls, args, {}, func) for args, func in zip(given, makers, strict=True) if args]
        return _agreed([self._passed_on(instance) for instance in made])

    def _left_to_another(self, cls: Cls) -> NodeName | None:
        """The name that the constructors of a class agree on which leave it to another: `Demo(options) : Demo("")`."""
        makers = [func for func in cls.methods if func.is_constructor and "declaration" not in func.fact.traits]
        whole = [(Instance(cls, {}, {}, func), func) for func in makers]
        made = [(self.folder.objects.delegated(instance), func) for instance, func in whole]
        return _agreed([self._passed_on(instance) for instance, func in made if instance.maker is not func])

    def _passed_on(self, made: Instance) -> NodeName | None:
        """The name that the constructors of an object pass to a node base."""
        cls = made.cls
        for owner in self.folder.program.ancestry(cls):
            part = self.folder.objects.part(made, owner)
            if part is None or not self._derives_outside(owner):
                continue
            for func in owner.methods:
                if func.is_constructor:
                    env = Env(func, args=part.args, this=cls, made=made)
                    name = self._passed(func, env)
                    if name is not None:
                        return name
        return None

    def _derives_outside(self, cls: Cls) -> bool:
        program = self.folder.program
        return any(is_node_base(program.canonical(base, cls.file, cls.qualified)) for base in cls.fact.bases)

    def _passed(self, func: Func, env: Env) -> NodeName | None:
        for at, statement in enumerate(func.fact.body):
            given, place = self._base_arguments(statement, env.before(at))
            if given is not None:
                return self._named(given, place, Evidence(func.file.path, statement.line))
        return None

    def _base_arguments(self, statement: Statement, env: Env) -> tuple[Given | None, Env]:
        """What a constructor hands to a node base, initialiser or `super().__init__`, with its place."""
        value, target = statement.value, statement.target
        if statement.kind == "init" and isinstance(target, Name) and is_node_base(plain(target.id)):
            args = value.args if isinstance(value, Call) and value.callee == target else (value,)
            return _given(args[0] if args else None, args[1] if len(args) > 1 else None), env
        if isinstance(value, Call) and isinstance(value.callee, Member) and value.callee.name == "__init__":
            call, place = self.folder.spreading.whole(value, env)
            own = structs.replace(call, args=call.args[1:] if call.args[:1] == (THIS,) else call.args)
            return _given(next(positions(NODE_NAME, own), None), space_given(own, place, self.folder)), place
        return None, env

    def _named(self, given: Given, env: Env, at: Evidence) -> NodeName | None:
        name = _known(self.folder.fold(given.name, env), at)
        if given.space is None or not self._is_text(given.space, env):
            return name
        values = self.folder.fold(given.space, env)
        value = values[0] if len(values) == 1 else unknown("namespace")
        space = value.text.strip("/")
        return replace(name or NodeName(_OPEN, at), space=space) if space or name is not None else None

    def _is_text(self, expr: Expr, env: Env) -> bool:
        """Tell whether the second argument of a node is its namespace; options are an object, in Python it is named."""
        if env.func.file.language == "python":
            return expr != Constant("null")
        written = self.folder.objects.type_of(expr, env)
        return "string" in written or is_known(self.folder.fold(expr, env)[0])

    def _makings(self, cls: Cls) -> Sequence[NodeName | None]:
        """The names that the places give a node which make it; none where its constructor is not known."""
        found: list[NodeName | None] = []
        for call in self.sites.calls.get(cls.fact.name, ()):
            if self.sites.makes(call, cls) and call.func.cls is not cls:
                constructor = self.folder.objects.constructor(cls, len(call.args))
                if constructor is None:
                    return ()
                given = bind(constructor, call, self.sites.root_env(call.func, call.at))
                name = self._passed_on(self.folder.objects.delegated(Instance(cls, given, {}, constructor)))
                found.append(replace(name, at=_place(call)) if name is not None else None)
        return found

    def of_program(self, main: Func) -> NodeName | None:
        """Return the name that a program gives its node, by a call in the file of its main function."""
        for call in self._free_calls(main.file):
            found = self._initialised(call)
            if found is not None:
                return found
        return None

    def _free_calls(self, file: File) -> Sequence[Invocation]:
        """The calls in functions of a file that can give a node its name, those of client libraries first."""
        if self._free is None:
            self._free = defaultdict(list)
            for call in (call for name in _NAMING for call in self.sites.calls.get(name, ())):
                if call.func.cls is None:
                    self._free[call.func.file].append(call)
        return self._free.get(file, ())

    def _initialised(self, call: Invocation) -> NodeName | None:
        named = library_function(call, _INITS.keys(), call.func.scope, self.folder.program)
        index = _INITS[named] if named is not None else None
        if index is None and (is_node_base(call.path) and call.receiver is None):
            index = 0
        if index is None:
            return None
        own, env = self.folder.spreading.out(call, self.sites.root_env(call.func, call.at))
        python = call.func.file.language == "python"
        name = next(positions(f"arg:{index}|kw:node_name|kw:name" if python else f"arg:{index}", own), None)
        after = f"arg:{index + 1}" if is_node_base(call.path) else ""
        space = space_given(own, env, self.folder) if python else next(positions(after, own), None)
        space = space if named not in _SPACELESS else None
        found = self._named(Given(name, space), env, _place(call)) if name is not None else None
        anonymous = found is not None and self._is_anonymous(
            next(positions(_ANONYMOUS.get(named or "", ""), own), None), env
        )
        return replace(found, is_anonymous=True) if found is not None and anonymous else found

    def _is_anonymous(self, given: Expr | None, env: Env) -> bool:
        """Tell whether a node may get a name of its own each time it runs."""
        if given is None:
            return False
        if env.func.file.language == "cpp":
            return any(last_name(name) == _ADDS for name in names_in(given))
        return self.folder.flow.truth(given, env) is not False


def _by_default(func: Func) -> dict[str, Bound]:
    """What a function is called with where nobody is seen to give it arguments."""
    stars = [parameter.name for parameter in func.fact.params if parameter.name.startswith("*")]
    more = {name.lstrip("*"): Bound(Table(()) if name.startswith("**") else Items(()), Env(func)) for name in stars}
    return more | {name: Bound(default, Env(func)) for name, default in func.defaults}


def _given(name: Expr | None, space: Expr | None) -> Given | None:
    return Given(name, space) if name is not None else None


def _agreed(found: Sequence[NodeName | None]) -> NodeName | None:
    """The name that several ways to make a node agree on."""
    return found[0] if len({name.full if name is not None else None for name in found}) == 1 else None


def _place(call: Invocation) -> Evidence:
    return Evidence(call.func.file.path, call.line)


def _known(values: tuple[Value, ...], at: Evidence) -> NodeName | None:
    value = values[0]
    is_fixed = len(values) == 1 and value.confidence != "pattern" and bool(value.text)
    return NodeName(value.text, at) if is_fixed else None
