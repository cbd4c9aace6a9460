"""Arguments of C++ to which the object that gets them keeps a way, and by which its methods change them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.judge import Kept
from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.containers import parts_of_elements
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.spelling import by_value, last_name, plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


_KEEPING: Final = calls_of("cpp").changing
"""Methods that put what they get into what they are called on."""


class KeptReferences:
    """Finds them; each field of a class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._writing: dict[tuple[Cls, str], bool] = {}

    def of(self, call: Call, env: Env) -> Sequence[Kept]:
        """Return the arguments of a call that are kept so."""
        if isinstance(call.callee, Member) and call.callee.name in _KEEPING:
            return () if self._copies(call.callee.base, env) else [Kept(at, True) for at in range(len(call.args))]
        made = pointed(call) or (call.callee.id if isinstance(call.callee, Name) else "")
        cls = self.folder.objects.class_written(made, env) if made else None
        if cls is None:
            method = self.folder.flow.target(call, env.func, env.at) if isinstance(call.callee, Member) else None
            return self._by_function(method, call) if method is not None and method.cls is not None else ()
        maker = self.folder.objects.constructor(cls, invocation_of(call, env))
        if maker is not None:
            return self._by_function(maker, call)
        fields = enumerate(cls.fact.fields[: len(call.args)])
        return [Kept(at, self._changes(field.name, cls)) for at, field in fields if _refers(field.type)]

    def _copies(self, container: Expr, env: Env) -> bool:
        """Whether it is a text, or holds texts and numbers themselves, so that what is put into it stays alone."""
        written = self.folder.objects.type_of(container, env)
        parts = parts_of_elements(written)
        return all(map(_is_itself, parts)) if parts else _is_itself(written)

    def _by_function(self, func: Func, call: Call) -> Sequence[Kept]:
        given = func.fact.params[: len(call.args)]  # others have their defaults
        referring = [(at, entry.name) for at, entry in enumerate(given) if _refers(entry.type)]
        return [Kept(at, changes) for at, name in referring for changes in self._keeps(name, func)]

    def _keeps(self, name: str, func: Func) -> Iterator[bool]:
        """Yield for each member that keeps a parameter whether that is changed through it."""
        for statement in func.fact.body:
            if statement.kind in {"init", "set"} and _is_given(name, statement.value) and func.cls is not None:
                member = own_name(statement.target)
                if member in func.cls.fields and _refers(func.cls.fields[member].type):
                    yield self._changes(member, func.cls)
        calls = (call for group in func.calls for call in group)
        kept = (call for call in calls if isinstance(call.callee, Member) and call.callee.name in _KEEPING)
        yield from (True for call in kept if any(_is_given(name, arg) for arg in call.args))

    def _changes(self, name: str, cls: Cls) -> bool:
        return _leads_out(cls.fields[name].type) and self.is_written_through(name, cls)

    def is_written_through(self, name: str, cls: Cls) -> bool:
        """Tell whether a method changes what a member refers to or points to, or gives others a way to."""
        known = self._writing.get((cls, name))
        if known is None:
            self._writing[cls, name] = True  # who asks in a circle
            program = self.folder.program
            lineage = (*program.ancestry(cls), *program.derived(cls))
            methods = [method for entry in lineage for method in entry.methods]
            funcs = (func for method in methods for func in (method, *self.folder.nesting.inner(method)))
            known = self._writing[cls, name] = any(self._writes(name, func, cls) for func in funcs)
        return known

    def writes(self, name: str, func: Func, cls: Cls) -> bool:
        """Tell whether a function changes what a member that leads out of its object refers or points to."""
        return _leads_out(cls.fields[name].type) and self._writes(name, func, cls)

    def _writes(self, name: str, func: Func, cls: Cls) -> bool:
        if name not in self.folder.shifting.names(func):
            return False
        outline = self.folder.flow.outline(func)
        keys = (f".{name}", name)
        begun = sum(1 for entry in func.fact.body if entry.kind == "init" and entry.target == Name(name))
        changed = any(outline.changes.get(key, 0) > begun for key in keys)
        within = any(each.startswith((f".{name}.", f"{name}.")) for each in outline.changes)
        refers = any(_leads_out(entry.type) or entry.kind == "return" for entry in self._naming(func, keys))
        return changed or within or refers or any(self._may_change(call, name, cls, func) for call in _on(func, name))

    def _naming(self, func: Func, keys: tuple[str, ...]) -> Iterator[Statement]:
        """The statements that declare another name of a member, or return it as a reference."""
        effects = self.folder.flow.effects(func)
        given_out = "reference" in func.fact.traits
        kinds = {"let", "each", "return"} if given_out else {"let", "each"}
        for statement in func.fact.body:
            if statement.kind in kinds and effects.root(statement.value) in keys:
                yield statement

    def _may_change(self, call: Call, name: str, cls: Cls, func: Func) -> bool:
        """Whether a method that is called on what a member refers to is one of the tree that changes its object."""
        written = cls.fields[name].type if name in cls.fields else ""
        owner = self.folder.objects.class_written(written, Env(func, this=cls)) if written else None
        method = call.callee.name if isinstance(call.callee, Member) else ""
        known = [each for entry in self.folder.program.ancestry(owner) for each in entry.methods] if owner else []
        return any(not self.folder.methods.leaves(each, owner) for each in known if owner and each.fact.name == method)


def _refers(written: str) -> bool:
    """Whether what a type is of lies elsewhere: a reference or a pointer."""
    return written.endswith(("&", "*")) or pointee(written) != written.removeprefix("const ").strip()


def _is_itself(written: str) -> bool:
    """Whether an object of a type is a text or a number, and no view of one."""
    return by_value(written) and bool(kind_of_type(written)) and last_name(plain(written)) != "string_view"


def _leads_out(written: str) -> bool:
    """Whether what a type is of refers to something that can be changed by it."""
    return _refers(written) and "const" not in written.replace("<", " ").partition("*")[0].split()


def _is_given(name: str, value: Expr | None) -> bool:
    """Whether a member is given a parameter, or its address, and nothing else."""
    if isinstance(value, Call) and len(value.args) == 1:
        value = value.args[0]
    return value == Name(name) or (isinstance(value, Op) and is_address(value) and value.operands[0] == Name(name))


def _on(func: Func, name: str) -> Iterator[Call]:
    """Yield the calls of methods of what a member refers to."""
    own = (Name(name), Member(THIS, name))
    for call in (call for group in func.calls for call in group):
        if isinstance(call.callee, Member) and call.callee.base in own:
            yield call
