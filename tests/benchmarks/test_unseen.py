"""How rows of unseen nodes are compared with an extraction."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from extracted import Evidence, Extraction, Interface, Module, Package, _Identity, _Signature
from unseen import Comparison, of_files
from unseen_format import SourceNode, SourceRow, load, resolved
from unseen_match import best

TRUTH = Path(__file__).parents[2] / "benchmarks" / "truth_unseen"


def _node(*rows: SourceRow, **given: Any) -> SourceNode:
    return SourceNode(node="n", name="n", package="p", files=["src/a.cpp"], interfaces=list(rows), **given)


def _one(role: str, name: str, line: int = 1, **given: Any) -> Interface:
    return Interface(role=role, name=name, raw_name=name, evidence=(Evidence("src/a.cpp", line),), **given)


def _figures(node: SourceNode, *found: Interface) -> dict[str, tuple[int, int]]:
    comparison = Comparison(node, list(found))
    comparison.run()
    shares = ((name, getattr(comparison.tally, name)) for name in comparison.tally.__struct_fields__)
    return {name: (share.right, share.of) for name, share in shares if share.of}


@pytest.mark.parametrize("path", sorted(TRUTH.rglob("[!.]*.yaml")), ids=lambda path: path.name)
def test_truth_files_are_read(path: Path) -> None:
    """Each row has the file and line that it was read at, among the files of its node."""
    if path.parent.name == "drawn":
        return
    for node in load(path).nodes:
        places = [(row.where or "").rpartition(":") for row in [*node.interfaces, *node.also]]
        assert all(file in node.files and line.isdigit() for file, _, line in places)


def test_what_is_found_and_what_is_false() -> None:
    """Found, typed, told by its full name, and what the source does not have."""
    node = _node(SourceRow("publisher", "~/a", type="m/msg/T", where="src/a.cpp:1", qos={"depth": 3}))
    right = _one("publisher", "/n/a", type="m/msg/T", qos={"depth": 3, "history": "keep_last"})
    assert _figures(node, right) == {
        "endpoints": (1, 1), "types": (1, 1), "names": (1, 1), "qos": (1, 1), "true": (1, 1),
        "typed": (1, 1),
    }  # fmt: skip
    other = _figures(node, _one("publisher", "/a", type="m/msg/S"), _one("subscriber", "/b"))
    assert other == {
        "endpoints": (1, 1),
        "types": (0, 1),
        "names": (0, 1),
        "qos": (0, 1),
        "true": (1, 2),
        "typed": (0, 2),
    }


def test_parameters_and_what_libraries_add() -> None:
    """A missing parameter costs its name and default; what a library adds is not counted."""
    added = [SourceRow("service_server", "~/set_parameters", where="src/a.cpp:2")]
    node = _node(SourceRow("parameter", "rate", where="src/a.cpp:1", default=5), also=added)
    assert _figures(node) == {"parameters": (0, 1), "names": (0, 1), "defaults": (0, 1)}
    found = _figures(node, _one("parameter", "rate", default=5), _one("service_server", "/n/set_parameters"))
    assert found == {"parameters": (1, 1), "names": (1, 1), "defaults": (1, 1), "true": (1, 1), "typed": (1, 1)}


def test_holes_are_alike_and_a_name_that_is_not_told_is_found_by_its_place() -> None:
    """`{i}` and `{item}` are one; `{topic}` alone is no pattern for everything."""
    row = SourceRow("publisher", "/robot{i}/scan", where="src/a.cpp:7")
    assert best(row, [_one("publisher", "/robot{item}/scan")], _node(row)) is not None
    assert best(row, [_one("publisher", "/{topic}", line=8)], _node(row)) is None
    assert best(row, [_one("publisher", "/{topic}", line=7)], _node(row)) is not None
    assert resolved("~/a{b}", "n") == "/n/a{}"


def test_rows_are_those_with_evidence_in_the_files_of_the_node() -> None:
    """Paths are from the root of the repository, evidence may be from the package; two types stay two."""
    rows = [_one("publisher", "/a", type="m/msg/T"), _one("publisher", "/a", type="m/msg/S")]
    elsewhere = Interface("publisher", "/b", evidence=(Evidence("src/b.cpp", 1),))
    module = Module(_Identity("ecm.p.n"), _Signature((*rows, elsewhere)))
    extraction = Extraction("s", (Package("p", ".", (module,)), Package("q", ".", (module,))))
    assert [one.type for one in of_files(_node(), extraction)] == ["m/msg/T", "m/msg/S"]


def test_one_name_told_with_several_types_is_several_rows() -> None:
    """Only the row of the type that the source has is true in its type; among names that are open it is found by it."""
    node = _node(SourceRow("parameter", "rate", type="double", where="src/a.cpp:1"))
    told = [_one("parameter", "rate", type=kind) for kind in ("double", "bool", "string")]
    figures = _figures(node, *told)
    assert (figures["true"], figures["typed"], figures["types"]) == ((3, 3), (1, 3), (1, 1))
    row = SourceRow("publisher", "a{serial}", type="m/msg/T", where="src/a.cpp:7")
    open_ones = [_one("publisher", "/{topic}", line=7, type=kind) for kind in ("m/msg/S", "m/msg/T")]
    found = best(row, open_ones, _node(row))
    assert found is not None
    assert found.type == "m/msg/T"
