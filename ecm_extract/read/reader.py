"""Read a whole tree: small declarative artefacts in this process, sources on all cores."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import PurePosixPath
from typing import Any, cast

from ecm_parsers import dynamic_reconfigure, interface, package_xml, parameter_library, plugin_xml
from ecm_parsers.behavior_tree import is_behavior_tree, parse_behavior_tree
from ecm_parsers.controllers_yaml import parse_controllers
from ecm_parsers.diagnostics_yaml import is_diagnostics, parse_diagnostics
from ecm_parsers.interface_facts import Shape
from ecm_parsers.overlay_yaml import Overlay, parse_overlay
from ecm_parsers.package_facts import Manifest
from ecm_parsers.recorder_topics import is_recorder, parse_recorder
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.sros_policy import is_policy, parse_policy

from ecm_extract.cache.blobs import Blob, BlobCache
from ecm_extract.cmake import BuildFiles
from ecm_extract.discover import PackageRoot, discover
from ecm_extract.errors import TreeReadError
from ecm_extract.exclusion import Exclusion
from ecm_extract.read import select
from ecm_extract.read.absent_sources import report_absent
from ecm_extract.read.build_files import read_cmake, read_setups
from ecm_extract.read.cuts import located
from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.installed import installed_sources
from ecm_extract.read.parallel import SourceParse
from ecm_extract.read.parsed_file import BlobFacts, ParsedFile, Task
from ecm_extract.read.prefetch import Prefetch
from ecm_extract.read.shared_sources import SharedSources
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import FileDiagnostic, Tree, Unread, printable, unread_of

OVERLAY = "ecm.yaml"
_NO_MANIFEST = frozenset(
    {
        "xml-empty",
        "xml-entity",
        "xml-malformed",
        "xml-too-deep",
        "xml-too-large",
        "package-wrong-root",
        "package-no-name",
    }
)
"""What the parser says of a file that is no package.xml."""
Progress = Callable[[int, int], None]


class Reader:
    """Reads the packages of one tree.

    Args:
        tree: where files are read.
        include_tests: also read test folders.
        exclude: patterns of paths that are not read, as in a `.gitignore`.
        cached: take facts of contents that were parsed before, and keep those of new ones.

    Attributes:
        files: how many were parsed or known. bytes: how much that was.
        blobs: git blob id of each source file, of the bytes that its facts were read from.
    """

    def __init__(
        self, tree: Tree, include_tests: bool = False, exclude: Iterable[str] = (), cached: bool = True
    ) -> None:
        self.tree = tree
        self.include_tests = include_tests
        self.exclude = Exclusion(tuple(exclude))
        self.files = 0
        self.bytes = 0
        self.blobs: dict[str, str] = {}
        self._cache = BlobCache() if cached else None
        self._contents = Prefetch(tree)

    def read(self, jobs: int | None, progress: Progress | None = None) -> list[PackageFacts]:
        """Return the facts of every package, sorted by path."""
        packages = [PackageFacts(root) for root in discover(self.tree, self.exclude)]
        tasks = [task for package in packages for task in select.sources(package.root, self.include_tests)]
        known = self._known(self._identified(packages, tasks))
        missing = [task for task in tasks if task[0] not in known]
        sources = SourceParse(self.tree, missing, jobs)
        sources.start()
        self._read_packages(packages)
        parsed = sources.finish(_counting(progress, len(missing)))
        self._keep(dict(missing), parsed)
        contents = known | {file.path: file.content for file in parsed}
        late = [task for package in packages for task in installed_sources(package) if task[0] not in contents]
        contents |= self._parsed(late)
        tasks += late
        owner = {entry.path: package for package in packages for entry in package.root.files}
        for path, _ in tasks:
            if path in contents:
                self._take_source(owner[path], path, contents[path])
        self._take_shared(packages)
        for package in packages:
            package.ros = _ros(package)
        return packages

    def _take_shared(self, packages: Sequence[PackageFacts]) -> None:
        """Take what lies beside the packages; it is a source of each that takes it."""
        shared = SharedSources(packages, self.tree.files(), self.exclude)
        contents: dict[str, BlobFacts] = {}
        for package in packages:
            tried: set[Task] = set()
            while wanted := [task for task in shared.wanted(package) if task not in tried]:
                tried.update(wanted)
                contents |= self._parsed([task for task in wanted if task[0] not in contents])
                for path in [path for path, _ in wanted if path in contents]:
                    self._take_source(package, path, contents[path])

    def _parsed(self, tasks: Sequence[Task]) -> dict[str, BlobFacts]:
        """Facts of the few sources that only build files tell to be programs."""
        parse = SourceParse(self.tree, tasks, 1)
        parse.start()
        parsed = parse.finish(lambda _: None)
        self._keep(dict(tasks), parsed)
        return {file.path: file.content for file in parsed}

    def _read_packages(self, packages: list[PackageFacts]) -> None:
        self._contents.fetch(entry for package in packages for entry in package.root.files)
        paths = [entry.path for entry in self.tree.files()]
        absent = [entry.path for entry in unread_of(self.tree.diagnostics) if entry.reason == "submodule"]
        build_files = BuildFiles(paths, self._contents.read, absent)
        for package in packages:
            package.cmake = read_cmake(build_files, package.root, self.tree)
            for path in package.cmake:
                self._count(path, len(self._contents.read(path) or b""), ())
            self._read_package(package)
        report_absent(packages, build_files, self.tree, self.exclude)
        self._contents.drop()

    def _take_source(self, package: PackageFacts, path: str, content: BlobFacts) -> None:
        if content.facts is not None:
            package.sources[path] = content.facts
            self._count(path, content.size, content.diagnostics)

    def _identified(self, packages: list[PackageFacts], tasks: Sequence[Task]) -> dict[str, Blob]:
        """Blob of each source file that can be read; a folder's files must be read for it, which is cheap."""
        if not self._wants_blobs():
            return {}
        listed = {entry.path: entry for package in packages for entry in package.root.files}
        found: dict[str, Blob] = {}
        for path, kind in tasks:
            # A blob that the repository lacks has no size: the reader must come across it and say so.
            if listed[path].identity is None or listed[path].size is not None:
                with suppress(TreeReadError):
                    found[path] = (kind, self.tree.identity(path))
        self.blobs = {path: blob for path, (_, blob) in found.items()}
        return found

    def _wants_blobs(self) -> bool:
        return self._cache is not None

    def _known(self, wanted: Mapping[str, Blob]) -> dict[str, BlobFacts]:
        """Facts by path of files that need not be parsed."""
        if self._cache is None:
            return {}
        known = self._cache.known(wanted.values())
        return {path: known[blob] for path, blob in wanted.items() if blob in known}

    def _keep(self, kinds: Mapping[str, select.SourceKind], parsed: Sequence[ParsedFile]) -> None:
        """Remember what was parsed, by the bytes that were: a file may change between two looks at it."""
        self.blobs.update((file.path, file.blob) for file in parsed)
        if self._cache is not None:
            self._cache.add({(kinds[file.path], file.blob): file.content for file in parsed})

    def _read_package(self, package: PackageFacts) -> None:
        root = package.root
        if root.manifest is not None and root.manifest.endswith("package.xml"):
            package.manifest = self._manifest(root.manifest)
        package.overlay = self._overlay(root)
        package.setups = read_setups(self, root)
        for entry in root.files:
            self._read_declarative(package, entry.path)
        self._read_named(package)

    def _manifest(self, path: str) -> Manifest | None:
        """Build tools refuse a manifest that is none, so what is read of it is no declaration of the package."""
        data = self._contents.read(path)
        if data is None:
            return None
        parsed = package_xml.parse(data)
        manifest: Manifest = self._taken(path, data, parsed)
        if any(entry.code in _NO_MANIFEST for entry in parsed.diagnostics):
            shown = printable(path)
            message = "No build tool reads this as the manifest of a package, so it has no name or version. Correct it."
            self.tree.report(FileDiagnostic("error", "package-unread", shown, 0, message, Unread(shown, "malformed")))
        return manifest

    def _overlay(self, root: PackageRoot) -> tuple[str, Overlay] | None:
        path = f"{root.path}/{OVERLAY}" if root.path else OVERLAY
        found = self.parse(path, parse_overlay) if any(entry.path == path for entry in root.files) else None
        return None if found is None else (path, found)

    def _read_declarative(self, package: PackageFacts, path: str) -> None:
        suffix = PurePosixPath(path).suffix
        if suffix in select.INTERFACES and (self.include_tests or not is_test_path(path, package.root.path)):
            shape = cast("Shape", suffix[1:])
            found = self.parse(path, lambda data: interface.parse(data, shape))
            if found is not None:
                package.interfaces[path] = found
        elif suffix == ".cfg" and dynamic_reconfigure.is_dynamic_reconfigure(self._contents.read(path) or b""):
            reconfigure = self.parse(path, lambda data: dynamic_reconfigure.parse_dynamic_reconfigure(data, path))
            if reconfigure is not None:
                package.reconfigure[path] = reconfigure
        elif suffix == ".xml" and self._is_other(path, package.root):
            self._read_xml(package, path)
        elif suffix in {".yaml", ".yml"} and self._is_other(path, package.root):
            self._read_yaml(package, path)

    def _is_other(self, path: str, root: PackageRoot) -> bool:
        """Behaviour trees and policies have no name of their own; manifests and launch files have."""
        named = path == root.manifest or path.endswith(".launch.xml")
        return not named and (self.include_tests or not is_test_path(path, root.path))

    def _read_xml(self, package: PackageFacts, path: str) -> None:
        data = self._contents.read(path) or b""
        if is_behavior_tree(data):
            package.trees[path] = self._taken(path, data, parse_behavior_tree(data))
        elif is_policy(data):
            package.grants[path] = self._taken(path, data, parse_policy(data))

    def _read_yaml(self, package: PackageFacts, path: str) -> None:
        data = self._contents.read(path) or b""
        if is_diagnostics(data):
            package.aggregators[path] = self._taken(path, data, parse_diagnostics(data))
        elif is_recorder(data):
            package.recorders[path] = self._taken(path, data, parse_recorder(data))
        elif b"controller" in data and b"type:" in data:
            package.controllers[path] = self._taken(path, data, parse_controllers(data))

    def _taken(self, path: str, data: bytes, parsed: Parsed[Any]) -> Any:
        self._count(path, len(data), parsed.diagnostics)
        return parsed.facts

    def _read_named(self, package: PackageFacts) -> None:
        """Files that another file names: plugin descriptions and parameter libraries."""
        for path in sorted(self._plugin_files(package)):
            classes = self.parse(path, plugin_xml.parse)
            if classes is not None:
                package.plugins[path] = classes
        for path in _parameter_files(package):
            found = self.parse(path, parameter_library.parse_parameter_library)
            if found is not None:
                package.parameters[path] = found

    def _plugin_files(self, package: PackageFacts) -> set[str]:
        listed = {entry.path for entry in package.root.files}
        named = {_beside(at, entry.path) for at, file in package.cmake.items() for entry in file.plugin_descriptions}
        root = f"{package.root.path}/" if package.root.path else ""
        if package.manifest is not None:
            named |= {root + entry.path.lstrip("/") for entry in package.manifest.plugins}
        return named & listed

    def parse(self, path: str, parser: Callable[[bytes], Parsed[Any]]) -> Any:
        """Return the facts of one file, None when it cannot be read; diagnostics go to the tree."""
        data = self._contents.read(path)
        if data is None:
            return None
        return self._taken(path, data, parser(data))

    def _count(self, path: str, size: int, diagnostics: Iterable[Diagnostic]) -> None:
        self.files += 1
        self.bytes += size
        for entry in diagnostics:
            self.tree.report(located(path, entry))


