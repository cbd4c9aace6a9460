"""Small packages from texts: files in, contracts out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ecm_checker.contract import Contract, Interface

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.link.running.faults import CODE
from ecm_extract.tree import open_tree

_HEAD = "<name>{name}</name><version>1.0.0</version>"
MANIFESTS = {
    1: f'<package format="2">{_HEAD}<buildtool_depend>catkin</buildtool_depend></package>',
    2: f'<package format="3">{_HEAD}<export><build_type>ament_cmake</build_type></export></package>',
}


class Workspace:
    """Writes packages below a folder and extracts them."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def package(self, files: Mapping[str, str], ros: int = 2, name: str = "pkg") -> Workspace:
        for path, text in {"package.xml": MANIFESTS[ros].format(name=name), **files}.items():
            target = self.root / name / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, "utf-8")
        return self

    def modules(self) -> dict[str, Contract]:
        extraction = extract(open_tree(self.root), Options(jobs=1, cache=False))  # no tree is read twice
        assert not [entry for entry in extraction.diagnostics if entry.code == CODE]
        return {m.ecm.module_id: m for package in extraction.packages for m in package.modules}

    def interfaces(self) -> list[Interface]:
        return [entry for module in self.modules().values() for entry in module.signature.interfaces]

    def only(self, role: str) -> Interface:
        found = [entry for entry in self.interfaces() if entry.role == role]
        assert len(found) == 1, [(entry.role, entry.name) for entry in self.interfaces()]
        return found[0]
