from __future__ import annotations

import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from memory_files import MemoryFiles, robot

from ecm_extract.description.element import Element
from ecm_extract.description.model import Problem
from ecm_extract.description.xacro import Xacro

FILES = {
    "arm/config/limits.yaml": "limits:\n  elbow: {max: !degrees 180, names: [a, b]}\nwidth: 0.5\n",
    "arm/parts/left.xacro": robot('<xacro:macro name="left" params=""><left/></xacro:macro>'),
    "arm/parts/right.xacro": robot('<xacro:macro name="right" params=""><right/></xacro:macro>'),
    "arm/parts/deep/right.xacro": robot("<deep/>"),
    "arm/urdf/part.xacro": robot(
        '<xacro:property name="size" value="3"/><xacro:property name="twice" value="${size * 2}"/>'
        '<xacro:macro name="helper" params="n"><h n="${n}" size="${size}"/></xacro:macro>'
        '<xacro:macro name="part" params="n"><xacro:helper n="${n}"/></xacro:macro>'
    ),
}
PART = '<xacro:macro name="part" params="{params}">{body}</xacro:macro>'
EXPANSIONS = [
    ('<xacro:property name="w" value="2"/><link name="a${w + 1}_${w}"/>', "link name=a3_2"),
    ('<xacro:property name="n" value="left"/><link name="${n}_${n.upper()}"/>', "link name=left_LEFT"),
    ('<xacro:property name="a" value="${b * 2}"/><xacro:property name="b" value="1.5"/><x v="${a}"/>', "x v=3.0"),
    ('<xacro:property name="a" value="1"/><xacro:property name="a" default="2"/><x v="${a}"/>', "x v=1"),
    ('<xacro:property name="a" default="2"/><x v="${a}"/>', "x v=2"),
    ('<xacro:property name="a" value="010"/><x v="${a}" w="${a * 1}"/>', "x v=10 w=10"),
    ('<xacro:property name="a" value="1_0"/><x v="${a}"/>', "x v=1_0"),
    ('<xacro:property name="a" value="True"/><x v="${not a}"/>', "x v=False"),
    (('<xacro:property name="a" value="1"/><xacro:property name="b" value="${a}" lazy_eval="false"/>'
     '<xacro:property name="a" value="2"/><x v="${b}"/>'), "x v=1"),
    ('<xacro:property name="o"><origin xyz="1 2 3"/><axis/></xacro:property><j><xacro:insert_block name="o"/></j>',
     "j; origin xyz=1 2 3; axis"),
    ("<x v='$${w} $$$(x) $ $1'/>", "x v=${w} $$(x) $ $1"),
    ("<x v=\"${dict(a=1)['a']}${[1, 2][1]}\"/>", "x v=12"),
    ("<t>${1 + 1} m</t>", "t 2 m"),
    ('<xacro:arg name="n" default="left"/><x v="$(arg n)_arm"/>', "x v=left_arm"),
    ("<xacro:arg name='n' default='2'/><x v='$(eval n * 2)' w='${xacro.arg(\"n\")}'/>", "x v=4 w=2"),
    (PART.format(params="a b:=2 c:='x y'", body='<p a="${a}" b="${b}" c="${c}"/>') + '<xacro:part a="1"/>',
     "p a=1 b=2 c=x y"),
    (PART.format(params="a b=${3*4} c:=^|7", body='<p a="${a}" b="${b}" c="${c}"/>') + '<xacro:part a="1"/>',
     "p a=1 b=12 c=7"),
    ('<xacro:property name="c" value="5"/>' + PART.format(params="c:=^", body='<p c="${c}"/>') + "<xacro:part/>",
     "p c=5"),
    (PART.format(params="*one **many", body='<xacro:insert_block name="many"/><xacro:insert_block name="one"/>')
     + '<xacro:part><o n="1"/><all><m n="1"/><m n="2"/></all></xacro:part>', "m n=1; m n=2; o n=1"),
    (PART.format(params="n", body='<p n="${n}"/>') + '<xacro:property name="which" value="part"/>'
     '<xacro:call macro="${which}" n="1"/>', "p n=1"),
    (PART.format(params="n", body='<xacro:if value="${n > 0}"><p n="${n}"/><xacro:part n="${n - 1}"/></xacro:if>')
     + '<xacro:part n="3"/>', "p n=3; p n=2; p n=1"),
    (PART.format(params="", body='<xacro:property name="a" value="1" scope="parent"/>') + "<xacro:part/><x v='${a}'/>",
     "x v=1"),
    (PART.format(params="", body='<xacro:property name="a" value="1"/>')
     + '<xacro:property name="a" value="0"/><xacro:part/><x v="${a}"/>', "x v=0"),
    (('<xacro:if value="1"><a/></xacro:if><xacro:if value="false"><b/></xacro:if>'
     '<xacro:unless value="${0}"><c/></xacro:unless><xacro:unless value="${1 == 1}"><d/></xacro:unless>'), "a; c"),
    ('<xacro:include filename="part.xacro"/><xacro:part n="${size}"/>', "h n=3 size=3"),
    ('<xacro:include filename="$(find arm)/urdf/part.xacro" ns="p"/><xacro:p.part n="${p.twice}"/>', "h n=6 size=3"),
    ('<xacro:include filename="none.xacro" optional="true"/><a/>', "a"),
    ('<xacro:include filename="$(find arm)/parts/*.xacro"/><xacro:left/><xacro:right/>', "left; right"),
    ('<xacro:include filename="$(find arm)/none/*.xacro"/><a/>', "a"),
    (PART.replace("part", "imu").format(params="frame", body="<imu><noise/></imu>") + '<xacro:imu frame="f"/>',
     "imu; noise"),
    (PART.format(params="a b:=1", body='<p a="${a}" b="${b}"/>') + '<part a="2"/><part b="2"/>',
     "p a=2 b=1; part b=2"),
    ('<xacro:element xacro:name="${1 + 1 == 2 and \'joint\'}" name="j"/>', "joint name=j"),
    ('<j><xacro:attribute name="t" value="${1 + 1}"/></j>', "j t=2"),
    (("<xacro:property name=\"y\" value=\"${xacro.load_yaml('$(find arm)/config/limits.yaml')}\"/>"
     "<x v=\"${y['limits']['elbow']['max']}\" w=\"${y.width}\" n=\"${y['limits']['elbow']['names'][1]}\"/>"),
     "x n=b v=3.141592653589793 w=0.5"),
    (("<x v=\"${[load_yaml('$(find arm)/config/' + f)['limits']['elbow']['names'][1] for f in ['limits.yaml']]}\""
     " w=\"${xacro.tokenize('a, b;c')[2]}\" n=\"${xacro.warning('careful') + 'b'}\"/>"), "x n=b v=['b'] w=c"),
    ("<xacro:include filename=\"${xacro.abs_filename('part.xacro')}\"/><xacro:part n=\"1\"/>", "h n=1 size=3"),
    (("<xacro:property name='twice' value='${lambda n: n * scale}'/><xacro:property name='scale' value='2'/>"
     "<x v='${twice(3)}' w=\"${' '.join([a + str(b) for a, b in dict(k=1, m=2).items()])}\"/>"), "x v=6 w=k1 m2"),
]  # fmt: skip