def _counting(progress: Progress | None, total: int) -> Callable[[int], None]:
    count = 0

    def done(finished: int) -> None:
        nonlocal count
        count += finished
        if progress is not None:
            progress(count, total)

    return done


def _parameter_files(package: PackageFacts) -> list[str]:
    """Declarations that generate_parameter_library makes code of, as CMake and `setup.py` name them."""
    found = [_beside(at, library.path) for at, file in package.cmake.items() for library in file.parameter_libraries]
    found += [_beside(at, path) for at, setup in package.setups.items() for path in setup.parameter_files]
    return list(dict.fromkeys(found))


def _beside(path: str, relative: str) -> str:
    """Return a path that a file at `path` gives relative to its own folder."""
    parts: list[str] = []
    for part in [*PurePosixPath(path).parts[:-1], *PurePosixPath(relative).parts]:
        if part == "..":
            parts[-1:] = []
        elif part != ".":
            parts.append(part)
    return "/".join(parts)


def _ros(package: PackageFacts) -> int | None:
    """The ROS version: of the manifest, else of what the sources include."""
    if package.root.rosbuild:
        return 1
    if package.manifest is not None:
        known = package_xml.ros_version(package.manifest)
        if known is not None:
            return known
        if package_xml.ros_versions(package.manifest):
            return None
    return _ros_by_includes(package)


def _ros_by_includes(package: PackageFacts) -> int | None:
    modules = {entry.module for facts in package.sources.values() for entry in facts.imports}
    ros1 = any(module in {"ros/ros.h", "rospy"} for module in modules)
    ros2 = any(module in {"rclcpp/rclcpp.hpp", "rclpy"} or module.startswith("rclpy.") for module in modules)
    return None if ros1 == ros2 else 1 if ros1 else 2
