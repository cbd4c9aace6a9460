"""XML of strangers is read without entities, without network and within bounds."""

import time

import pytest
from ecm_parsers.xml_tree import (
    MAX_ATTRIBUTES,
    MAX_BYTES,
    MAX_DEPTH,
    children,
    line_of,
    parse_xml,
    text_of,
    without_comments,
)
from hypothesis import given, settings
from hypothesis import strategies as st

_BOMB = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 20))


def codes(data: bytes) -> list[tuple[str, int]]:
    return [(found.code, found.line) for found in parse_xml(data).diagnostics]


def test_lines_and_text() -> None:
    """Elements keep the line of the file, whatever its line ends and declaration."""
    tree = parse_xml(b'\r\n\r\n<?xml version="1.0"?>\r\n<a>\r\n<!-- no -->\r\n<b> x\r\n<c>y</c> </b></a>')
    assert tree.root is not None
    assert tree.diagnostics == ()
    assert [(tag, line_of(child), text_of(child)) for tag, child in children(tree.root)] == [("b", 6, "x y")]


@pytest.mark.parametrize("noise", ["", "<!-- <x\n> -->", "<![CDATA[<x>]]>", "<?pi <x> ?>", "<c d='>'/>"])
@pytest.mark.parametrize("many_roots", [False, True])
def test_line_is_where_the_tag_begins(noise: str, many_roots: bool) -> None:
    """An element whose attributes span lines is found at its first line."""
    text = f'{noise if many_roots else ""}<a>{noise}\n<b\n x="<1>"\n y="2"/></a>'
    tree = parse_xml(text.replace("<1>", "1>").encode(), many_roots=many_roots)
    last = list(tree.roots[-1])[-1]
    assert (last.tag, line_of(last)) == ("b", text[: text.index("<b")].count("\n") + 1)


@pytest.mark.parametrize(
    "data",
    [
        f'<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY e0 "x">{_BOMB}]>\n<a>&e19;</a>'.encode(),
        f'\n<!DOCTYPE a [<!ENTITY e0 "x">{_BOMB}]>\n<a b="&e19;"/>'.encode("utf-16"),
        b'\n<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/hostname">]>\n<a>&x;</a>',
        b'\n<!DOCTYPE a [<!ENTITY % x SYSTEM "http://localhost/x"> %x;]>\n<a/>',
    ],
)
def test_entities_are_refused_at_once(data: bytes) -> None:
    """An entity bomb, or a file read through an entity, is a diagnostic in under a second."""
    started = time.process_time()
    assert codes(data) == [("xml-entity", 2)]
    assert parse_xml(data).root is None
    assert time.process_time() - started < 1


def test_external_dtd_is_not_loaded() -> None:
    """A DTD elsewhere is neither fetched nor needed."""
    tree = parse_xml(b'<!DOCTYPE a SYSTEM "http://localhost:1/a.dtd"><a/>')
    assert tree.root is not None
    assert tree.diagnostics == ()


def test_an_element_with_too_many_attributes_loses_them() -> None:
    """Looking one up would cost as much as there are; the other elements keep theirs."""
    crowd = " ".join(f'a{at}="1"' for at in range(MAX_ATTRIBUTES + 1))
    tree = parse_xml(f'<a>\n<b {crowd}/><c d="1"/></a>'.encode())
    assert [(entry.code, entry.line) for entry in tree.diagnostics] == [("xml-too-many-attributes", 2)]
    assert tree.root is not None
    assert [dict(child.attrib) for _, child in children(tree.root)] == [{}, {"d": "1"}]


def test_comments_are_blank_and_lines_stay() -> None:
    """What is commented out is gone; a comment that never ends is no comment."""
    assert without_comments(b"<a>\n<!-- x\ny -->\n<b/>") == b"<a>\n      \n     \n<b/>"
    assert without_comments(b"a = '<!--'") == b"a = '<!--'"


@pytest.mark.parametrize("depth", [MAX_DEPTH + 1, 1_000, 1_000_000])
def test_depth_is_bounded(depth: int) -> None:
    """Nesting beyond the bound is refused, closed or not."""
    assert ("xml-too-deep", 0) in codes(b"<a>" * depth)
    assert parse_xml(b"<a>" * depth).root is None


def test_depth_at_the_bound_is_read() -> None:
    """The bound itself is allowed."""
    assert codes(b"<a>" * MAX_DEPTH + b"</a>" * MAX_DEPTH) == []


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"", [("xml-empty", 0)]),
        (b" \n\0", [("text-nul", 2), ("xml-empty", 0)]),
        (b"x" * (MAX_BYTES + 1), [("xml-too-large", 0)]),
        (b"<a>\n<b>\n</a>", [("xml-malformed", 3)]),
        (b'<a>\n<b x:y="1"/></a>', [("xml-malformed", 2)]),
        (b"<a/>\n<b/>", [("xml-malformed", 2)]),
        (b"<a>\xe9</a>", [("text-not-utf8", 1)]),
        (b'<?xml version="1.0" encoding="ISO-8859-1"?><a>\xe9</a>', []),
    ],
)
def test_problems(data: bytes, expected: list[tuple[str, int]]) -> None:
    """Every problem is a diagnostic with its line."""
    assert codes(data) == expected


@pytest.mark.parametrize(
    "text",
    ["<a><!-- x -- y --><b/></a>", "<a>&nbsp;<b/></a>", '<a n="1 < 2"><b/></a>', "<x:a><x:b y:c='1'/></x:a>"],
)
def test_slips_that_ros_tolerates_lose_no_element(text: str) -> None:
    """Where tinyxml reads on, so do we, with a warning."""
    tree = parse_xml(text.encode())
    assert tree.root is not None
    assert [tag for tag, _ in children(tree.root)] == ["b"]
    assert {found.severity for found in tree.diagnostics} == {"warning"}


def test_many_roots() -> None:
    """Several roots are read where a format allows them, with the lines of the file."""
    tree = parse_xml(b'<?xml version="1.0"?>\n<a/>\n<!-- x -->\n<b/>', many_roots=True)
    assert [(root.tag, line_of(root)) for root in tree.roots] == [("a", 2), ("b", 4)]
    assert tree.diagnostics == ()


@pytest.mark.parametrize("part", [b"<a", b'<a "', b"<![CDATA[", b"<!--", b"<?", b"\n", b"<a/>", b"</a>", b"&a;"])
def test_hostile_repetition_ends_soon(part: bytes) -> None:
    """No repeated fragment makes reading more than linear."""
    started = time.process_time()
    parse_xml(b"<r>" + part * (500_000 // len(part)))
    parse_xml(part * (500_000 // len(part)) + b"<r/>")
    assert time.process_time() - started < 2


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="<>/ab&;!?\"'=[]-x\n\0", max_size=80), st.booleans())
def test_never_raises(text: str, many_roots: bool) -> None:
    """Any text gives roots or a diagnostic that says why not."""
    tree = parse_xml(text.encode(), many_roots=many_roots)
    assert bool(tree.roots) != any(found.severity == "error" for found in tree.diagnostics)
