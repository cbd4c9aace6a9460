"""`.cfg` files of dynamic_reconfigure."""

import pytest
from diagnosed import is_told
from ecm_parsers.dynamic_reconfigure import EnumValue, parse_dynamic_reconfigure
from hypothesis import given, settings
from hypothesis import strategies as st

CFG = b"""#!/usr/bin/env python
PACKAGE = 'drive'
import roslib; roslib.load_manifest(PACKAGE)
from dynamic_reconfigure.parameter_generator_catkin import *
from local_planner.limits import add_limits
from math import pi
gen = ParameterGenerator()
add_limits(gen)
mode = gen.enum([gen.const("Slow", int_t, 0, "safe"), gen.const("Fast", int_t, 1, "unsafe")], "Modes")
gen.add("mode", int_t, 0x2, "Mode", 1, 0, 1, edit_method=mode)
limits = gen.add_group("Limits", type="tab")
inner = limits.add_group("Inner")
limits.add("max_" + "angle", double_t, 1,
           "Angle " "in rad", pi / 2, -pi, pi)
inner.add(name="label", paramtype="str", level=0, description="Text", default="x")
for side in ["l", "r"]:
    gen.add("gain_%s" % side, gen.double_t, 0, "Gain", 0.5)
print "done"
exit(gen.generate(PACKAGE, "drive_node", "Drive"))
"""


def test_parameters() -> None:
    """Types, defaults, limits, groups and enums are folded; nothing is executed."""
    facts = parse_dynamic_reconfigure(CFG).facts
    assert (facts.package, facts.node, facts.name, facts.line) == ("drive", "drive_node", "Drive", 19)
    found = {p.name: p for p in facts.parameters}
    assert list(found) == ["mode", "max_angle", "label", "gain_l", "gain_r"]
    mode = found["mode"]
    assert (mode.type, mode.level, mode.default, mode.min, mode.max, mode.line) == ("int", 2, 1, 0, 1, 10)
    assert mode.enum == (EnumValue("Slow", 0, "safe"), EnumValue("Fast", 1, "unsafe"))
    angle = found["max_angle"]
    assert (angle.type, angle.group, angle.description) == ("double", ("Limits",), "Angle in rad")
    assert (round(angle.default, 3), round(angle.min, 3), angle.line) == (1.571, -3.142, 13)
    assert (found["label"].group, found["label"].default) == (("Limits", "Inner"), "x")
    assert found["gain_r"].type == "double"


LOOPS = [
    ('for n in ("a", "b"):', "    add(n, True)", ["a", "b"]),
    ('for n, d in [("a", True), ("b", False)]:', "    add(n, d)", ["a", "b"]),
    ('for s in ["l", "r"]:\n    for n in ["a", "b"]:', "        add(s + n, True)", ["la", "lb", "ra", "rb"]),
    ("for n in names():", "    add(n, True)", ["{n}"]),
    ('rows = ["a"]\nrows.append(more())\nfor n in rows:', "    add(n, True)", ["a", "{}"]),
    ('rows = ["a"]\nrows += more()\nfor n in rows:', "    add(n, True)", ["a", "{n}"]),
    ('for n, d in ["a", "b"]:', "    add(n, d)", ["{n}", "{n}"]),
]


@pytest.mark.parametrize(("loop", "body", "names"), LOOPS, ids=[row[0] for row in LOOPS])
def test_loops_over_what_is_written_out(loop: str, body: str, names: list[str]) -> None:
    """Each round of a loop over a list that the file states adds a parameter; of any other one the name is open."""
    added = (
        body.replace("add(", "gen.add(")
        .replace("(n,", '(n, bool_t, 0, "",')
        .replace("(s + n,", '(s + n, bool_t, 0, "",')
    )
    text = f'gen = ParameterGenerator()\n{loop}\n{added}\nexit(gen.generate("p", "n", "C"))\n'
    assert [each.name for each in parse_dynamic_reconfigure(text.encode()).facts.parameters] == names


def test_imported_parameters_are_reported() -> None:
    """A function of another module that adds parameters is named and diagnosed."""
    parsed = parse_dynamic_reconfigure(CFG)
    assert [(i.module, i.name, i.line) for i in parsed.facts.included] == [("local_planner.limits", "add_limits", 8)]
    assert ("cfg-imported-parameters", 8) in [(d.code, d.line) for d in parsed.diagnostics]


def test_signs_of_numbers() -> None:
    """A number may have either sign."""
    text = b'gen.add("a", double_t, 0, "", +1.5, -2.0, +2.0)\nexit(gen.generate("p", "n", "C"))\n'
    (found,) = parse_dynamic_reconfigure(text).facts.parameters
    assert (found.default, found.min, found.max) == (1.5, -2.0, 2.0)


