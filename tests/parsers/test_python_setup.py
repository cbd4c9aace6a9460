"""`setup.py`, `setup.cfg` and `pyproject.toml`."""

import pytest
from diagnosed import is_told
from ecm_parsers.python_metadata import parse_pyproject, parse_setup_cfg
from ecm_parsers.python_setup import parse_setup_py
from ecm_parsers.python_setup_facts import DataFiles, EntryPoint
from hypothesis import given, settings
from hypothesis import strategies as st

SETUP = b"""import os
from glob import glob
from setuptools import find_packages, setup
package_name = 'robot_tools'
VERSION = '1.' + '0'
setup(
    name=package_name,
    version=VERSION,
    packages=find_packages(exclude=['test']),
    package_dir={'': 'src'},
    scripts=['scripts/run'],
    data_files=[
        ('share/' + package_name, ['package.xml']),
        (os.path.join('share', package_name, 'launch'), glob('launch/*.py')),
        (f'share/{package_name}/config', ['a.yaml']),
    ],
    entry_points={
        'console_scripts': [
            'talk = robot_tools.talk:main',
            'listen = ' + package_name + '.listen:main',
            'walk = \\
                robot_tools.walk:main',
            '%s_fly = {0}.fly:main'.format(package_name) % 'can',
        ],
        'ros2cli.verb': ['x = robot_tools.x:Verb [extra]', COMPUTED, 'broken'],
    },
)
"""


def test_setup_py() -> None:
    """Arguments of setup() are folded with the names before them; entry points have lines."""
    parsed = parse_setup_py(SETUP)
    facts = parsed.facts
    assert (facts.name, facts.version, facts.packages) == ("robot_tools", "1.0", ("**",))
    assert (facts.package_dir, facts.scripts) == ({"": "src"}, ("scripts/run",))
    assert facts.data_files == (
        DataFiles("share/robot_tools", ("package.xml",), 13),
        DataFiles("share/robot_tools/launch", ("launch/*.py",), 14),
        DataFiles("share/robot_tools/config", ("a.yaml",), 15),
    )
    assert facts.entry_points == (
        EntryPoint("console_scripts", "talk", "robot_tools.talk", "main", 19),
        EntryPoint("console_scripts", "listen", "robot_tools.listen", "main", 20),
        EntryPoint("console_scripts", "walk", "robot_tools.walk", "main", 21),
        EntryPoint("console_scripts", "can_fly", "robot_tools.fly", "main", 23),
        EntryPoint("ros2cli.verb", "x", "robot_tools.x", "Verb", 25),
    )
    assert [d.code for d in parsed.diagnostics] == ["setup-computed-entry-point", "setup-bad-entry-point"]


def test_catkin_setup_of_python_2() -> None:
    """catkin's generate_distutils_setup counts, and Python 2 text is read."""
    text = b"print 'x'\nd = generate_distutils_setup(packages=['a', u'b'], package_dir={'': 'x'})\nsetup(**d)\n"
    facts = parse_setup_py(text).facts
    assert (facts.packages, facts.package_dir) == (("a", "b"), {"": "x"})


def test_spread_dictionaries() -> None:
    """setup(**dict) is read when the dict is written in the file."""
    assert parse_setup_py(b"k = dict(name='a')\nsetup(**k)\n").facts.name == "a"
    assert parse_setup_py(b"k = {'name': 'b'}\nsetup(version='1', **k)\n").facts.name == "b"


def test_entries_that_are_set_one_by_one() -> None:
    """What catkin gives, or a dictionary, can be filled before it is handed on; the last value counts."""
    filled = b"d['packages'] = ['b']\nd['package_dir'] = {'': 'src'}\nsetup(**d)\n"
    of_catkin = parse_setup_py(b"d = generate_distutils_setup(packages=['a'])\n" + filled).facts
    of_table = parse_setup_py(b"d = {}\n" + filled).facts
    assert (of_catkin.packages, of_catkin.package_dir) == (("b",), {"": "src"})
    assert (of_table.packages, of_table.package_dir) == (("b",), {"": "src"})
    assert parse_setup_py(b"setup()\nd[0] = 1\nd[a][b] = 2\nself.d['x'] = 3\n").facts.packages == ()


