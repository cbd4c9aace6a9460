"""Behaviour tree nodes that a package registers, and their ports: the names that behaviour tree files use."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ecm_checker.hub.provision import Line, Provision
from ecm_parsers.source.expr import Call, Constant, Number, Text
from ecm_parsers.source.facts import Function, SourceFile

from ecm_extract.entities.paths import inside
from ecm_extract.entities.signatures import normal_type
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.read.facts import PackageFacts

_REGISTERS = frozenset(
    {
        "registerNodeType",
        "registerBuilder",
        "registerSimpleAction",
        "registerSimpleCondition",
        "registerSimpleDecorator",
    }
)
_PORTS = frozenset({"InputPort", "OutputPort", "BidirectionalPort"})
_LIBRARY = "behaviortree_cpp"
"""In the path of each header of BehaviorTree.CPP, of any version."""
_LISTS_PORTS = "providedPorts"
"""Static method in which BehaviorTree.CPP asks a node class for its ports."""
_ADDS_PORTS = "providedBasicPorts"
"""What base classes by custom add to the ports of a node."""
_EXAMPLES = frozenset({"example", "examples", "tutorial", "tutorials"})
"""Programs that show how nodes are made; nobody else's trees can name these."""
Port = tuple[Call, Text, Line]


def base_ports(packages: Iterable[PackageFacts]) -> dict[str, list[Port]]:
    """Return the ports that base classes of a tree add to those of a node, by the own name of the class."""
    found: dict[str, list[Port]] = {}
    for facts in packages:
        if _uses_trees(facts):
            found |= _listed(facts, _ADDS_PORTS)
    return found


def bt_entities(facts: PackageFacts, added: Mapping[str, list[Port]]) -> Iterator[Provision]:
    """Yield the registered nodes of a package, each with the ports that its class and its bases list.

    Args:
        facts: of the package.
        added: ports of base classes, see `base_ports`.
    """
    if not _uses_trees(facts):
        return
    ports = _ports_by_class(facts, added)
    for path, source in facts.sources.items():
        if source.language == "cpp" and _EXAMPLES.isdisjoint(inside(path, facts.root.path).split("/")[:-1]):
            for call, name in _named_calls(source, _REGISTERS):
                yield Provision(
                    kind="bt_node", package=facts.name, owner="", name=name.value, path=path, line=call.line
                )
                cls = call.types[0].rsplit("::", 1)[-1] if call.types else ""
                yield from (_port(facts.name, name.value, port) for port in ports.get(cls, ()))


def _uses_trees(facts: PackageFacts) -> bool:
    return any(_LIBRARY in entry.module for source in facts.sources.values() for entry in source.imports)


def _ports_by_class(facts: PackageFacts, added: Mapping[str, list[Port]]) -> dict[str, list[Port]]:
    """The calls that make ports, by the own name of the class that lists them; those of its bases included."""
    listed = _listed(facts, _LISTS_PORTS)
    bases = {
        cls.name: [plain(base) for base in cls.bases] for source in facts.sources.values() for cls in source.classes
    }
    return {
        name: [*ports, *(port for base in bases.get(name, ()) for port in added.get(base.rsplit("::", 1)[-1], ()))]
        for name, ports in listed.items()
    }


def _listed(facts: PackageFacts, method: str) -> dict[str, list[Port]]:
    found: dict[str, list[Port]] = {}
    for path, source in facts.sources.items():
        for function in source.functions:
            if function.name == method and function.body:
                calls = _named_calls_of(function, _PORTS)
                ports = [(call, name, (path, call.line or function.line)) for call, name in calls]
                found.setdefault(function.scope.rsplit("::", 1)[-1], ports)
    return found


def _port(package: str, node: str, port: Port) -> Provision:
    call, name, (path, line) = port
    default = call.args[1] if len(call.args) == 3 else None
    return Provision(
        kind="bt_port",
        package=package,
        owner=node,
        name=name.value,
        type=normal_type(call.types[0]) if call.types else None,
        default=_plain(default),
        path=path,
        line=line,
    )


def _plain(expr: object) -> object:
    """A default as data; None where it is computed, or there is none."""
    if isinstance(expr, Call) and len(expr.args) == 1:
        return _plain(expr.args[0])
    if isinstance(expr, Constant):
        return {"true": True, "false": False}.get(expr.name)
    return expr.value if isinstance(expr, Text | Number) else None


def _named_calls(source: SourceFile, names: frozenset[str]) -> Iterator[tuple[Call, Text]]:
    for function in source.functions:
        yield from _named_calls_of(function, names)


def _named_calls_of(function: Function, names: frozenset[str]) -> Iterator[tuple[Call, Text]]:
    """Calls of these names whose first argument is a literal."""
    for statement in function.body:
        for expr, _ in expressions(statement):
            if isinstance(expr, Call) and expr.args and isinstance(expr.args[0], Text):
                called = (dotted(expr.callee) or "").replace("::", ".").rsplit(".", 1)[-1]
                if called in names:
                    yield expr, expr.args[0]
