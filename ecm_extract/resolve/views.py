"""What a C++ file sees: a translation unit is a source with all that it includes.

A header is compiled as part of the sources that include it, so that it may use what stands before it there.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations

from ecm_extract.link.code.units import File
from ecm_extract.resolve.headers import Headers


class View:
    """Files that are seen together, with the namespaces that their using-directives name, by scope.

    Args:
        files: the files.
        partly: whether directives and aliases count that only a part of a function has.
    """

    def __init__(self, files: Iterable[File], partly: bool = True) -> None:
        self.partly = partly
        self.files = frozenset(files)
        found: dict[str, set[str]] = defaultdict(set)
        for file in self.files:
            for using in (each for each in file.facts.usings if partly or not each.partly):
                found[using.where].add(using.namespace)
            for scope, namespace in _within_used(file):
                if namespace in self._namespaces:
                    found[scope].add(namespace)
        self.usings: Mapping[str, Sequence[str]] = {scope: sorted(names) for scope, names in found.items()}

    def __contains__(self, file: File) -> bool:
        return file in self.files

    @cached_property
    def surely(self) -> View:
        """The same files with the directives and aliases only that all of a function has; itself without others."""
        facts = [file.facts for file in self.files] if self.partly else []
        open_ = any(using.partly for each in facts for using in each.usings)
        open_ = open_ or any(alias.partly for each in facts for alias in each.aliases)
        return View(self.files, partly=False) if open_ else self

    @cached_property
    def _namespaces(self) -> frozenset[str]:
        """The scopes in which the files declare classes and functions."""
        classes = {each.scope for file in self.files for each in file.facts.classes}
        return frozenset(classes.union(each.scope for file in self.files for each in file.facts.functions))


def _within_used(file: File) -> Iterator[tuple[str, str]]:
    """`using namespace a; using namespace b;` may mean `a::b` (C++, basic.lookup.udir): scope and that name."""
    for earlier, later in combinations(file.facts.usings, 2):
        if earlier.where == later.where:
            yield later.where, f"{earlier.namespace}::{later.namespace}"


class Views:
    """Answers which files a C++ file sees, each asked about once."""

    def __init__(self, files: Sequence[File], headers: Headers) -> None:
        self._files = files
        self._headers = headers
        self._own: dict[File, View] = {}
        self._wide: dict[File, View] = {}
        self._users: Mapping[File, Sequence[File]] | None = None

    def of(self, file: File) -> View:
        """Return the file and what it includes itself."""
        known = self._own.get(file)
        if known is None:
            known = self._own[file] = View((file, *self._headers.of(file)))
        return known

    def wide(self, file: File) -> View:
        """Return what all translation units see that the file is a part of."""
        known = self._wide.get(file)
        if known is None:
            users = self._including().get(file, ())
            seen = (each for user in users for each in self.of(user).files)
            known = self._wide[file] = View((*self.of(file).files, *seen)) if users else self.of(file)
        return known

    def _including(self) -> Mapping[File, Sequence[File]]:
        if self._users is None:
            found: dict[File, list[File]] = defaultdict(list)
            for file in self._files:
                for header in self._headers.of(file) if file.language == "cpp" else ():
                    found[header].append(file)
            self._users = found
        return self._users