def test_configuration_without_a_name() -> None:
    """Without generate() the parameters are kept and the lack is diagnosed; an ini file has none."""
    parsed = parse_dynamic_reconfigure(b'gen.add("a", int_t, 0, "d", 1)\n')
    assert [p.name for p in parsed.facts.parameters] == ["a"]
    assert [d.code for d in parsed.diagnostics] == ["cfg-no-generate"]
    assert parse_dynamic_reconfigure(b"[section]\nkey=value\n").facts.parameters == ()


def test_hostile_cfg_files() -> None:
    """Deep nesting, endless chains and huge files end at a bound."""
    for data in (
        b"x = " + b"(" * 50_000,
        b"gen.add(" * 20_000,
        b"a" + b".add(1, 2)" * 20_000,
        b"a" * 2_000_000,
    ):
        assert is_told(data, parse_dynamic_reconfigure(data))


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet='gen.ad(),="%\\ \n1x[]{}', max_size=80).map(lambda t: b"gen.add(" + t.encode()))
def test_cfg_never_raises(data: bytes) -> None:
    """Any text gives facts or diagnostics."""
    assert is_told(data, parse_dynamic_reconfigure(data))


_ROUNDS = b"""
from other import LIMIT
gen = ParameterGenerator()
ends = ("_goal", "_speed")
begun = {"_goal": 1.0, "_speed": 2.0}
least = [0.0, LIMIT]
for at, end in enumerate(ends):
    if at < 1 or end not in begun:
        for joint in ("a", "b"):
            gen.add(joint + end, double_t, 0, "", begun[end], least[at])
    elif len(ends) == 2:
        gen.add("only" + end, double_t, 0, "", begun[end], least[at])
    else:
        gen.add("never", double_t, 0, "", 1.0)
for at in range(2):
    gen.add("row_%d" % at, int_t, 0, "", at if at else 7)
for key, value in begun.items():
    gen.add("first" + key, double_t, 0, "", value)
for name, count in zip(["x", "y"], [3, 4]):
    gen.add(name, int_t, 0, "", count)
if LIMIT > 2:
    gen.add("perhaps", bool_t, 0, "", True)
exit(gen.generate("p", "n", "N"))
"""


def test_rounds_and_branches_that_the_file_decides() -> None:
    """Loops over `enumerate`, `range`, `zip`, `items` are gone through; a branch that is never taken adds nothing."""
    parsed = parse_dynamic_reconfigure(_ROUNDS)
    assert [(each.name, each.default, each.min) for each in parsed.facts.parameters] == [
        ("a_goal", 1.0, 0.0),
        ("b_goal", 1.0, 0.0),
        ("only_speed", 2.0, None),
        ("row_0", 7, None),
        ("row_1", 1, None),
        ("first_goal", 1.0, None),
        ("first_speed", 2.0, None),
        ("x", 3, None),
        ("y", 4, None),
        ("perhaps", True, None),
    ]


def test_a_variable_of_a_branch_that_is_not_decided_is_open() -> None:
    """Of two values that a variable may have, the later one is not told."""
    text = b"low = 1\nif other:\n    low = 2\n    high = 3\ngen.add('a', int_t, 0, '', low, 0, high)\n"
    [found] = parse_dynamic_reconfigure(b"gen = ParameterGenerator()\n" + text).facts.parameters
    assert (found.default, found.max) == (None, 3)


def test_a_configuration_may_be_called_like_its_file() -> None:
    """What os.path makes of `__file__` is known by the path of the file, as far as that leads in its tree."""
    text = (
        b"from os.path import abspath, basename, dirname, splitext\n"
        b"gen = ParameterGenerator()\n"
        b"PACKAGE = basename(dirname(dirname(abspath(__file__))))\n"
        b'gen.add("rate", double_t, 0, "Rate", 1.0)\n'
        b'exit(gen.generate(PACKAGE, PACKAGE + "_node", splitext(basename(__file__))[0]))\n'
    )
    facts = parse_dynamic_reconfigure(text, "drive/cfg/Planner.cfg").facts
    assert (facts.package, facts.node, facts.name) == ("drive", "drive_node", "Planner")
    at_root = parse_dynamic_reconfigure(text, "cfg/Planner.cfg").facts
    assert (at_root.package, at_root.name) == ("{}", "Planner")
    unplaced = parse_dynamic_reconfigure(text)
    assert unplaced.facts.name != "Planner"
    assert [each.code for each in unplaced.diagnostics] == ["cfg-no-name"]
