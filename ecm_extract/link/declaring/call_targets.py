"""Which functions of the tree a call means, and which calls mean a function."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Container, Iterator, Mapping, Sequence

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.overloads import best, scored
from ecm_extract.link.code.own import is_super
from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.closures import around, handed_to, is_returned, uses, uses_handed
from ecm_extract.link.declaring.dispatching import Dispatching
from ecm_extract.link.running.env import Env


class CallTargets:
    """Matches calls and functions by name, arguments and receiver; each call and each name is asked about once.

    What a call can mean is sought in the packages that its own sees, and its receiver is looked up once for all
    functions of the name.

    Args:
        dispatching: tells which methods objects run.
        calls: all calls by the last part of what they name.
        place: gives the place of evaluation of a call.
    """

    def __init__(
        self,
        dispatching: Dispatching,
        calls: Mapping[str, Sequence[Invocation]],
        place: Callable[[Invocation], Env],
    ) -> None:
        self.folder = dispatching.folder
        self.calls = calls
        self.place = place
        self._targets: dict[Invocation, tuple[Func, ...]] = {}
        self._dispatching = dispatching
        self._receivers: dict[Invocation, Cls | Container[Cls]] = {}
        self._asked: set[tuple[str, str]] = set()
        self._callers_of: dict[Func, list[Invocation]] = defaultdict(list)
        self._own_of: dict[Func, list[Invocation]] = defaultdict(list)
        self._uses_of: dict[Func, tuple[Invocation, ...]] = {}

    def callers(self, func: Func) -> Sequence[Invocation]:
        """Return the calls of a function by others: those that mean it by name, arguments and receiver."""
        outer = around(func, self.folder)
        if outer is None:
            return self._by_name(func)
        return [*self._by_name(func), *self._uses(func, outer)]

    def own(self, func: Func) -> Sequence[Invocation]:
        """Return the calls of a function by itself, where others call it too."""
        return self._own_of.get(func, ()) if self._by_name(func) else ()

    def _uses(self, func: Func, outer: Func) -> Sequence[Invocation]:
        """The calls of what holds a function, found once: a function that is handed to itself calls itself again."""
        if func not in self._uses_of:
            makers = self.callers(outer) if is_returned(func, outer) else ()
            self._uses_of[func] = (*uses(func, outer, makers), *self._handed(func, outer))
        return self._uses_of[func]

    def _handed(self, func: Func, outer: Func) -> Iterator[Invocation]:
        """The calls of a function by those that the function around it hands it to."""
        for call, arg in handed_to(func, outer):
            for callee in self.targets(call):
                yield from uses_handed(call, arg, callee)

    def _by_name(self, func: Func) -> Sequence[Invocation]:
        asked = (func.fact.name, func.file.package)
        if asked not in self._asked:
            self._asked.add(asked)
            for call in self.calls.get(func.fact.name, ()):
                if self.folder.program.sees(call.func.file, func.file):
                    self._note(call)
        return self._callers_of.get(func, ())

    def _note(self, call: Invocation) -> None:
        """Remember a call with each function that it means, once."""
        if call not in self._targets:
            for target in self.targets(call):
                known = self._callers_of if target is not call.func else self._own_of
                known[target].append(call)

    def targets(self, call: Invocation) -> tuple[Func, ...]:
        """Return the functions of the tree that a call can mean, the best fitting overloads only."""
        known = self._targets.get(call)
        if known is None:
            seen = self.folder.program.seen_functions(call.last, call.func.file)
            visible = {func: fit for func, fit in scored(call, seen).items() if self._visible(call, func)}
            if call.simple and any(func.cls is not None for func in visible):
                visible = {func: fit for func, fit in visible.items() if func.cls is not None}  # members hide functions
            known = self._targets[call] = _own_first(call, best(call, visible))
        return known

    def _visible(self, call: Invocation, func: Func) -> bool:
        if "lambda" in func.fact.traits and func.file.language == "cpp":
            here = call.func.inner_scope
            return (
                call.func.file is func.file
                and call.receiver is None
                and func.fact.scope in {here, call.func.fact.scope}
            )
        if func.cls is not None:
            return self._method_means(call, func, func.cls)
        if call.receiver is not None:
            return False
        return func in self.folder.program.functions_named(call.path, call.func.file, call.func.scope)

    def _method_means(self, call: Invocation, func: Func, cls: Cls) -> bool:
        if "::" in call.path or (call.receiver is None and not call.simple):
            return cls in self._named_classes(call)
        if is_super(call.receiver) and call.func.cls is not None and not func.is_constructor:
            return func in self._of_bases(call, call.func.cls)
        known = self._receivers.get(call)
        if known is None:
            known = self._receivers[call] = self._classes(call)
        if not isinstance(known, Cls):
            return cls in known
        if func.file.language == "python" or func.is_constructor:
            has = cls in self.folder.program.ancestry(known)
            return (has and not self._is_hidden(func, cls, known)) or self._fills(func, cls, known)
        return self._dispatching.may_mean(call, func, known)

    def _is_hidden(self, func: Func, cls: Cls, known: Cls) -> bool:
        """Whether each object of a class of Python has another method of the name before one of its bases."""
        program = self.folder.program
        if func.is_constructor or func.file.language != "python":
            return False
        lines = (program.ancestry(each) for each in (known, *program.derived(known)))
        nearest = (next((each for each in line if _has(each, func.fact.name)), cls) for line in lines)
        return all(each is not cls for each in nearest)

    def _of_bases(self, call: Invocation, own: Cls) -> Iterator[Func]:
        """The methods that `super().name()` may mean, of objects of a class and of those that derive from it."""
        for this in (own, *self.folder.program.derived(own)):
            yield from self.folder.objects.methods_of_base(call, own, this)

    def _fills(self, func: Func, cls: Cls, base: Cls) -> bool:
        """Whether a method of Python is what a derived class has for an abstract one of a base, which never runs."""
        if func.is_constructor or base not in self.folder.program.ancestry(cls):
            return False
        lineage = self.folder.program.ancestry(base)
        named = (each for entry in lineage for each in entry.methods if each.fact.name == func.fact.name)
        nearest = next(named, None)
        return nearest is not None and "pure" in nearest.fact.traits

    def _named_classes(self, call: Invocation) -> Container[Cls]:
        """The class in front of the name of a method, with its bases."""
        program = self.folder.program
        owner = call.path.replace("::", ".").rpartition(".")[0].replace(".", "::")
        named = program.class_named(owner, call.func.file, call.func.scope)
        return program.ancestry(named) if named is not None else ()

    def _classes(self, call: Invocation) -> Cls | Container[Cls]:
        """The class of the object of a call; all for one of unknown type, none where the tree does not have it."""
        if call.receiver is None:
            return self.folder.nesting.object_of(call.func) or ()
        env = self.place(call)
        owner = self.folder.objects.class_of(call.receiver, env)
        if owner is not None:
            return owner
        written = plain(pointee(self.folder.objects.type_of(call.receiver, env)))
        return _Any() if not written or written == "auto" or written in _templates(call.func) else ()


def _has(cls: Cls, name: str) -> bool:
    return any(method.fact.name == name for method in cls.methods)


class _Any(Container[Cls]):
    """Every class: those of an object of which nothing is known."""

    def __contains__(self, _: object) -> bool:
        return True


def _own_first(call: Invocation, funcs: list[Func]) -> tuple[Func, ...]:
    """A function that the file defines is meant, and none of that name in another program of the package."""
    own = [func for func in funcs if func.file is call.func.file and "declaration" not in func.fact.traits]
    return tuple(own if call.simple and own and all(func.cls is None for func in own) else funcs)


def _templates(func: Func) -> set[str]:
    return {*func.fact.template, *(func.cls.fact.template if func.cls is not None else ())}
