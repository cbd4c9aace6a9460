"""Names of nodes, where a constructor or an initialisation call fixes them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from ecm_checker.contract import Evidence
from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Items, Member, Name, Table
from ecm_parsers.source.facts import Statement
from msgspec import structs

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.index.library_functions import library_function
from ecm_extract.link.index.module_kinds import is_node_base
from ecm_extract.link.naming.anonymous import is_anonymous
from ecm_extract.link.naming.new_nodes import NODE_NAME, NODE_SPACE
from ecm_extract.link.naming.node_settings import NodeSettings, Settings, agreed
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, Instance
from ecm_extract.link.running.values import Value, is_known, unknown

_INITS = {"ros::init": 2, "rospy.init_node": 0, "rclpy.create_node": 0}
_SPACELESS = frozenset({"ros::init", "rospy.init_node"})
"""Those of ROS 1, where only a launch file gives a node its namespace."""
_OPEN_SPACE: Final = "{namespace}"
_OPEN: Final = "{name}"
"""Stands for the name of a node of which only the namespace is of use."""
_NAMING = ("init", "init_node", "create_node", "Node", "LifecycleNode", "make_shared")


@dataclass(frozen=True, slots=True)
class NodeName:
    """The name that a node gives itself, the line that says it, and the namespace that it puts itself in.

    One that is `anonymous` gets a number behind its name when it starts: nobody knows what it is called. `settings` is
    what is given beside the name, None where nothing can be.
    """

    text: str
    at: Evidence
    space: str = ""
    anonymous: bool = False
    settings: Settings | None = None

    @property
    def full(self) -> str:
        """Return the name with the namespace before it."""
        return f"{self.space}/{self.text}" if self.space else self.text

    @property
    def in_graph(self) -> str | None:
        """Return the same as names below it have it; None of one that is anonymous."""
        return None if self.anonymous else self.full

    @property
    def is_open(self) -> bool:
        """Whether not all of it is known."""
        return "{" in self.full


@dataclass(frozen=True, slots=True)
class Given:
    """What a node is made with: its name, what may be its namespace, and what else it is given."""

    name: Expr
    space: Expr | None
    args: Sequence[Expr] = ()
    keywords: Sequence[tuple[str, Expr]] = ()


class NodeNames:
    """Finds the name that a class or program gives its node; others make objects of classes that are `registered`."""

    def __init__(self, folder: Folder, sites: Sites, registered: Collection[Cls]) -> None:
        self.folder = folder
        self.sites = sites
        self.registered = registered
        self.settings = NodeSettings(folder)
        self._free: dict[File, list[Invocation]] | None = None

    def of_class(self, cls: Cls) -> NodeName | None:
        """Return the name that the class passes to its node base, None when it is not fixed."""
        with self.folder.faults.of(cls):
            return self._of_class(cls)
        return None

    def _of_class(self, cls: Cls) -> NodeName | None:
        found = self._passed_on(Instance(cls, {}, {}))
        if found is not None and not found.is_open:
            return self._renamed(found, cls) if found.settings is not None else found
        made = self._made_with(cls)
        given = _agreed(made)
        if given is not None and given.is_open and cls in self.registered:
            made, given = (), None  # who loads a component gives it nothing
        told = given or self._left_to_another(cls) or self._by_default(cls) or found
        others = {name.space for name in made if name is not None}
        return replace(told, space=_OPEN_SPACE) if told is not None and others - {told.space} else told

    def _renamed(self, found: NodeName, cls: Cls) -> NodeName:
        """The name that a class states, or the one that all who make its node give it instead by their options."""
        made = [name for name in self._made_with(cls) if name is not None] if cls not in self.registered else []
        if all(name.full == found.full for name in made):
            return found
        return _agreed(made) or replace(found, text=_OPEN, space=_OPEN_SPACE)

    def of_object(self, made: Instance) -> str | None:
        """Return the name, with its namespace, of the node that an object is; None where that is not known."""
        found = self._passed_on(made)
        return found.in_graph if found is not None and not found.is_open else None

    def own_settings(self, unit: Cls | Func) -> Settings:
        """Return what a class gives the node that it is, or a program the node that it begins, whoever runs it."""
        if isinstance(unit, Func):
            return self.settings_of(unit)
        found = self._passed_on(Instance(unit, {}, {}))
        return found.settings or Settings() if found is not None else Settings()

    def settings_of(self, unit: Cls | Func) -> Settings:
        """Return what all who make the node of a class, or of a program, give it.

        What one gives a component, which others load, sets something in that process only, as a launch file does.
        """
        if isinstance(unit, Func):
            name = self.of_program(unit)
            return name.settings or Settings() if name is not None else Settings()
        classes = (unit, *self.folder.program.derived(unit)) if unit not in self.registered else ()
        made = [name for cls in classes for name in self._made_with(cls)]
        return agreed([name.settings or Settings() for name in made if name is not None] or [self.own_settings(unit)])

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
        return self._is_directly_outside(cls) or any(map(self._hands_on, self.folder.program.bases(cls)))

    def _is_directly_outside(self, cls: Cls) -> bool:
        program = self.folder.program
        return any(is_node_base(program.canonical(base, cls.file, cls.qualified)) for base in cls.fact.bases)

    def _hands_on(self, cls: Cls) -> bool:
        """Tell whether a class of C++ has the constructors of a node base for its own: `using rclcpp::Node::Node;`."""
        lineage = self.folder.program.ancestry(cls) if cls.file.language == "cpp" else ()
        return any(map(self._is_directly_outside, lineage)) and not any(each.constructors for each in lineage)

    def _passed(self, func: Func, env: Env) -> NodeName | None:
        for at, statement in enumerate(func.fact.body):
            given, place = self._base_arguments(statement, env.before(at))
            if given is not None:
                return self._named(given, place, Evidence(func.file.path, statement.line))
        return None

    def _base_arguments(self, statement: Statement, env: Env) -> tuple[Given | None, Env]:
        """What a constructor hands to a node base, initialiser or `super().__init__`, with its place."""
        value, target = statement.value, statement.target
        if statement.kind == "init" and isinstance(target, Name) and self._is_base(plain(target.id), env):
            args = value.args if isinstance(value, Call) and value.callee == target else (value,)
            given = [arg for arg in args if arg is not None]
            return (Given(given[0], given[1] if len(given) > 1 else None, given[1:]) if given else None), env
        if isinstance(value, Call) and isinstance(value.callee, Member) and value.callee.name == "__init__":
            call, place = self.folder.spreading.whole(value, env)
            own = structs.replace(call, args=call.args[1:] if call.args[:1] == (THIS,) else call.args)
            name = next(positions(NODE_NAME, own), None)
            space = next(positions(NODE_SPACE, own), None)
            return (Given(name, space, (), own.keywords) if name is not None else None), place
        return None, env

    def _is_base(self, written: str, env: Env) -> bool:
        if is_node_base(written):
            return True
        cls = self.folder.objects.class_written(written, env)
        return cls is not None and self._hands_on(cls)

    def _named(self, given: Given, env: Env, at: Evidence) -> NodeName | None:
        settings = self.settings.of(given.args, given.keywords, env) if given.args or given.keywords else None
        values = (settings.name,) if settings and settings.name is not None else self.folder.fold(given.name, env)
        name = _known(values, at)
        spaces = self._spaces(given.space, env)
        spaces = (settings.space,) if settings and settings.space is not None else spaces
        space = (spaces[0] if len(spaces) == 1 else unknown("namespace")).text.strip("/") if spaces else ""
        if name is None and not space and not settings:
            return None
        return replace(name or NodeName(_OPEN, at), space=space, settings=settings)

    def _spaces(self, space: Expr | None, env: Env) -> tuple[Value, ...]:
        return self.folder.fold(space, env) if space is not None and self._is_text(space, env) else ()

    def _is_text(self, expr: Expr, env: Env) -> bool:
        """Tell whether the second argument of a node is its namespace; options are an object, in Python it is named."""
        if env.func.file.language == "python":
            return expr != Constant("null")
        written = self.folder.objects.type_of(expr, env)
        return "string" in written or is_known(self.folder.fold(expr, env)[0])

    def _made_with(self, cls: Cls) -> Sequence[NodeName | None]:
        return [name for _, name in self._makings(cls)]

    def _makings(self, cls: Cls) -> Sequence[tuple[Func, NodeName | None]]:
        """The names that the places give a node which make it; none where its constructor is not known."""
        found: list[tuple[Func, NodeName | None]] = []
        for call in self.sites.makers(cls):
            if call.func.cls is not cls:
                constructor = self.folder.objects.constructor(cls, call)
                if constructor is None and call.args and self._hands_on(cls):
                    found += [] if self.sites.making.is_base_of(call, cls) else [(call.func, self._given_to_base(call))]
                    continue
                if constructor is None:
                    return ()
                given = bind(constructor, call, self.sites.root_env(call.func, call.at))
                name = self._passed_on(self.folder.objects.delegated(Instance(cls, given, {}, constructor)))
                found.append((call.func, replace(name, at=_place(call)) if name is not None else None))
        return found

    def _given_to_base(self, call: Invocation) -> NodeName | None:
        """The name that a call gives the node base whose constructors it uses."""
        given = Given(call.args[0], next(iter(call.args[1:]), None), call.args[1:])
        return self._named(given, self.sites.root_env(call.func, call.at), _place(call))

    def of_program(self, main: Func) -> NodeName | None:
        """Return the name that a program gives its node, by a call in the file of its main function."""
        with self.folder.faults.of(main):
            found = (self._initialised(call) for call in self._free_calls(main.file))
            return next((name for name in found if name is not None), None)
        return None

    def made_by(self, classes: Iterable[Cls]) -> Iterator[tuple[Func, NodeName | None]]:
        """Yield the functions that make nodes, of libraries or of classes of the tree, and what each is called."""
        for call in (call for name in _NAMING for call in self.sites.calls.get(name, ())):
            found = self._initialised(call) if call.statement.kind != "init" else None
            if found is not None:
                yield call.func, found
        for cls in classes:
            yield from self._makings(cls)

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
        if index is None and call.receiver is None and self._makes_node(call):
            index = 0
        if index is None:
            return None
        own, env = self.folder.spreading.out(call, self.sites.root_env(call.func, call.at))
        python = call.func.file.language == "python"
        name = next(positions(f"arg:{index}|kw:node_name|kw:name" if python else f"arg:{index}", own), None)
        after = f"arg:{index + 1}" if is_node_base(call.path) else ""
        space = next(positions(NODE_SPACE if python else after, own), None)
        given = Given(name, space, own.args[1:], own.keywords) if name is not None else None
        if given is not None and named in _SPACELESS:
            given = Given(given.name, None)
        found = self._named(given, env, _place(call)) if given is not None else None
        anonymous = found is not None and named is not None and is_anonymous(named, call, env, self.folder)
        return replace(found, anonymous=True) if found is not None and anonymous else found

    def _makes_node(self, call: Invocation) -> bool:
        """Tell whether a call makes a node: what a tree itself calls `Node`, by a class or an alias, may be none."""
        func, program = call.func, self.folder.program
        if not is_node_base(call.path) or not is_node_base(program.canonical(call.path, func.file, func.scope)):
            return False
        cls = program.class_named(call.path, func.file, func.scope)
        return cls is None or self._derives_outside(cls)


def _by_default(func: Func) -> dict[str, Bound]:
    """What a function is called with where nobody is seen to give it arguments."""
    stars = [parameter.name for parameter in func.fact.params if parameter.name.startswith("*")]
    more = {name.lstrip("*"): Bound(Table(()) if name.startswith("**") else Items(()), Env(func)) for name in stars}
    return more | {name: Bound(default, Env(func)) for name, default in func.defaults}


def _agreed(found: Sequence[NodeName | None]) -> NodeName | None:
    """The name that several ways to make a node agree on."""
    return found[0] if len({name.full if name is not None else None for name in found}) == 1 else None


def _place(call: Invocation) -> Evidence:
    return Evidence(call.func.file.path, call.line)


def _known(values: tuple[Value, ...], at: Evidence) -> NodeName | None:
    value = values[0]
    is_fixed = len(values) == 1 and value.confidence != "pattern" and bool(value.text)
    return NodeName(value.text, at) if is_fixed else None