def shown(root: Element | None) -> str:
    if root is None:
        return "nothing"
    entries = []
    for element in list(root.walk())[1:]:
        attributes = [f"{name}={value}" for name, value in sorted(element.attributes.items())]
        entries.append(" ".join([element.tag, *attributes, *element.text.split()]))
    return "; ".join(entries)


def expanded(body: str, **arguments: str) -> tuple[str, list[Problem]]:
    xacro = Xacro(MemoryFiles({**FILES, "arm/urdf/a.xacro": robot(body)}), arguments)
    root = xacro.expand("arm/urdf/a.xacro")
    return shown(root), xacro.problems


@pytest.mark.parametrize(("body", "result"), EXPANSIONS)
def test_a_description_expands_as_xacro_expands_it(body: str, result: str) -> None:
    """What xacro makes of a document, the expansion makes of it, without a problem."""
    assert expanded(body) == (result, [])


@pytest.mark.parametrize(
    ("body", "result", "messages"),
    [
        ('<x v="$(arg p)_joint"/>', "x v={p}_joint", ["`$(arg p)` is known at launch only"]),
        ('<x v="$(env HOME)/a"/>', "x v={HOME}/a", ["`$(env HOME)` is known at launch only"]),
        ('<x v="${none + 1}"/>', "x v={none + 1}", ["`none` has no value here. Define it."]),
        (
            (
                "<xacro:arg name='m'/><xacro:property name='m' value='$(arg m)'/>"
                "<xacro:if value=\"${m == 'a'}\"><a/></xacro:if><xacro:unless value=\"${m == 'a'}\"><b/></xacro:unless>"
            ),
            "a; b",
            [
                "`$(arg m)` is known at launch only",
                "condition `{m == 'a'}` is known at launch only; it is read as if it held",
            ],
        ),
        (
            "<xacro:property name='y' value=\"${load_yaml('none.yaml')}\"/><x v=\"${y['a']['b'] * 2}\"/>",
            "x v={y['a']['b'] * 2}",
            ["file `none.yaml` is not in the tree"],
        ),
        (
            '<xacro:if value="yes"><a/></xacro:if>',
            "a",
            ["condition `yes` is no truth value; it is read as if it held"],
        ),
        ('<xacro:include filename="none.xacro"/><a/>', "a", ["included file `none.xacro` is not in the tree"]),
        (
            "<xacro:arg name='m'/><x v=\"${[part + 'x' for part in [xacro.arg('m')]]}\"/>",
            "x v=['{m}x']",
            ["`arg('m')` is known at launch only"],
        ),
        (
            (
                "<xacro:arg name='m'/><xacro:property name='l' value=\"${[xacro.arg('m'), 'b']}\"/>"
                "<xacro:if value=\"${l[0] == 'b'}\"><a/></xacro:if><x v='${l[0]}_x'/>"
            ),
            "a; x v={m}_x",
            [
                "`arg('m')` is known at launch only",
                "condition `{l[0] == 'b'}` is known at launch only; it is read as if it held",
            ],
        ),
        (
            "<xacro:property name='n' value=\"${xacro.fatal('no')}\"/><x v='${n}'/>",
            "x v={xacro.fatal('no')}",
            ["The description ends itself: no"],
        ),
        (
            '<xacro:arg name="k" default=""/><xacro:include filename="$(arg k)/none.xacro"/>',
            "",
            ["included file `/none.xacro` is known at launch only"],
        ),
        (
            PART.format(params="a b c d", body="<p/>") + "<xacro:part/>",
            "p",
            ["`a`, `b`, `c` and 1 more are not given to macro `part`"],
        ),
        ("<xacro:none/><a/>", "a", ["macro `none` is not defined"]),
        (
            PART.format(params="n", body='<p n="${n}_x"/>') + "<xacro:part/>",
            "p n={n}_x",
            ["`n` is not given to macro `part`"],
        ),
        (
            PART.format(params="*b", body="<p/>") + '<xacro:part m="1"/>',
            "p",
            ["`*b` is not given to macro `part`", "macro `part` has no parameter `m`"],
        ),
    ],
)
def test_what_only_the_launch_knows_stays_a_pattern(body: str, result: str, messages: list[str]) -> None:
    """The known part of a value is kept, the rest is named once, with its cause and not what follows from it."""
    found, problems = expanded(body)
    assert found == result
    assert [each.message for each in problems] == messages


