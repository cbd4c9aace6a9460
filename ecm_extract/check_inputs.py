"""Contracts and profiles of a check: manifests, folders of manifests, extract documents, or source trees."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeVar

import msgspec
from ecm_checker.contract import Contract, Evidence
from ecm_checker.encode import decode
from ecm_checker.hub.package import SUFFIX as DOCUMENT
from ecm_checker.hub.package import Package
from ecm_checker.wire import NotRead
from ecm_parsers.yaml_tree import parse_yaml, plain

from ecm_extract.errors import InputError
from ecm_extract.extraction_model import LocatedDiagnostic
from ecm_extract.report.manifest_yaml import SUFFIX
from ecm_extract.stored import is_stored, packages_of, read_stored
from ecm_extract.tree.unread import not_read, unread_in

MAX_BYTES: Final = 200_000_000

_YAML: Final = frozenset({".yaml", ".yml"})
_Profile = TypeVar("_Profile", bound=msgspec.Struct)


Told = Callable[[Sequence[LocatedDiagnostic]], None]
"""Takes the diagnostics of a tree that was read."""


def silent(_diagnostics: Sequence[LocatedDiagnostic]) -> None:
    """Tell nobody."""


class Subject(msgspec.Struct, frozen=True):
    """What a path names: contracts of modules, and the documents of their packages where they are at hand.

    `unread`: what was not read of the tree or of the packages.
    """

    path: str
    contracts: tuple[Contract, ...]
    packages: tuple[Package, ...] = ()
    unread: tuple[NotRead, ...] = ()


def subject(path: str, cache: bool = True, told: Told = silent) -> Subject:
    """What a path names.

    Args:
        path: a manifest, a document (`.json`), a folder with manifests below it, or else a source tree or
            `DIR@REF`, which is then extracted.
        cache: let the extraction use the cache.
        told: gets what was said of the sources.

    Raises:
        InputError: nothing is there, or it holds no contract.
    """
    place = Path(path)
    if place.is_file():
        found = tuple(_of_file(place))
        return _documented(path, found) if is_stored(path) else Subject(path, found)
    manifests = sorted(found for found in place.rglob(f"*{SUFFIX}") if found.is_file())
    if manifests:
        found = tuple(contract for file in manifests for contract in _of_file(file))
        return _documented(path, found) if next(place.rglob(f"*{DOCUMENT}"), None) else Subject(path, found)
    return _extracted(path, cache, told)


def whole_subject(path: str, cache: bool = True) -> Subject:
    """What a path names, see `subject`, where all of it is needed.

    Raises:
        InputError: as `subject`, or not all of it could be read.
    """
    from ecm_extract.asked import refuse_gaps

    found = subject(path, cache)
    refuse_gaps(path, unread_in(found.unread))
    return found


def _documented(path: str, contracts: tuple[Contract, ...]) -> Subject:
    """The packages of documents beside the contracts of their modules."""
    stored = read_stored(path)
    rows = [each for package in stored.packages for each in package.unread]
    return Subject(path, contracts, stored.packages, tuple(dict.fromkeys((*not_read(stored.unread), *rows))))


class LaunchedContracts(NamedTuple):
    """Contracts of the nodes that launch files start, and the line that starts each, by the id of its contract.

    `started` is what the launch makes of names of nodes, see `system.started`. `unread` is what was not read of the
    packages that run.
    """

    contracts: tuple[Contract, ...]
    starts: Mapping[str, Evidence]
    started: Package
    unread: tuple[NotRead, ...]


def launched_contracts(path: str, words: Sequence[str], cache: bool = True) -> LaunchedContracts:
    """Contracts of the nodes that launch files start.

    Args:
        path: of the workspace, `DIR@REF`, or of documents.
        words: launch files by path or as `package/file`, and arguments as `name:=value`.
        cache: let the reading use the cache.

    Raises:
        InputError: there is no such tree or launch file, or it starts nothing.
    """
    from ecm_extract.extraction_model import Options
    from ecm_extract.system.contracts import instance_contracts
    from ecm_extract.system.model import Given
    from ecm_extract.system.started import started_package
    from ecm_extract.system.system import read_system, stored_system
    from ecm_extract.tree import open_tree

    arguments = dict(word.split(":=", 1) for word in words if ":=" in word)
    launches = [word for word in words if ":=" not in word]
    if is_stored(path):
        system = stored_system(read_stored(path), launches, Given(arguments))
    else:
        system = read_system(open_tree(path), launches, Given(arguments), Options(cache=cache))
    if not system.launched.is_complete:
        message = f"{', '.join(launches)} was read in part only, so that nothing can be said of the whole"
        raise InputError(message, "`ecm-extract system` shows what was left out, with its line")
    found = instance_contracts(system)
    if not found:
        message = f"{', '.join(launches) or path} starts no node that is known before the launch"
        raise InputError(message, "`ecm-extract system` shows what it starts and under which conditions")
    starts = {node.name: Evidence(node.instance.place.path, node.instance.place.line) for node in system.nodes}
    return LaunchedContracts(found, starts, started_package(system), system.unread)


def profile(path: str | None, kind: type[_Profile]) -> _Profile | None:
    """A profile from a YAML or JSON file; None without a path.

    Raises:
        InputError: the file cannot be read, or does not fit the schema; the message names the key.
    """
    if path is None:
        return None
    documents = list(_documents(Path(path)))
    try:
        return msgspec.convert(documents[0] if documents else {}, kind)
    except msgspec.ValidationError as error:
        message = f"{path}: {error}"
        raise InputError(message, f"fields of this profile: {', '.join(kind.__struct_fields__)}") from error


def _of_file(path: Path) -> Iterator[Contract]:
    for document in _documents(path):
        for module in _modules(document):
            try:
                yield decode(module)
            except msgspec.ValidationError as error:
                message = f"{path}: {error}"
                raise InputError(message, "a manifest is what `ecm-extract PATH` writes") from error


def _modules(document: Any) -> list[Any]:
    """Modules of an extract document or of that of a package, or the manifest itself."""
    if isinstance(document, dict) and isinstance(document.get("modules"), list):
        return list(document["modules"])
    if isinstance(document, dict) and isinstance(document.get("packages"), list):
        found = [package.get("modules") for package in document["packages"] if isinstance(package, dict)]
        return [module for modules in found if isinstance(modules, list) for module in modules]
    return [document]


def _documents(path: Path) -> Iterator[Any]:
    try:
        data = path.read_bytes() if path.stat().st_size <= MAX_BYTES else None
    except OSError as error:
        message = f"cannot read {path}: {error.strerror}"
        raise InputError(message) from error
    if data is None:
        message = f"{path} is larger than {MAX_BYTES} bytes"
        raise InputError(message)
    if path.suffix.lower() in _YAML:
        yield from _yaml(path, data)
        return
    try:
        yield msgspec.json.decode(data)
    except (msgspec.DecodeError, RecursionError) as error:
        message = f"{path} is not JSON: {error}"
        raise InputError(message) from error


def _yaml(path: Path, data: bytes) -> Iterator[Any]:
    parsed = parse_yaml(data)
    wrong = [each for each in parsed.diagnostics if each.severity == "error"]
    if wrong:
        message = f"{path}:{wrong[0].line}: {wrong[0].message}"
        raise InputError(message)
    yield from map(plain, parsed.facts)


def _extracted(path: str, cache: bool, told: Told) -> Subject:
    from ecm_extract.asked import refuse_nothing_read
    from ecm_extract.extraction import extract
    from ecm_extract.extraction_model import Options
    from ecm_extract.tree import open_tree

    extraction = extract(open_tree(path, None), Options(cache=cache, hub=True))
    refuse_nothing_read(extraction)
    told(extraction.diagnostics)
    found = tuple(module for package in extraction.packages for module in package.modules)
    if not found:
        message = f"{path} holds neither manifests nor ROS packages"
        raise InputError(message, "name a manifest, a folder of manifests, or a folder with a package.xml below it")
    return Subject(path, found, packages_of(extraction), not_read(extraction.unread))
