"""Runs `ecm-extract` and reads its JSON (DESIGN §6): the interfaces of every module, with their evidence."""

from __future__ import annotations

import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from shutil import which

import msgspec

RESOLVED = {"literal", "folded", "default"}


class Evidence(msgspec.Struct, frozen=True):
    """A place in a tree, 1-based."""

    path: str
    line: int
    end_line: int | None = None


class Interface(msgspec.Struct, frozen=True):
    """What the benchmarks read of an interface."""

    role: str
    name: str = ""
    raw_name: str = ""
    type: str | None = None
    confidence: str = "pattern"
    evidence: tuple[Evidence, ...] = ()
    qos: dict[str, object] | None = None
    default: object = None


class _Signature(msgspec.Struct, frozen=True):
    interfaces: tuple[Interface, ...] = ()


class _Identity(msgspec.Struct, frozen=True):
    module_id: str
    kind: str = ""


class Module(msgspec.Struct, frozen=True):
    """One module of a package."""

    ecm: _Identity
    signature: _Signature = _Signature()


class Diagnostic(msgspec.Struct, frozen=True):
    """What the tool says of its own reading."""

    code: str
    message: str = ""


class Package(msgspec.Struct, frozen=True):
    """One package of the tree; `path` is where its package.xml lies."""

    name: str
    path: str = ""
    modules: tuple[Module, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()


class Extraction(msgspec.Struct, frozen=True):
    """The answer for one tree; keys that the benchmarks do not read are ignored."""

    schema: str
    packages: tuple[Package, ...] = ()


class Index:
    """The interfaces of a tree by the file of their evidence."""

    def __init__(self, extraction: Extraction) -> None:
        self._by_path: dict[str, list[tuple[int, int, Interface]]] = defaultdict(list)
        for package, interface in _interfaces(extraction):
            for place in interface.evidence:
                span = (place.line, place.end_line or place.line, interface)
                for path in {place.path, f"{package.path}/{place.path}".lstrip("./")}:
                    self._by_path[path].append(span)

    def overlapping(self, path: str, line: int, end_line: int) -> list[Interface]:
        """Interfaces with evidence in `path` on any line from `line` to `end_line`."""
        return [found for start, end, found in self._by_path[path] if start <= end_line and line <= end]


def _interfaces(extraction: Extraction) -> Iterator[tuple[Package, Interface]]:
    for package in extraction.packages:
        for module in package.modules:
            for interface in module.signature.interfaces:
                yield package, interface


def command() -> str:
    """The installed `ecm-extract`: the one beside this interpreter, else the first on the path."""
    beside = Path(sys.executable).with_name("ecm-extract")
    found = str(beside) if beside.exists() else which("ecm-extract")
    if found is None:
        sys.exit("ecm-extract is not installed: run `pip install -e .` in the root of the project first")
    return found


def extract(tree: Path, saved: Path | None = None) -> Extraction:
    """Extract `tree`, or read the JSON that an earlier run saved."""
    data = saved.read_bytes() if saved else _run(tree)
    extraction = msgspec.json.decode(data, type=Extraction)
    for package in extraction.packages:
        for fault in [found for found in package.diagnostics if found.code == "function-left-out"]:
            print(f"FAULT of the tool in {tree.name}, {package.name}: {fault.message}", file=sys.stderr)
    return extraction


def _run(tree: Path) -> bytes:
    line = [command(), str(tree), "--format", "json", "-o", "-"]
    done = subprocess.run(line, capture_output=True, check=False)
    if not done.stdout:
        sys.exit(f"{' '.join(line)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")
    return done.stdout
