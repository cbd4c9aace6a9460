"""What rules ask that want the other side of a requirement: the packages under lint, and those known beside them.

A rule that asks so reads no source: it gives the same findings from documents that were stored.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.engine import Match
from ecm_checker.match.packages import Packages

from ecm_extract.lint.near import nearest
from ecm_extract.system.launch_files import is_aside, is_launch_file


class Asked(msgspec.Struct, frozen=True):
    """A requirement of a package under lint, and what became of it."""

    consumer: Package
    match: Match

    @property
    def requirement(self) -> Requirement:
        """What is required."""
        return self.match.requirement

    @property
    def path(self) -> str:
        """The file that requires."""
        return self.requirement.evidence[0].path


class Known:
    """Packages that are known.

    Attributes:
        own: names of those under lint. packages: these, and others by their documents.
        elsewhere: names of packages that the project, or a list of sources around a package, has from elsewhere.
        distributions: that the trees of the packages say to be for.
    """

    def __init__(
        self, own: Sequence[Package], stored: Sequence[Package] = (), elsewhere: frozenset[str] = frozenset()
    ) -> None:
        """Gather packages; of the document of one that is under lint only what it says of its tree counts."""
        self.own = frozenset(package.name for package in own)
        self.packages = Packages([*own, *(each for each in stored if each.name not in self.own)])
        around = [package.around for package in (*own, *stored) if package.around]
        self.elsewhere = elsewhere.union(*(each.fetched for each in around))
        self.distributions = frozenset(name for each in around for name in each.distributions)
        self._files: dict[str, frozenset[str]] = {}

    def asked(self, use: str) -> Iterator[Asked]:
        """Yield the requirements of a use of the packages under lint, without launch files that are put aside."""
        for consumer in self.packages.consumers:
            if consumer.package in self.own:
                package = self.packages.by_name[consumer.package]
                for requirement in consumer.requirements:
                    if requirement.use == use and not _is_buried(requirement.evidence[0].path):
                        yield Asked(package, self.packages.match(requirement, consumer))

    def near(self, name: str, package: str, kind: str, prefix: str = "") -> str:
        """Return the name of a kind that a package has and that is most like another; empty for none.

        Args:
            name: that is looked for, without the prefix.
            package: that would have it.
            kind: of names.
            prefix: that the names must have; it is left out of the answer.
        """
        names = self._names.get((package, kind), ())
        return nearest(name, [each.removeprefix(prefix) for each in names if each.startswith(prefix)]) or ""

    def members(self, package: str, owner: str, kind: str) -> Sequence[str]:
        """Return the names of a kind that something of a package has, as the fields of a message, in their order."""
        rows = self.packages.by_name[package].provides if package in self.packages.by_name else ()
        return [row.name for row in rows if row.kind == kind and row.owner == owner]

    def launched(self, kind: str) -> Iterator[str]:
        """Yield the names of a kind that packages provide; launch files that are put aside give none."""
        for package in self.packages.by_name.values():
            for row in package.provides:
                if row.kind == kind and not _is_buried(row.evidence[0].path):
                    yield row.name

    def needed_by(self, package: str) -> frozenset[str]:
        """Return the packages that one says to depend on."""
        found = self.packages.by_name.get(package)
        return frozenset(each.name for each in found.requires if each.row.brings) if found else frozenset()

    def names(self, package: str, kind: str) -> Sequence[str]:
        """Return the names of a kind that a package provides, or that its build may make."""
        return self._names.get((package, kind), ())

    def places(self, package: str, kind: str) -> list[Evidence]:
        """Return the first line of each name of a kind that a package provides."""
        rows = self.packages.by_name[package].provides if package in self.packages.by_name else ()
        return [row.evidence[0] for row in rows if row.kind == kind]

    def path_of(self, package: str, path: str) -> str:
        """Return a path below the folder of a package as one of the tree; of one that is not in it, below its name."""
        folder = self.packages.by_name[package].path if package in self.own else package
        return f"{folder}/{path}" if folder not in {"", "."} else path

    def lines_of(self, package: str, lines: Iterable[Evidence]) -> list[Evidence]:
        """Return lines of a package that can be shown: those of one that a document tells are of another tree."""
        return list(dict.fromkeys(lines)) if package in self.own else []

    def may_have(self, package: str, kind: str, name: str) -> bool:
        """Whether a package provides a name of a kind, or its build may make one."""
        return name in self._names.get((package, kind), ())

    def files_of(self, package: str) -> frozenset[str]:
        """Return the files and folders of a package, from its own folder; none of one that is not known."""
        if package not in self._files:
            found = self.packages.by_name.get(package)
            self._files[package] = found.shared if found is not None else frozenset()
        return self._files[package]

    def named_like(self, package: str, path: str, endings: Sequence[str] = ()) -> list[str]:
        """Return the files of a package with the name of another one, or that with one of some endings."""
        name = path.rpartition("/")[2]
        names = {name, *(f"{name}{ending}" for ending in endings)}
        return sorted(each for each in self.files_of(package) if each.rpartition("/")[2] in names)

    def provider(self, kind: str, ending: str) -> str | None:
        """Return the first package that provides a name of a kind with an ending."""
        rows = ((package, row) for package in self.packages.by_name.values() for row in package.provides)
        return next((each.name for each, row in rows if row.kind == kind and row.name.endswith(ending)), None)

    @cached_property
    def _names(self) -> Mapping[tuple[str, str], Sequence[str]]:
        """Names by package and kind, with those that builds may make."""
        found: dict[tuple[str, str], list[str]] = defaultdict(list)
        for package in self.packages.by_name.values():
            for row in package.provides:
                found[package.name, row.kind].append(row.name)
            for kind, names in package.possible.items():
                found[package.name, kind].extend(names)
        return found


def _is_buried(path: str) -> bool:
    return is_launch_file(path) and is_aside(path)
