"""Objects: of which class they are, how they were made, and which function a call on them means."""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Text

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.containers import (
    ELEMENT_METHODS,
    PAIR,
    element_type,
    is_container,
)
from ecm_extract.link.code.overloads import best, fitting, is_countable, scored
from ecm_extract.link.code.own import is_own_member, is_super
from ecm_extract.link.code.pointed import pointed as pointed_class
from ecm_extract.link.code.spelling import by_value, is_pointer, last_name, plain, pointee, template_arguments
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.base_calls import base_call
from ecm_extract.link.running.class_lines import behind, nearest
from ecm_extract.link.running.early_binding import early_bound
from ecm_extract.link.running.env import MAX_DEPTH, Env, Instance, invocation_of
from ecm_extract.link.running.file_scope import FileScope
from ecm_extract.link.running.makers import makers_of
from ecm_extract.link.running.named_classes import class_asked, class_at_hand, class_cast_to, is_cast
from ecm_extract.link.running.nested_types import seen_from_outside
from ecm_extract.link.running.pair_types import type_in_pair
from ecm_extract.link.running.scope import Scope
from ecm_extract.shipped import shipped_names

_POINTER_SUFFIX = re.compile(r"(?:Const)?(?:Shared|Unique|Weak)?Ptr$")
HANDLES_OF_NODELETS: Final = frozenset(
    {"getNodeHandle", "getPrivateNodeHandle", "getMTNodeHandle", "getMTPrivateNodeHandle"}
)
"""Methods of nodelet::Nodelet (nodelet/nodelet.h) that give a handle."""
_ITSELF = frozenset({"lock", "get", "shared_from_this", "value", "release"})
_TYPED_CALLS = shipped_names("link/code/library_values.toml", "typed_calls")
_POINTER_CASTS = shipped_names("link/code/library_values.toml", "pointer_casts")
_BUILT_IN = frozenset({"bool", "float", "int", "str"})
"""Classes of Python for values of parameters."""


