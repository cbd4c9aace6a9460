"""Objects of plain structures and pairs: the values that they are made from, and their fields."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op

from ecm_extract.infer.held import Held
from ecm_extract.infer.places import as_written
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.containers import PAIR, makes_tuple
from ecm_extract.link.code.member_paths import lies_deep
from ecm_extract.link.code.pointed import is_only_reached_into, pointed
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.asked_once import AskedOnce
from ecm_extract.link.folding.changed_objects import is_lost
from ecm_extract.link.folding.constructions import construction_of, given_of, left_empty, named_parts
from ecm_extract.link.folding.left_by_constructors import left_by_constructors
from ecm_extract.link.folding.replaced_fields import with_fields_in_place
from ecm_extract.link.folding.same_objects import by_variable, is_as_made, left_by_maker, place_now, variable_given
from ecm_extract.link.folding.subscripts import taken
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, Instance
from ecm_extract.link.running.makers import best_makers
from ecm_extract.link.running.values import Value, alternatives, demoted, parameter, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_STATEMENTS: Final = 1_000_000
"""Behind the last statement of a function."""
_DECLARED: Final = frozenset({"made", "given", "shared"})
"""Ways to hold an object that say nothing of its fields: it is as it was declared, here or elsewhere."""
_FOLLOWED: Final = _DECLARED | {"value"}
"""Ways to hold an object whose fields are what the functions at hand give them."""


class StructureFolder:
    """Evaluates fields by what the object is made from: `Row{"a", 1}` and `row.name`."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._asked = AskedOnce(folder)

    def field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return the values of a field; empty when it is not known what the object is made from."""
        if self._is_reached_into(expr, env) or is_lost(expr.base, env, self.folder):
            return ()
        whole = self._of_other(expr.base, env)
        if meant := by_variable(whole, expr, env, self.folder):
            return meant
        if whole is not None:
            values = self.handed_on(expr, env)
            if values or self._has_changed_fields(whole, expr.name):
                return values
        made = self._constructed(expr, env)
        if made:
            return made
        bound = self.part(expr, env)
        if bound is None:
            return self._left_out(expr, env)
        return demoted(self.folder.fold(bound.expr, bound.env.deeper(env.depth + 1)))

    def _left_out(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """A field that nothing is given to where its object is made: what C++ makes of a value that is left out."""
        parts = self.parts(expr.base, env) if env.func.file.language == "cpp" else None
        cls = self.class_at(expr.base, env) if parts is not None else None
        at = self._place(expr, env) if cls is not None and not cls.fact.bases else None
        field = cls.fields.get(expr.name) if cls is not None else None
        if parts is None or at is None or field is None or at < len(parts) or dict(named_parts(parts)):
            return ()
        if field.default is not None:
            return demoted(self.folder.fold(field.default, Env(env.func, depth=env.depth + 1, this=cls)))
        return left_empty(field.type)

    def _of_other(self, expr: Expr, env: Env) -> Bound | None:
        """The object that one is a copy of, or which was handed to the function; None where it is neither."""
        made = self.made(expr, env) if env.depth < MAX_DEPTH else None
        return made if made is not None and isinstance(made.expr, Name | Member) else None

    def _has_changed_fields(self, whole: Bound, name: str) -> bool:
        """Whether a field of an object is given something where that stands, be it by a pointer to it."""
        outline = self.folder.flow.outline(whole.env.func)
        root = outline.effects.root(whole.expr)
        given = self.folder.flow.ways(Member(whole.expr, name), whole.env)
        return bool(given) or not root or any(key.startswith(f"{root}.") for key in outline.changes)

    def _constructed(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """What the constructor that takes the arguments of an object best gives its member; empty without one."""
        places = self.constructed_at(expr.base, env)
        exact = is_as_made(expr.base, env, self.folder)
        values = [value for place in places for value in left_by_maker(expr.name, place, exact, self.folder)]
        return alternatives(values) if values else ()

    def constructed_at(self, expr: Expr, env: Env) -> list[Env]:
        """Return the constructors that may have made an object, with their arguments; none where that is unknown."""
        bound = self._origin(expr, env)
        call = bound.expr if bound is not None else None
        cls = self._class_made(call, expr, bound.env, env) if bound and isinstance(call, Items | Call) else None
        if bound is None or not isinstance(call, Items | Call) or cls is None:
            return []
        made = construction_of(cls, call, bound.env)
        makers = best_makers(cls, made, self.folder.program)
        given = ((maker, bind(maker, made, bound.env)) for maker in makers)
        return [Env(maker, this=cls, made=Instance(cls, args, {}, maker)) for maker, args in given]

    def _class_made(self, made: Items | Call, base: Expr, place: Env, env: Env) -> Cls | None:
        if isinstance(made, Items):
            return self.folder.objects.class_of(base, env) if made.items else None
        return self.class_called(made, place)

    def given(self, expr: Expr, env: Env) -> Value | None:
        """Return what is known of the fields of an object that may not be as its class declares it; None if it is."""
        if env.depth > MAX_DEPTH or not isinstance(expr, Name | Member):
            return None
        listed = self._listed(expr, env)
        if listed is not None:
            return self.given(listed.expr, listed.env.deeper(env.depth + 1)) or unknown(_name(expr))
        copied = self.copied(expr, env)
        if copied is not None:
            return self.given(copied.expr, copied.env.deeper(env.depth + 1))
        if self._is_changed(expr, env):
            return unknown(_name(expr))
        return self.given(expr.base, env) if isinstance(expr, Member) else self._passed(expr.id, env)

    def handed_on(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return a field of an object that is handed on, or copied: what it was there; empty of others."""
        if self.folder.kept.is_kept(expr.base, env):
            return self.folder.kept.value(expr, env)
        handed = self.handed(expr, env)
        values = self.folder.fold(handed.expr, handed.env.deeper(env.depth + 1)) if handed is not None else ()
        return demoted(values) if any(value.confidence != "pattern" for value in values) else ()

    def handed(self, expr: Member, env: Env) -> Bound | None:
        """Return the field of the object that is handed on, or copied, and that nobody may have changed since."""
        copied = self.copied(expr.base, env) if not lies_deep(expr) else None
        if copied is None or self.is_touched(copied.expr, copied.env) or self._is_reached_into(expr, env):
            return None
        place = place_now(copied, env, self.folder.flow)
        return Bound(Member(copied.expr, expr.name), place) if place is not None else None

    def is_touched(self, expr: Expr, env: Env) -> bool:
        """Tell whether somebody whose body is not seen, or who is not followed, may have changed an object."""
        if not isinstance(expr, Name | Member):
            return False
        touched = any(held.how not in _FOLLOWED for held in self._helds(expr, env))
        return touched or (isinstance(expr, Member) and self.is_touched(expr.base, env))

    def _is_reached_into(self, expr: Member, env: Env) -> bool:
        """Tell whether a member of the object at hand may be changed by those who have the object."""
        path = self.folder.flow.effects(env.func).key(expr)
        return path.startswith(".") and path.count(".") > 1 and self.folder.given_fields.is_reached_into(path)

    def copied(self, expr: Expr, env: Env) -> Bound | None:
        """Return the other object of which one is a copy, or a part of one, or for which it stands as a parameter."""
        made = self.made(expr, env) if env.depth < MAX_DEPTH else None
        if made is not None:
            return made if isinstance(made.expr, Name | Member) else None
        whole = self.copied(expr.base, env) if isinstance(expr, Member) else None
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
        given = given or (isinstance(expr, Member) and self.part(expr, env) is not None)
        return given and self.parts(expr, env) is None

    def _passed(self, name: str, env: Env) -> Value | None:
        bound = self.folder.names.argument(name, env)
        if bound is not None:
            return self.given(bound.expr, bound.env.deeper(env.depth + 1))
        is_param = any(entry.name == name for entry in env.func.fact.params)
        return parameter(name, env.func.is_constructor) if is_param else None

    def part(self, expr: Member, env: Env) -> Bound | None:
        """Return what a field is where its object is made; None where that gives it nothing."""
        parts = self.parts(expr.base, env)
        named = dict(named_parts(parts or ()))
        if expr.name in named:
            return named[expr.name]
        at = self._place(expr, env) if parts is not None else None
        return parts[at] if parts is not None and at is not None and at < len(parts) else None

    def _place(self, expr: Member, env: Env) -> int | None:
        """Return the place of a field among the values that its object is made from; an entry of a map is a pair."""
        cls = self.class_at(expr.base, env)
        names = cls.filled if cls is not None else []
        if expr.name in names:
            return names.index(expr.name)
        return PAIR.index(expr.name) if env.func.file.language == "cpp" and expr.name in PAIR else None

    def class_at(self, expr: Expr, env: Env) -> Cls | None:
        """Return the class of an object: that which is called to make it, else its declared one."""
        bound = self._origin(expr, env)
        made = self.class_called(bound.expr, bound.env) if bound is not None else None
        return made or self.folder.objects.class_of(expr, env)

    def class_called(self, made: Expr, env: Env) -> Cls | None:
        """Return the class of which a call makes an object; None of other expressions."""
        written = pointed(made) or (dotted_name(made.callee) if isinstance(made, Call) else "")
        return self.folder.objects.class_written(written, env) if written else None

    def parts(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the values that an object is made from, in order."""
        bound = self._origin(expr, env) or (Bound(expr, env) if isinstance(expr, Call) else None)
        bound = self.folder.returns.shown(bound) if bound is not None else None
        made = bound.expr if bound is not None else None
        if bound is None or not isinstance(made, Items | Call):
            return None
        if isinstance(made, Items):
            return [Bound(item, bound.env) for item in made.items]
        if makes_tuple(made) and made.args:
            return [Bound(item, bound.env) for item in made.args]
        cls = self.class_called(made, bound.env)
        is_filled = cls is not None and cls.file.language == "cpp"  # Python has a constructor for what it is given
        if cls is None or not is_filled or any(method.is_constructor for method in cls.methods):
            return None
        named = [Op(".=", (Name(key), value)) for key, value in made.keywords]
        return [Bound(item, bound.env) for item in (*given_of(made), *named)]

    def _origin(self, expr: Expr, env: Env) -> Bound | None:
        """Return the expression that makes an object, through the variables that it is handed on by."""
        return self._asked.answer(("origin", expr, env), lambda: self._followed(expr, env))

    def _followed(self, expr: Expr, env: Env) -> Bound | None:
        bound = self.made(expr, env) if env.depth < MAX_DEPTH else None
        if bound is not None and (isinstance(bound.expr, Name | Member) or taken(bound.expr) is not None):
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
        begun = None if any(place.func.is_constructor for _, place in found) else self._declared_with(key, cls, env)
        first = {begun} if begun is not None and (found or begun.how == "value") else set()
        return first | {held if held.env is not None else replace(held, env=place) for held, place in found}

    def _declared_with(self, key: str, cls: Cls, env: Env) -> Held | None:
        """What a member of C++ is declared with, until a method gives it something; None where that is nothing."""
        owner = self.folder.scope.declaring(key[1:], cls)
        if owner is None or (default := owner.fields[key[1:]].default) is None:
            return None
        place = self.folder.names.at_class(owner, cls, env)
        made = default if isinstance(default, Call | Items) else Items((default,))  # one literal stands without braces
        is_object = made is default or self.folder.objects.class_of(as_written(key), place) is not None
        return Held("value", key, made, place) if is_object else Held("given", key)

    def made(self, expr: Expr, env: Env) -> Bound | None:
        """Return what an object is made from: of a variable its value, of a parameter what is passed for it.

        Where a function gives it, it is the variable of that which it gives back.
        """
        if (found := self._made(expr, env)) is None:
            return None
        return self.folder.returns.given_back(self.folder.own_copies.copied(with_fields_in_place(found, self.folder)))

    def _made(self, expr: Expr, env: Env) -> Bound | None:
        if isinstance(expr, Call) and self.class_called(expr, env) is not None:
            return Bound(expr, env)
        if isinstance(expr, Call) and (given := variable_given(expr, env, self.folder)):
            return given
        if not isinstance(expr, Name | Member):
            return self.folder.own_copies.of_element(self.folder.tables.element(expr, env))
        helds = self._helds(expr, env)
        if all(held.how == "given" for held in helds):
            return self._of_name(expr, env) if isinstance(expr, Name) else self._of_whole(expr, env)
        held = helds.pop()
        if helds or held.how != "value" or held.env is None or held.expr is None:
            return None
        if isinstance(expr, Name) and not self._is_followed(expr.id, held.expr, held.env.func):
            return None
        return self.folder.own_copies.given(expr, Bound(held.expr, held.env), held.env.func)

    def _is_followed(self, name: str, made: Expr, func: Func) -> bool:
        """Whether it is seen who changes the object in a variable."""
        if self.folder.states.callers.is_changed_inside(name, func):
            return False
        return not pointed(made) or is_only_reached_into(name, func, lambda call: self._is_method(call, func))

    def _is_method(self, call: Call, func: Func) -> bool:
        callee = self.folder.flow.target(call, func, MAX_STATEMENTS)
        return callee is not None and callee.cls is not None

    def _of_whole(self, expr: Member, env: Env) -> Bound | None:
        """What a member is made from, of an object that is copied, is made in braces, or by a constructor."""
        if lies_deep(expr):
            return None
        return self._asked.answer(("whole", expr, env), lambda: self._of_made(expr, env))

    def _of_made(self, expr: Member, env: Env) -> Bound | None:
        whole = self.made(expr.base, env) if env.depth < MAX_DEPTH else None
        if whole is not None and isinstance(whole.expr, Name | Member):
            return Bound(Member(whole.expr, expr.name), whole.env)
        return self.part(expr, env) or (self._left_by_maker(expr, whole, env) if whole is not None else None)

    def _left_by_maker(self, expr: Member, whole: Bound, env: Env) -> Bound | None:
        """What the one constructor that can have made an object gives a member of it."""
        if not isinstance(whole.expr, Items | Call):
            return None
        cls = self._class_made(whole.expr, expr.base, whole.env, env)
        made = construction_of(cls, whole.expr, whole.env) if cls is not None else None
        makers = best_makers(cls, made, self.folder.program) if cls is not None and made is not None else []
        if cls is None or made is None or len(makers) != 1:
            return None
        args = bind(makers[0], made, whole.env)
        ways = left_by_constructors(expr.name, Instance(cls, args, {}, makers[0]), env, self.folder)
        held = ways[0] if len(ways) == 1 and ways[0].how == "value" else None
        return Bound(held.expr, held.env) if held is not None and held.expr is not None and held.env else None

    def _of_name(self, expr: Name, env: Env) -> Bound | None:
        """What is passed for a parameter, or what a variable of a namespace is declared with that nobody changes."""
        given = self.folder.names.argument(expr.id, env)
        if given is not None or not self.folder.outside.is_untouched(expr.id, env.func):
            return self.folder.own_copies.given(expr, given, env.func) if given is not None else None
        found = self.folder.scope.constant(expr.id, env)
        value = found[0].value if found is not None else None
        return Bound(value, self.folder.names.stated_at(*found, env)) if found and value else None

    def listed(self, expr: Member, env: Env) -> Bound | None:
        """Return the list that a field of a variable of a namespace is which nobody changes; None of other objects."""
        cls = self.folder.objects.class_of(expr.base, env)
        root = expr.base.id if isinstance(expr.base, Name) else ""
        if cls is None or not root or not self.folder.outside.is_untouched(root, env.func):
            return None
        bound, found = self._origin(expr.base, env), self.folder.scope.constant(root, env)
        if bound is not None or found is not None:
            return self.part(expr, env)
        default = cls.fields[expr.name].default if expr.name in cls.fields and not cls.constructors else None
        return Bound(default, Env(env.func, depth=env.depth + 1, this=cls)) if default is not None else None


def _name(expr: Name | Member) -> str:
    return expr.id if isinstance(expr, Name) else expr.name
