"""Plugin descriptions give the classes that a loader can ask for."""

import pytest
from ecm_parsers.plugin_xml import PluginClass, parse
from hypothesis import given, settings
from hypothesis import strategies as st

CLASS = '<class name="n" type="a::B" base_class_type="c::D"/>'
LIBRARIES = f'<library path="l">{CLASS}</library>\n<library path="m">{CLASS}</library>'


def test_class() -> None:
    """A class keeps its library, its base, its description and its line."""
    text = (
        '<library path="libarm">\n <class name="arm/Fast"\n  type="arm::Fast" base_class_type="core::Arm">\n'
        "  <description> Moves\n fast.</description>\n </class>\n</library>\n"
    )
    parsed = parse(text.encode())
    assert parsed.diagnostics == ()
    assert parsed.facts == (PluginClass("arm/Fast", "arm::Fast", "core::Arm", "libarm", "Moves fast.", 2),)


@pytest.mark.parametrize(
    ("text", "libraries"),
    [
        (f'<library path="l">{CLASS}</library>', ["l"]),
        (f"<class_libraries>{LIBRARIES}</class_libraries>", ["l", "m"]),
        (f'<?xml version="1.0"?>\n{LIBRARIES}', ["l", "m"]),
        ('<library path="l"><!-- <class name="x"/> --></library>', []),
    ],
)
def test_roots(text: str, libraries: list[str]) -> None:
    """One library, several side by side and several in `<class_libraries>` all count."""
    parsed = parse(text.encode())
    assert parsed.diagnostics == ()
    assert [plugin.library for plugin in parsed.facts] == libraries


def test_name_defaults_to_type() -> None:
    """A class without a name is looked up by its type."""
    parsed = parse(b'<library path="l"><class type="a::B" base_class_type="c::D"/></library>')
    assert parsed.facts[0].lookup_name == "a::B"


@pytest.mark.parametrize(("written", "malformed"), [("a::B&lt;c::D, int&gt;", False), ("a::B<c::D, int>", True)])
def test_templates(written: str, malformed: bool) -> None:
    """Template arguments are read escaped, and unescaped as tinyxml does, with a diagnostic."""
    text = f'<library path="l"><class name="n" type="{written}" base_class_type="{written}"/></library>'
    parsed = parse(text.encode())
    assert (parsed.facts[0].type, parsed.facts[0].base_class_type) == ("a::B<c::D, int>",) * 2
    assert bool(parsed.diagnostics) is malformed


@pytest.mark.parametrize(
    ("text", "codes", "count"),
    [
        ("\n<launch/>", [("plugin-wrong-root", 2)], 0),
        (f"\n<library>{CLASS}</library>", [("plugin-no-path", 2)], 1),
        ('<library path="l">\n<class name="n" type="t"/></library>', [("plugin-incomplete", 2)], 1),
        ('<library path="l">\n<class/></library>', [("plugin-incomplete", 2)], 0),
        ("", [("xml-empty", 0)], 0),
    ],
)
def test_problems(text: str, codes: list[tuple[str, int]], count: int) -> None:
    """What a loader would refuse is a diagnostic on its line."""
    parsed = parse(text.encode())
    assert [(found.code, found.line) for found in parsed.diagnostics] == codes
    assert len(parsed.facts) == count


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(["<library>", "</library>", "<class", " name='x'", ">", "/>", "<a", "y"])))
def test_never_raises(parts: list[str]) -> None:
    """Any broken description gives a tuple of classes."""
    assert isinstance(parse("".join(parts).encode()).facts, tuple)
