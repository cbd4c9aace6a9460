"""Methods that a call may run in the place of the one found: those of derived classes, and what a class is given."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.own import is_own_member, is_super
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.class_lines import ahead, behind, nearest
from ecm_extract.link.running.early_binding import is_virtual
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.known_callers import Calling
from ecm_extract.link.running.values import Value, parameter, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_CALLERS: Final = 50
"""Functions through which a constructor is sought that calls a method."""


class Redefined:
    """Tells where another method may run than the one that the class at hand has."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._replaced: dict[tuple[Cls, str], bool] = {}
        self._making: dict[tuple[Func, Cls | None], bool] = {}
        self._below: dict[Cls, Set[str]] = {}

    def may_be(self, callee: Func, call: Invocation, env: Env) -> bool:
        """Tell whether a call on the object at hand may run something else than the method that was found."""
        return self.rest(callee, call, env) is not None

    def rest(self, callee: Func, call: Invocation, env: Env) -> Value | None:
        """Return what a call gives that runs another method than the one found: makers of the object may know that."""
        cls, name = env.this or env.func.cls, callee.fact.name
        if callee.cls is None or callee.is_constructor:
            return None
        own = cls is not None and call.receiver in {None, THIS}
        if self.is_replaced(callee) or (own and self._is_earlier(callee, env)):
            return unknown(name)
        if not own:
            others = self._is_between(callee, call, env) or self._is_of_derived(callee, call, env)
            return unknown(name) if others else None
        if cls is None or self._binds_early(callee, env):
            return None
        concrete = env.made is not None and env.made.is_one
        return parameter(name, made=True) if not concrete and name in self._names_below(cls) else None

    def _is_between(self, callee: Func, call: Invocation, env: Env) -> bool:
        """Whether `super()` may mean another class, of an object of a derived one that has several bases."""
        own, exact = env.func.cls, env.made is not None and env.made.is_one
        if own is None or exact or not is_super(call.receiver) or callee.file.language != "python":
            return False
        program = self.folder.program
        several = (each for each in program.derived(env.this or own) if len(each.fact.bases) > 1)
        return any(callee not in nearest(call, behind(own, each, program)) for each in several)

    def _is_of_derived(self, callee: Func, call: Invocation, env: Env) -> bool:
        """Whether another object, of which only the class is known, may be of a derived one with its own method."""
        receiver = call.receiver
        if receiver is None or is_super(receiver) or callee.cls is None or callee.fact.name in callee.cls.statics:
            return False
        cls = self.folder.objects.class_of(receiver, env)
        if cls is None or callee.fact.name not in self._names_below(cls):
            return False
        if env.func.file.language == "cpp":
            known = self._is_value(receiver, env) or self.of_pointed(receiver, env) is not None
            return is_virtual(callee, self.folder.program) and not known
        return not self._is_made_as(receiver, cls, env)

    def of_pointed(self, receiver: Expr | None, env: Env) -> Cls | None:
        """Return the class of the object that a pointer of C++ points to, where it is seen how that is made."""
        if receiver is None or env.func.file.language != "cpp" or self._is_value(receiver, env):
            return None
        made = self.folder.states.instance(receiver, env)
        return made.cls if made is not None else None

    def _is_value(self, receiver: Expr, env: Env) -> bool:
        return self.folder.objects.is_value(self.folder.objects.type_of(receiver, env), env)

    def _is_made_as(self, receiver: Expr, cls: Cls | None, env: Env) -> bool:
        """Whether an object of Python is made by a call of the class itself, as far as it is seen who makes it."""
        if self.folder.states.instance(receiver, env) is not None:
            return True
        if isinstance(receiver, Call):
            return self.folder.objects.class_written(dotted_name(receiver.callee), env) is cls
        own = env.this or env.func.cls
        found = [(held.expr, held.env) for way in self.folder.flow.ways(receiver, env) for held in way]
        if not found and is_own_member(receiver) and own is not None:
            found = [(held.expr, place) for held, place in self.folder.members.sources(receiver.name, own, env)]
        return bool(found) and all(
            isinstance(made, Call) and place is not None and self._is_made_as(made, cls, place) for made, place in found
        )

    def is_hidden(self, name: str, cls: Cls, env: Env) -> bool:
        """Tell whether a derived class of Python, of which the object at hand may be, has an attribute of its own."""
        exact = env.made is not None and env.made.is_one and env.made.cls is cls
        if cls.file.language != "python" or exact:
            return False
        return name in self._names_below(cls)

    def open_call(self, expr: Expr | None, env: Env) -> str:
        """Return the name of the method that an expression calls, or of the attribute, where another may be meant."""
        cls = env.this or env.func.cls
        if is_own_member(expr) and cls is not None and self.is_hidden(expr.name, cls, env):
            return expr.name
        read = self.folder.properties.read(expr, env) if isinstance(expr, Member) else expr
        call = invocation_of(read, env) if isinstance(read, Call) else None
        callee = self.folder.returns.meant(call, env) if call is not None else None
        return callee.fact.name if call is not None and callee is not None and self.may_be(callee, call, env) else ""

    def _names_below(self, cls: Cls) -> Set[str]:
        """The names that classes have something of their own by which derive from one, or are asked before it."""
        known = self._below.get(cls)
        if known is None:
            others = ahead(cls, self.folder.program)
            known = self._below[cls] = frozenset(name for entry in others for name in _own_names(entry))
        return known

    def _binds_early(self, callee: Func, env: Env) -> bool:
        """Whether a call of C++ has the method of the class that writes it: [class.virtual], [class.cdtor]."""
        if env.func.file.language != "cpp":
            return False
        return env.func.is_constructor or not is_virtual(callee, self.folder.program)

    def _is_earlier(self, callee: Func, env: Env) -> bool:
        """Whether a constructor of a base of C++, whose object is not yet of the derived class, may call a method."""
        lineage = self.folder.program.ancestry(callee.cls)[1:] if callee.cls is not None else ()
        static = env.func.cls
        if static not in lineage or env.func.file.language != "cpp" or self._binds_early(callee, env):
            return False
        known = self._making.get((env.func, callee.cls))
        if known is None:
            around = self._around(env.func)
            known = any(each.is_constructor and each.cls in lineage for each in around)
            self._making[env.func, callee.cls] = known
        return known

    def _around(self, func: Func) -> Iterator[Func]:
        """The functions that call one, directly or through others."""
        pending, seen = [func], {func}
        while pending and len(seen) < MAX_CALLERS:
            for call, _ in self._calls_of(pending.pop()):
                if call.func not in seen:
                    seen.add(call.func)
                    pending.append(call.func)
                    yield call.func

    def _calls_of(self, func: Func) -> Iterable[Calling]:
        find = self.folder.states.callers.find
        return find(func) if find is not None else ()

    def is_replaced(self, method: Func) -> bool:
        """Tell whether somebody gives a class of Python something else than a method: `Base.topic = other`."""
        cls, name = method.cls, method.fact.name
        if cls is None or cls.file.language != "python":
            return False
        known = self._replaced.get((cls, name))
        if known is None:
            known = self._replaced[cls, name] = self._is_given(name, cls)
        return known

    def _is_given(self, name: str, cls: Cls) -> bool:
        program = self.folder.program
        named = {each.fact.name for each in (*program.ancestry(cls), *program.derived(cls))} | {"cls", "__class__"}
        given = self.folder.scope.assigned_outside(name, "python")
        return any(
            program.sees(each.func.file, cls.file) and _names_class(each.statement.target, named) for each in given
        )


def _names_class(target: Expr | None, names: Collection[str]) -> bool:
    """Whether what is assigned is an attribute of a class, by its name, or of what a call gives: `type(self).x`."""
    base = target.base if isinstance(target, Member) else None
    named = base.id if isinstance(base, Name) else base.name if isinstance(base, Member) else ""
    return named in names or (isinstance(base, Call) and base.callee == Name("type"))


def _own_names(cls: Cls) -> Iterator[str]:
    """The names of what a class has of its own in the place of a method of its base: of Python attributes, too."""
    yield from (method.fact.name for method in cls.methods)
    yield from (name for name, field in cls.fields.items() if field.default is not None)
