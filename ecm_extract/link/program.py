"""All source facts of a tree, indexed so that names can be looked up the way a compiler would.

A name resolves to the nearest candidate: same file, included or imported file, same package, packages that it sees.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from ecm_parsers.source.facts import Constant, Function

from ecm_extract.link.aliases import Aliases, enclosing_scopes
from ecm_extract.link.class_alternatives import alternatives_joined
from ecm_extract.link.includes import Includes
from ecm_extract.link.sight import Sight
from ecm_extract.link.spelling import plain
from ecm_extract.link.units import Cls, File, Func

_Unit = TypeVar("_Unit", Cls, Func)
_Asked = tuple[str, str, str]
"""A name, with the package and the language of who asks for it."""


class Program:
    """The index over all files. Built once, then only read.

    Args:
        files: all source files of the tree.
        sight: which packages see which.
    """

    def __init__(self, files: Sequence[File], sight: Sight) -> None:
        self.files = tuple(files)
        self.sight = sight
        self.classes: Mapping[str, list[Cls]] = _group_classes(self.files)
        self.functions: dict[str, list[Func]] = defaultdict(list)
        self.constants: dict[str, list[tuple[File, Constant]]] = defaultdict(list)
        self.aliases = Aliases(self.nearness)
        self._resolved: dict[tuple[str, str, int], Cls | None] = {}
        self._headers = Includes(self.files, sight)
        self._classes_by_file = _by_file(self.classes)
        self._functions_by_file: dict[int, list[Func]] = defaultdict(list)
        self._seen_functions: dict[_Asked, tuple[Func, ...]] = {}
        self._seen_classes: dict[_Asked, tuple[Cls, ...]] = {}
        self._mro: dict[int, tuple[Cls, ...]] = {}
        self._derived: dict[int, list[Cls]] | None = None
        for file in self.files:
            self._index(file)

    def _index(self, file: File) -> None:
        for function in file.facts.functions:
            owner = self._owner(function, file)
            namesakes = self.functions[function.name]
            func = Func(function, file, owner, namesakes)
            namesakes.append(func)
            self._functions_by_file[id(file)].append(func)
            if owner is not None:
                owner.methods.append(func)
                if "static" in function.traits and file.language == "cpp":
                    owner.statics.add(function.name)
        for constant in file.facts.constants:
            self.constants[constant.name].append((file, constant))
        for alias in file.facts.aliases:
            self.aliases.add(file, alias)
        file.imported = imported_names(file) if file.language == "python" else {}

    def _owner(self, function: Function, file: File) -> Cls | None:
        """The class that a scope names; with `using` it is a part of its name, inside a namespace it may repeat it."""
        if not function.scope:
            return None
        last = function.scope.rsplit("::", 1)[-1]
        candidates = self.seen_classes(last, file)
        exact = [cls for cls in candidates if cls.qualified == function.scope]
        loose = [cls for cls in candidates if cls.qualified.endswith("::" + function.scope)]
        repeated = [cls for cls in candidates if function.scope.endswith("::" + cls.qualified)]
        return self._nearest(exact or loose or repeated, file)

    def _nearest(self, candidates: Sequence[Cls], file: File) -> Cls | None:
        if not candidates:
            return None
        return max(candidates, key=lambda cls: self.nearness(cls.file, file))

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

    def classes_in(self, file: File) -> Sequence[Cls]:
        """Return the classes of a file, in its order."""
        return self._classes_by_file.get(id(file), ())

    def functions_in(self, file: File) -> Sequence[Func]:
        """Return the functions of a file, in its order."""
        return self._functions_by_file.get(id(file), ())

    def nearness(self, other: File, file: File) -> int:
        """Return how close another file is: 3 itself, 2 included, 1 in the same package, 0 elsewhere."""
        if other is file:
            return 3
        if self.includes(file, other):
            return 2
        return 1 if other.package == file.package else 0

    def includes(self, file: File, other: File) -> bool:
        """Tell whether `file` includes or imports `other`, C++ headers also through other headers of the tree."""
        if file.language == "python":
            module = other.path.removesuffix(".py").replace("/", ".")
            return any(entry.module and module.endswith(entry.module.lstrip(".")) for entry in file.facts.imports)
        return id(other) in self._headers.of(file)

    def included(self, file: File) -> Iterable[File]:
        """Return the headers of the tree that a C++ file sees, directly or through others."""
        return self._headers.of(file).values()

    def class_named(self, name: str, file: File, scope: str = "") -> Cls | None:
        """Return the class that `name` (possibly qualified, without template arguments) means in a scope of a file."""
        key = (name, scope, id(file))
        if key not in self._resolved:
            self._resolved[key] = None  # aliases may stand for each other
            self._resolved[key] = self._find_class(name, file, scope)
        return self._resolved[key]

    def _find_class(self, name: str, file: File, scope: str) -> Cls | None:
        if file.language == "python":
            return self._find_python(name, file)
        last = name.rsplit("::", 1)[-1]
        candidates = self.seen_classes(last, file)
        for prefix in enclosing_scopes(scope):
            wanted = f"{prefix}::{name}" if prefix else name.removeprefix("::")
            exact = [cls for cls in candidates if cls.qualified == wanted]
            if exact:
                return self._nearest(exact, file)
        loose = [cls for cls in candidates if cls.qualified.endswith("::" + name) and self._visible(cls, file)]
        found = self._nearest(loose, file)
        return found or self._aliased(name, file, scope)

    def _visible(self, cls: Cls, file: File) -> bool:
        namespace = cls.fact.scope
        return any(namespace == using or namespace.endswith("::" + using) for using in file.facts.usings) or (
            cls.file.package == file.package
        )

    def _find_python(self, name: str, file: File) -> Cls | None:
        head, *rest = name.replace("::", ".").split(".")
        target = ".".join([file.imported.get(head, head), *rest])
        last = target.rsplit(".", 1)[-1]
        candidates = self.seen_classes(last, file)
        if head not in file.imported:
            return next((cls for cls in candidates if cls.file is file), None)
        module = target.rpartition(".")[0].lstrip(".")
        near = [cls for cls in candidates if module and module_matches(cls.file.path, module)]
        if near:
            return self._nearest(near, file)
        return next((cls for cls in candidates if cls.file.package == file.package and cls.file is not file), None)

    def _aliased(self, name: str, file: File, scope: str) -> Cls | None:
        found = self.aliases.find(name, file, scope)
        if found is None or plain(found[1].target) == name:
            return None
        other, alias = found
        target = plain(alias.target)
        return self.class_named(target, file, scope) or self.class_named(target, other, alias.scope)

    def alias(self, name: str, file: File, scope: str = "") -> str | None:
        """Return what `using name = ...` or a typedef stands for, nearest declaration first."""
        found = self.aliases.find(name, file, scope)
        return found[1].target if found is not None else None

    def bases(self, cls: Cls) -> list[Cls]:
        """Return the direct base classes that stand in the tree."""
        found = (self.class_named(plain(base), cls.file, cls.qualified) for base in cls.fact.bases)
        return [base for base in found if base is not None and base is not cls]

    def ancestry(self, cls: Cls) -> tuple[Cls, ...]:
        """Return the class and its bases in the tree, nearest first, each once."""
        known = self._mro.get(id(cls))
        if known is None:
            ordered = [cls]
            for entry in ordered:
                ordered.extend(base for base in self.bases(entry) if base not in ordered)
            known = self._mro[id(cls)] = tuple(ordered)
        return known

    def derived(self, cls: Cls) -> Sequence[Cls]:
        """Return the classes of the tree that derive from a class, at any distance."""
        if self._derived is None:
            self._derived = defaultdict(list)
            for group in self.classes.values():
                for entry in group:
                    for base in self.ancestry(entry)[1:]:
                        self._derived[id(base)].append(entry)
        return self._derived.get(id(cls), ())

    def base_names(self, cls: Cls) -> list[str]:
        """Return all base names of the ancestry as written, those outside the tree included."""
        return [
            self.canonical(base, entry.file, entry.qualified)
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


def _group_classes(files: tuple[File, ...]) -> dict[str, list[Cls]]:
    grouped: dict[str, list[Cls]] = defaultdict(list)
    for file in files:
        for fact in alternatives_joined(file.facts.classes) if file.language == "cpp" else file.facts.classes:
            grouped[fact.name].append(Cls(fact, file, fields={entry.name: entry for entry in fact.fields}))
    return grouped


def _by_file(classes: Mapping[str, list[Cls]]) -> Mapping[int, list[Cls]]:
    found: dict[int, list[Cls]] = defaultdict(list)
    for group in classes.values():
        for cls in group:
            found[id(cls.file)].append(cls)
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


def _dotted(module: str, name: str) -> str:
    return f"{module}.{name}" if name and name != "*" and module else name or module


def module_matches(path: str, module: str) -> bool:
    """Tell whether a Python file is what a dotted module name means, seen from some folder of the tree."""
    stem = path.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
    return stem == module or stem.endswith("." + module)
