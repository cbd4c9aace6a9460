"""What lint rules see: a tree read, linked, and its launch files evaluated, each once and only when asked for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from ecm_checker.contract import Evidence
from ecm_checker.hub.package import Package
from ecm_checker.versions import in_range
from ecm_parsers.cmake_tokens import Command, parse_commands
from ecm_parsers.launch.model import Action, Include, LaunchFile
from ecm_parsers.launch.templates import all_actions
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.robot_names import is_whole_robot

from ecm_extract.assemble.contracts import assemble
from ecm_extract.collector import rare_collector, without_collector
from ecm_extract.description.model import Description
from ecm_extract.description.read import read_description
from ecm_extract.entities.workspace import PackagesRead, read_packages
from ecm_extract.entities.workspace import Workspace as Side
from ecm_extract.extraction_model import Options
from ecm_extract.link.linker import Linker
from ecm_extract.link.owning.composition import composition_of
from ecm_extract.lint.beside import Lines, own_running, running_beside
from ecm_extract.lint.beside_files import Beside, is_description
from ecm_extract.lint.builds import builds, hidden_of
from ecm_extract.lint.known import Known
from ecm_extract.lint.own_packages import own_packages
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.service_calls import ServiceCall, request_fields, service_calls
from ecm_extract.settings import config_of
from ecm_extract.system.files import Files
from ecm_extract.system.launch_files import is_aside, is_launch_file, read_launch
from ecm_extract.system.model import Given, Place
from ecm_extract.system.modules import ModuleIndex
from ecm_extract.system.package_folders import folders_read
from ecm_extract.system.running import running_of
from ecm_extract.system.system import System, evaluated_system
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import FileDiagnostic, Tree, Unread, printable

MAX_SYSTEMS = 80
MAX_DESCRIPTIONS = 120


class Workspace:
    """A tree under lint.

    Attributes:
        tree: where files are read. config: what the project sets.
        packages: their facts. linker: with all that it found.
        files: as launch files and descriptions name them.
        stored: documents of packages that lie beside the tree, which may start and describe what is in it.
        released: packages that a registry tells of beside, as providers.

    `read` is what was read of the tree, for callers that have it already.
    """

    def __init__(
        self, tree: Tree, options: Options, read: PackagesRead | None = None, stored: Sequence[Package] = ()
    ) -> None:
        self.tree = tree
        self.stored = stored
        self.released: Sequence[Package] = ()
        self._options = options
        self._is_part = False
        self.config = config = config_of(tree, options)
        self._read = found = read or read_packages(tree, options, {})
        self.packages = found.packages
        with rare_collector():
            self.linker = Linker(found.packages, found.forms)
            self.linked = self.linker.link()
            self.linker.tell(tree)
        self.externals = frozenset(config.externals)
        self.by_name = {package.name: package for package in self.packages}
        self.files = Files(tree, folders_read(self.packages))
        self._composition = composition_of(self.linker.modules, self.linker.references)
        self.programs = self._composition.programs

    @property
    def others(self) -> Sequence[Package]:
        """All packages that are known and not in the tree."""
        return (*self.stored, *self.released)

    @cached_property
    def index(self) -> ModuleIndex:
        """What runs of its packages, and of those that are known by their documents."""
        own = running_of(self.packages, self.linked, self._composition)
        others = (each for each in self.others if each.name not in self.by_name)
        beside = running_beside(others, self.lines)
        return ModuleIndex({**beside, **own_running(own, beside)})

    @cached_property
    def lines(self) -> Lines:
        """Where lines lie that documents tell of."""
        return Lines(self.tree, self.roots, self.stored)

    @cached_property
    def roots(self) -> Mapping[str, str]:
        """The folders of its packages by name."""
        return {package.name: package.root.path for package in self.packages}

    def ros_of(self, package: str) -> int | None:
        """Return the ROS version of a package that is known, None where nothing tells."""
        own = self.by_name.get(package)
        return own.ros if own is not None else next((each.ros for each in self.others if each.name == package), None)

    @cached_property
    def parts(self) -> Sequence[Workspace]:
        """The workspace itself, or one for each set of packages that are built together."""
        groups = builds(self.packages)
        for package in hidden_of(self.packages):
            self.tree.report(_hidden(package))
        return [self] if groups == [self.packages] else [self._part(group) for group in groups]

    def _part(self, packages: list[PackageFacts]) -> Workspace:
        read = PackagesRead(self.tree, packages, self._read.forms)
        part = Workspace(self.tree, self._options, read, self.stored)
        part.released = self.released
        part._is_part = True
        return part

    @cached_property
    def known(self) -> Known:
        """What its packages provide and require, with the packages that are known by their documents."""
        return Known(own_packages(self), self.others, self.externals)

    @cached_property
    def launches(self) -> Mapping[str, LaunchFile]:
        """Launch files by path; those of tests, and copies in hidden folders, are left out."""
        return {path: read.facts for path, read in self._launches_read.items() if read.facts is not None}

    @cached_property
    def launch_problems(self) -> Mapping[str, Sequence[Diagnostic]]:
        """What the reader of launch files says of each, by path."""
        return {path: read.diagnostics for path, read in self._launches_read.items()}

    @cached_property
    def _launches_read(self) -> Mapping[str, Parsed[LaunchFile | None]]:
        found = {}
        for package in self.packages:
            for entry in package.root.files:
                if (
                    is_launch_file(entry.path)
                    and not is_aside(entry.path)
                    and not is_test_path(entry.path, package.root.path)
                ):
                    data = self.files.read(entry.path)
                    if data is not None:
                        found[entry.path] = read_launch(entry.path, data, package.ros)
        return found

    @cached_property
    def included(self) -> frozenset[str]:
        """Names, without folders, of launch files that another one includes, of documents too."""
        launches = (*self.launches.values(), *self.beside.launches.values())
        return frozenset(name for facts in launches for name in _included(facts.actions))

    @cached_property
    def systems(self) -> Sequence[System]:
        """What each launch file that no other includes starts, with the defaults of its arguments.

        Those of documents are among them: they start what is in the tree, and nodes that launch files of the tree name.
        """
        launches = (*self.launches, *self.beside.launches)
        roots = sorted(
            (path for path in launches if path.rsplit("/", 1)[-1] not in self.included), key=self._by_package
        )
        tree, files = self.beside.tree, self.beside.files
        with without_collector():
            self.leave_out(roots[MAX_SYSTEMS:], "launch files")
            return [evaluated_system(tree, files, self.index, [path], Given()) for path in roots[:MAX_SYSTEMS]]

    def _by_package(self, path: str) -> tuple[str, str]:
        """The same order wherever packages lie, so that which of two lines is told first is no matter of folders."""
        files = self.beside.files
        name = files.package_of(path) or ""
        return name, path.removeprefix(files.package_path(name) or "").lstrip("/")

    @cached_property
    def beside(self) -> Beside:
        """The tree with what documents beside it keep."""
        own = frozenset(self.by_name)
        documents = [each for each in self.stored if each.name not in own]
        return Beside(self.tree, self.files, folders_read(self.packages), documents)

    @cached_property
    def service_calls(self) -> Sequence[tuple[ServiceCall, tuple[str, ...]]]:
        """Calls of rospy service proxies, with the fields of the request where the service is known."""
        fields = request_fields(self.packages)
        calls = service_calls(self.linker.program.files, self.linked)
        return [(call, fields[call.service]) for call in calls if call.service in fields]

    @cached_property
    def descriptions(self) -> Sequence[Description]:
        """Every robot description of its own (no file that only defines macros), with the defaults of its arguments.

        Those of documents are among them that may include files of the tree.
        """
        files = self.beside.files
        own = (
            entry.path
            for package in self.packages
            for entry in package.root.files
            if is_description(entry.path) and not is_test_path(entry.path, package.root.path)
        )
        others = self.beside.reaching(self.beside.descriptions)
        paths = sorted(filter(self._is_robot, (*own, *others)), key=self._by_package)
        self.leave_out(paths[MAX_DESCRIPTIONS:], "robot descriptions")
        return [read_description(path, {}, files) for path in paths[:MAX_DESCRIPTIONS]]

    def _is_robot(self, path: str) -> bool:
        return self.beside.files.parsed(path, is_whole_robot) is True

    def leave_out(self, paths: Iterable[str], what: str) -> None:
        """Tell of files that are beyond the number that one run judges, so that nothing found is not nothing there."""
        message = f"More {what} than one run judges; this one is left out. Lint the packages one by one."
        for path in paths:
            self.tree.report(FileDiagnostic("warning", "lint-bound", path, 0, message, Unread(path, "unjudged")))

    def assemble(self) -> None:
        """Lay the overlays over the contracts, which reports where they contradict the sources."""
        if any(package.overlay is not None for package in self.packages):
            assemble(self.tree, self.packages, self.linked)

    def diagnostics(self, *codes: str) -> Iterator[FileDiagnostic]:
        """Yield what reading has reported under these codes."""
        found = (entry for entry in self.tree.diagnostics if entry.code in codes)
        return (entry for entry in found if not self._is_part or self.package_of(entry.path))

    def as_side(self) -> Side:
        """Return the workspace as a comparison reads it."""
        return Side(self.tree, self.packages, self.linked, self.linker.program, self.linker.folder.objects)

    @cached_property
    def versions(self) -> Mapping[str, str | None]:
        """The versions of the packages of the tree and of documents beside it."""
        own = ((name, facts.manifest) for name, facts in self.by_name.items())
        stored = {each.name: each.version for each in self.stored}
        return {**stored, **{name: manifest.version if manifest is not None else None for name, manifest in own}}

    def provides(self, package: str, versions: str) -> bool:
        """Tell whether the tree, or a document beside it, holds a package in a range of versions, such as `<1.11.1`."""
        held = self.versions.get(package)
        return held is not None and in_range(held, versions) is True

    def commands(self, path: str) -> Sequence[Command]:
        """Return the commands of a CMake file as they are written, parsed once; none of one that cannot be read."""
        parsed = self.files.parsed(path, parse_commands)
        return parsed.facts if parsed is not None else ()

    def in_package(self, path: str) -> str:
        """Return a path of the tree, or of a document beside it, as that of a package: the same wherever it lies."""
        files = self.beside.files
        name = files.package_of(path)
        return f"{name}/{path.removeprefix(files.package_path(name) or '').lstrip('/')}" if name else path

    def package_of(self, path: str) -> str:
        """Return the name of the package that a file belongs to, also one of a document beside it; empty for none."""
        return self.beside.files.package_of(path) or ""


def evidence_of(place: Place) -> Evidence:
    """Return a place as evidence."""
    return Evidence(place.path, place.line)


def _hidden(package: PackageFacts) -> FileDiagnostic:
    """What is told of a package whose files are judged as those of the one around it."""
    path = printable(package.root.manifest or package.root.path)
    message = (
        f"{printable(package.name)} lies within another package, and one of its name stands elsewhere, which build "
        "tools take: it is not judged as a package of its own. Give it another name, or move it out."
    )
    return FileDiagnostic("info", "package-hidden", path, 0, message, about=printable(package.name))


def _included(actions: Sequence[Action]) -> Iterator[str]:
    """File names that includes end in."""
    for action in all_actions(actions):
        if isinstance(action, Include) and action.path and isinstance(action.path[-1], str):
            yield action.path[-1].rsplit("/", 1)[-1]
