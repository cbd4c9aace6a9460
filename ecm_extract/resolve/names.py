"""Look-ups of both languages behind one front: what a name means where it stands in a file."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence

from ecm_parsers.source.expr import Name

from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.resolve.aliases import Aliases
from ecm_extract.resolve.cpp_classes import CppClasses
from ecm_extract.resolve.cpp_constants import CppConstants, Stated
from ecm_extract.resolve.cpp_functions import CppFunctions
from ecm_extract.resolve.cpp_owners import CppOwners
from ecm_extract.resolve.cpp_scopes import Scopes
from ecm_extract.resolve.headers import Headers
from ecm_extract.resolve.outcome import Ambiguous, External, outcome
from ecm_extract.resolve.python_names import PythonNames
from ecm_extract.resolve.python_path import PythonPath
from ecm_extract.resolve.views import Views

Bases = Callable[[Cls], Sequence[Cls]]


class Names:
    """Looks up names of a tree.

    Args:
        files: of the tree.
        headers, path: find headers and Python modules.
        classes: all classes of the tree, in the order of files.
        bases: gives the bases of a class, at any distance.
    """

    def __init__(
        self, files: Sequence[File], headers: Headers, path: PythonPath, classes: Iterable[Cls], bases: Bases
    ) -> None:
        self.aliases = Aliases(files)
        by_name = _by_qualified_name(classes)
        views = Views(files, headers)
        scopes = Scopes(self.aliases, by_name, bases)
        self._classes = CppClasses(scopes, views, self.aliases, by_name)
        self._functions = CppFunctions(scopes, views, self.aliases)
        self._constants = CppConstants(scopes, views)
        self._owners = CppOwners(self._classes, by_name, self.aliases.last_names)
        self._python = PythonNames(path, bases)

    def add(self, file: File, classes: Sequence[Cls], functions: Sequence[Func]) -> None:
        """Make known what a file declares."""
        if file.language == "python":
            self._python.add(file, classes, functions)
            return
        for func in functions:
            if func.cls is None:
                self._functions.add(func)
        for constant in file.facts.constants:
            self._constants.add(file, constant)

    def owner(self, scope: str, file: File) -> Cls | None:
        """Return the class whose member a function of a scope is, as the function writes it; None of others."""
        return self._owners.find(scope, file)

    def classes(self, name: str, file: File, scope: str) -> Cls | Ambiguous[Cls] | External:
        """Return the class that a name, without template arguments, means in a scope of a file."""
        if file.language != "python":
            return self._classes.find(name, file, scope)
        return outcome((each for each in self._python.find(name, file, scope) if isinstance(each, Cls)), name)

    def alias(self, name: str, file: File, scope: str) -> str | None:
        """Return what the alias stands for that a C++ name means, or the macro of another name."""
        if file.language == "python":
            return None
        return self._classes.alias(name, file, scope) or self._of_macro(name, file, scope)

    def _of_macro(self, name: str, file: File, scope: str) -> str | None:
        """`#define MESSAGE std_msgs::String`."""
        found = self._constants.find(name, file, scope) if "::" not in name else None
        value = found.constant.value if isinstance(found, Stated) and "define" in found.constant.traits else None
        return value.id if isinstance(value, Name) and "::" in value.id else None

    def readings(self, name: str, file: File, scope: str) -> Iterable[str]:
        """Return the qualified names that a name can have in a scope of a C++ file, also of what the tree lacks."""
        return dict.fromkeys(self._classes.readings(name, file, scope))

    def spelled_out(self, name: str, file: File) -> str:
        """Return a C++ name with what the alias in front of it stands for."""
        return self._classes.spelled_out(name, file)

    def outside(self, dotted: str, file: File) -> str:
        """Return what a name that a Python file imports is called outside of the tree; empty of what is inside."""
        return self._python.outside(dotted, file)

    def functions(self, name: str, file: File, scope: str) -> tuple[Func, ...]:
        """Return the functions outside of classes that a name means in a scope of a file, all overloads."""
        if file.language != "python":
            return self._functions.find(name, file, scope)
        found = self._python.find(name, file, scope)
        return tuple(each for each in found if isinstance(each, Func) and each.cls is None)

    def constants(self, name: str, file: File, scope: str) -> Stated | Ambiguous[Stated] | External:
        """Return the constant or global that a name means; a Python one of its own file or one that it imports."""
        if file.language != "python":
            return self._constants.find(name, file, scope)
        found = [each for each in self._python.find(name, file, scope) if isinstance(each, Stated)]
        valued = [each for each in found if each.constant.value is not None] or found
        same = valued and all(each.constant.value == valued[0].constant.value for each in valued)
        return valued[0] if same else outcome(valued, name)


def _by_qualified_name(classes: Iterable[Cls]) -> Mapping[str, Sequence[Cls]]:
    found: dict[str, list[Cls]] = defaultdict(list)
    for cls in classes:
        if cls.file.language == "cpp":
            found[cls.qualified].append(cls)
    return found
