"""Objects of Python in members that only the methods of the class have: what their fields are when a method begins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.infer.held import Held
from ecm_extract.infer.places import as_written
from ecm_extract.infer.reading_calls import leaves_arguments
from ecm_extract.infer.run import Run
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.running.base_calls import makes_base
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.shared_members import SharedMembers

if TYPE_CHECKING:
    from ecm_extract.infer.outline import Outline
    from ecm_extract.link.folding.fold import Folder


class KeptMembers:
    """Tells which members hold such objects; each class is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.shared = SharedMembers(folder)
        self._shown: dict[Cls, Set[str]] = {}
        self._outside: dict[tuple[str, Cls], bool] = {}
        self._named: dict[Func, Set[str]] = {}

    def is_followed(self, key: str, env: Env) -> bool:
        """Tell whether a field of a member may change, and all that change it are methods of the object at hand."""
        cls = self.folder.nesting.object_of(env.func) if env.func.file.language == "python" else None
        if cls is None or not self._may_change(key, env):
            return False
        member = f".{key.split('.')[1]}"
        return member not in self._given_away(cls) and not self._is_named_outside(member[1:], cls)

    def is_had_by_others(self, expr: Member, env: Env) -> bool:
        """Tell whether somebody who is not seen may change a field of a member: others have its object, too."""
        if self._is_of_shown(expr, env):
            return True
        key = self.folder.flow.effects(env.func).key(expr)
        cls = self.folder.nesting.object_of(env.func) if env.func.file.language == "python" else None
        if cls is None or not key.startswith(".") or key.count(".") != 2 or not self._may_change(key, env):
            return False
        member = f".{key.split('.')[1]}"
        return member in self._given_away(cls) or self._is_named_outside(member[1:], cls)

    def _is_of_shown(self, expr: Member, env: Env) -> bool:
        """Tell whether others may change a field of an object: its methods give it away, or its class is remade."""
        if env.func.file.language != "python":
            return False
        cls = self.folder.objects.class_of(expr.base, env)
        lineage = self.folder.program.ancestry(cls) if cls is not None else ()
        if any("remade" in entry.fact.traits for entry in lineage):
            return True
        assigned = bool(lineage) and bool(self.folder.scope.assigned_outside(expr.name, "python"))
        return assigned and any(self._gives_itself(method) for entry in lineage for method in entry.methods)

    def _gives_itself(self, method: Func) -> bool:
        stored = any(entry.kind == "set" and entry.value == THIS for entry in method.fact.body)
        calls = (call for group in method.calls for call in group if not makes_base(call))
        return stored or any(arg == THIS for call in calls for arg in self._kept_by(call, method))

    def as_made(self, key: str, maker: Env, run: Run) -> Sequence[Held] | None:
        """Return what a field is behind the constructor that makes its object there; None of other objects."""
        left = self.folder.flow.left(run, f".{key.split('.')[1]}")
        fresh = len(left) == 1 and left[0].how == "value" and isinstance(left[0].expr, Call)
        whole = as_written(key.rpartition(".")[0])
        if not fresh or run.end is None or self.folder.objects.class_of(whole, maker) is None:
            return None
        end = maker.within(run.end, len(maker.func.fact.body))
        return (Held("value", key, as_written(key), end),)

    def _may_change(self, key: str, env: Env) -> bool:
        field = key.rpartition(".")[2]
        if self.folder.scope.assigned_outside(field, "python"):
            return True
        cls = self.folder.objects.class_of(as_written(key.rpartition(".")[0]), env)
        return cls is not None and self.folder.shifting.member(field, cls)

    def _is_named_outside(self, name: str, cls: Cls) -> bool:
        """Whether somebody who sees the class asks an object other than his own for a member of that name."""
        known = self._outside.get((name, cls))
        if known is None:
            program = self.folder.program
            seeing = (file for file in program.files if file.language == "python" and program.sees(file, cls.file))
            asked = (self._asked(func) for file in seeing for func in program.functions_in(file))
            known = self._outside[name, cls] = any(name in each for each in asked)
        return known

    def _asked(self, func: Func) -> Set[str]:
        """The names of the members that a function asks other objects than its own for."""
        known = self._named.get(func)
        if known is None:
            parts = (expr for statement in func.fact.body for expr, _ in expressions(statement))
            others = (expr for expr in parts if isinstance(expr, Member) and expr.base != THIS)
            known = self._named[func] = frozenset(expr.name for expr in others)
        return known

    # --- who has them ----------------------------------------------------------------------------------------

    def _given_away(self, cls: Cls) -> Set[str]:
        """The members whose objects methods of a class give to others, who may keep them."""
        if cls not in self._shown:
            self._shown[cls] = frozenset()  # who asks in a circle
            outlines, named = self.shared.named(cls)
            found = (each for outline in outlines for each in self._given(outline))
            self._shown[cls] = frozenset(
                key
                for outline, expr in found
                for key in self.shared.meant(expr, outline, named[outline.func])
                if key.startswith(".")
            )
        return self._shown[cls]

    def _given(self, outline: Outline) -> Iterator[tuple[Outline, Expr]]:
        """Yield what a method returns, puts into others than its own, or gives to functions that may keep it."""
        for statement in outline.func.fact.body:
            value = statement.value
            if value is None:
                continue
            gone = statement.kind == "return" or statement.type.startswith("yield")
            keys = outline.bound_keys(statement.target) if statement.kind == "set" else ()
            if gone or any(self._is_others(key, outline) for key in keys):
                yield outline, value
        for group in outline.func.calls:
            for call in group:
                yield from ((outline, arg) for arg in self._kept_by(call, outline.func))

    def _is_others(self, key: str, outline: Outline) -> bool:
        """Whether a variable, or a field, is none of the function and of its object."""
        root = key.partition(".")[0]
        return not key.startswith(".") and ("." in key or root not in outline.effects.own)

    def _kept_by(self, call: Call, func: Func) -> Iterator[Expr]:
        """Yield the arguments of a call that somebody may keep."""
        flow = self.folder.flow
        callee = flow.target(call, func, 0)
        path = call.callee.name if isinstance(call.callee, Member) else getattr(call.callee, "id", "")
        left = leaves_arguments(call.callee, func) or flow.keeps(path) or self._is_put_into_own(call, func)
        if callee is None and left:
            return
        own = isinstance(call.callee, Member) and call.callee.base == THIS
        params = callee.fact.params if callee is not None else ()
        for at, arg in enumerate(call.args):
            name = params[at].name if at < len(params) else ""
            if not own and (callee is None or not name or self._keeps(callee, name)):
                yield arg
        yield from (value for _, value in call.keywords if not own)

    def _is_put_into_own(self, call: Call, func: Func) -> bool:
        """Whether a call puts something into a list or table of the function, or of its object."""
        effects = self.folder.flow.effects(func)
        root = effects.root(call.callee.base) if isinstance(call.callee, Member) else ""
        own = root.startswith(".") or root.partition(".")[0] in effects.own - func.given
        return own and isinstance(call.callee, Member) and call.callee.name in effects.calls.changing

    def _keeps(self, func: Func, name: str) -> bool:
        """Whether a function may keep what it gets: it gives it to something, or does what its body does not show."""
        stored = any(entry.kind in {"set", "return"} and entry.value == Name(name) for entry in func.fact.body)
        return stored or self.folder.methods.parameters.is_hidden(func, name)
