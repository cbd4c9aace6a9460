"""Predictions: findings of `ecm-extract check` (or `diff`) on contracts that are extracted from the fixtures."""

from __future__ import annotations

import atexit
import json
from contextlib import redirect_stdout
from dataclasses import dataclass
from functools import cache
from io import BytesIO, TextIOWrapper
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp

from ecm_checker.contract import Contract

from ecm_extract.check_inputs import subject
from ecm_extract.cli.run import run
from path_a.row import FIXTURES


@dataclass(frozen=True)
class Predicted:
    """A finding: its rule and what it says."""

    rule: str
    message: str


def check(*arguments: str) -> tuple[Predicted, ...]:
    """Findings of `ecm-extract check`, without those about what nobody declared."""
    found = _run("check", *arguments)
    return tuple(Predicted(each["rule"], each["message"]) for each in found if each["rule"] != "VER005")


def diff(*arguments: str) -> tuple[Predicted, ...]:
    """Findings of `ecm-extract diff`."""
    return tuple(Predicted(each["rule"], each["message"]) for each in _run("diff", *arguments))


def rules(found: tuple[Predicted, ...]) -> str:
    return ", ".join(sorted({each.rule for each in found})) or "nothing against it"


@cache
def manifests(package: str) -> Path:
    """The folder with the manifests of a fixture package, which stays as long as this process."""
    folder = Path(mkdtemp(prefix="path_a_"))
    atexit.register(rmtree, folder, ignore_errors=True)
    _told(str(FIXTURES / package), "-o", str(folder), "-q")
    return folder


def manifest(package: str, module: str) -> str:
    """The manifest of a module of a fixture package."""
    return str(next(manifests(package).rglob(f"*.{module}.ecm.yaml")))


def contract(package: str, module: str) -> Contract:
    """The contract of a module of a fixture package."""
    (found,) = subject(manifest(package, module)).contracts
    return found


def _run(command: str, *arguments: str) -> list[dict[str, str]]:
    told = _told(command, *arguments, "--format", "json", "--fail-on", "never")
    found: list[dict[str, str]] = json.loads(told)["findings"]
    return found


def _told(*arguments: str) -> str:
    """What the program prints; it runs in this process, which has loaded it."""
    with redirect_stdout(TextIOWrapper(BytesIO(), "utf-8")) as printed:
        status = run([*arguments, "--no-cache"])
    if status:
        message = f"ecm-extract {' '.join(arguments)} ended with status {status}"
        raise RuntimeError(message)
    printed.seek(0)
    return printed.read()
