"""Calls of rospy service proxies, and request objects, with the service that they are of.

A proxy is bound where a service client is made, directly or through a helper; it is called by its own name, through
`self`, or as an attribute of the module that binds it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

from ecm_parsers.interface_facts import Definition
from ecm_parsers.source.expr import Call, Expr, Member
from ecm_parsers.source.facts import Function

from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped

_OWN = "this"


@dataclass(frozen=True, slots=True)
class ServiceCall:
    """One call of a proxy.

    Attributes:
        file, line: where. proxy: as written.
        service: `package/srv/Name`.
        call: the call with its arguments.
    """

    file: File
    line: int
    proxy: str
    service: str
    call: Call


@cache
def common_services() -> Mapping[str, tuple[str, ...]]:
    """Return the request fields of services that are known without their package."""
    return MappingProxyType(
        {name: tuple(fields) for name, fields in shipped("requires/common_services.toml")["services"].items()}
    )


def request_fields(packages: Sequence[PackageFacts]) -> dict[str, tuple[str, ...]]:
    """Return the request fields of each service of the tree, and of the common ones."""
    own = {
        f"{package.name}/srv/{path.rpartition('/')[2].removesuffix('.srv')}": _request(definition)
        for package in packages
        for path, definition in package.interfaces.items()
        if definition.shape == "srv"
    }
    return {**common_services(), **own}


def service_calls(files: Sequence[File], linked: Sequence[LinkedModule]) -> Iterator[ServiceCall]:
    """Yield the calls of proxies whose service is known.

    Args:
        files: all sources.
        linked: modules with their endpoints.
    """
    made = _clients(linked)
    python = [file for file in files if file.language == "python" and file.ros == 1]
    bound = {file.path: _bound(file, made) for file in python}
    for file in python:
        for function in file.facts.functions:
            for statement in function.body:
                for expr, line in expressions(statement):
                    proxy, service = _proxy(expr, file, function, bound)
                    if isinstance(expr, Call) and service:
                        yield ServiceCall(file, line, proxy, service, expr)


def _request(definition: Definition) -> tuple[str, ...]:
    return tuple(field.name for section in definition.sections if section.name == "request" for field in section.fields)


def _clients(linked: Sequence[LinkedModule]) -> dict[tuple[str, int], str]:
    """Service of the line that makes a client; a line that makes several kinds tells nothing."""
    found: dict[tuple[str, int], set[str]] = {}
    for entry in linked:
        for interface in entry.interfaces:
            if interface.row.calls and interface.row.shape == "srv" and interface.type:
                place = interface.evidence[0]
                found.setdefault((place.path, place.line), set()).add(interface.type)
    return {place: next(iter(types)) for place, types in found.items() if len(types) == 1}


def _bound(file: File, made: Mapping[tuple[str, int], str]) -> dict[str, str]:
    """Proxies of a file by name: `scope::name` of a local or attribute, `name` of a global."""
    found: dict[str, set[str]] = {}
    for function in file.facts.functions:
        for statement in function.body:
            name = dotted(statement.target) if statement.target is not None else None
            service = made.get((file.path, statement.line)) if isinstance(statement.value, Call) else None
            if name and service:
                found.setdefault(_key(name, function), set()).add(service)
                if function.name != "<module>" and any(entry.name == name for entry in file.facts.constants):
                    found.setdefault(name, set()).add(service)  # a function that sets a global
    return {name: next(iter(services)) for name, services in found.items() if len(services) == 1}


def _key(name: str, function: Function) -> str:
    if function.name == "<module>":
        return name
    scope = function.scope if name.startswith(f"{_OWN}.") else f"{function.scope}::{function.name}"
    return f"{scope}|{name}"


def _proxy(expr: Expr, file: File, function: Function, bound: Mapping[str, Mapping[str, str]]) -> tuple[str, str]:
    """Return the name and the service of the proxy that an expression calls; empty for none."""
    callee = expr.callee if isinstance(expr, Call) else None
    if isinstance(callee, Member) and callee.name == "call":
        callee = callee.base
    name = dotted(callee) if callee is not None else None
    if not name:
        return "", ""
    own = bound[file.path]
    found = own.get(_key(name, function)) or (own.get(name) if "." not in name else None)
    return (name, found) if found else (name, _of_module(name, file, bound))


def _of_module(name: str, file: File, bound: Mapping[str, Mapping[str, str]]) -> str:
    """`command.land`, where `command` is an imported module of the tree."""
    head, _, last = name.rpartition(".")
    if not head:
        return ""
    first, _, rest = head.partition(".")
    module = file.imported.get(first, "")
    ending = "/".join([*module.split("."), *rest.split(".")] if rest else module.split("."))
    found = {
        names[last]
        for path, names in bound.items()
        if module and last in names and f"/{path}".endswith((f"/{ending}.py", f"/{ending}/__init__.py"))
    }
    return found.pop() if len(found) == 1 else ""
