"""Fixture pairs of rules: contracts and profiles of one case, read from a folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import yaml
from ecm_checker.case import Case
from ecm_checker.catalogue import catalogue
from ecm_checker.contract import Contract
from ecm_checker.encode import decode
from ecm_checker.finding import Finding
from ecm_checker.hub.package import PackageDocument, decode_documents
from ecm_checker.match.packages import Packages
from ecm_checker.operations.engine import findings
from ecm_checker.outcome import ordered
from ecm_checker.profiles import Call, Embodiment, Policy, Profiles, Runtime
from ecm_checker.view import view

ROOT = Path(__file__).parent.parent.parent
RULES = ROOT / "fixtures" / "rules"


def load(path: Path) -> Any:
    return yaml.safe_load(path.read_text("utf-8"))


def contract(path: Path) -> Contract:
    return decode(load(path))


def profile(path: Path, kind: Any) -> Any:
    return msgspec.convert(load(path), kind) if path.is_file() else None


def profiles(folder: Path) -> Profiles:
    return Profiles(
        profile(folder / "embodiment.yaml", Embodiment),
        profile(folder / "policy.yaml", Policy),
        profile(folder / "runtime.yaml", Runtime),
    )


def packages(folder: Path, names: str) -> Packages | None:
    """Documents of packages beside the contracts: `previous` and `dependent` are as for contracts."""
    found = [decode_documents(path.read_bytes()) for path in sorted(folder.glob(names))]
    return Packages([each for each in found if isinstance(each, PackageDocument)]) if found else None


def case(folder: Path) -> Case:
    named = {path.name.removesuffix(".ecm.yaml"): contract(path) for path in sorted(folder.glob("*.ecm.yaml"))}
    previous, dependent = named.pop("previous", None), named.pop("dependent", None)
    return Case(
        [view(each) for each in named.values()],
        profiles(folder),
        ordered=len(named) > 1,
        previous=None if previous is None else view(previous),
        dependents=None if dependent is None else (view(dependent),),
        call=profile(folder / "call.yaml", Call),
        packages=packages(folder, "[!pds]*.package.json"),
        replaced=packages(folder, "previous.package.json"),
        users=packages(folder, "dependent.package.json"),
        started=packages(folder, "started.package.json"),
    )


def said(folder: Path) -> tuple[Finding, ...]:
    return ordered(findings(case(folder), catalogue()))
