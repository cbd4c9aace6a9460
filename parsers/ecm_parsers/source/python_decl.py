"""Python declarations: functions, classes, parameters, decorators and imports."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec
from tree_sitter import Node

from ecm_parsers.source.expr import THIS, Expr, Items, Member, Name, Opaque
from ecm_parsers.source.facts import Class, Field, Function, Import, Parameter, Statement
from ecm_parsers.source.python_dataclasses import Imported, generated_init
from ecm_parsers.source.python_parameters import parameters
from ecm_parsers.source.python_remade import is_remade
from ecm_parsers.source.python_scan import Frame, Scan, StatementHandler, parts

_PARTS_OF_CHOICE = 3
"""What `a if condition else b` has."""


def _decorated(scan: Scan, node: Node) -> None:
    decorators: list[Node] = []
    for child in parts(node):
        if child.type == "decorator":
            decorators += parts(child)
            for part in parts(child):
                scan.do(part)
        elif child.type == "function_definition":
            _read_function(scan, child, tuple([scan.text(each) for each in decorators]))
        elif child.type == "class_definition":
            _read_class(scan, child, decorators)


def _function(scan: Scan, node: Node) -> None:
    _read_function(scan, node, ())


def _class(scan: Scan, node: Node) -> None:
    _read_class(scan, node, [])


def _read_function(scan: Scan, node: Node, decorators: tuple[str, ...]) -> None:
    outer = scan.frame
    name = scan.text(node.child_by_field_name("name"))
    params = parameters(scan, node.child_by_field_name("parameters"))
    names = outer.names
    if outer.place == "class":
        names, params = _method_names(scan, params, decorators)
    elif _hides_receiver(names, params):
        names = {}
    body: list[Statement] = []
    frame = Frame("function", _inside(outer.scope, name), body, names)
    frame.fields = outer.fields if outer.place == "class" and name == "__init__" else None
    frame.bases = outer.bases
    _read_body(scan, node, frame)
    bound = set(_bound_in(scan, frame)) if frame.globals else set()
    scan.constants += [entry for entry in frame.globals if entry.name in bound]  # `global` alone binds nothing
    scan.functions.append(
        Function(
            name=name,
            scope=outer.scope,
            params=params,
            returns=scan.text(node.child_by_field_name("return_type")),
            line=node.start_point[0] + 1,
            end_line=node.end_point[0] + 1,
            body=tuple(body),
            traits=(*_traits(name, decorators), *_ways_to_run(node, frame)),
            decorators=decorators,
            flow=frame.flow.flow(),
            shared=tuple(frame.shared),
        )
    )


def _ways_to_run(node: Node, frame: Frame) -> Iterator[str]:
    """How a body runs that does not when it is called."""
    if frame.yields:
        yield "generator"
    if frame.yields > frame.unanswered:
        yield "receiving"
    if any(child.type == "async" for child in node.children):
        yield "coroutine"


def _bound_in(scan: Scan, frame: Frame) -> Iterator[str]:
    """The names that a function binds: by assignments, loops, imports, and what it declares."""
    for statement in frame.body:
        targets = statement.target.items if isinstance(statement.target, Items) else (statement.target,)
        if statement.type != "del":
            yield from (target.id for target in targets if isinstance(target, Name))
    yield from (entry.name for entry in scan.functions if entry.scope == frame.scope)
    yield from (entry.name for entry in scan.classes if entry.scope == frame.scope)
    yield from (entry.alias or entry.name or entry.module for entry in scan.imports)


def _read_class(scan: Scan, node: Node, decorators: list[Node]) -> None:
    outer = scan.frame
    name = scan.text(node.child_by_field_name("name"))
    bases = node.child_by_field_name("superclasses")
    fields: list[Field] = []
    # The body of a class runs where the class is declared.
    frame = Frame("class", _inside(outer.scope, name), outer.body, dict(outer.names), outer.flow)
    frame.depth = frame.begun = outer.depth
    frame.fields = fields
    frame.owner = Member(outer.owner, name) if outer.owner is not None else Name(name)
    frame.bases = _bases(scan, bases) if bases is not None else ()
    before = len(scan.functions)
    _read_body(scan, node, frame)
    made = Class(
        name=name,
        scope=outer.scope,
        bases=frame.bases,
        line=node.start_point[0] + 1,
        end_line=node.end_point[0] + 1,
        fields=tuple(fields),
        traits=_traits(name, tuple([scan.text(each) for each in decorators])),
        decorators=tuple([scan.expr(each) for each in decorators]),
    )
    methods = [each.name for each in scan.functions[before:] if each.scope == frame.scope]
    imported = Imported.of(scan.imports)
    if is_remade(made, _metaclass(scan, bases), imported):
        made = msgspec.structs.replace(made, traits=(*made.traits, "remade"))
    scan.classes.append(made)
    init = generated_init(made, frame.scope, methods, imported)
    if init is not None:
        scan.functions.append(init)


def _read_body(scan: Scan, node: Node, frame: Frame) -> None:
    body = node.child_by_field_name("body")
    if body is None:
        return
    outer, scan.frame = scan.frame, frame
    scan.block(body)
    scan.frame = outer


def _method_names(
    scan: Scan, params: tuple[Parameter, ...], decorators: tuple[str, ...]
) -> tuple[dict[bytes, Expr], tuple[Parameter, ...]]:
    """Names inside a method, where the first parameter is `this`, and its other parameters."""
    if "staticmethod" in decorators or not params or params[0].name.startswith("*"):
        return {}, params
    return scan.names_of(params[0].name.encode()), params[1:]


def _hides_receiver(names: dict[bytes, Expr], params: tuple[Parameter, ...]) -> bool:
    """Whether a nested function has a parameter named like the receiver of the method around it."""
    return any(names.get(param.name.encode()) == THIS for param in params)


def _inside(scope: str, name: str) -> str:
    return f"{scope}::{name}" if scope else name


def _bases(scan: Scan, node: Node) -> tuple[str, ...]:
    found = (each for child in parts(node) if child.type != "keyword_argument" for each in _alternatives(child))
    return tuple(scan.text(each) for each in found)


def _alternatives(node: Node) -> Iterator[Node]:
    """What a base may be: of `Node if HAVE_ROS else object` both."""
    found = parts(node) if node.type == "conditional_expression" else []
    if len(found) != _PARTS_OF_CHOICE:
        yield node
        return
    then, _, otherwise = found
    yield from (*_alternatives(then), *_alternatives(otherwise))


def _metaclass(scan: Scan, bases: Node | None) -> str:
    """What makes a class, where its head says so."""
    named = (child for child in (parts(bases) if bases is not None else ()) if child.type == "keyword_argument")
    return next((scan.text(each.children[-1]) for each in named if scan.text(each.children[0]) == "metaclass"), "")


def _traits(name: str, decorators: tuple[str, ...]) -> tuple[str, ...]:
    traits: list[str] = []
    if name.startswith("_") and not name.endswith("__"):
        traits.append("private")
    for decorator in decorators:
        last = decorator.partition("(")[0].rpartition(".")[2].strip()
        trait = _DECORATOR_TRAITS.get(last)
        if trait is not None:
            traits.append(trait)
    return tuple(traits)


_DECORATOR_TRAITS: Mapping[str, str] = {
    "staticmethod": "static",
    "abstractmethod": "pure",
    "abstractproperty": "pure",
    "override": "override",
    "deprecated": "deprecated",
}


def _may_fail(scan: Scan, node: Node) -> None:
    """An import within `try` is a step of its own: what it asks for may not be there."""
    if scan.frame.attempts:
        scan.emit("do", node, Opaque("import"))


def _import(scan: Scan, node: Node) -> None:
    _may_fail(scan, node)
    line = node.start_point[0] + 1
    for child in parts(node):
        module, alias = _imported(scan, child)
        scan.imports.append(Import(module, "", alias, line))
        _give_others(scan, child, alias or module, Opaque("import"))


def _import_from(scan: Scan, node: Node) -> None:
    _may_fail(scan, node)
    module, *names = parts(node)
    origin = _compact(scan, module)
    for child in names:
        name, alias = ("*", "") if child.type == "wildcard_import" else _imported(scan, child)
        line = child.start_point[0] + 1
        here = _bound_here(scan, name, alias, line)
        scan.imports.append(Import(origin, name, here, line))
        _give_others(scan, child, alias or name, Name(here))


def _bound_here(scan: Scan, name: str, alias: str, line: int) -> str:
    """The alias of an import: one of its own where a function hides a variable of the module by it."""
    bound = alias or name
    hides = scan.frame.place == "function" and any(each.name == bound and not each.scope for each in scan.constants)
    if not hides:
        return alias
    own = f"{bound}@{line}"
    scan.frame.names = dict(scan.frame.names)  # methods beside it mean what they meant
    scan.names_again(bound, Name(own))
    return own


def _give_others(scan: Scan, node: Node, bound: str, value: Expr) -> None:
    """An import of a name that the function declares `global`: a variable of the module is given something."""
    if bound in scan.frame.shared and any(each.name == bound and not each.scope for each in scan.constants):
        scan.emit("set", node, value, Name(bound))


def _import_future(scan: Scan, node: Node) -> None:
    line = node.start_point[0] + 1
    for child in parts(node):
        name, alias = _imported(scan, child)
        scan.imports.append(Import("__future__", name, alias, line))


def _imported(scan: Scan, node: Node) -> tuple[str, str]:
    """Imported name and its alias."""
    if node.type != "aliased_import":
        return _compact(scan, node), ""
    children = node.children
    return _compact(scan, children[0]), scan.text(children[-1])


def _compact(scan: Scan, node: Node) -> str:
    return scan.text(node).replace(" ", "").replace("\\", "")


DECLARATIONS: Mapping[str, StatementHandler] = {
    "class_definition": _class,
    "decorated_definition": _decorated,
    "function_definition": _function,
    "future_import_statement": _import_future,
    "import_from_statement": _import_from,
    "import_statement": _import,
}
