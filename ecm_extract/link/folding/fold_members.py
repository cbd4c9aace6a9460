"""Members: what the methods of a class give its data members, and fields of other objects."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.infer.held import Held, all_ways
from ecm_extract.infer.run import Run
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.member_paths import below_variable
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.begun_fields import begun_field
from ecm_extract.link.folding.changed_objects import may_be_another
from ecm_extract.link.folding.chosen_objects import field_of_chosen
from ecm_extract.link.folding.formats import VALUE_READS, read_as
from ecm_extract.link.folding.handed_fields import handed_field
from ecm_extract.link.folding.path_parts import part_of_path
from ecm_extract.link.index.module_kinds import class_kind
from ecm_extract.link.running.env import Env, Instance
from ecm_extract.link.running.values import (
    Value,
    alternatives,
    circular,
    demoted,
    given_holes,
    is_circle,
    lowered,
    parameter,
    set_by,
    unknown,
    without_defaults,
)

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class MemberFolder:
    """Folds `object.member`."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Hashable, tuple[Value, ...]] = {}

    def forget(self) -> None:
        """Drop remembered members, since more of the parameters is known now."""
        self._known.clear()

    def member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """`this->x`, `params_.x`, `module.CONSTANT`, `object.field`."""
        values = self._member(expr, env)
        if expr.base == THIS and self.folder.properties.changed_by_reading(expr.name, env):
            return alternatives((*values, unknown(expr.name)))
        return values

    def _member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        reached = self.folder.flow.effects(env.func).reached(expr)
        expr = self.folder.class_names.by_object(reached if isinstance(reached, Member) else expr, env)
        expr = self.folder.properties.through(expr, env)
        ways = self.folder.flow.ways(expr, env)
        if ways:
            return self.folder.held.of(ways, env)
        read = self._run_by_reading(expr, env)
        if read:
            return read
        if expr.base == THIS:
            first = self.folder.held.at_first(expr.name, env) if self.folder.names.is_fresh(env) else ()
            if first:
                return first
            cls = env.this or env.func.cls
            return (self.member_value(expr.name, cls, env) if cls is not None else ()) or (unknown(expr.name),)
        if handed := handed_field(expr, env, self.folder) or part_of_path(expr, env, self.folder):
            return handed
        pointed = self.folder.searches.part(expr, env)
        if pointed is not None:
            return demoted(self.folder.lists.fold(pointed, env))
        if listed := self.folder.data_classes.of_field(expr, env):
            return listed
        part = self._of_object(expr, env) or begun_field(expr, env, self.folder)
        if not part and expr.name in VALUE_READS:
            return read_as(expr.name, self.folder.fold(expr.base, env.before(env.at)))
        dotted = dotted_name(expr)
        found = self.folder.names.imported(dotted, env) if dotted and env.func.file.language == "python" else ()
        known = found or part or self._field(expr, env) or self._option(expr, env)
        known = self.folder.member_fields.beside(known, expr, env, as_made=known is part)
        told = any(value.confidence != "pattern" for value in known)
        if told and may_be_another(expr, env, self.folder):
            return alternatives((*known, unknown(expr.name)))
        known = known or self.folder.module_objects.member(expr, env)
        return known or self._of_given(expr, env) or self._of_message(expr, env) or self.folder.names.unseen(expr, env)

    def _of_object(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """A field of an object of which it is known what, or which of several, it is made from."""
        return field_of_chosen(expr, env, self.folder) or self.folder.structures.field(expr, env)

    def _run_by_reading(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """What Python makes when an attribute is read, of the class or of the object."""
        found = self.folder.properties.value(expr, env) or self.folder.class_names.value(expr, env)
        return found or self.folder.enums.value(expr, env)

    def _of_message(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """`code.ARM`: a constant of the message that an object is."""
        written = self.folder.objects.type_of(expr.base, env)
        return self.folder.names.of_message(plain(pointee(written)), expr.name, env) if written else ()

    def _of_given(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """A part of what callers, or the makers of the object, pass, of which Python need not say the type."""
        own = is_own_member(expr.base)
        if env.func.file.language != "python" or not (own or isinstance(expr.base, Name)):
            return ()
        return next(filter(None, (_taken_of(value, expr.name) for value in self.folder.fold(expr.base, env))), ())

    def _option(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """`args.name` of argparse: the option's default."""
        if env.func.file.language != "python" or not isinstance(expr.base, Name):
            return ()
        default = self.folder.scope.option(expr.name, env.func.file)
        return lowered(self.folder.fold(default, env.before(env.at)), "default") if default is not None else ()

    def _field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        default = self._library_parameter(expr, env)
        if default is not None:
            return default
        written = self.folder.fields.value(expr, env)
        if written:
            return written
        handed = self.folder.structures.handed_on(expr, env)
        if handed:
            return handed
        cls = self.folder.objects.class_of(expr.base, env)
        if cls is None:
            return ()
        found = self.member_value(expr.name, cls, Env(env.func, env.at, depth=env.depth + 1, this=cls))
        values = tuple([without_defaults(value) for value in found])  # who made that object may have said otherwise
        asked = _is_plain(cls) or any(value.confidence == "pattern" for value in values)
        read = self.folder.given_fields.of_parameters(expr.name, cls, env) if asked else ()
        if read:
            return read
        given = self.folder.structures.given(expr.base, env) if asked else None
        if given is None or not values:
            return _taken_of(given, expr.name) if given is not None else values
        return (given,)

    def _library_parameter(self, expr: Member, env: Env) -> tuple[Value, ...] | None:
        """`params_.a.b` of generate_parameter_library: the default of parameter `a.b`."""
        (name, node), package = below_variable(expr), env.func.file.package
        if not self.folder.reads.is_declared(name, package) or not self._holds_parameters(node, env):
            return None
        known = self.folder.reads.default(name, package)
        asked = ("parameter", package, name)  # a default may be the parameter itself: declare_parameter("a", params_.a)
        values = self.folder.guarded(asked, name, lambda: self.folder.parameters.default_value(name, known, None, env))
        return set_by(name, values)

    def _holds_parameters(self, node: Expr, env: Env) -> bool:
        """Tell whether a variable is the struct of a listener, which is generated: by its type, or what gave it."""
        root = node.id if isinstance(node, Name) else node.name if isinstance(node, Member) else ""
        if self.folder.objects.class_of(node, env) is not None:
            return False
        if plain(self.folder.scope.declared_type(root, env)).rpartition("::")[2] == "Params":
            return True
        given = (held.expr for held in self.folder.origins.of(node, env))
        called = (value.callee for value in given if isinstance(value, Call))
        return any(isinstance(callee, Member) and callee.name == "get_params" for callee in called)

    def member_value(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        """Return the values that the methods of a class and its bases give one of its data members."""
        anyone = env.made is None or env.made.cls is not cls or not (env.made.args or env.made.types)
        exact = env.made is not None and env.made.cls is cls and env.made.is_one
        asked = ("member", cls, name, None if anyone else env.made, exact, self.folder.scope.owner(name, cls, env))
        known = self._known.get(asked)
        if known is not None:
            return known
        if self._is_being_run(name, cls):
            self.folder.cycles += 1
            return (unknown(name),)
        marks = self.folder.marks
        place = Env(env.func, env.at, this=env.this, made=env.made)  # at no depth: the answer is for everybody
        values = self.folder.guarded(asked, name, lambda: self._member_value(name, cls, place), circular(name))
        if marks == self.folder.marks or not self.folder.is_asking:
            self._known[asked] = values
        return values

    def _is_being_run(self, name: str, cls: Cls) -> bool:
        """Whether a method that may change a member is run right now: what it leaves is not known before it ends."""
        running = self.folder.flow.running
        return bool(running) and any(
            method in running
            for entry in self.folder.program.ancestry(cls)
            for method in self.folder.scope.changing(name, entry)
        )

    def _member_value(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        values: list[Value] = []
        emptied: list[Value] = []
        sources = self.sources(name, cls, env)
        for held, place in sources:
            if place.func.file.language != "python" or not _is_as_given(held):
                given = self.folder.held.values(held, place)
                values += given
                emptied += [each for each in given if not each.text and not place.func.is_constructor]
        for entry in self.folder.program.ancestry(cls):
            for method, read in self.folder.reads.members(entry, name):
                if read.at not in self._reads_of(method, name):
                    place = self.beginning(method, cls, env).within(None, read.at)
                    values += self.folder.parameters.parameter_value(read.name, read.default, place)
        making = [place.func for held, place in sources if _makes(held)]
        if not any(func.is_constructor for func in making) or self._is_left_alone(cls, making, env):
            kept = not making or cls.file.language == "python"
            values += [each for each in self.initial(name, cls, env) if kept or _may_stay(each)]
        others = [value for value in values if not is_circle(value)]  # `x = x` gives it nothing new
        others = others or list(self.initial(name, cls, env))
        filled = [value for value in others or values if value.text or value in emptied]
        others_give = self.folder.python_fields.any_is_given(cls) or self._is_others(name, cls)
        others_give = others_give or (cls.file.language == "cpp" and self.is_given(name, cls))
        return alternatives([*(filled or others or values), *[unknown(name)] * others_give]) if values else ()

    def _is_left_alone(self, cls: Cls, making: Collection[Func], env: Env) -> bool:
        """Tell whether a constructor that can have made an object of C++ leaves a member as its default."""
        makers = (each for each in cls.constructors if "declaration" not in each.fact.traits)
        known = [each for each in makers if self.folder.objects.runs(each, env.made)]
        return cls.file.language == "cpp" and any(each not in making for each in known)

    def _is_others(self, name: str, cls: Cls) -> bool:
        """Tell whether a function that has the object of a node, or any of Python, changes its member meanwhile."""
        asked = cls.file.language == "python" or class_kind(cls, self.folder.program) is not None
        return asked and self.folder.changed_outside.is_changed(name, cls)

    def _reads_of(self, method: Func, name: str) -> Collection[int]:
        """The statements whose reads of parameters the run of a method has followed into the member."""
        found = self.folder.flow.reads(method)
        effects = self.folder.flow.effects(method)
        return [at for at, entries in found.items() if any(effects.key(entry.out) == f".{name}" for entry in entries)]

    def initial(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        """Return what a member holds before any method runs: its default; that of a derived class hides others."""
        lineage = self.folder.program.ancestry(cls)
        owner = next((each for each in lineage if name in each.fields and each.fields[name].default is not None), cls)
        default = owner.fields[name].default if name in owner.fields else None
        default = default or self._defined_outside(name, cls)
        if default is None:
            return ()
        values = demoted(self.folder.fold(default, self.folder.names.at_class(owner, cls, env)))
        if self.is_given(name, cls):
            return alternatives((*values, unknown(name)))
        hidden = self.folder.redefined.is_hidden(name, cls, env)
        return alternatives((*values, parameter(name, made=True))) if hidden else values

    def is_given(self, name: str, cls: Cls) -> bool:
        """Tell whether others than the methods of a class give a member of some object of it something."""
        if cls.file.language == "python":
            lineage = self.folder.program.ancestry(cls)
            remade = any("remade" in each.fact.traits or self.folder.names.is_changed(each, name) for each in lineage)
            return remade or bool(self.folder.scope.assigned_outside(name, "python"))
        return self.folder.given_fields.is_given(name, cls)

    def _defined_outside(self, name: str, cls: Cls) -> Expr | None:
        """What a static member of C++ is defined with outside of its class: `double Sensor::limit = 0.5;`."""
        owners = (entry for entry in self.folder.program.ancestry(cls) if name in entry.fields)
        owner = next((entry for entry in owners if "static" in entry.fields[name].traits), None)
        if owner is None:
            return None
        found = self.folder.program.constant_named(f"{owner.qualified}::{name}", owner.file)
        return found.constant.value if found is not None else None

    def sources(self, name: str, cls: Cls, env: Env) -> list[tuple[Held, Env]]:
        """Return what the methods of a class and its bases leave a member with, or show it with to other functions.

        Of a class whose objects are not known to be of no derived one, what derived classes do counts too.
        """
        return [(held, place) for run, place in self.ends(name, cls, env) for held in self._left(run, name)]

    def sources_in_base(self, name: str, base: Cls, env: Env) -> list[tuple[Held, Env]]:
        """Return what the methods of a base leave a member with of the object at hand, whose constructor begins."""
        cls = env.func.cls
        made = env.made if env.made is not None or cls is None else Instance(cls, {}, {})
        part = self.folder.objects.part(made, base) if made is not None else None
        return self.sources(name, base, Env(env.func, env.at, this=env.this, made=part, depth=env.depth))

    def ends(self, name: str, cls: Cls, env: Env) -> Iterator[tuple[Run | None, Env]]:
        """Yield the run of each method that may change a data member, with its place; None for one that is run now."""
        concrete = env.made is not None and env.made.is_one
        derived = () if concrete else self.folder.program.derived(cls)
        scope = self.folder.scope
        owner = scope.owner(name, cls, env)
        for entry in (*self.folder.program.ancestry(cls), *derived):
            for method in scope.changing(name, entry) if scope.declaring(name, entry) is owner else ():
                if self.folder.objects.runs(method, env.made):
                    place = self.beginning(method, cls if entry not in derived else entry, env)
                    run = self.folder.flow.run(place, whole=method.is_constructor)
                    if run is not None or self.folder.flow.outline(method).may_change(f".{name}"):
                        yield run, place

    def _left(self, run: Run | None, name: str) -> list[Held]:
        """What a run leaves a data member with that it gives something."""
        if run is None:
            return [Held("lost", name)]
        helds = dict.fromkeys(self.folder.flow.shown(run, f".{name}"))
        return [held for held in helds if held.how not in {"given", "shared"}]

    def beginning(self, method: Func, cls: Cls, env: Env) -> Env:
        """Return the beginning of a method of the object at hand, which is of a class."""
        made = env.made if env.made is not None and env.made.cls is cls else None
        return Env(method, this=cls, made=made or Instance(cls, {}, {}), depth=env.depth + 1)


def _may_stay(value: Value) -> bool:
    """Tell whether what a member begins with is of use before a method gives it something: a text, a truth value."""
    return isinstance(value.data, bool) or (value.data is None and bool(value.text))


def _is_plain(cls: Cls) -> bool:
    """Tell whether whoever makes an object of a class can give its fields what he likes."""
    return cls.file.language == "cpp" and not any(method.is_constructor for method in cls.methods)


def _taken_of(value: Value, name: str) -> tuple[Value, ...]:
    """A field of what callers, or the makers of the object, know; nothing of other values."""
    holes = tuple([hole.of(name) for hole in given_holes(value)])
    return (Value(holes, "pattern"),) if holes else ()


def _is_as_given(held: Held) -> bool:
    """Tell whether a member of Python is the text that the function found: who was handed it cannot change it."""
    pending, seen = [held], {held}
    while pending:
        each = pending.pop()
        of_caller = each.how == "given" and not each.name.startswith(".")  # a parameter, which is news to the member
        if of_caller or each.how not in {"handed", "reached", "given", "shared"}:
            return False
        further = all_ways(each.before) if each.how in {"handed", "reached"} else ()
        pending += [way for way in further if way not in seen]
        seen.update(further)
    return True


def _makes(held: Held) -> bool:
    """Tell whether a value does not depend on what was there before, and is given before anybody else asks for it."""
    body = held.env.func.fact.body if held.env is not None else ()
    later = 0 <= held.at < len(body) and body[held.at].deferred
    return held.how in {"value", "each", "part"} and not later
