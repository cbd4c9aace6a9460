"""`.msg`, `.srv` and `.action` of ROS 1 and ROS 2 give fields and constants with their lines."""

import time

import pytest
from ecm_parsers.interface import MAX_BYTES, parse
from ecm_parsers.interface_facts import SECTIONS, Constant, Field, Section, Shape
from hypothesis import given, settings
from hypothesis import strategies as st


def message(text: str) -> Section:
    parsed = parse(text.encode(), "msg")
    assert parsed.diagnostics == ()
    return parsed.facts.sections[0]


def field(text: str) -> Field:
    return message(text).fields[0]


def constant(text: str) -> Constant:
    return message(text).constants[0]


@pytest.mark.parametrize(
    ("text", "base", "package", "array", "bound", "string_bound"),
    [
        ("float64 x", "float64", None, "none", None, None),
        ("float64[] x", "float64", None, "unbounded", None, None),
        ("float64[9] x", "float64", None, "fixed", 9, None),
        ("float64[<=9] x", "float64", None, "bounded", 9, None),
        ("string<=10 x", "string", None, "none", None, 10),
        ("string<=10[<=5] x", "string", None, "bounded", 5, 10),
        ("wstring x", "wstring", None, "none", None, None),
        ("geometry_msgs/Pose[] x", "Pose", "geometry_msgs", "unbounded", None, None),
        ("geometry_msgs/msg/Pose x", "Pose", "geometry_msgs", "none", None, None),
        ("Waypoint x", "Waypoint", None, "none", None, None),
        ("Header x", "Header", "std_msgs", "none", None, None),
        ("time x", "time", None, "none", None, None),
        ("duration[2] x", "duration", None, "fixed", 2, None),
        ("  byte\tx  ", "byte", None, "none", None, None),
        ("@key int32 x", "int32", None, "none", None, None),
    ],
)
def test_types(
    text: str, base: str, package: str | None, array: str, bound: int | None, string_bound: int | None
) -> None:
    """Every way to write a type comes apart into element type, package, array kind and bounds."""
    read = field(text)
    assert (read.base, read.package, read.array) == (base, package, array)
    assert (read.bound, read.string_bound, read.name) == (bound, string_bound, "x")


@pytest.mark.parametrize(
    ("text", "default", "comment"),
    [
        ("float64 x", None, ""),
        ("float64 x 1.5", "1.5", ""),
        ("int32[] x [1, 2]  # two", "[1, 2]", "two"),
        ('string x "a # b" # c', '"a # b"', "c"),
        ("string x 'it' # isn't", "'it'", "isn't"),
        ("bool CamelCase true", "true", ""),
        ("bool x#glued", None, "glued"),
    ],
)
def test_defaults(text: str, default: str | None, comment: str) -> None:
    """A ROS 2 default ends where the comment starts, and a `#` in quotes starts none."""
    read = field(text)
    assert (read.default, read.comment) == (default, comment)


@pytest.mark.parametrize(
    ("text", "value", "whole", "comment"),
    [
        ("int32 X=1", "1", "1", ""),
        ("int32 X = -1  # one", "-1", "-1", "one"),
        ("uint8 X=0x1F", "0x1F", "0x1F", ""),
        ("string X=some text #no comment", "some text #no comment", "some text #no comment", ""),
        ('string X = "quoted" # why', "quoted", '"quoted" # why', "why"),
        ("string X='a=b'", "a=b", "'a=b'", ""),
        ("string X=it's", "it's", "it's", ""),
        ("string X=", "", "", ""),
        ('string<=5 X="ab"', "ab", '"ab"', ""),
    ],
)
def test_constants(text: str, value: str, whole: str, comment: str) -> None:
    """A ROS 1 string constant runs to the end of its line, a ROS 2 one to its closing quote."""
    read = constant(text)
    assert (read.name, read.value, read.text, read.comment) == ("X", value, whole, comment)


def test_comments_belong_to_their_declaration() -> None:
    """The block directly above and the indented continuation below go to the field, others to none."""
    section = message(
        "# licence\n\n# speed of\n# the base\nfloat64 v # [m/s]\n          # forward\n# next\nfloat64 w\n"
    )
    first, second = section.fields
    assert (first.doc, first.comment, first.unit, first.line) == (
        "speed of\nthe base",
        "[m/s]\nforward",
        "m/s",
        5,
    )
    assert (second.doc, second.comment, second.unit, second.line) == ("next", "", None, 8)


