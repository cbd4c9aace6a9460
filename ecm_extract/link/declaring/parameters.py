"""What is known of ROS parameters while values are folded: reads, out arguments, declared defaults."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from ecm_parsers.source.expr import THIS, Expr, Member, Name

from ecm_extract.infer.read_into import ReadInto
from ecm_extract.link.code.calls import Invocation, invocations
from ecm_extract.link.code.overloads import NO, score
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.declaring.forms import Form, FormTable
from ecm_extract.link.declaring.match import name_argument, positions
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.parameter_reads import MethodRead, ParameterRead
from ecm_extract.link.running.values import Value

Home = Cls | File | str
"""Who declares a parameter: a class, a file, or by its name a package, whose nodes may give it different defaults."""

READERS = frozenset({"get_parameter", "getParam", "get_param", "get_parameter_or", "getInput"})
"""Calls that read a parameter or a port without declaring it."""


class Parameters:
    """Implements `fold.ParameterReads`; declarations and wrappers are added as they are found."""

    def __init__(self, forms: FormTable) -> None:
        self.forms = forms
        self._names = {name for name, rows in forms.items() if any(form.row.value for form in rows)}
        self._written: dict[Func, dict[str, list[ReadInto]]] = {}
        self._by_class: dict[Cls, dict[str, list[MethodRead]]] = {}
        self._defaults: dict[tuple[Home, str], tuple[Expr, Env] | Value] = {}
        self._several: set[tuple[Home, str]] = set()
        self._declared: set[tuple[str, str]] = set()
        self._bare: dict[tuple[Home, str], set[File]] = defaultdict(set)
        self._instead: set[tuple[Home, str]] = set()
        self._wrappers: dict[str, list[tuple[Func, str, str]]] = defaultdict(list)

    def read(self, call: Invocation) -> ParameterRead | None:
        """Return what a call reads that gives the value of a parameter."""
        read = self._read(call)
        tells = read is not None and call.func.file.language == "cpp" and self._out(call) is not None
        if read is None or not tells:
            return read
        return read._replace(tells=True, node=call.receiver, plainly=call.last in READERS)

    def _read(self, call: Invocation) -> ParameterRead | None:
        form = self._form(call)
        if form is not None:
            name = name_argument(form, call)
            if name is not None and (form.match != "method" or call.receiver is not None or call.simple):
                return ParameterRead(name, next(positions(form.default, call), None), form.fallback)
        if call.last in READERS and call.args and not self._is_own(call):
            return ParameterRead(call.args[0], None)
        wrapped = self._wrapped(call)
        return ParameterRead(*wrapped) if wrapped is not None else None

    def _is_own(self, call: Invocation) -> bool:
        """Whether a call means a wrapper of its own class or file that is called like what it wraps."""
        wrappers = [func for func, _, _ in self._wrappers.get(call.last, ())]
        if call.receiver == THIS:
            return any(func.cls is not None and func.cls is call.func.cls for func in wrappers)
        return call.receiver is None and any(func.cls is None and func.file is call.func.file for func in wrappers)

    def _form(self, call: Invocation) -> Form | None:
        for form in self.forms.get(call.last, ()):
            declares = form.row.value and form.language == call.func.file.language and not form.items
            if declares and (form.match == "method" or call.path.endswith(form.callee)):
                return form
        return None

    def _wrapped(self, call: Invocation) -> tuple[Expr, Expr | None] | None:
        scored = [(score(call, func), func, name, default) for func, name, default in self._fitting(call)]
        best = max((entry for entry in scored if entry[0] != NO), key=lambda entry: entry[0], default=None)
        if best is None:
            return None
        _, func, name, default = best
        bound = bind(func, call, Env(call.func))
        return (bound[name].expr, bound[default].expr if default in bound else None) if name in bound else None

    def _fitting(self, call: Invocation) -> list[tuple[Func, str, str]]:
        """A method is called on an object or from its class, a function on nothing."""
        found = self._wrappers.get(call.last, ())
        return [entry for entry in found if entry[0].cls is not None or call.receiver is None]

    def knows(self, name: str) -> bool:
        """Tell whether a row of the tables is about calls of a name."""
        return name in self.forms

    def written(self, func: Func, target: str) -> Sequence[ReadInto]:
        """Return the calls of a function that write a parameter to a variable, or `.field` to that of an object."""
        return self.all_written(func).get(target, [])

    def all_written(self, func: Func) -> Mapping[str, Sequence[ReadInto]]:
        """Return the calls of a function that write a parameter, by what they write to."""
        known = self._written.get(func)
        if known is None:
            known = self._written[func] = self._index(func)
        return known

    def read_into(self, func: Func, name: Expr) -> list[str]:
        """Return the variables that a function reads a parameter into, by its name as written."""
        written = self.all_written(func).items()
        return [target for target, entries in written if any(entry.name == name for entry in entries)]

    def members(self, cls: Cls, target: str) -> Sequence[MethodRead]:
        """Return the calls of a class that write a parameter to a member."""
        known = self._by_class.get(cls)
        if known is None:
            known = self._by_class[cls] = defaultdict(list)
            for method in cls.methods:
                for name, entries in self.all_written(method).items():
                    known[name] += [MethodRead(method, entry) for entry in entries]
        return known.get(target, [])

    def _index(self, func: Func) -> dict[str, list[ReadInto]]:
        found: dict[str, list[ReadInto]] = defaultdict(list)
        for call in invocations(func, self._relevant()):
            read = self._out(call)
            if read is not None and _variable(read.out):
                found[_variable(read.out)].append(read)
        return found

    def _relevant(self) -> set[str]:
        return {*READERS, *self._names, *self._wrappers}

    def _out(self, call: Invocation) -> ReadInto | None:
        if call.last in READERS and len(call.args) >= 2:
            default = call.args[2] if len(call.args) > 2 else None
            return ReadInto(call.at, call.args[1], call.args[0], default)
        form = self._form(call)
        if form is None:
            return self._wrapped_out(call)
        out, default = (next(positions(where, call), None) for where in (form.out, form.default))
        # of `param("rate", 5)`, which returns what is read, the second argument is the default and not written to
        return None if out is None or out is default else ReadInto(call.at, out, call.args[0], default)

    def _wrapped_out(self, call: Invocation) -> ReadInto | None:
        """A helper that writes the parameter to a variable that it gets by reference."""
        found = self._wrapped(call)
        if found is None:
            return None
        for func, name, _ in self._fitting(call):
            for arg, parameter in zip(call.args, func.fact.params, strict=False):
                reference = parameter.type.endswith("&") and "const" not in parameter.type
                if reference and parameter.name != name and _variable(arg):
                    return ReadInto(call.at, arg, *found)
        return None

    def declare(self, name: str, home: Home, default: tuple[Expr, Env] | Value) -> None:
        """Remember the default of a parameter that a class, a file or a package declares."""
        known = self._defaults.setdefault((home, name), default)
        if _written(known) != _written(default):
            self._several.add((home, name))

    def give_instead(self, name: str, home: Home) -> None:
        """Remember that what a class or a file declares is given something else by who makes its node."""
        self._instead.add((home, name))

    def is_given_instead(self, name: str, owners: Sequence[Cls | File]) -> bool:
        """Tell whether a parameter has not the default that its call states."""
        return any((owner, name) in self._instead for owner in owners)

    def declare_name(self, name: str, package: str) -> None:
        """Remember a parameter, with or without a default."""
        self._declared.add((package, name))

    def declare_bare(self, name: str, homes: Sequence[Home], file: File) -> None:
        """Remember a parameter that homes declare with a type or with nothing: nobody else's default is its value."""
        for home in homes:
            self._bare[home, name].add(file)

    def is_declared(self, name: str, package: str) -> bool:
        """Tell whether a package declares a parameter, with a default or without."""
        return (package, name) in self._declared or (package, name) in self._defaults

    def default(self, name: str, package: str, owners: Sequence[Cls | File] = ()) -> tuple[Expr, Env] | Value | None:
        """Return the default that the first of `owners` declares, else the only one that is declared in the package."""
        for owner in owners:
            if (owner, name) in self._defaults:
                return self._defaults[owner, name]
            if (owner, name) in self._bare:
                return None
        return None if self._is_several(name, package) else self._defaults.get((package, name))

    def _is_several(self, name: str, package: str) -> bool:
        """Whether files of a package declare a parameter with different defaults, or one of them without any."""
        bare = self._bare.get((package, name), ())
        return (package, name) in self._several or any((file, name) not in self._defaults for file in bare)

    def forget(self) -> None:
        """Drop what was indexed, since more wrappers are known now."""
        self._written.clear()
        self._by_class.clear()

    def add_wrapper(self, func: Func, name: str, default: str) -> None:
        """Remember that a function reads the parameter named by its parameter `name`."""
        known = self._wrappers[func.fact.name]
        if all(entry[0] is not func for entry in known):
            known.append((func, name, default))


def _written(default: tuple[Expr, Env] | Value) -> Expr | Value:
    return default if isinstance(default, Value) else default[0]


def _variable(expr: Expr | None) -> str:
    """What a read writes to: a variable or member of `this` by its name, a field of another object as `.field`."""
    if isinstance(expr, Member):
        return expr.name if expr.base == THIS else f".{expr.name}"
    return expr.id if isinstance(expr, Name) else ""
