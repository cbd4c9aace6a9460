"""Below which namespace a `dynamic_reconfigure` server offers its parameters."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import Call, Expr, Name, Text
from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.facts import PackageFacts


def server_namespaces(facts: PackageFacts) -> dict[str, str]:
    """Return `~/namespace` by path of the `.cfg` file, where the constructor of the server's holder names one."""
    found = {}
    for path, reconfigure in facts.reconfigure.items():
        if not reconfigure.name:
            continue
        for source in facts.sources.values():
            for member in _servers(source, f"{reconfigure.name}Config"):
                namespace = _namespace(source, member)
                if namespace:
                    found[path] = namespace
    return found


def _servers(source: SourceFile, config: str) -> Iterator[str]:
    """Members of a type `dynamic_reconfigure::Server<...Config>`."""
    for cls in source.classes:
        for field in cls.fields:
            if config in field.type and "Server" in field.type:
                yield field.name


def _namespace(source: SourceFile, member: str) -> str | None:
    for function in source.functions:
        for statement in function.body:
            if statement.target == Name(member) or getattr(statement.target, "name", None) == member:
                text = _node_handle(statement.value, 0)
                if text:
                    return text
    return None


def _node_handle(expr: Expr | None, depth: int) -> str | None:
    """The literal that a `ros::NodeHandle` inside an expression is made of."""
    if not isinstance(expr, Call) or depth > 8:
        return None
    if isinstance(expr.callee, Name) and expr.callee.id.endswith("NodeHandle") and expr.args:
        last = expr.args[-1]
        return last.value if isinstance(last, Text) else None
    return next((text for arg in expr.args if (text := _node_handle(arg, depth + 1))), None)
