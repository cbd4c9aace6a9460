"""What a site leaves open, and who knows it: the callers of its function, or the makers of its object."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.own import is_own_member, own_name
from ecm_extract.link.code.pointed import makes_pointed
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.texts import is_text_type
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import children, last_of
from ecm_extract.link.declaring.match import handle_argument, name_argument, positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.data import plain_type
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.interfaces.types import Types
from ecm_extract.link.running.class_lines import ahead
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Hole, Value

MAX_CHAIN = 8
"""Calls through which a name, a handle or a profile is followed."""
_OF_TABLES: Final = frozenset({"get", "pop"})
_INITIALISING = frozenset({"init", "let", "set"})
"""Statements by which a constructor makes a member: in its initialiser list, or in its body."""


class Openness:
    """Finds the parameters that decide about sites; `derived` gives the classes that derive from one."""

    def __init__(self, folder: Folder, types: Types, derived: Callable[[Cls], Sequence[Cls]]) -> None:
        self.folder = folder
        self.types = types
        self.derived = derived

    def of(self, site: Site, names: Sequence[Value]) -> tuple[frozenset[str], frozenset[str]]:
        """Return the parameters and the constructor parameters that name, type and profile depend on."""
        params: frozenset[str] = frozenset()
        made: frozenset[str] = frozenset()
        for value in names:
            params |= value.open("param")
            made |= value.open("made")
        found = self.types.at(site.form.type, site.call, site.env, site.form.role) if not site.form.row.value else None
        if found is not None and found.open:
            params |= found.open
            made |= found.open
        made |= self._redefined(site, names)
        handle = _below_what(handle_argument(site.form, site.call), {"NodeHandle"})
        for expr, accepts in ((handle, _is_handle), (_qos(site), self._is_made_of)):
            given, kept = self._origin(expr, site, accepts)
            params, made = params | given, made | given | kept
        if any(value.confidence == "pattern" for value in names):
            parts = _own_fields(name_argument(site.form, site.call))
            made = made.union(*(self._origin(part, site, _is_parameter)[1] for part in parts))
        return params, made

    def _redefined(self, site: Site, names: Sequence[Value]) -> frozenset[str]:
        """What a name or another argument is made of that derived classes have of their own: fields and methods."""
        owner = site.owner
        derived = self.derived(owner) if owner is not None else ()
        if owner is None or not derived:
            return frozenset()
        asked = {label for value in names for label in _unknown(value)}
        used = asked.union(*map(_attributes, _deciding(site))) if owner.file.language == "python" else asked
        others = ahead(owner, self.folder.program) if owner.file.language == "python" else ()
        fields = (entry.fields.get(name) for name in used for entry in others)
        own = (field.name for field in fields if field is not None and field.default is not None)
        return frozenset(own) | self._methods(owner, derived, used)

    def _methods(self, owner: Cls, derived: Iterable[Cls], asked: set[str]) -> frozenset[str]:
        """The methods among what is not known that derived classes, or other bases of them, have.

        Of C++ those only that the class at hand has not: who calls them in its constructor runs its own.
        """
        program = self.folder.program
        others = [entry for each in derived for entry in program.ancestry(each)] if asked else []
        theirs = set(_with_bodies(others))
        if owner.file.language == "python":
            return frozenset(asked & {method.fact.name for each in ahead(owner, program) for method in each.methods})
        return frozenset(asked & theirs - set(_with_bodies(program.ancestry(owner))))

    def _origin(
        self, expr: Expr | None, site: Site, accepts: Callable[[str, Func], bool]
    ) -> tuple[frozenset[str], frozenset[str]]:
        """The parameter of the outermost function, or of the constructor, that a node handle or a profile comes from.

        Whoever passes it knows the namespace, or the QoS.
        """
        params: frozenset[str] = frozenset()
        made: frozenset[str] = frozenset()
        pending: Iterable[tuple[Expr | None, Env]] = [(expr, site.env)]
        around = list(self.folder.nesting.around(site.root))
        for _ in range(2 * (MAX_CHAIN + 1)):  # in each function its parameter, and the member that is made of it
            if accepts == self._is_made_of:
                pending = [(part, env) for each, env in pending for part in _parts(each)]
            for each, env in pending:
                found = self._accepted(each, env, accepts)
                if env.func is site.root or (env.func in around and not env.func.is_constructor):
                    params |= found
                elif env.func.is_constructor:
                    made |= found
            pending = [outer for each, env in pending for outer in self._outward(each, env, accepts)]
        return params, made

    def _accepted(self, expr: Expr | None, env: Env, accepts: Callable[[str, Func], bool]) -> frozenset[str]:
        """The parameters of a function that an expression is, or is joined of, and that nobody has bound."""
        if own_name(expr) in env.args:
            return frozenset()
        return frozenset(name for name in _names(expr) if accepts(name, env.func))

    def _is_made_of(self, name: str, func: Func) -> bool:
        """Tell whether a function takes by this name what a profile is made of; of an object one part alone may be."""
        given = [plain_type(entry.type) for entry in func.fact.params if entry.name.lstrip("*") == name]
        named = self.folder.program.class_named
        return bool(given) and not any(named(written, func.file, func.scope) for written in given)

    def _outward(
        self, expr: Expr | None, env: Env, accepts: Callable[[str, Func], bool]
    ) -> Iterable[tuple[Expr | None, Env]]:
        """What an expression is further out: what is passed for it, or what makes it."""
        name = own_name(expr)
        bound = env.args.get(name)
        if bound is not None:
            return [(bound.expr, bound.env)]
        place = self.folder.names.captured_at(name, env) if name else None
        if place is not None:
            return [(expr, place)]
        if expr is None or not name or self._accepted(expr, env, accepts):
            return ()
        return self._initialisers(expr, env)

    def _initialisers(self, variable: Expr, env: Env) -> Iterator[tuple[Expr | None, Env]]:
        """Yield what constructors, and the function at hand, make of a member, and what a handle of a body is below."""
        for made in self.folder.origins.makers(variable, env) or ():
            body = made.env.func.fact.body
            statement = body[made.env.at] if 0 <= made.env.at < len(body) else None
            outer = _below(statement) if statement is not None else None
            if outer is not None:
                yield outer, made.env
            elif statement is not None and statement.kind in _INITIALISING and _is_begun_by(made.env.func, env):
                yield _parent(made.expr, own_name(variable)), made.env


def _is_begun_by(func: Func, env: Env) -> bool:
    """Tell whether it is certain what a function is given: a constructor, or the function at hand."""
    return func.is_constructor or func is env.func


def _parent(expr: Expr, member: str) -> Expr:
    """What a member is made of: `m(x)`, or a handle that it is below, `m(x, "in")` or `m(ros::NodeHandle(x, "in"))`."""
    given = expr.args[0] if isinstance(expr, Call) and len(expr.args) == 1 else expr
    return _below_what(given, {member, "NodeHandle"}) or given


def _below_what(expr: Expr | None, makers: Set[str]) -> Expr | None:
    """The handle, or the namespace, that a handle is made of which is written out."""
    while isinstance(expr, Call) and expr.args and _made_by(expr) in makers:
        expr = expr.args[0]
    return expr.operands[0] if isinstance(expr, Op) and expr.op == "&" else expr


def _made_by(call: Call) -> str:
    """The last name of what a call makes, be it behind a pointer: `std::make_shared<ros::NodeHandle>(x, "in")`."""
    last = last_name(own_name(call.callee))
    return last_name(plain(call.types[0])) if makes_pointed(last) and call.types else last


def _names(expr: Expr | None) -> Iterator[str]:
    """A name, or those of which a text is joined."""
    if own_name(expr):
        yield own_name(expr)
    for part in expr.operands if isinstance(expr, Op) else ():
        yield from _names(part)


def _qos(site: Site) -> Expr | None:
    return next(positions(site.form.qos, site.call), None) if not site.form.fixed else None


def _deciding(site: Site) -> Iterator[Expr | None]:
    """The arguments of a call that its endpoint is made of: name, profile, type and default."""
    yield name_argument(site.form, site.call)
    yield _qos(site)
    yield from positions(site.form.type, site.call)
    yield from positions(site.form.default, site.call)


def _parts(expr: Expr | None) -> Iterator[Expr | None]:
    """What a profile is, or what the calls that make one and set its policies are given."""
    whole = _whole(expr)
    if not isinstance(whole, Call):
        yield whole
        return
    callee = whole.callee
    of_table = last_of(callee) in _OF_TABLES  # `options.get("depth", 5)`
    chained = [callee.base] if isinstance(callee, Member) and (of_table or isinstance(callee.base, Call)) else []
    for part in (*chained, *whole.args, *(value for _, value in whole.keywords)):
        yield from _parts(part)


def _whole(expr: Expr | None) -> Expr | None:
    """The variable, or the member of the object at hand, that a profile is a field of; itself where it is none."""
    while isinstance(expr, Member) and expr.base != THIS:
        expr = expr.base
    return expr


def _own_fields(expr: Expr | None) -> Iterator[Expr]:
    """Yield the members of the object at hand of which an expression has a field: `self.part` of `self.part.name`."""
    if isinstance(expr, Member) and is_own_member(expr.base):
        yield expr.base
    for part in children(expr) if expr is not None else ():
        yield from _own_fields(part)


def _is_parameter(name: str, func: Func) -> bool:
    return name in func.given


def _is_handle(name: str, func: Func) -> bool:
    """Tell whether a function takes by this name a node handle of ROS 1, or the namespace that one is made of."""
    given = [entry.type for entry in func.fact.params if entry.name == name]
    return any("NodeHandle" in written or is_text_type(written) for written in given)


def _below(statement: Statement) -> Expr | None:
    """The handle that a variable of a body is made below: `ros::NodeHandle inner(outer, "inner")`."""
    made = statement.value if statement.kind == "let" else None
    if not isinstance(made, Call) or not ("NodeHandle" in statement.type or _made_by(made) == "NodeHandle"):
        return None
    return _below_what(next(iter(made.args), None), {"NodeHandle"})


def _unknown(value: Value) -> Iterator[str]:
    """What a value leaves open without knowing who knows it."""
    return (part.label for part in value.parts if isinstance(part, Hole) and part.kind in {"unknown", "outside"})


def _with_bodies(classes: Iterable[Cls]) -> Iterator[str]:
    return (method.fact.name for entry in classes for method in entry.methods if method.fact.body)


def _attributes(expr: Expr | None) -> set[str]:
    """Names of the members of `self` in an expression."""
    pending, found = [expr] if expr is not None else [], set()
    while pending:
        part = pending.pop()
        if is_own_member(part):
            found.add(part.name)
        pending.extend(children(part))
    return found