def test_what_a_function_adds_to_a_list_leaves_the_rest() -> None:
    """Files that a function finds are told as unread; those that are written beside them are known."""
    parsed = parse_setup_py(b"setup(data_files=[('share/a', ['x'])] + found('y'),\n packages=more + ['a'])\n")
    assert parsed.facts.data_files == (DataFiles("share/a", ("x",), 1),)
    assert parsed.facts.packages == ("{*more}", "a")
    assert [each.code for each in parsed.diagnostics] == ["setup-computed-data-files"]


@pytest.mark.parametrize(
    ("text", "packages"),
    [
        ("p = ['a']\np += ['b']", ("a", "b")),
        ("p = ['a']\np.append('b')\np.extend(['c'])", ("a", "b", "c")),
        ("p = ['a']\nif other:\n    p.append('b')", ("a", "{*p}")),
        ("p = ['a']\nfor each in rows:\n    p.append(each)", ("a", "{*p}")),
        ("p = ['a']\nif other:\n    p = ['b']", ()),
        ("p = ['a']\np.insert(0, 'b')", ("b", "a")),
        ("p = ['a', 'b']\np.remove('a')", ("b",)),
        ("p = ['a', 'b']\nif other:\n    p.remove('a')", ("{*p}",)),
        ("p = ['b', 'a']\np.sort()\ndel p[0]", ("b",)),
        ("p = ['a']\np.sort(key=other)", ("{*p}",)),
        ("p = ['a']\ndef f():\n    p = ['b']", ("a",)),
        ("def f(x):\n    return [x + '.b']\np = f('a')", ("a.b",)),
        ("def f():\n    if other:\n        return ['a']\n    return ['b']\np = f()", ()),
        ("p = ['a.' + each for each in ('b', 'c')]", ("a.b", "a.c")),
        ("p = [each for each in ('b', 'c') if other(each)]", ("b", "c")),
        ("p = ['a']\nwhile other:\n    p = ['b']", ()),
        ("p = ['a']\nfor each in rows:\n    p = ['b']", ()),
        ("try:\n    p = ['a']\nexcept OSError:\n    p = ['b']", ()),
        ("class V:\n    p = ['a']\np = V.p", ("a",)),
        ("p, q = ['a'], ['b']\np = ['c']", ("c",)),
        ("p, q = ['a'], ['b']", ("a",)),
        ("rows = []\nrows.append(1)\np = ['a'] if rows else ['b']", ("a",)),
        ("p = ['a']\nif glob('x/*'):\n    p = ['b']", ()),
        ("p = ['a'] if len(glob('x/*')) == 1 else ['b']", ()),
        ("t = {'k': ['a'], 'k': ['b']}\np = t['k']", ("b",)),
        ("t = {}\nt.update(k=['a'])\np = t['k']", ("a",)),
        ("t = {'k': ['a']}\nt.update(other)\np = t['k']", ()),
    ],
)
def test_what_changes_a_variable_is_followed_or_leaves_it_open(text: str, packages: tuple[str, ...]) -> None:
    """A value that a later statement changes, or may change, is not told as it was."""
    assert parse_setup_py(f"{text}\nsetup(packages=p)\n".encode()).facts.packages == packages


def test_attributes_are_what_they_are_called() -> None:
    """`other.name` is not the variable `name` of the file."""
    text = b"name = 'a'\nself.version = '1'\nsetup(name=other.name, version=self.version)\n"
    facts = parse_setup_py(text).facts
    assert (facts.name, facts.version) == (None, "1")


def test_lines_of_packages() -> None:
    """Each package has the line on which the list names it, or that of the list."""
    of_setup = parse_setup_py(
        b"p = 'a'\nsetup(\n  packages=[\n    p,\n    'b', p + '.c'],\n  py_modules=['d'])\n"
    ).facts
    of_cfg = parse_setup_cfg(b"[options]\npackages =\n  a\n  b\n").facts
    of_project = parse_pyproject(b'[tool.setuptools]\npackages = ["a",\n  "b",\n]\n').facts
    assert of_setup.package_lines == {"a": 4, "b": 5, "a.c": 5, "d": 6}
    assert of_cfg.package_lines == {"a": 3, "b": 4}
    assert of_project.package_lines == {"a": 2, "b": 3}


