"""Parameters that build files generate: generate_parameter_library YAML and dynamic_reconfigure `.cfg`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from ecm_checker.contract import Evidence, Interface
from ecm_parsers.dynamic_reconfigure import ReconfigureFile
from ecm_parsers.parameter_library import ParameterNamespace
from msgspec.structs import replace

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.code.units import Cls, File
from ecm_extract.link.declaring.parameters import Parameters
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.endpoints.endpoint_types import held_default
from ecm_extract.link.endpoints.listeners import Listeners
from ecm_extract.link.index.module_kinds import declared_by_base
from ecm_extract.link.owning.mentioned_types import MentionedTypes
from ecm_extract.link.owning.references import Unit
from ecm_extract.link.running.values import Value, constant, literal
from ecm_extract.read.facts import PackageFacts

_TYPES = {"int": "integer", "str": "string", "double": "double", "bool": "bool"}


class Generated(NamedTuple):
    """A unit that holds generated parameters, and the class of their configuration where a server sets them."""

    unit: Unit
    parameters: tuple[Interface, ...]
    config: str = ""


class GeneratedParameters:
    """Ties generated parameters to the classes that use them."""

    def __init__(self, sites: Sites, packages: Sequence[PackageFacts]) -> None:
        self.program = sites.program
        self.packages = packages
        self._mentioned = MentionedTypes(self.program)
        self._makers = Listeners(sites)
        self._files: dict[str, list[File]] = defaultdict(list)
        for file in self.program.files:
            self._files[file.package].append(file)

    def declare(self, parameters: Parameters) -> None:
        """Make the defaults known, so that names that come from parameters fold."""
        for package in self.packages:
            for namespaces in package.parameters.values():
                for namespace in namespaces:
                    for entry in namespace.parameters:
                        parameters.declare_name(entry.name, package.name)
                        value = _value(held_default(entry.default, entry.type))
                        if value is not None:
                            parameters.declare(entry.name, package.name, value)

    def interfaces(self) -> Iterator[Generated]:
        """Yield each unit that holds generated parameters, with them."""
        for package in self.packages:
            files = self._files[package.name]
            for path, namespaces in package.parameters.items():
                for namespace in namespaces:
                    yield from self._of_library(package, path, namespace)
            for path, reconfigure in package.reconfigure.items():
                for unit in self._servers(reconfigure, files):
                    yield Generated(unit, _reconfigured(path, reconfigure), _config_class(reconfigure))

    def _of_library(self, package: PackageFacts, path: str, namespace: ParameterNamespace) -> Iterator[Generated]:
        """Yield the units that listen to a namespace: who makes a listener declares, below the prefix that it gives.

        Who only mentions it may have got it from somebody, and is told where nobody is seen who gives a prefix.
        """
        made = dict.fromkeys(self._makers.made(namespace.name, {package.name, *self._users(package, namespace)}))
        placed = [(entry.unit, prefix) for entry in made for prefix in entry.prefixes]
        found = _library(path, namespace)
        if all(prefix.text == "" for _, prefix in placed):
            own = self._listeners(namespace.name, self._files[package.name])
            for unit in dict.fromkeys([*own, *(unit for unit, _ in placed)]):
                yield Generated(unit, self._declared(unit, found))
            return
        for unit, prefix in placed:
            yield Generated(unit, tuple(_below(prefix, entry) for entry in found))

    def _declared(self, unit: Unit, found: Sequence[Interface]) -> tuple[Interface, ...]:
        """The parameters as a unit has them: of those that its base has declared before the default is not told."""
        before = declared_by_base(unit, self.program) if isinstance(unit, Cls) else ()
        return tuple(replace(entry, default=None) if entry.name in before else entry for entry in found)

    def _users(self, package: PackageFacts, namespace: ParameterNamespace) -> Iterator[str]:
        """Yield the packages that depend on one and have no parameters of their own in a namespace of it."""
        for other in self.packages:
            own = (entry.name for namespaces in other.parameters.values() for entry in namespaces)
            depends = other.manifest is not None and any(
                entry.name == package.name for entry in other.manifest.dependencies
            )
            if depends and other is not package and namespace.name not in own:
                yield other.name

    def _listeners(self, namespace: str, files: Sequence[File]) -> list[Unit]:
        """Units that mention `<namespace>::ParamListener`; for Python the import of the generated module."""
        marks = (f"{namespace}::ParamListener", f"{namespace}.ParamListener")
        found = self._mentioned.units(marks, files)
        if found:
            return found
        header = [
            file
            for file in files
            if any(entry.module.endswith(f"{namespace}_parameters.hpp") for entry in file.facts.imports)
        ]
        return self._units_of(
            header or [f for f in files if any(namespace in entry.module for entry in f.facts.imports)]
        )

    def _units_of(self, files: Sequence[File]) -> list[Unit]:
        found: list[Unit] = [cls for file in files for cls in self.program.classes_in(file)]
        return found[:1]

    def _servers(self, reconfigure: ReconfigureFile, files: Sequence[File]) -> list[Unit]:
        """Units that hold a `dynamic_reconfigure::Server<pkg::NameConfig>`, or make a server of it in Python."""
        return self._mentioned.servers(_config_class(reconfigure), files)


def _config_class(reconfigure: ReconfigureFile) -> str:
    return f"{reconfigure.name or '?'}Config"


def _value(default: Any) -> Value | None:
    """A default as it folds; None of lists and of what has none."""
    if isinstance(default, str):
        return literal(default)
    return constant(default) if isinstance(default, bool | int | float) else None


def _library(path: str, namespace: ParameterNamespace) -> tuple[Interface, ...]:
    return tuple(
        _parameter(path, entry.name, entry.type, held_default(entry.default, entry.type), entry.line)
        for entry in namespace.parameters
    )


def _below(prefix: Value, entry: Interface) -> Interface:
    """A parameter below what the constructor of its listener was given."""
    text = prefix.text
    if not text:
        return entry
    name = f"{text.removesuffix('.')}.{entry.name}"
    confidence = "pattern" if "{" in name else "folded"
    return replace(entry, name=name, raw_name=name, confidence=confidence)


def _reconfigured(path: str, reconfigure: ReconfigureFile) -> tuple[Interface, ...]:
    return tuple(
        _parameter(path, f"~{entry.name}", _TYPES.get(entry.type, entry.type), entry.default, entry.line)
        for entry in reconfigure.parameters
    )


def _parameter(path: str, name: str, kind: str, default: Any, line: int) -> Interface:
    return Interface(
        role="parameter",
        name=name,
        raw_name=name,
        type=_TYPES.get(kind, kind) or None,
        qos=None,
        frame=None,
        confidence="pattern" if "{" in name else "literal",
        evidence=(Evidence(path, line),),
        default=None if default is UNKNOWN else default,
    )