def test_unit_above_counts_when_nothing_trails() -> None:
    """A unit in the block above is the field's, and text fields have none."""
    assert field("# in metres\nfloat64 x").unit == "m"
    assert field("string x # m").unit is None


@pytest.mark.parametrize(
    ("shape", "text", "counts"),
    [
        ("msg", "", [0]),
        ("srv", "int8 a\n---\nint8 a\nint8 b\n", [1, 2]),
        ("srv", "---", [0, 0]),
        ("action", "int8 a\n---\n----\nint8 b # x\n", [1, 0, 1]),
    ],
)
def test_sections(shape: Shape, text: str, counts: list[int]) -> None:
    """`---` parts the sections that the suffix asks for, empty ones included."""
    parsed = parse(text.encode(), shape)
    assert parsed.diagnostics == ()
    assert [section.name for section in parsed.facts.sections] == list(SECTIONS[shape])
    assert [len(section.fields) for section in parsed.facts.sections] == counts


@pytest.mark.parametrize(
    ("shape", "text", "code", "line"),
    [
        ("msg", "int8 a\nint8\n", "interface-bad-line", 2),
        ("msg", "int8[x] a", "interface-bad-line", 1),
        ("msg", "int8[<=] a", "interface-bad-line", 1),
        ("msg", "Pose X=1", "interface-bad-line", 1),
        ("msg", "int8 X=", "interface-bad-line", 1),
        ("msg", "int32<=3 a", "interface-bad-line", 1),
        ("msg", "int8 a-b", "interface-bad-line", 1),
        ("msg", "int8 a\n\nint16 a", "interface-duplicate", 3),
        ("msg", "int8 a\n---\nint8 b", "interface-separators", 2),
        ("srv", "int8 a", "interface-separators", 0),
        ("action", "---\n---\n\n---\n", "interface-separators", 4),
    ],
)
def test_problems_have_a_line(shape: Shape, text: str, code: str, line: int) -> None:
    """What cannot be read is one diagnostic on its line, and the rest is still read."""
    parsed = parse(text.encode(), shape)
    assert [(found.code, found.line) for found in parsed.diagnostics] == [(code, line)]
    assert len(parsed.facts.sections) == len(SECTIONS[shape])


def test_unknown_shape_is_a_diagnostic() -> None:
    """A suffix that is no interface does not raise."""
    parsed = parse(b"int8 a", "idl")  # type: ignore[arg-type]
    assert [found.code for found in parsed.diagnostics] == ["interface-unknown-shape"]


@pytest.mark.parametrize("line", [b"int8 a", b"#", b"string X='", b"'\"#", b"a" * 500, b'int8 x "\\'])
def test_large_files_are_bounded(line: bytes) -> None:
    """A file beyond the limit is skipped and one just below is read in seconds."""
    assert parse(line * (MAX_BYTES // len(line) + 1), "msg").diagnostics[0].code == "interface-too-large"
    started = time.process_time()
    parse((line * (300_000 // len(line)))[:300_000], "msg")
    parse(((line + b"\n") * 150_000)[:300_000], "msg")
    assert time.process_time() - started < 4


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="int8 string<=[]'\"#=-x\n\t@/", max_size=120), st.sampled_from(["msg", "srv", "action"]))
def test_never_raises(text: str, shape: Shape) -> None:
    """Any text gives a definition whose facts carry lines of that text."""
    parsed = parse(text.encode(), shape)
    lines = text.count("\n") + 1
    for section in parsed.facts.sections:
        assert all(1 <= item.line <= lines for item in section.fields)
        assert all(1 <= item.line <= lines for item in section.constants)


@pytest.mark.parametrize("text", [f"int8[{'9' * 5000}] x", f"int8[<={'9' * 5000}] x", f"string<={'9' * 5000} x"])
def test_a_bound_beyond_all_sizes_is_no_bound(text: str) -> None:
    """A length of thousands of digits is told like any other line that is no field."""
    parsed = parse(text.encode(), "msg")
    assert parsed.facts.sections[0].fields == ()
    assert len(parsed.diagnostics) == 1