def test_arguments_come_before_defaults() -> None:
    """An argument of the launch replaces the default of the file."""
    assert expanded('<xacro:arg name="n" default="1"/><x v="$(arg n)"/>', n="2") == ("x v=2", [])


def test_elements_know_the_file_and_line_that_wrote_them() -> None:
    """An element made by an included macro points into the included file."""
    files = {"m.xacro": robot('\n<xacro:macro name="m">\n<link name="a"/></xacro:macro>')}
    main = robot('\n<xacro:include filename="m.xacro"/>\n\n<xacro:m/>\n<link name="b"/>')
    root = Xacro(MemoryFiles({**files, "a.xacro": main}), {}).expand("a.xacro")
    assert root is not None
    assert [(entry.path, entry.line) for entry in root.children] == [("m.xacro", 3), ("a.xacro", 5)]


def test_early_xacro_needs_no_prefix() -> None:
    """Files of the first xacro write property, macro, include and calls without the prefix."""
    body = '<property name="w" value="2"/><macro name="part" params="n"><p n="${n * w}"/></macro><part n="3"/>'
    assert expanded(body) == ("p n=6", [])


def test_xacro_of_ros_2_needs_the_prefix() -> None:
    """What has no prefix in a package of ROS 2 is an element of the description."""
    body = '<macro name="part" params="n"><p n="${n}"/></macro><part n="3"/>'
    root = Xacro(MemoryFiles({"a.xacro": robot(body)}, ros=2), {}).expand("a.xacro")
    assert root is not None
    assert [entry.tag for entry in root.children] == ["macro", "part"]