def test_setup_cfg() -> None:
    """setup.cfg gives names, folders with their case, and entry points with lines."""
    text = b"""[metadata]
name = 'robot'
version = 2.0
[options]
packages = find:
package_dir =
    = src
[options.packages.find]
where = src
[options.data_files]
share/Robot = a.xml, b.xml
[options.entry_points]
console_scripts =
    talk=robot.talk:main
    go = robot.go
"""
    facts = parse_setup_cfg(text).facts
    assert (facts.name, facts.version, facts.packages, facts.package_dir) == (
        "robot",
        "2.0",
        ("src/**",),
        {"": "src"},
    )
    assert facts.data_files == (DataFiles("share/Robot", ("a.xml", "b.xml"), 11),)
    assert facts.entry_points == (
        EntryPoint("console_scripts", "talk", "robot.talk", "main", 14),
        EntryPoint("console_scripts", "go", "robot.go", "", 15),
    )


def test_pyproject() -> None:
    """The project table and packages of setuptools are read."""
    text = b"""[project]
name = "robot"
version = "3.1"
[project.scripts]
talk = "robot.talk:main"
[project.entry-points."my.group"]
plug = "robot.plug:Plug"
[tool.setuptools.packages.find]
where = ["src"]
"""
    facts = parse_pyproject(text).facts
    assert (facts.name, facts.version, facts.packages) == ("robot", "3.1", ("src/**",))
    assert facts.entry_points == (
        EntryPoint("console_scripts", "talk", "robot.talk", "main", 5),
        EntryPoint("my.group", "plug", "robot.plug", "Plug", 7),
    )


@pytest.mark.parametrize(
    ("parsed", "code"),
    [
        (parse_setup_py(b"x = 1\n"), "setup-no-call"),
        (parse_setup_py(b"#" * 2_000_000), "setup-too-large"),
        (parse_setup_cfg(b"name = x\n"), "setup-cfg-syntax"),
        (parse_pyproject(b"[project\n"), "pyproject-syntax"),
        (parse_pyproject(b"a = " + b"[" * 100_000), "pyproject-too-deep"),
        (parse_setup_py(b"x = [1]\n" + b"x = x + x\n" * 10_000), "python-too-long"),
    ],
)
def test_broken_files_are_reported(parsed: object, code: str) -> None:
    """What cannot be read is diagnosed, never raised."""
    assert code in [d.code for d in parsed.diagnostics]  # type: ignore[attr-defined]


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="setup(n=)[]{}'%\n:\\ .+*x1", max_size=80).map(str.encode))
def test_setup_never_raises(data: bytes) -> None:
    """Any text gives facts or diagnostics in all three forms."""
    for parse, text in ((parse_setup_py, b"setup(" + data), (parse_setup_cfg, b"[options]\n" + data)):
        assert is_told(text, parse(text))
    assert is_told(data, parse_pyproject(data))


def test_generated_parameter_modules() -> None:
    """Files of generate_parameter_module are told, by position or by name; a computed one is said."""
    text = b"f = 'a'\ngenerate_parameter_module('m', f)\nx.generate_parameter_module('n', yaml_file='b')\nsetup()\n"
    assert parse_setup_py(text).facts.parameter_files == ("a", "b")
    parsed = parse_setup_py(b"generate_parameter_module('m', find())\nsetup()\n")
    assert (parsed.facts.parameter_files, [d.code for d in parsed.diagnostics]) == ((), ["setup-computed-parameters"])
    texts = (text, b"generate_parameter_module('m', find())\nsetup()\n", b"setup(ext_modules=[find()])\n", b"setup()\n")
    assert [parse_setup_py(each).facts.makes_modules for each in texts] == [True, True, True, False]
