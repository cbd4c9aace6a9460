"""Documented nodes are compared by name, role and type, and every difference has a line."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from accuracy import ENDPOINTS, Comparison, of_node
from extracted import Evidence, Extraction, Interface
from truth_format import Row, Truth, covered, load, same_name, same_type

ROLES = ENDPOINTS | {"parameter"}
TRUTH = Path(__file__).parents[2] / "benchmarks" / "truth"


@pytest.mark.parametrize(
    ("documented", "names", "expected"),
    [
        ("~rate", ("/node/rate", "~rate"), True),
        ("/odom", ("/node/odom", "odom"), True),
        ("a.b", ("/node/a.b",), True),
        ("rate", ("/node/frame_rate", "frame_rate"), False),
    ],
)
def test_names_are_compared_below_any_namespace(documented: str, names: tuple[str, ...], expected: bool) -> None:
    """A document names a topic or parameter without the node that holds it."""
    assert same_name(documented, names) is expected


def test_types_are_compared_across_spellings() -> None:
    """ROS 1 and ROS 2 spellings of a type, and C++ and Python names of parameter types, are one."""
    assert same_type("std_msgs/String", "std_msgs/msg/String")
    assert same_type("double", "float")
    assert not same_type("int", "double")


def test_a_pattern_covers_only_what_it_says_something_about() -> None:
    """A name that is nothing but a hole proves nothing, unless the document itself leaves it open."""
    assert covered("color/camera_info", ("/node/{stream}/camera_info",))
    assert not covered("color/image_raw", ("/node/{stream}/camera_info",))
    assert not covered("color/image_raw", ("{name}",))
    assert covered("{source_list}", ("/{source}",))


def _truth() -> Truth:
    return Truth(
        node="n",
        tree="t",
        ref="main",
        commit="0",
        package="p",
        module="n",
        files=[],
        documents=[],
        complete=["publisher", "parameter"],
        interfaces=[Row("publisher", "/a", "std_msgs/msg/String"), Row("parameter", "gone", "int")],
        undocumented=[Row("parameter", "extra", where="a.cpp:2")],
    )


@pytest.mark.parametrize(("file", "found"), [("src/", 1), ("src/a.cpp", 1), ("src/b/", 0), ("rc/", 0)])
def test_what_stands_below_a_folder_of_the_node_is_the_nodes(file: str, found: int) -> None:
    """Where no module is called as the node is, its files tell, and a folder stands for all that lies below it."""
    interface = {"role": "publisher", "name": "/a", "evidence": [{"path": "p/src/a.cpp", "line": 1}]}
    module = {"ecm": {"module_id": "ecm.p.other"}, "signature": {"interfaces": [interface]}}
    package = {"name": "p", "path": "p", "modules": [module]}
    truth = msgspec.structs.replace(_truth(), module="^n$", files=[file])
    extraction = msgspec.convert({"schema": "", "packages": [package]}, Extraction)
    assert len(of_node(truth, extraction)[0]) == found


def test_every_difference_is_counted_and_has_a_line() -> None:
    """Missing, wrong, undocumented and invented interfaces are told apart; the framework's are left out."""
    place = (Evidence("a.cpp", 1),)
    interfaces = [
        Interface("publisher", "/a", "a", "std_msgs/msg/Bool", "literal", place),
        Interface("parameter", "/n/extra", "extra", "int", "literal", place),
        Interface("parameter", "/n/invented", "invented", "int", "literal", place),
        Interface("publisher", "/rosout", "/rosout", None, "literal", place),
        Interface("subscriber", "/b", "b", None, "literal", place),
    ]
    comparison = Comparison(_truth(), interfaces)
    score = comparison.score(ROLES)
    assert (score.documented, score.found, score.type_right) == (2, 1, 0)
    assert (score.extracted, score.right) == (3, 2)
    assert [line.split()[0] for line in comparison.lines] == ["~", "-", "o", "+"]


@pytest.mark.parametrize("path", sorted(TRUTH.glob("*.yaml")), ids=lambda path: path.stem)
def test_truth_files_are_well_formed(path: Path) -> None:
    """Each names its documents, the commit that was read, and roles of the contract, once each."""
    truth = load(path)
    rows = [*truth.interfaces, *truth.undocumented, *truth.absent]
    assert truth.documents
    assert len(truth.commit) == 40
    assert truth.interfaces
    assert {row.role for row in rows} | set(truth.complete) <= ROLES
    assert len({(row.role, row.name) for row in rows}) == len(rows)
    assert all(row.where for row in (*truth.undocumented, *truth.absent))
