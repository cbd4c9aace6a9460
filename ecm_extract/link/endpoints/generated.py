"""Parameters that build files generate: generate_parameter_library YAML and dynamic_reconfigure `.cfg`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from ecm_checker.contract import Evidence, Interface
from ecm_parsers.dynamic_reconfigure import ReconfigureFile
from ecm_parsers.parameter_library import ParameterNamespace

from ecm_extract.link.code.units import File
from ecm_extract.link.declaring.parameters import Parameters
from ecm_extract.link.index.program import Program
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

    def __init__(self, program: Program, packages: Sequence[PackageFacts]) -> None:
        self.program = program
        self.packages = packages
        self._mentioned = MentionedTypes(program)
        self._files: dict[str, list[File]] = defaultdict(list)
        for file in program.files:
            self._files[file.package].append(file)

    def declare(self, parameters: Parameters) -> None:
        """Make the defaults known, so that names that come from parameters fold."""
        for package in self.packages:
            for namespaces in package.parameters.values():
                for namespace in namespaces:
                    for entry in namespace.parameters:
                        parameters.declare_name(entry.name, package.name)
                        value = _value(entry.default)
                        if value is not None:
                            parameters.declare(entry.name, package.name, value)

    def interfaces(self) -> Iterator[Generated]:
        """Yield each unit that holds generated parameters, with them."""
        for package in self.packages:
            files = self._files[package.name]
            for path, namespaces in package.parameters.items():
                for namespace in namespaces:
                    found = _library(path, namespace)
                    for unit in self._listeners(namespace.name, files):
                        yield Generated(unit, found)
            for path, reconfigure in package.reconfigure.items():
                for unit in self._servers(reconfigure, files):
                    yield Generated(unit, _reconfigured(path, reconfigure), _config_class(reconfigure))

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
    return tuple(_parameter(path, entry.name, entry.type, entry.default, entry.line) for entry in namespace.parameters)


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
        default=default,
    )
