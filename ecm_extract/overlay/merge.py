"""An overlay laid over contracts: declared wins over inferred, defaults fill what is left."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any, NamedTuple

import msgspec
from ecm_checker.contract import Contract, Evidence, Value
from ecm_checker.fields import FIELDS, missing_fields
from ecm_checker.finding import Severity
from ecm_checker.overlay import is_declarable
from ecm_parsers.overlay_yaml import Declared, Overlay

from ecm_extract.overlay.drift import contradiction
from ecm_extract.overlay.seen import with_seen
from ecm_extract.overlay.template import examples
from ecm_extract.read.reader import OVERLAY
from ecm_extract.tree import FileDiagnostic, Tree

FILE_NAME = OVERLAY
_KNOWN = frozenset(row.path for row in FIELDS)


def overlaid(tree: Tree, path: str, overlay: Overlay, contracts: Iterable[Contract]) -> list[Contract]:
    """Return contracts with an overlay laid over them.

    Args:
        tree: gets the diagnostics: unknown fields and modules, drift.
        path: of the overlay in the tree.
        overlay: what it declares.
        contracts: of the package that the overlay stands in.
    """
    merger = _Merger(tree, path, overlay)
    found = [merger.merged(contract) for contract in contracts]
    merger.report_unused(found)
    return found


class _Merger:
    """Lays one overlay over contracts."""

    def __init__(self, tree: Tree, path: str, overlay: Overlay) -> None:
        self.tree = tree
        self.path = path
        self.overlay = overlay

    def merged(self, contract: Contract) -> Contract:
        fields = [*self.overlay.everywhere]
        for module in self.overlay.modules:
            if _means(module.module, contract.ecm.module_id):
                fields += module.fields
                contract = with_seen(contract, module.endpoints, self.path)
        for declared in fields:
            contract = self._laid(contract, declared)
        for declared in self.overlay.defaults:
            if self._is_usable(declared) and _read(contract, declared) is None:
                contract = _with(contract, declared, self._value(declared, "default"))
        return msgspec.structs.replace(contract, missing=missing_fields(contract))

    def _laid(self, contract: Contract, declared: Declared) -> Contract:
        if not self._is_usable(declared):
            return contract
        inferred = _read(contract, declared)
        if inferred is not None and inferred.origin == "inferred":
            self._compare(contract, declared, inferred)
        return _with(contract, declared, self._value(declared, self.overlay.origin))

    def _compare(self, contract: Contract, declared: Declared, inferred: Value) -> None:
        differs = None if inferred.confidence == "pattern" else contradiction(declared.value, inferred.value)
        if differs is None:
            return
        place = f" at {inferred.evidence[0].path}:{inferred.evidence[0].line}" if inferred.evidence else ""
        path = f"{declared.section}.{declared.field}"
        wrong = f"{contract.ecm.module_id} declares {path} otherwise than the source shows{place}: {differs}"
        problem = _Problem(wrong, "Correct the one that is wrong", f"{contract.ecm.module_id} {path}")
        self._report("drift", declared.line, problem, "warning")

    def _is_usable(self, declared: Declared) -> bool:
        """What cannot be meant is told and stays undeclared."""
        path = f"{declared.section}.{declared.field}"
        if path in _KNOWN:
            fits = is_declarable(declared.section, declared.field, declared.value)
            if not fits:
                self._report("overlay-wrong-value", declared.line, _unusable(path, declared))
            return fits
        near = get_close_matches(path, _KNOWN, 1)
        hint = f"Did you mean {near[0]}?" if near else "See the manual for the fields"
        self._report("overlay-unknown-field", declared.line, _Problem(f"{path} is no field of a contract", hint))
        return False

    def report_unused(self, contracts: Iterable[Contract]) -> None:
        ids = [contract.ecm.module_id for contract in contracts]
        for module in self.overlay.modules:
            if not any(_means(module.module, each) for each in ids):
                near = get_close_matches(module.module, [each.rsplit(".", 1)[-1] for each in ids], 1)
                hint = f"Did you mean {near[0]}?" if near else "Remove it, or correct its name"
                self._report(
                    "overlay-unknown-module", module.line, _Problem(f"There is no module {module.module}", hint)
                )

    def _value(self, declared: Declared, origin: Any) -> Value:
        value = declared.value
        if origin == "default" and self.overlay.default_name:
            return Value(value, origin, "default", (Evidence(self.path, declared.line),))
        return Value(value, origin, "literal", (Evidence(self.path, declared.line),))

    def _report(self, code: str, line: int, problem: _Problem, severity: Severity = "error") -> None:
        message = f"{problem.wrong}. {problem.advice}{'' if problem.advice.endswith('?') else '.'}"
        told = severity, code, self.path, line, message
        self.tree.report(FileDiagnostic(*told, about=problem.about, wrong=problem.wrong, advice=problem.advice))


class _Problem(NamedTuple):
    """What is wrong and what to do, without full stops, and what it is about where that is less than what is wrong."""

    wrong: str
    advice: str
    about: str = ""


def _unusable(path: str, declared: Declared) -> _Problem:
    shown = "such a list or map" if isinstance(declared.value, list | dict) else repr(declared.value)[:60]
    meaning = next(row.meaning for row in FIELDS if row.path == path)
    return _Problem(
        f"{path} cannot be {shown}: it is {meaning}", f"Write it like `{declared.field}: {examples()[path]}`"
    )


def _means(name: str, module_id: str) -> bool:
    return name in {module_id, module_id.removeprefix("ecm."), module_id.rsplit(".", 1)[-1]}


def _read(contract: Contract, declared: Declared) -> Value | None:
    found: Value | None = getattr(getattr(contract, declared.section), declared.field)
    return found


def _with(contract: Contract, declared: Declared, value: Value) -> Contract:
    section = msgspec.structs.replace(getattr(contract, declared.section), **{declared.field: value})
    return msgspec.structs.replace(contract, **{declared.section: section})