class Objects:
    """Looks up classes, constructors and methods of a program."""

    def __init__(self, program: Program, scope: Scope) -> None:
        self.program = program
        self.scope = scope
        self.file_scope = FileScope(program, scope)
        self._callees: dict[Hashable, Sequence[Func]] = {}
        self._classes: dict[tuple[str, Func, Cls | None], Cls | None] = {}

    # --- types -----------------------------------------------------------------------------------------

    def class_of(self, expr: Expr, env: Env) -> Cls | None:
        """Return the class in the tree that an object belongs to."""
        if expr == THIS:
            return env.this or env.func.cls
        return self.class_written(self.type_of(expr, env), env)

    def class_written(self, written: str, env: Env) -> Cls | None:
        """Return the class in the tree that a type as written means, through pointers and aliases of them."""
        asked = (written, env.func, env.this)
        if asked not in self._classes:
            self._classes[asked] = self._class_meant(written, env)
        return self._classes[asked]

    def _class_meant(self, written: str, env: Env) -> Cls | None:
        for _ in range(3):
            name = plain(pointee(written))
            found = self.program.class_named(name, env.func.file, env.scope) if name else None
            found = found or (self._of_inherited_member(name, env) if name else None)
            if found is not None or not name:
                return found
            alias = self.program.alias(name, env.func.file, env.scope)
            written = alias or _POINTER_SUFFIX.sub("", name)
            if written == name:
                return None
        return None

    def _of_inherited_member(self, name: str, env: Env) -> Cls | None:
        """The class of a member of a base, which names it where the base stands."""
        cls = env.this or env.func.cls
        bases = self.program.ancestry(cls)[1:] if cls is not None else ()
        naming = (base for base in bases if any(plain(pointee(each.type)) == name for each in base.fields.values()))
        found = (self.program.class_named(name, base.file, base.qualified) for base in naming)
        return next((each for each in found if each is not None), None)

    def is_value(self, written: str, env: Env) -> bool:
        """Tell whether a type as written, or what it stands for, is that of an object and of no pointer to one."""
        alias = self.program.alias(plain(written), env.func.file, env.scope) if written else ""
        return by_value(written) and by_value(alias or written)

    def type_of(self, expr: Expr, env: Env) -> str:
        """Return the type of an object as written, empty when the tree does not show it."""
        if env.depth > MAX_DEPTH:
            return ""
        if isinstance(expr, Name):
            known = self.scope.declared_type(expr.id, env) or self.assigned_type(expr.id, env)
            return known or self.file_scope.type_of(expr.id, env)
        if is_own_member(expr):
            cls = env.this or env.func.cls
            return self.scope.member_type(expr.name, cls) or self._member_assigned_type(expr.name, cls, env)
        if isinstance(expr, Member):
            part = type_in_pair(expr, env.before(env.at), self) if expr.name in PAIR else ""
            cls = self.class_of(expr.base, env.before(env.at)) if not part else None
            return part or seen_from_outside(self.scope.member_type(expr.name, cls), cls, self.program)
        if isinstance(expr, Call):
            return self._made_type(expr, env)
        if isinstance(expr, Op) and expr.op in {"&", "?:"}:
            return self.type_of(expr.operands[-1], env.before(env.at))
        if isinstance(expr, Op) and expr.op == "[]":
            return element_type(self.type_of(expr.operands[0], env.before(env.at)))
        return ""

    def assigned_type(self, name: str, env: Env, looped: Callable[[str], str] = element_type) -> str:
        """Return the type of what a variable is given; it needs no run, since it does not change on the way."""
        holder = self.scope.holding(name, env.func) or env.func
        around = env if holder is env.func else Env(holder, this=env.this, depth=env.depth + 1)
        body, places = holder.fact.body, self.scope.locals_of(holder).get(name, ())
        seen = self.scope.declaration(name, holder, around) or 0
        given = [at for at in places if seen <= at < around.at and body[at].value is not None]
        for at in reversed(given):
            value = body[at].value
            written = self.type_of(value, around.before(at)) if value is not None else ""
            return looped(written) if body[at].kind == "each" else written
        return self._member_assigned_type(name, env.this or env.func.cls, env)

    def _member_assigned_type(self, name: str, cls: Cls | None, env: Env) -> str:
        for entry in self.program.ancestry(cls) if cls is not None else ():
            for definition in self.scope.members(name, entry):
                value = definition.statement.value
                if value is not None:
                    return self.type_of(value, Env(definition.func, definition.at, this=cls, depth=env.depth + 1))
        return ""

    def _made_type(self, expr: Call, env: Env) -> str:
        """What the tree shows of a call, or the type that one of a library asks for: `node["a"].as<int>()`."""
        shown = self._shown_type(expr, env)
        if shown or not expr.types:
            return shown
        last = invocation_of(expr, env).last
        if last in _POINTER_CASTS:
            return f"std::shared_ptr<{expr.types[0]}>"
        return expr.types[0] if last in _TYPED_CALLS else ""

    def _shown_type(self, expr: Call, env: Env) -> str:
        if isinstance(expr.callee, Name):
            last = expr.callee.id.rsplit("::", 1)[-1]
            if pointed_class(expr):
                return pointed_class(expr)
            if expr.types and is_container(expr.callee.id):
                return f"{expr.callee.id}<{', '.join(expr.types)}>"
            if expr.types and is_pointer(last):
                return expr.types[0]
            if last in HANDLES_OF_NODELETS:
                return "ros::NodeHandle"
            if self._is_type(last, env.func.file):
                return expr.callee.id
            own = self._returned_by(env.this or env.func.cls, last) if last == expr.callee.id else ""
            return own or self._static_type(expr.callee.id, env) or self._returned(expr.callee.id, env.func.file)
        dotted = dotted_name(expr.callee)
        if dotted and env.func.file.language == "python":
            return dotted
        return self._method_type(expr.callee, env) if isinstance(expr.callee, Member) else ""

    def _method_type(self, callee: Member, env: Env) -> str:
        """The type that a method returns; `lock()` and the like give the object itself."""
        inner = env.before(env.at)
        if callee.name in _ITSELF:
            return self.type_of(callee.base, inner)
        if callee.name in ELEMENT_METHODS:
            return element_type(self.type_of(callee.base, inner))
        return self._returned_by(self.class_of(callee.base, inner), callee.name)

    def _static_type(self, path: str, env: Env) -> str:
        """The type that a method returns which is named with its class."""
        owner, _, name = path.rpartition("::")
        return self._returned_by(self.program.class_named(owner, env.func.file, env.scope), name) if owner else ""

    def _returned_by(self, cls: Cls | None, name: str) -> str:
        for owner in self.program.ancestry(cls) if cls is not None else ():
            for method in owner.methods:
                if method.fact.name == name and method.fact.returns and cls is not None:
                    return self.scope.base_types.within(method.fact.returns, owner, cls)
        return ""

    def _is_type(self, name: str, file: File) -> bool:
        built_in = name in _BUILT_IN and file.language == "python"
        unseen = (name[:1].isupper() or built_in) and not self.program.seen_functions(name, file)
        return bool(self.program.seen_classes(name, file)) or unseen

    def _returned(self, name: str, file: File) -> str:
        own = () if name.startswith("std::") else self.program.seen_functions(last_name(name), file)
        types = {func.fact.returns for func in own if func.fact.returns}
        return next(iter(types)) if len(types) == 1 else ""

    # --- instances -------------------------------------------------------------------------------------

    def part(self, made: Instance, base: Cls, depth: int = 0, whole: Instance | None = None) -> Instance | None:
        """Return how the `base` part of an object is made, following constructor initialisers; `whole` is all of it."""
        if made.cls is base:
            return made
        if depth > 8:
            return None
        whole = whole if whole is not None else made
        for written in made.cls.fact.bases:
            parent = self.program.class_named(plain(written), made.cls.file, made.cls.fact.scope)
            if parent is None or base not in self.program.ancestry(parent):
                continue
            return self.part(self._base_instance(made, parent, written, whole), base, depth + 1, whole)
        return None

    def class_types(self, env: Env) -> Mapping[str, str]:
        """Return what the object at hand has for the template parameters of the class whose method runs."""
        made, cls = env.made, env.func.cls
        if made is None or cls is None or made.cls is cls or not cls.fact.template:
            return made.types if made is not None else {}
        part = self.part(made, cls)
        return part.types if part is not None else made.types

    def held(self, expr: Expr | None, cls: Cls, env: Env) -> Instance:
        """Return the part of class `cls` of an object of which only the type is known, with its template arguments."""
        written = self.type_of(expr, env) if expr is not None else ""
        owner = self.class_written(written, env) if written else None
        if owner is None or cls not in self.program.ancestry(owner):
            return Instance(cls, {}, {})
        bare = pointee(written)
        full = bare if "<" in bare else self.program.alias(plain(bare), env.func.file, env.scope) or bare
        types = dict(zip(owner.fact.template, [env.types.get(x, x) for x in template_arguments(full)], strict=False))
        return self.part(Instance(owner, {}, types), cls) or Instance(cls, {}, {})

    def runs(self, func: Func, made: Instance | None) -> bool:
        """Tell whether a method can have run on an object: of several constructors only the one that made it."""
        if not func.is_constructor or made is None or func.cls is None:
            return True
        part = self.part(made, func.cls)
        return part is None or part.maker is None or part.maker is func

    def _base_instance(self, made: Instance, parent: Cls, written: str, whole: Instance) -> Instance:
        """Return how a derived class makes its direct base, with what methods of the whole object give."""
        types = dict(zip(parent.fact.template, template_arguments(written), strict=False))
        types = {key: made.types.get(value) or self._meant(value, made.cls) for key, value in types.items()}
        if made.maker is not None and made.maker.cls is not made.cls:
            return Instance(parent, made.args, types, made.maker)  # a constructor that is inherited
        makers = [method for method in made.cls.methods if method.is_constructor]
        if len(makers) != 1 and made.maker is not None:
            makers = [made.maker]
        calls = [call for call in (base_call(func, parent) for func in makers) if call is not None]
        constructor = self.constructor(parent, calls[0]) if len(calls) == 1 else None
        if constructor is None or constructor.is_implied:
            return Instance(parent, {}, types)
        env = Env(calls[0].func, args=made.args, this=whole.cls, made=whole)
        return Instance(parent, bind(constructor, calls[0], env.before(calls[0].at)), types, constructor)

    def delegated(self, made: Instance) -> Instance:
        """Return how an object is made by the constructor to which its own one leaves that."""
        seen: set[Func] = set()
        while made.maker is not None and made.maker not in seen:
            seen.add(made.maker)
            env = Env(made.maker, args=made.args, this=made.cls, made=made)
            call = base_call(made.maker, made.cls)
            target = self.constructor(made.cls, call) if call is not None else None
            if call is None or target is None or target is made.maker:
                break
            made = Instance(made.cls, bind(target, call, env.before(call.at)), made.types, target, made.exact)
        return made

    def may_run(self, func: Func, cls: Cls, call: Invocation) -> bool:
        """Tell whether a call that makes an object may run a function: of constructors those that it means."""
        if not func.is_constructor or func.cls is not cls or is_countable(call, func):
            return True
        maker = self.constructor(cls, call)
        return maker is not None and base_call(maker, cls) is not None  # it leaves the work to another one

    def _meant(self, written: str, cls: Cls) -> str:
        """What a template argument in the head of a class stands for where the class is."""
        return self.program.alias(written, cls.file, cls.fact.scope) or written

    def constructor(self, cls: Cls, call: Invocation) -> Func | None:
        """Return the constructor that takes the arguments of a call best; a class without any has that of its base."""
        makers = makers_of(cls, self.program)
        if len(makers) < 2:
            return makers[0] if makers else None
        count = len(call.args)
        fitting = best(call, scored(call, makers)) or [func for func in makers if len(func.params) >= count] or makers
        return min(fitting, key=lambda f: (abs(len(f.params) - count), "declaration" in f.fact.traits), default=None)

    # --- functions -------------------------------------------------------------------------------------

    def run_by(self, call: Call, env: Env) -> Func | None:
        """Return the function with a body that a call means, or the constructor of what it makes."""
        behind = pointed_class(call)
        function = self.callee(invocation_of(call, env), env) if not behind else None
        made = behind or (call.callee.id if isinstance(call.callee, Name) and env.func.file.language == "cpp" else "")
        cls = self.class_written(made, env) if made and function is None else None
        return self.constructor(cls, invocation_of(call, env)) if cls is not None else function

    def callee(self, call: Invocation, env: Env) -> Func | None:
        """Return the function in the tree that a call means, with a body; of several that it can mean one."""
        return next(iter(self.callees(call, env)), None)

    def callees(self, call: Invocation, env: Env) -> Sequence[Func]:
        """Return the functions in the tree that a call can mean, with a body, best first; each is looked up once."""
        if call.last not in self.program.functions:
            return ()
        place = (env.func, env.at, env.this, call.func)
        asked = (place, call.path, call.receiver, call.args, call.keywords, call.types)
        known = self._callees.get(asked)
        if known is None:
            known = self._callees[asked] = early_bound(call, env, self) or self._looked_up(call, env.deeper(0))
        return known

    def _looked_up(self, call: Invocation, env: Env) -> Sequence[Func]:
        own = env.func.cls or env.this
        if is_super(call.receiver) and own is not None:
            return self.methods_of_base(call, own, env.this or own)
        named = class_asked(call, self.program)
        if is_cast(call):
            return self.methods(call, named or class_cast_to(call, env, self.scope))
        if call.receiver is not None:
            return self.methods(call, named or self.class_of(call.receiver, env.before(env.at)))
        return self.methods(call, named or class_at_hand(call, env, self.program)) or self._free(call, env)

    def methods_of_base(self, call: Invocation, own: Cls, this: Cls) -> Sequence[Func]:
        """Return the methods that `super().name()` means, of the next class of the object, or `Base.name(self)`."""
        written = call.receiver.args[0] if isinstance(call.receiver, Call) and call.receiver.args else None
        if not isinstance(written, Text):
            return nearest(call, behind(own, this, self.program))
        named = self.program.class_named(plain(written.value), call.func.file, call.func.scope)
        found = self.methods(call, named)
        return [func for func in found if "static" not in func.fact.traits]  # that is given the object in its place

    def methods(self, call: Invocation, cls: Cls | None) -> Sequence[Func]:
        """Return the methods of an object's class, or else of its nearest base, that fit a call."""
        return nearest(call, self.program.ancestry(cls)) if cls is not None else ()

    def _free(self, call: Invocation, env: Env) -> Sequence[Func]:
        """The functions outside of classes, or methods named with their class, that a call can mean."""
        owner = self.program.class_named(call.path.rpartition("::")[0], call.func.file, env.scope)
        methods = self.program.ancestry(owner) if owner is not None else ()
        named = [func for cls in methods for func in cls.called if func.fact.name == call.last]
        return fitting(call, [*self.program.functions_named(call.path, call.func.file, env.scope), *named])
