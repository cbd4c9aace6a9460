"""What is kept to be run later: partials, and generators that a variable holds.

What `functools.partial` is given is what it was when it was made: `make = partial(f, name)` keeps `name`. It is told as
assignments of their own before: `make*0 = name`, then `make = partial(f, make*0)`. No variable has such a name. What
`rows = (name + x for x in names)` gives is what variables are when somebody asks for it.
"""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Member, Name, Number, Op, Text
from ecm_parsers.source.facts import Constant as NamedValue
from ecm_parsers.source.flow import Later
from ecm_parsers.source.python_scan import Scan

_AS_THEY_ARE = (Text, Number, Constant)


def value_for(scan: Scan, target: Expr, node: Node | None) -> Expr | None:
    """Read what a target is given; what a partial keeps is told before."""
    if node is not None and node.type == "generator_expression":
        return _later(scan, node)
    value = scan.expr(node) if node is not None else None
    own = isinstance(target, Name) or (isinstance(target, Member) and target.base == THIS)
    if node is None or not isinstance(value, Call) or not own or scan.frame.place == "class":
        return value
    return _keeping(scan, node, target, value) if value.args and _is_partial(scan, value.callee) else value


def _later(scan: Scan, node: Node) -> Expr:
    scan.frame.lambdas += 1
    scan.frame.flow.begin()
    scan.done(node)
    scan.frame.flow.add(Later(scan.frame.flow.end()))
    scan.frame.lambdas -= 1
    return scan.opaque(node)


def _keeping(scan: Scan, node: Node, target: Expr, value: Call) -> Call:
    args = [kept(scan, node, _part(target, str(at)), arg) for at, arg in enumerate(value.args[1:])]
    keywords = [(name, kept(scan, node, _part(target, name), each)) for name, each in value.keywords if name != "**"]
    tables = [(name, _table(scan, node, _part(target, name), each)) for name, each in value.keywords if name == "**"]
    named = sorted(zip(value.keywords, value.keyword_lines, strict=True), key=lambda each: each[0][0] == "**")
    lines = tuple([line for _, line in named])
    return Call(value.callee, (value.args[0], *args), (*keywords, *tables), value.types, value.line, lines)


def kept(scan: Scan, node: Node, target: Expr, value: Expr) -> Expr:
    """Return the target to which an argument is given, in its place; `*values` is given as what it consists of."""
    if isinstance(value, _AS_THEY_ARE):
        return value
    spread = isinstance(value, Op) and value.op == "*" and len(value.operands) == 1
    given = Call(Name("tuple"), value.operands) if spread and isinstance(value, Op) else value
    _give(scan, node, target, given)
    return Op("*", (target,)) if spread else target


def _table(scan: Scan, node: Node, target: Expr, value: Expr) -> Expr:
    _give(scan, node, target, Call(Name("dict"), (value,)))
    return target


def _give(scan: Scan, node: Node, target: Expr, value: Expr) -> None:
    scan.emit("set", node, value, target)
    if scan.frame.place == "module" and isinstance(target, Name):
        scan.constants.append(NamedValue(target.id, "", value, node.start_point[0] + 1))


def _part(target: Expr, which: str) -> Expr:
    if isinstance(target, Member):
        return Member(target.base, f"{target.name}*{which}")
    return Name(f"{target.id}*{which}") if isinstance(target, Name) else target


def _is_partial(scan: Scan, callee: Expr) -> bool:
    """Tell whether what is called is `functools.partial`, by what the file has imported so far."""
    imported = {entry.alias or entry.name or entry.module: (entry.module, entry.name) for entry in scan.imports}
    if isinstance(callee, Name):
        return imported.get(callee.id) == ("functools", "partial")
    named = isinstance(callee, Member) and callee.name == "partial" and isinstance(callee.base, Name)
    return named and isinstance(callee, Member) and imported.get(getattr(callee.base, "id", "")) == ("functools", "")
