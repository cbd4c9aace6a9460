"""Names: locals, parameters, members and constants that an identifier can mean."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Constant as Null
from ecm_parsers.source.expr import Expr, Member, Name
from ecm_parsers.source.facts import Constant, Function

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name, invocations
from ecm_extract.link.code.member_paths import below_variable
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.folding.meant_names import spelled
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.module_variables import ModuleVariables
from ecm_extract.link.running.shared_variables import SharedVariables
from ecm_extract.link.running.values import (
    Enumerator,
    Value,
    alternatives,
    constant,
    demoted,
    literal,
    lowered,
    outside,
    parameter,
    unknown,
)
from ecm_extract.resolve.cpp_constants import Stated
from ecm_extract.shipped import shipped

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder
    from ecm_extract.link.folding.fold_tables import Entry

_OF_CLASSES: Final = "__init_subclass__"
"""Gets what the heads of classes say, which is not read."""


@cache
def outside_constants(table: str = "constants") -> Mapping[str, str | float]:
    """Return constants of public headers outside the tree by their own name, `python`: those of modules, in full."""
    return MappingProxyType(shipped("link/folding/outside_constants.toml")[table])


class NameFolder:
    """Folds identifiers."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.variables = ModuleVariables(folder)
        self.shared = SharedVariables(folder)
        self._scopes: dict[tuple[File, str], Func] = {}

    def name(self, expr: Name, env: Env) -> tuple[Value, ...]:
        """A variable, a parameter, a member of `this`, or a constant."""
        meant = spelled(expr.id, env, self.folder.objects)
        if meant != expr.id:
            return self.name(Name(meant), env) if meant else (parameter(expr.id, made=True),)
        return self.folder.once(expr.id, env, lambda: self._name(expr.id, env))

    def _name(self, name: str, env: Env) -> tuple[Value, ...]:
        ways = self.folder.flow.ways(Name(name), env)
        if ways:
            return self.folder.held.of(ways, env)
        key = self.folder.flow.effects(env.func).key(Name(name))
        first = self.folder.held.at_first(name, env) if key.startswith(".") and self.is_fresh(env) else ()
        return first or self.around(name, env) or self.unseen(Name(name), env)

    def unseen(self, expr: Name | Member, env: Env) -> tuple[Value, ...]:
        """A name that nothing of the tree tells: of its own variables what they hold, else a constant of a library."""
        last = expr.name if isinstance(expr, Member) else last_name(expr.id)
        return (unknown(last) if self._is_of_tree(expr, env) else outside(last),)

    def _is_of_tree(self, expr: Name | Member, env: Env) -> bool:
        """Whether a name leads to a variable of the function, the object, or the file."""
        root = below_variable(expr).root
        name = root.id if isinstance(root, Name) else ""
        cls = env.this or env.func.cls
        fields = (each.fields for each in self.folder.program.ancestry(cls)) if cls is not None else ()
        own = name in {"", *self.folder.flow.effects(env.func).own} or any(name in each for each in fields)
        stated = self.folder.program.constant_named(name, env.func.file, env.scope)
        return own or (stated is not None and not is_lacking(stated, name, env.func.file))

    def is_fresh(self, env: Env) -> bool:
        """Tell whether a place is one on which no function of the tree was called before, in every state of it."""
        if env.state is not None:
            return not env.state.called
        made = env.func.is_constructor and env.func.file.language == "cpp"
        begins = made or self.folder.first_methods.is_first(env.func)
        states = self.folder.flow.states(env) if begins else []
        return bool(states) and not any(state.called for state in states)

    def around(self, name: str, env: Env) -> tuple[Value, ...]:
        """Return what a name means that the function at hand does not give a value; empty when nothing shows it."""
        return self._given(name, env) or self._captured(name, env) or self._outside(name, env)

    def _captured(self, name: str, env: Env) -> tuple[Value, ...]:
        """A variable of the function around the one at hand: of who calls it there, else if it has one value."""
        place = self.captured_at(name, env)
        if place is None:
            return ()
        if place is not env.outer and not self.folder.flow.is_bound_once(place.func, name):
            return (unknown(name),)
        return self.folder.fold(Name(name), place.deeper(env.depth + 1))

    def captured_at(self, name: str, env: Env) -> Env | None:
        """Return the place in the nearest function around the one at hand that has a variable; None where none has."""
        outer = self.folder.nesting.enclosing(env.func)
        if outer is None or name in env.func.given:
            return None
        is_called = env.outer is not None and env.outer.func is outer
        place = env.outer if is_called else Env(outer, this=env.this, made=env.made, depth=env.depth)
        if place is None or name in self.folder.flow.effects(outer).own:
            return place
        return self.captured_at(name, place)

    def _given(self, name: str, env: Env) -> tuple[Value, ...]:
        """What a name is before the function assigns it: its parameter, or a member of the object."""
        if name in env.func.given:
            return self._parameter(name, env)
        cls = env.this or env.func.cls
        if cls is None or env.func.file.language != "cpp" or "::" in name:
            return ()
        if self.folder.flow.is_outside(name, env.func):
            return ()
        return self.folder.members.member_value(name, cls, env)

    def argument(self, name: str, env: Env) -> Bound | None:
        """Return what is passed for a parameter of the function at hand, where its caller or maker is known."""
        bound = env.args.get(name)
        if bound is not None or not env.func.is_constructor or env.made is None or env.func.cls is None:
            return bound
        instance = self.folder.objects.part(env.made, env.func.cls)
        return instance.args.get(name) if instance is not None else None

    def _parameter(self, name: str, env: Env) -> tuple[Value, ...]:
        bound = self.argument(name, env)
        if bound is not None:
            return demoted(self.folder.fold(bound.expr, bound.env.before(bound.env.at)))
        if env.func.fact.name == _OF_CLASSES:
            return (unknown(name),)
        default = next((entry.default for entry in env.func.fact.params if entry.name == name), None)
        if default is not None and (env.args or self._is_left_out(name, env)):
            return lowered(self.folder.fold(default, env.before(0)), "default")
        return (parameter(name, env.func.is_constructor, self._fallback(default, env)),)

    def _is_left_out(self, name: str, env: Env) -> bool:
        """Tell whether nobody hands a program its parameter: console scripts hand `main` nothing, its file may."""
        func = env.func
        if func.file.language != "python" or func.fact.name != "main" or func.cls is not None:
            return False
        names = [entry.name for entry in func.fact.params]
        calls = (call for each in self.folder.program.functions_in(func.file) for call in invocations(each, {"main"}))
        given = {key for call in calls for key in (*names[: len(call.args)], *(key for key, _ in call.keywords))}
        return name not in given and given <= set(names)

    def _fallback(self, default: Expr | None, env: Env) -> str | None:
        """The text of a parameter's default, when it is one."""
        value = self.folder.fold(default, Env(env.func, 0, depth=env.depth + 1))[0] if default is not None else None
        known = value is not None and value.confidence != "pattern" and value.text != "null"
        return value.text if value is not None and known else None

    def _outside(self, name: str, env: Env) -> tuple[Value, ...]:
        if env.func.file.language == "python":
            return self._of_module(name, env.func.file, env) or self.imported(name, env)
        found = self.folder.scope.constant(name, env)
        if found is not None:
            return self._of_namespace(name, found, env)
        known = self.folder.program.message_constant(name, env.func.file, env.scope)
        told = _read(outside_constants().get(last_name(name)) if known is None else known)
        return told or self._begun_empty(name, env)

    def _begun_empty(self, name: str, env: Env) -> tuple[Value, ...]:
        """A variable of a namespace that is declared without a value: what functions read into it."""
        stated = self.folder.objects.file_scope.meant(name, env.func)
        if stated is None or stated.constant.value is not None or "enum" in stated.constant.traits:
            return ()
        left = self.folder.guarded(("outside", stated.constant), name, lambda: self._left_outside(name, env))
        return alternatives(left) if left else ()

    def _of_namespace(self, name: str, found: tuple[Constant, File], env: Env) -> tuple[Value, ...]:
        """A constant, or a variable that functions may assign to."""
        constant, file = found
        if constant.value is None:
            return (Value((f"{constant.scope}::{constant.name}",), "literal", (), Enumerator(constant)),)
        values = demoted(self.folder.fold(constant.value, self.stated_at(constant, file, env)))
        if "default" in constant.traits:
            values = lowered(values, "default")
        if not self.may_change(name, constant, env):
            return values
        left = self.folder.guarded(("outside", constant), name, lambda: self._left_outside(name, env))
        first = [value for value in values if value.text and value.confidence != "pattern"]
        return alternatives((*first, *left)) if left else alternatives((*values, unknown(name)))

    def _left_outside(self, name: str, env: Env) -> tuple[Value, ...]:
        """What functions read parameters into a variable of a namespace; nothing where one does anything else."""
        found: list[Value] = []
        for func, key in self.folder.outside.changers(name, env.func).items():
            place = Env(func, depth=env.depth + 1)
            ways = self.folder.flow.left(self.folder.flow.run(place), key) if func is not env.func else ()
            values = self.folder.held.of([ways], place) if ways else ()
            if not values or any(value.confidence != "default" for value in values):
                return ()
            found += values
        return tuple(found)

    def stated_at(self, constant: Constant, file: File, env: Env) -> Env:
        """Return a place at which names mean what they mean in the value of a constant: in its namespace or class."""
        if file.language != "cpp":
            return Env(self.at_file(file, env).func, depth=env.depth + 1)
        place = (file, constant.scope)
        if place not in self._scopes:
            self._scopes[place] = Func(Function("", constant.scope, (), "", 0, 0), file)
        return Env(self._scopes[place], depth=env.depth + 1)

    def may_change(self, name: str, constant: Constant, env: Env) -> bool:
        """Tell whether a variable of a namespace may hold something else than what it is declared with."""
        outside = self.folder.outside
        changed = self.folder.objects.file_scope.is_changed(name, env) or bool(outside.changers(name, env.func))
        return changed and not _is_fixed(constant) and not outside.is_followed(name, env.func)

    def at_file(self, file: File, env: Env) -> Env:
        """Return a place at which the names of a file are known; the one at hand where the file has none."""
        func = next((f for f in self.folder.program.functions_in(file) if f.fact.name == "<module>"), None)
        return Env(func) if func is not None else env

    def at_class(self, owner: Cls, this: Cls, env: Env) -> Env:
        """Return a place at which names mean what they mean in the body of a class, of an object of one."""
        python = owner.file.language == "python"
        func = self.at_file(owner.file, env).func if python else env.func
        return Env(func, depth=env.depth + 1, this=this)

    def _of_module(self, name: str, file: File, env: Env) -> tuple[Value, ...]:
        """What the body of a Python module leaves a name with; functions may give it something else."""
        place = self.module_end(file, env)
        ways = self.folder.flow.ways(Name(name), place) if place is not None else []
        if place is None or not ways:
            return ()
        values = demoted(self.folder.held.of(ways, place))
        return self.variables.given(name, file, values)

    def module_end(self, file: File, env: Env) -> Env | None:
        """Return the end of the body of a Python module; None in that body itself."""
        module = next((f for f in self.folder.program.functions_in(file) if f.fact.name == "<module>"), None)
        return Env(module, depth=env.depth + 1) if module is not None and module is not env.func else None

    def module_items(self, name: str, env: Env) -> list[Bound] | None:
        """Return the elements of a list that the body of a module leaves a name with."""
        place, ways = self.left_by_module(name, env)
        return self.folder.held.items_of(ways, place) if place is not None and ways else None

    def module_entries(self, name: str, env: Env) -> list[Entry] | None:
        """Return the entries of a table that the body of a module leaves a name with."""
        place, ways = self.left_by_module(name, env)
        if place is None or len(set(ways)) != 1 or len(ways[0]) != 1:
            return None
        return self.folder.tables.held_entries(ways[0][0], place)

    def left_by_module(self, name: str, env: Env) -> tuple[Env | None, list[tuple[Held, ...]]]:
        """Return what the body of a module leaves a variable with, which a name means, and where that is seen."""
        file = env.func.file
        place = self.module_end(file, env)
        if place is not None and "." not in name and not self.variables.changers(name, file):
            ways = self.folder.flow.ways(Name(name), place)
            if ways:
                return place, ways
        return self._left_elsewhere(name, env)

    def _left_elsewhere(self, dotted: str, env: Env) -> tuple[Env | None, list[tuple[Held, ...]]]:
        """What another module leaves a variable with, or a class one of its own, if nobody changes it later."""
        found = self.folder.program.constant_named(dotted, env.func.file)
        value = found.constant.value if found is not None else None
        if found is None or value is None or self.shared.is_changed(found):
            return None, []
        name, scope = found.constant.name, found.constant.scope
        if scope:
            inner = Env(self.at_file(found.file, env).func, depth=env.depth + 1)
            return inner, [(Held("value", name, value, inner),)]
        place = self.module_end(found.file, env)
        if place is None or found.file is env.func.file or self.variables.changers(name, found.file):
            return None, []
        return place, self.folder.flow.ways(Name(name), place)

    def ways_of_class(self, expr: Name | Member, env: Env) -> list[tuple[Held, ...]]:
        """Return what a variable of a class of Python holds that is named by its class, where nobody changes it."""
        dotted = dotted_name(expr) if isinstance(expr, Member) and env.func.file.language == "python" else ""
        found = self.folder.program.constant_named(dotted, env.func.file) if dotted else None
        known = found is not None and found.constant.scope and not self.shared.is_changed(found)
        return self._left_elsewhere(dotted, env)[1] if known else []

    def is_changed(self, cls: Cls, name: str) -> bool:
        """Tell whether a variable that a class of Python has, not its objects, is changed by somebody."""
        if cls.file.language != "python":
            return False
        own = (each for each in cls.file.facts.constants if each.name == name and each.scope == cls.qualified)
        return any(self.shared.is_changed(Stated(cls.file, each)) for each in own)

    def imported(self, dotted: str, env: Env) -> tuple[Value, ...]:
        """A constant of another Python module, by its dotted name."""
        found = self.folder.program.constant_named(dotted, env.func.file)
        if found is None or found.constant.value is None:
            return self._of_outside(dotted, env.func.file) if found is None else ()
        if found.constant.scope:
            inner = Env(self.at_file(found.file, env).func, depth=env.depth + 1)
            values = demoted(self.folder.fold(found.constant.value, inner))
        else:
            values = self._of_module(found.constant.name, found.file, env)
        return alternatives((*values, unknown(found.constant.name))) if self.shared.is_changed(found) else values

    def _of_outside(self, dotted: str, file: File) -> tuple[Value, ...]:
        known = self.folder.program.message_constant(dotted, file)
        whole = self.folder.program.canonical(dotted, file)
        return _read(outside_constants("python").get(whole) if known is None else known)

    def of_message(self, owner: str, name: str, env: Env) -> tuple[Value, ...]:
        """Return a constant of a message by the type of one, as it is written; empty where it has none."""
        dot = "." if env.func.file.language == "python" else "::"
        return _read(self.folder.program.message_constant(f"{owner}{dot}{name}", env.func.file, env.scope))


def is_lacking(stated: Stated, name: str, file: File) -> bool:
    """Tell whether a variable of Python is what an import gives, and None where there is no such library."""
    is_null = stated.constant.value == Null("null") and stated.file is file
    return is_null and bool(file.imported.get(name))


def _read(known: str | float | None) -> tuple[Value, ...]:
    return () if known is None else demoted((literal(known) if isinstance(known, str) else constant(known),))


def _is_fixed(constant: Constant) -> bool:
    """Tell whether nobody can assign to a constant; a pointer to what is constant may be moved to something else."""
    own = "fixed" if constant.type.endswith("*") else "const"
    return any(trait in {"constexpr", "define", "enum", own} for trait in constant.traits)
