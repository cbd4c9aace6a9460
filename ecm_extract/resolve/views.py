"""What a C++ file sees: a translation unit is a source with all that it includes.

A header is compiled as part of the sources that include it, so that it may use what stands before it there.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

from ecm_extract.link.code.units import File
from ecm_extract.resolve.headers import Headers


class View:
    """Files that are seen together, with the namespaces that their using-directives name, by scope."""

    def __init__(self, files: Iterable[File]) -> None:
        self.files = frozenset(files)
        found: dict[str, set[str]] = defaultdict(set)
        for file in self.files:
            for using in file.facts.usings:
                found[using.where].add(using.namespace)
        self.usings: Mapping[str, Sequence[str]] = {scope: sorted(names) for scope, names in found.items()}

    def __contains__(self, file: File) -> bool:
        return file in self.files


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
