"""What sources require does not depend on modules, so that another process may read it off while these are found."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.reader import Reader
from ecm_extract.requires.collect import Required, source_requirements
from ecm_extract.tree import open_tree

FIXTURES = Path(__file__).parents[2] / "fixtures"


def _sorted(found: Required) -> dict[str, list[str]]:
    return {package: sorted(map(repr, entries)) for package, entries in found.items()}


@pytest.mark.parametrize("name", ["arm_robot", "demo_robot", "path_a", "lint"])
def test_what_sources_require_is_known_before_modules_are(name: str) -> None:
    """What is read off once parameters are declared is what is read off when all is linked."""
    packages = Reader(open_tree(FIXTURES / name), cached=False).read(1, None)
    linker = Linker(packages, form_table())
    linker.declare()
    before = source_requirements(linker.program, linker.folder.objects)
    linker.attributed()
    assert before
    assert _sorted(source_requirements(linker.program, linker.folder.objects)) == _sorted(before)
