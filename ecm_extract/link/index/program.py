"""All source facts of a tree, indexed; names are looked up the way a compiler or interpreter does (`resolve`)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from ecm_parsers.source.facts import Constant, Function
from msgspec.structs import replace

from ecm_extract.link.code.spelling import plain, template_arguments
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.base_lines import merged_lines
from ecm_extract.link.index.class_alternatives import alternatives_joined
from ecm_extract.link.index.imported_variables import imported_variables
from ecm_extract.link.index.member_callables import settle_callables
from ecm_extract.link.index.member_lists import settle_members
from ecm_extract.resolve.cpp_constants import Stated
from ecm_extract.resolve.headers import Headers
from ecm_extract.resolve.layout import PackageLayout
from ecm_extract.resolve.messages import Messages
from ecm_extract.resolve.names import Names
from ecm_extract.resolve.python_path import PythonPath
from ecm_extract.resolve.sight import Sight

MAX_ALIASES = 4
"""Aliases of aliases that are followed."""
_Unit = TypeVar("_Unit", Cls, Func)
_Asked = tuple[str, str, str]
"""A name, with the package and the language of who asks for it."""
_Named = tuple[str, str, File]
"""A name, with the scope and the file in which it stands."""


class Program:
    """The index over all files. Built once, then only read.

    Args:
        files: all source files of the tree.
        sight: which packages see which.
        layouts: where packages have their headers and modules, by name.
    """

    def __init__(self, files: Sequence[File], sight: Sight, layouts: Mapping[str, PackageLayout]) -> None:
        self.files = tuple(sorted(files, key=lambda file: file.path))  # the order of reading says nothing
        self.sight = sight
        self.classes: Mapping[str, list[Cls]] = _group_classes(self.files)
        self.functions: dict[str, list[Func]] = defaultdict(list)
        self.constants: dict[str, list[tuple[File, Constant]]] = defaultdict(list)
        self._headers = Headers(self.files, sight, layouts)
        self._classes_by_file = _by_file(self.classes)
        self._functions_by_file: dict[File, list[Func]] = defaultdict(list)
        self._seen_functions: dict[_Asked, tuple[Func, ...]] = {}
        self._seen_classes: dict[_Asked, tuple[Cls, ...]] = {}
        self._resolved: dict[_Named, Cls | None] = {}
        self._free: dict[_Named, tuple[Func, ...]] = {}
        self._renamed: dict[_Named, str | None] = {}
        self._mro: dict[Cls, tuple[Cls, ...]] = {}
        self._derived: dict[Cls, list[Cls]] | None = None
        classes = (cls for group in self.classes.values() for cls in group)
        self._path = PythonPath(self.files, sight, layouts)
        self._names = Names(self.files, self._headers, self._path, classes, lambda cls: self.ancestry(cls)[1:])
        self.aliases = self._names.aliases
        self._messages = Messages(layouts, self.included)
        for file in self.files:
            self._index(file)
            self._names.add(file, self.classes_in(file), self.functions_in(file))
        for file in self.files:
            if file.language == "python":
                file.variables = imported_variables(file, self.functions_in(file), self.constant_named)
            settle_members(self.functions_in(file), self._aliased)
        settle_callables(self.every_function(), lambda cls: (*self.ancestry(cls), *self.derived(cls)))

    def _aliased(self, written: str, func: Func) -> str:
        """What an alias stands for in a function; what is none stays."""
        return self.alias(plain(written), func.file, func.scope) or written

    def _index(self, file: File) -> None:
        renamed: dict[str, str] = {}
        for written in file.facts.functions:
            owner = self._owner(written, file)
            if owner is not None and owner.qualified != written.scope:
                renamed[written.scope] = owner.qualified
            function = _in_scope(written, renamed) if renamed else written
            namesakes = self.functions[function.name]
            func = Func(function, file, owner, namesakes)
            namesakes.append(func)
            self._functions_by_file[file].append(func)
            if owner is not None:
                owner.methods.append(func)
                if "static" in function.traits or "classmethod" in function.decorators:
                    owner.statics.add(function.name)
        for constant in file.facts.constants:
            self.constants[constant.name].append((file, constant))
        file.imported = imported_names(file) if file.language == "python" else {}
        file.inner_classes = _inner_classes(file) if file.language == "python" else frozenset()

    def _owner(self, function: Function, file: File) -> Cls | None:
        if not function.scope or "lambda" in function.traits:  # `D::D` is a constructor, and names the class as well
            return None
        if file.language == "cpp":
            return self._names.owner(function.scope, file)
        return next((cls for cls in self.classes_in(file) if cls.qualified == function.scope), None)

    def seen_functions(self, name: str, file: File) -> tuple[Func, ...]:
        """Return the functions of a name that code in a file can mean: of its language, in packages that it sees."""
        key = (name, file.package, file.language)
        known = self._seen_functions.get(key)
        if known is None:
            known = self._seen_functions[key] = self._seen(self.functions.get(name, ()), file)
        return known

    def seen_classes(self, name: str, file: File) -> tuple[Cls, ...]:
        """Return the classes of a name that code in a file can mean: of its language, in packages that it sees."""
        key = (name, file.package, file.language)
        known = self._seen_classes.get(key)
        if known is None:
            known = self._seen_classes[key] = self._seen(self.classes.get(name, ()), file)
        return known

    def seen_constants(self, name: str, file: File) -> Iterator[tuple[File, Constant]]:
        """Yield the constants of a name that code in a file can mean, each with the file it stands in."""
        seen = self.sight.of(file.package)
        return (entry for entry in self.constants.get(name, ()) if entry[0].package in seen)

    def sees(self, file: File, other: File) -> bool:
        """Tell whether code in a file can mean what stands in another: the package of one sees that of the other."""
        return other.package in self.sight.of(file.package)

    def _seen(self, units: Iterable[_Unit], file: File) -> tuple[_Unit, ...]:
        seen = self.sight.of(file.package)
        return tuple([unit for unit in units if unit.file.language == file.language and unit.file.package in seen])

    def every_function(self) -> Iterator[Func]:
        """Yield the functions of all files."""
        return (func for group in self.functions.values() for func in group)

    def classes_in(self, file: File) -> Sequence[Cls]:
        """Return the classes of a file, in its order."""
        return self._classes_by_file.get(file, ())

    def functions_in(self, file: File) -> Sequence[Func]:
        """Return the functions of a file, in its order."""
        return self._functions_by_file.get(file, ())

    def included(self, file: File) -> Iterable[File]:
        """Return the headers of the tree that a C++ file sees, directly or through others."""
        return self._headers.of(file)

    def imported_files(self, file: File) -> frozenset[File]:
        """Return the files of the tree that a Python file imports itself."""
        if file.language != "python":
            return frozenset()
        return frozenset(self._path.imported(file)) - {file}

    def class_named(self, name: str, file: File, scope: str = "") -> Cls | None:
        """Return the class that a name means in a scope of a file; None where it is outside the tree or ambiguous.

        Args:
            name: possibly qualified, without template arguments; of Python also with imports put in.
            file: in which it stands.
            scope: in which it stands, the function included.
        """
        key = (name, scope, file)
        if key not in self._resolved:
            self._resolved[key] = None  # aliases may stand for each other
            found = self._names.classes(name, file, scope) if name else None
            self._resolved[key] = found if isinstance(found, Cls) else None
        return self._resolved[key]

    def functions_named(self, name: str, file: File, scope: str = "") -> tuple[Func, ...]:
        """Return the functions outside of classes that a name means in a scope of a file, all overloads."""
        key = (name, scope, file)
        if key not in self._free:
            self._free[key] = self._names.functions(name, file, scope)
        return self._free[key]

    def constant_named(self, name: str, file: File, scope: str = "") -> Stated | None:
        """Return the constant or global that a name means in a scope of a file; None where several are meant."""
        found = self._names.constants(name, file, scope)
        return found if isinstance(found, Stated) else None

    def alias(self, name: str, file: File, scope: str = "") -> str | None:
        """Return what the `using name = ...` or typedef stands for that a name means; None of other names."""
        key = (name, scope, file)
        if key not in self._renamed:
            self._renamed[key] = self._names.alias(name, file, scope)
        return self._renamed[key]

    def spelled_out(self, name: str, file: File) -> str:
        """Return a C++ name with what the alias in front of `::` stands for: `msgs::Grip` -> `arm_msgs::msg::Grip`."""
        return self._names.spelled_out(name, file)

    def outside(self, dotted: str, file: File) -> str:
        """Return what a dotted name that a Python file imports is called outside of the tree; empty of others."""
        return self._names.outside(dotted, file)

    def readings(self, name: str, file: File, scope: str = "") -> Iterable[str]:
        """Return the qualified names that a type or base, as written, can have where it stands: the tree may lack it.

        Of C++ one for each scope and namespace in which it is looked for, of Python the one that the imports give.
        """
        meant = self.canonical(name, file, scope)
        if file.language != "python":
            return self._names.readings(self.spelled_out(meant, file), file, scope)
        return dict.fromkeys((meant, self.outside(plain(name), file) or meant))

    def installed_module(self, dotted: str, package: str) -> File | None:
        """Return the file of a module that a package installs; None of one that its build does not show."""
        found = self._path.installed(dotted, package)
        return self._path.file(found) if found is not None else None

    def message_named(self, name: str, file: File, scope: str) -> str | None:
        """Return the whole name of a C++ `msg::Name` whose package is a namespace around it; None of other names."""
        return self._messages.find(name, file, scope)

    def message_starred(self, name: str, modules: Sequence[str]) -> str | None:
        """Return which of the modules of messages that a Python file takes whole brings a name; None of several."""
        return self._messages.starred(name, modules)

    def message_constant(self, name: str, file: File, scope: str = "") -> str | float | None:
        """Return the constant of a message of the tree that a name means where it stands; None of other names."""
        if file.language == "python":
            return self._messages.constant(self.canonical(name, file), file, scope)
        owner, _, last = name.rpartition("::")
        return self._messages.constant(f"{self._meant(owner, file, scope)}::{last}", file, scope) if owner else None

    def _meant(self, name: str, file: File, scope: str) -> str:
        """What the aliases in a C++ name stand for, those of the whole name or of its first part."""
        for _ in range(MAX_ALIASES):
            head, _, rest = name.partition("::")
            whole, front = self.alias(name, file, scope), self.alias(head, file, scope) if rest else None
            if whole is None and front is None:
                break
            name = plain(whole) if whole is not None else f"{plain(front or head)}::{rest}"
        return name

    def bases(self, cls: Cls) -> list[Cls]:
        """Return the direct base classes that stand in the tree."""
        found = (self.class_named(plain(base), cls.file, cls.fact.scope) for base in cls.fact.bases)
        return [base for base in found if base is not None and base is not cls]

    def ancestry(self, cls: Cls) -> tuple[Cls, ...]:
        """Return the class and its bases in the tree, nearest first, each once; of Python as that looks them up."""
        known = self._mro.get(cls)
        if known is None:
            self._mro[cls] = (cls,)  # of a class that derives from itself
            merged = merged_lines([self.ancestry(base) for base in self.bases(cls)]) if _is_python(cls) else None
            if merged is not None and cls not in merged:
                known = self._mro[cls] = (cls, *merged)
                return known
            ordered = [cls]
            for entry in ordered:
                ordered.extend(base for base in (*self.bases(entry), *self._given(entry)) if base not in ordered)
            known = self._mro[cls] = tuple(ordered)
        return known

    def _given(self, cls: Cls) -> Iterator[Cls]:
        """The bases that a class gives its own base, which derives from a parameter of its template."""
        for written in cls.fact.bases if cls.file.language == "cpp" else ():
            parent = self.class_named(plain(written), cls.file, cls.fact.scope) if "<" in written else None
            given = dict(zip(parent.fact.template, template_arguments(written), strict=False)) if parent else {}
            for base in parent.fact.bases if parent is not None and given else ():
                found = self.class_named(plain(given.get(base, "")), cls.file, cls.fact.scope)
                if found is not None and found is not cls:
                    yield found

    def derived(self, cls: Cls) -> Sequence[Cls]:
        """Return the classes of the tree that derive from a class, at any distance."""
        if self._derived is None:
            self._derived = defaultdict(list)
            for group in self.classes.values():
                for entry in group:
                    for base in self.ancestry(entry)[1:]:
                        self._derived[base].append(entry)
        return self._derived.get(cls, ())

    def related(self, cls: Cls) -> Sequence[Cls]:
        """Return the classes of which an object of a class, or of one that derives from it, may have methods."""
        objects = (cls, *self.derived(cls))
        return list(dict.fromkeys(each for entry in objects for each in self.ancestry(entry)))

    def base_names(self, cls: Cls) -> list[str]:
        """Return all base names of the ancestry as written, those outside the tree included."""
        return [
            self.canonical(base, entry.file, entry.fact.scope)
            for entry in self.ancestry(cls)
            for base in entry.fact.bases
        ]

    def canonical(self, name: str, file: File, scope: str = "") -> str:
        """Return a base or type name with imports and aliases resolved and template arguments dropped."""
        bare = plain(name)
        if file.language == "python":
            head, *rest = bare.split(".")
            return ".".join([file.imported.get(head, head), *rest])
        target = self.alias(bare, file, scope)
        return plain(target) if target else bare


def _is_python(cls: Cls) -> bool:
    return cls.file.language == "python"


def _group_classes(files: tuple[File, ...]) -> dict[str, list[Cls]]:
    grouped: dict[str, list[Cls]] = defaultdict(list)
    for file in files:
        for fact in alternatives_joined(file.facts.classes) if file.language == "cpp" else file.facts.classes:
            grouped[fact.name].append(Cls(fact, file, fields={entry.name: entry for entry in fact.fields}))
    return grouped


def _in_scope(function: Function, renamed: Mapping[str, str]) -> Function:
    """A function, with those inside it, in the scope of its class, where it writes another name of that."""
    for written, qualified in renamed.items():
        if function.scope == written or function.scope.startswith(f"{written}::"):
            return replace(function, scope=qualified + function.scope.removeprefix(written))
    return function


def _by_file(classes: Mapping[str, list[Cls]]) -> Mapping[File, list[Cls]]:
    found: dict[File, list[Cls]] = defaultdict(list)
    for group in classes.values():
        for cls in group:
            found[cls.file].append(cls)
    return found


def imported_names(file: File) -> dict[str, str]:
    """Return what each name that a Python file imports stands for; `import a.b` binds `a`."""
    found: dict[str, str] = {}
    for entry in file.facts.imports:
        if entry.alias or entry.name:
            found[entry.alias or entry.name] = _dotted(entry.module, entry.name)
        else:
            head = entry.module.split(".")[0]
            found[head] = head
    return found


def _inner_classes(file: File) -> frozenset[str]:
    """The classes of a file that stand in other classes of it, with those in front."""
    known = {f"{each.scope}::{each.name}" if each.scope else each.name for each in file.facts.classes}
    return frozenset(f"{each.scope}::{each.name}" for each in file.facts.classes if each.scope in known)


def _dotted(module: str, name: str) -> str:
    dot = "" if module.endswith(".") else "."
    return f"{module}{dot}{name}" if name and name != "*" and module else name or module
