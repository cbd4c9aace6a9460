"""Objects of plain structures and pairs: the values that they are made from, and their fields."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final

import msgspec
from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import Invocation, Step, construction, dotted_name
from ecm_extract.link.code.containers import makes_tuple
from ecm_extract.link.code.numbers import as_number, kind_of_type
from ecm_extract.link.code.overloads import NO, score
from ecm_extract.link.code.pointed import given_to_pointed, is_only_reached_into, pointed
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, Instance, bind
from ecm_extract.link.running.values import Value, alternatives, constant, demoted, literal, parameter, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_PAIR: Final = ("first", "second")
_GET: Final = "std::get"
_DECLARED: Final = frozenset({"made", "given", "shared"})
"""Ways to hold an object that say nothing of its fields: it is as it was declared, here or elsewhere."""
_FOLLOWED: Final = _DECLARED | {"value"}
"""Ways to hold an object whose fields are what the functions at hand give them."""


class StructureFolder:
    """Evaluates fields by what the object is made from: `Row{"a", 1}` and `row.name`."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return the values of a field; empty when it is not known what the object is made from."""
        if self._is_reached_into(expr, env):
            return ()
        made = self._constructed(expr, env)
        if made:
            return made
        bound = self._part(expr, env)
        if bound is None:
            return self._left_out(expr, env)
        return demoted(self.folder.fold(bound.expr, bound.env.deeper(env.depth + 1)))

    def _left_out(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """A field that nothing is given to where its object is made: what C++ makes of a value that is left out."""
        parts = self._parts(expr.base, env) if env.func.file.language == "cpp" else None
        cls = self._class_at(expr.base, env) if parts is not None else None
        at = self._place(expr, env) if cls is not None and not cls.fact.bases else None
        field = cls.fields.get(expr.name) if cls is not None else None
        if parts is None or at is None or field is None or at < len(parts) or dict(_named(parts)):
            return ()
        if field.default is not None:
            return demoted(self.folder.fold(field.default, Env(env.func, depth=env.depth + 1, this=cls)))
        return _left_empty(field.type)

    def part_by_place(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """`std::get<1>(pair)`; None for other calls."""
        at = call.types[0] if call.path == _GET and len(call.args) == len(call.types) == 1 else ""
        tuple_ = call.args[0] if at.isdigit() else None
        parted = any(self.folder.flow.ways(Member(tuple_, name), env) for name in _PAIR) if tuple_ is not None else True
        parts = self._parts(tuple_, env) if tuple_ is not None and not parted else None
        if parts is None or int(at) >= len(parts):
            return None
        bound = parts[int(at)]
        return demoted(self.folder.fold(bound.expr, bound.env.deeper(env.depth + 1)))

    def _constructed(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """What the constructor that takes the arguments of an object best gives its member; empty without one."""
        bound = self._origin(expr.base, env)
        call = bound.expr if bound is not None else None
        if bound is None or not isinstance(call, Items | Call):
            return ()
        cls = self._class_made(call, expr.base, bound.env, env)
        if cls is None or not _makers(cls):
            return ()
        return self._by_best(expr.name, cls, _construction(cls, call, bound.env), bound.env)

    def _class_made(self, made: Items | Call, base: Expr, place: Env, env: Env) -> Cls | None:
        if isinstance(made, Items):
            return self.folder.objects.class_of(base, env) if made.items else None
        return self._class_called(made, place)

    def _by_best(self, name: str, cls: Cls, call: Invocation, env: Env) -> tuple[Value, ...]:
        scores = {maker: score(call, maker) for maker in _makers(cls)}
        best = max(scores.values())
        fitting = [maker for maker, points in scores.items() if points == best != NO]
        values = [
            value for maker in fitting for value in self._left(name, Instance(cls, bind(maker, call, env), {}, maker))
        ]
        return alternatives(values) if values else ()

    def _left(self, name: str, made: Instance) -> tuple[Value, ...]:
        place = Env(made.maker, this=made.cls, made=made) if made.maker is not None else None
        return self.folder.members.member_value(name, made.cls, place) if place is not None else ()

    def given(self, expr: Expr, env: Env) -> Value | None:
        """Return what is known of the fields of an object that may not be as its class declares it; None if it is."""
        if env.depth > MAX_DEPTH or not isinstance(expr, Name | Member):
            return None
        listed = self._listed(expr, env)
        if listed is not None:
            return self.given(listed.expr, listed.env.deeper(env.depth + 1)) or unknown(_name(expr))
        copied = self._copied(expr, env)
        if copied is not None:
            return self.given(copied.expr, copied.env.deeper(env.depth + 1))
        if self._is_changed(expr, env):
            return unknown(_name(expr))
        return self.given(expr.base, env) if isinstance(expr, Member) else self._passed(expr.id, env)

    def handed_on(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return a field of an object that is handed on, or copied: what it was there; empty of others."""
        if self.is_kept(expr.base, env):
            return self._of_kept(expr, env)
        handed = self.handed(expr, env)
        values = self.folder.fold(handed.expr, handed.env.deeper(env.depth + 1)) if handed is not None else ()
        return demoted(values) if any(value.confidence != "pattern" for value in values) else ()

    def is_kept(self, expr: Expr, env: Env) -> bool:
        """Tell whether Python has an object in a member since another function: it may have become another one."""
        return env.func.file.language == "python" and isinstance(expr, Member) and not self.folder.flow.ways(expr, env)

    def kept_in(self, expr: Member, env: Env) -> Cls | None:
        """Return the class of the object that a member is, which another function was handed.

        None where its field is given something at several places: which was last depends on when it is asked for.
        """
        handed = self._first_handed(expr.base, env)
        cls = self.folder.objects.class_of(handed.expr, handed.env) if handed is not None else None
        if cls is None or self.folder.members.is_given(expr.name, cls):
            return None
        given = [self.folder.scope.members(expr.name, each) for each in self.folder.program.ancestry(cls)]
        return cls if sum(map(len, given)) <= 1 else None

    def _first_handed(self, expr: Expr, env: Env) -> Bound | None:
        """The object that is handed from one function to the next, as the first one has it."""
        found: Bound | None = None
        for _ in range(MAX_DEPTH):
            further = self._copied(expr, env)
            if further is None:
                break
            found, expr, env = further, further.expr, further.env
        return found

    def _of_kept(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """What all methods of its class leave a field with."""
        cls = self.kept_in(expr, env)
        place = Env(env.func, env.at, this=cls, depth=env.depth + 1)
        return self.folder.members.member_value(expr.name, cls, place) if cls is not None else ()

    def handed(self, expr: Member, env: Env) -> Bound | None:
        """Return the field of the object that is handed on, or copied, and that nobody may have changed since."""
        copied = self._copied(expr.base, env)
        if copied is None or self._is_touched(copied.expr, copied.env) or self._is_reached_into(expr, env):
            return None
        return Bound(Member(copied.expr, expr.name), copied.env)

    def _is_touched(self, expr: Expr, env: Env) -> bool:
        """Tell whether somebody whose body is not seen, or who is not followed, may have changed an object."""
        if not isinstance(expr, Name | Member):
            return False
        touched = any(held.how not in _FOLLOWED for held in self._helds(expr, env))
        return touched or (isinstance(expr, Member) and self._is_touched(expr.base, env))

    def _is_reached_into(self, expr: Member, env: Env) -> bool:
        """Tell whether a member of the object at hand may be changed by those who have the object."""
        path = self.folder.flow.effects(env.func).key(expr)
        return path.startswith(".") and path.count(".") > 1 and self.folder.given_fields.is_reached_into(path)

    def _copied(self, expr: Expr, env: Env) -> Bound | None:
        """Return the other object of which one is a copy, or a part of one, or for which it stands as a parameter."""
        made = self._made(expr, env) if env.depth < MAX_DEPTH else None
        if made is not None:
            return made if isinstance(made.expr, Name | Member) else None
        whole = self._copied(expr.base, env) if isinstance(expr, Member) else None
        return (
            Bound(Member(whole.expr, expr.name), whole.env) if whole is not None and isinstance(expr, Member) else None
        )

    def _listed(self, expr: Name | Member, env: Env) -> Bound | None:
        """Return the list that an object is one of, of which not all is known."""
        helds = {held for way in self.folder.flow.ways(expr, env) for held in way}
        held = helds.pop() if len(helds) == 1 else None
        if held is None or held.how != "each" or held.env is None or not isinstance(held.expr, Name | Member):
            return None
        return Bound(held.expr, held.env)

    def _is_changed(self, expr: Name | Member, env: Env) -> bool:
        """Tell whether an object was given a value that does not show what it is made from."""
        given = any(held.how not in _DECLARED for held in self._helds(expr, env))
        given = given or (isinstance(expr, Member) and self._part(expr, env) is not None)
        return given and self._parts(expr, env) is None

    def _passed(self, name: str, env: Env) -> Value | None:
        bound = self.folder.names.argument(name, env)
        if bound is not None:
            return self.given(bound.expr, bound.env.deeper(env.depth + 1))
        is_param = any(entry.name == name for entry in env.func.fact.params)
        return parameter(name, env.func.is_constructor) if is_param else None

    def _part(self, expr: Member, env: Env) -> Bound | None:
        parts = self._parts(expr.base, env)
        named = dict(_named(parts or ()))
        if expr.name in named:
            return named[expr.name]
        at = self._place(expr, env) if parts is not None else None
        return parts[at] if parts is not None and at is not None and at < len(parts) else None

    def _place(self, expr: Member, env: Env) -> int | None:
        """Return the place of a field among the values that its object is made from; an entry of a map is a pair."""
        cls = self._class_at(expr.base, env)
        names = [field.name for field in cls.fact.fields] if cls is not None else []
        if expr.name in names:
            return names.index(expr.name)
        return _PAIR.index(expr.name) if env.func.file.language == "cpp" and expr.name in _PAIR else None

    def _class_at(self, expr: Expr, env: Env) -> Cls | None:
        """The class of an object: that which is called to make it, else its declared one."""
        bound = self._origin(expr, env)
        made = self._class_called(bound.expr, bound.env) if bound is not None else None
        return made or self.folder.objects.class_of(expr, env)

    def _class_called(self, made: Expr, env: Env) -> Cls | None:
        written = pointed(made) or (dotted_name(made.callee) if isinstance(made, Call) else "")
        return self.folder.objects.class_written(written, env) if written else None

    def _parts(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the values that an object is made from, in order."""
        bound = self._origin(expr, env)
        made = bound.expr if bound is not None else None
        if bound is None or not isinstance(made, Items | Call):
            return None
        if isinstance(made, Items):
            return [Bound(item, bound.env) for item in made.items]
        if makes_tuple(made) and made.args:
            return [Bound(item, bound.env) for item in made.args]
        cls = self._class_called(made, bound.env)
        if cls is None or any(method.is_constructor for method in cls.methods):
            return None
        named = [Op(".=", (Name(key), value)) for key, value in made.keywords]
        return [Bound(item, bound.env) for item in (*_given(made), *named)]

    def _origin(self, expr: Expr, env: Env) -> Bound | None:
        """Return the expression that makes an object, through the variables that it is handed on by."""
        bound = self._made(expr, env) if env.depth < MAX_DEPTH else None
        if bound is not None and isinstance(bound.expr, Name | Member):
            return self._origin(bound.expr, bound.env.deeper(env.depth + 1))
        return bound

    def _helds(self, expr: Name | Member, env: Env) -> set[Held]:
        """What a variable may hold: by the function at hand, else, of a member of its object, by all methods."""
        key = self.folder.flow.effects(env.func).key(expr)
        helds = {held for way in self.folder.flow.ways(expr, env) for held in way}
        cls = env.this or env.func.cls
        if helds or cls is None or not key.startswith(".") or key.count(".") > 1:
            return helds
        found = self.folder.members.sources(key.removeprefix("."), cls, env)
        return {held if held.env is not None else replace(held, env=place) for held, place in found}

    def _made(self, expr: Expr, env: Env) -> Bound | None:
        """Return what an object is made from: of a variable its value, of a parameter what is passed for it."""
        if not isinstance(expr, Name | Member):
            return None
        helds = self._helds(expr, env)
        if all(held.how == "given" for held in helds):
            return self._of_name(expr, env) if isinstance(expr, Name) else self._part(expr, env)
        held = helds.pop()
        if helds or held.how != "value" or held.env is None or held.expr is None:
            return None
        if pointed(held.expr) and not (isinstance(expr, Name) and is_only_reached_into(expr.id, held.env.func)):
            return None
        return Bound(held.expr, held.env)

    def _of_name(self, expr: Name, env: Env) -> Bound | None:
        """What is passed for a parameter, or what a variable of a namespace is declared with that nobody changes."""
        given = self.folder.names.argument(expr.id, env)
        if given is not None or not self.folder.outside.is_untouched(expr.id, env.func):
            return given
        found = self.folder.scope.constant(expr.id, env)
        value = found[0].value if found is not None else None
        return Bound(value, self.folder.names.at_file(found[1], env).deeper(env.depth + 1)) if found and value else None

    def listed(self, expr: Member, env: Env) -> Bound | None:
        """Return the list that a field of a variable of a namespace is which nobody changes; None of other objects."""
        cls = self.folder.objects.class_of(expr.base, env)
        root = expr.base.id if isinstance(expr.base, Name) else ""
        if cls is None or not root or not self.folder.outside.is_untouched(root, env.func):
            return None
        bound, found = self._origin(expr.base, env), self.folder.scope.constant(root, env)
        if bound is not None or found is not None:
            return self._part(expr, env)
        default = cls.fields[expr.name].default if expr.name in cls.fields and not _makers(cls) else None
        return Bound(default, Env(env.func, depth=env.depth + 1, this=cls)) if default is not None else None


def _construction(cls: Cls, made: Items | Call, env: Env) -> Invocation:
    """The call of a constructor: braces and parentheses say the same."""
    step = Step(env.func, env.at, Statement("do", cls.fact.line, None))
    call = construction(step, cls.fact.name, made.items if isinstance(made, Items) else _given(made), cls.fact.line)
    return call if isinstance(made, Items) else msgspec.structs.replace(call, keywords=made.keywords)


def _given(made: Call) -> tuple[Expr, ...]:
    """What the constructor gets of the arguments of a call that makes an object."""
    return given_to_pointed(last_name(dotted_name(made.callee)), made.args)


def _named(parts: Sequence[Bound]) -> Iterator[tuple[str, Bound]]:
    """Yield field -> value of those that say for which field they are: `Row{.name = "a"}`."""
    for part in parts:
        if isinstance(part.expr, Op) and part.expr.op == ".=" and isinstance(part.expr.operands[0], Name):
            yield part.expr.operands[0].id, Bound(part.expr.operands[1], part.env)


def _makers(cls: Cls) -> list[Func]:
    return [func for func in cls.methods if func.is_constructor and "deleted" not in func.fact.traits]


def _left_empty(written: str) -> tuple[Value, ...]:
    """What a field is that begins with nothing: an empty text, zero; nothing is told of other types."""
    kind, last = kind_of_type(written), plain(written).rsplit("::", 1)[-1]
    if not kind or "*" in written or "&" in written or "[" in written:
        return ()
    if kind == "text":
        return (literal("")._replace(confidence="folded"),)
    return demoted((constant(False if last == "bool" else as_number(0, last)),))


def _name(expr: Name | Member) -> str:
    return expr.id if isinstance(expr, Name) else expr.name