def _chain(count: int, fan: int) -> str:
    macros = "".join(f'<xacro:macro name="m{at}">{f"<xacro:m{at + 1}/>" * fan}</xacro:macro>' for at in range(count))
    return f'{macros}<xacro:macro name="m{count}"><l/></xacro:macro><xacro:m0/>'


@pytest.mark.parametrize(
    "body",
    [
        '<xacro:include filename="a.xacro"/>',
        '<xacro:include filename="a.xacro"/>' * 3,
        '<xacro:macro name="m"><xacro:m/><xacro:m/></xacro:macro><xacro:m/>',
        (
            '<xacro:macro name="m" params="*b"><xacro:m><xacro:insert_block name="b"/></xacro:m></xacro:macro>'
            "<xacro:m><l/></xacro:m>"
        ),
        '<xacro:property name="b"><a><xacro:insert_block name="b"/></a></xacro:property><xacro:insert_block name="b"/>',
        _chain(12, 10),
        '<x v="${1 + 1}"/>' * 50_000,
        '<x v="${len(sorted(range(19000)))}"/>' * 15_000,
        f'<xacro:property name="t" value="{"x" * 19_000}"/>' + '<x v="${t}${t}${t}${t}"/>' * 8_000,
        f'<x v="{"${" * 30_000}"/>',
        f'<x v="{"$(arg " * 5_000 + ")" * 5_000}"/>',
        '<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/><x v="${a}"/>',
        '<xacro:property name="p0" value="xxxxxxxxxx"/>'
        + "".join(f'<xacro:property name="p{at + 1}" value="{f"${{p{at}}}" * 10}"/>' for at in range(12))
        + '<x v="${p12}"/>',
    ],
)
def test_what_never_ends_is_cut_at_once(body: str) -> None:
    """Cycles and explosions of files, macros, blocks and texts end in a diagnostic, quickly."""
    begin = time.process_time()
    found, problems = expanded(body)
    assert time.process_time() - begin < 4.0
    assert found is not None
    assert problems


def test_what_was_read_before_a_bound_is_kept() -> None:
    """A cycle at the end of a file does not lose what stands before it."""
    found, _ = expanded('<link name="a"/><xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>')
    assert found == "link name=a"


WORDS = st.sampled_from(
    [
        "${",
        "}",
        "$(arg ",
        ")",
        "a",
        "1",
        "<xacro:if value='${a}'>",
        "</xacro:if>",
        "<xacro:m ",
        "/>",
        "'",
        '"',
        ">",
        "<xacro:macro name='m' params='a *b'>",
        "</xacro:macro>",
        "<xacro:property name='a' value='",
        "<link name='",
        "<xacro:include filename='a.xacro'/>",
        "load_yaml(",
        "$",
        "\0",
        "<xacro:insert_block name='b'/>",
        "é",
        "\n",
    ]
)


@settings(max_examples=50, deadline=None)
@given(st.lists(WORDS, max_size=40).map("".join))
def test_no_content_makes_the_expansion_fail(body: str) -> None:
    """Whatever the text, there is a result in bounded time."""
    begin = time.process_time()
    found, problems = expanded(body)
    assert time.process_time() - begin < 2.0
    assert found is not None or problems
