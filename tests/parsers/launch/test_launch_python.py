"""Python launch files are read, not run."""

from __future__ import annotations

import time

import pytest
from diagnosed import is_told
from ecm_parsers.launch.model import Action, Argument, Group, Include, Node, ParameterFile, ParameterValue, Unread
from ecm_parsers.launch.python import parse_launch_python
from ecm_parsers.template import Substitution
from hypothesis import given, settings
from hypothesis import strategies as st


def read(body: str, before: str = "") -> tuple[Action, ...]:
    indented = "".join(f"    {line}\n" for line in body.splitlines())
    parsed = parse_launch_python(f"{before}\ndef generate_launch_description():\n{indented}".encode())
    assert parsed.facts is not None
    assert parsed.diagnostics == ()
    return parsed.facts.actions


def only(body: str, before: str = "") -> Node:
    nodes = [action for action in flat(read(body, before)) if isinstance(action, Node)]
    assert len(nodes) == 1
    return nodes[0]


def flat(actions: tuple[Action, ...]) -> list[Action]:
    found: list[Action] = []
    for action in actions:
        found += flat(action.actions) if isinstance(action, Group) else [action]
    return found


ARG_X = (Substitution("arg", (("x",),)),)


@pytest.mark.parametrize(
    ("expression", "parts"),
    [
        ("LaunchConfiguration('x')", ARG_X),
        ("[LaunchConfiguration('x'), '/a']", (*ARG_X, "/a")),
        (
            "os.path.join(get_package_share_directory('p'), 'a', 'b')",
            (Substitution("find", (("p",),)), "/a/b"),
        ),
        ("PathJoinSubstitution([FindPackageShare('p'), 'a'])", (Substitution("find", (("p",),)), "/a")),
        ("Path(get_package_share_path('p')) / 'a'", (Substitution("find", (("p",),)), "/a")),
        ("EnvironmentVariable('X', default_value='d')", (Substitution("env", (("X",), ("d",))),)),
        ("os.environ.get('X', 'd')", (Substitution("env", (("X",), ("d",))),)),
        ("os.environ['X']", (Substitution("env", (("X",),)),)),
        ("'a_{}'.format(LaunchConfiguration('x'))", ("a_", *ARG_X)),
        ("f'a_{1 + 1}'", ("a_2",)),
        ("'a_%s' % 'b'", ("a_b",)),
        ("'/'.join(['a', 'b'])", ("a/b",)),
        ("'a' if False else 'b'", ("b",)),
        ("names['k']", ("v",)),
        ("pick('c')", ("c_picked",)),
        ("(lambda y: y + '!')('d')", ("d!",)),
        ("'ABC'.lower()", ("abc",)),
        ("str(3)", ("3",)),
        ("f'{1.5:.2f}_{[1]}_{None}'", ("1.50_[1]_None",)),
        ("'%02d%%' % 3", ("03%",)),
        ("'{:>3}{{}}'.format('a')", ("  a{}",)),
        ("'_'.join({'a': 1, 'b': 2})", ("a_b",)),
        ("','.join(str(2 ** n) for n in range(3))", ("1,2,4",)),
        ("'a%d' % sorted([1, 2], reverse=True)[0]", ("a2",)),
    ],
)
def test_values(expression: str, parts: tuple[object, ...]) -> None:
    """What a file computes before launch is known; what the launch decides stays a substitution."""
    before = "names = {'k': 'v'}\ndef pick(a, b='_picked'):\n    return a + b\n"
    found = only(f"return LaunchDescription([Node(package='p', executable='e', name={expression})])", before)
    assert found.name == parts


@pytest.mark.parametrize(
    "body",
    [
        "return LaunchDescription([Node(package='p', executable='e')])",
        "ld = LaunchDescription()\nld.add_action(Node(package='p', executable='e'))\nreturn ld",
        "nodes = []\nnodes.append(Node(package='p', executable='e'))\nreturn LaunchDescription(nodes)",
        "nodes = []\nnodes += [Node(package='p', executable='e')]\nreturn LaunchDescription([] + nodes)",
        "return LaunchDescription([Node(package='p', executable=e) for e in ['e']])",
        "ld = LaunchDescription()\nfor e in ['e']:\n    ld.add_action(Node(package='p', executable=e))\nreturn ld",
        "return LaunchDescription([GroupAction([Node(package='p', executable='e')])])",
        "return LaunchDescription([TimerAction(period=1.0, actions=[Node(package='p', executable='e')])])",
        "return LaunchDescription([OpaqueFunction(function=setup)])",
        "kw = {'package': 'p', 'executable': 'e'}\nreturn LaunchDescription([Node(**kw)])",
        "try:\n    n = Node(package='p', executable='e')\nexcept Exception:\n    n = None\nreturn LaunchDescription([n])",
        "n = Node(package='p', executable='e')\nreturn LaunchDescription([RegisterEventHandler(OnProcessExit(on_exit=[n]))])",
    ],
)
def test_ways_to_start_a_node(body: str) -> None:
    """Lists, loops, handlers and functions all start the same node."""
    found = only(body, "def setup(context, *args, **kwargs):\n    return [Node(package='p', executable='e')]\n")
    assert (found.package, found.executable) == (("p",), ("e",))


@pytest.mark.parametrize(
    "actions",
    [
        "other.declare(1) + [Node(package='p', executable='e')]",
        "[Node(package='p', executable='e')] + other.declare(1)",
        "[OpaqueFunction(function=other.declare), Node(package='p', executable='e')]",
    ],
)
def test_what_another_module_adds_is_told(actions: str) -> None:
    """What can be read is, and what cannot is said on its line."""
    made = flat(read(f"return LaunchDescription({actions})", "import other\n"))
    (unread,) = [each for each in made if isinstance(each, Unread)]
    assert [each.package for each in made if isinstance(each, Node)] == [("p",)]
    assert unread.text.startswith("other.declare")


def test_branch_that_only_the_launch_decides_is_read_both_ways() -> None:
    """Each side carries its condition."""
    body = """
if LaunchConfiguration('x').perform(context) == 'a':
    made = Node(package='p', executable='a')
else:
    made = Node(package='p', executable='b')
return LaunchDescription([made])
"""
    (group,) = read(body)
    assert isinstance(group, Group)
    equal = Substitution("equals", (ARG_X, ("a",)))
    sides = {side.condition for side in group.actions}
    assert sides == {(equal,), (Substitution("not", ((equal,),)),)}


def test_early_return_guards_what_follows() -> None:
    """After `if x: return`, the rest is taken only without x."""
    body = "if LaunchConfiguration('x').perform(context):\n    return [Node(package='p', executable='a')]\nreturn [Node(package='p', executable='b')]"
    before = f"def setup(context):\n{''.join(f'    {line}' + chr(10) for line in body.splitlines())}"
    (group,) = read("return LaunchDescription([OpaqueFunction(function=setup)])", before)
    assert isinstance(group, Group)
    assert [side.condition for side in group.actions] == [ARG_X, (Substitution("not", (ARG_X,)),)]


def test_parameters() -> None:
    """Maps are flattened, files stay files, rewritten files keep their rewrites."""
    body = """
source = RewrittenYaml(source_file='f.yaml', root_key='ns', param_rewrites={'a': LaunchConfiguration('x')})
return LaunchDescription([Node(package='p', executable='e', parameters=[
    {'a': 1, 'b': {'c': [1.5, 2.5]}, 'd': LaunchConfiguration('x')}, 'g.yaml', source, [{'h': True}]])])
"""
    found = only(body).parameters
    values = {entry.name: entry.value for entry in found if isinstance(entry, ParameterValue)}
    assert values == {("a",): 1, ("b", ".", "c"): [1.5, 2.5], ("d",): ARG_X, ("h",): True}
    files = [entry for entry in found if isinstance(entry, ParameterFile)]
    assert [entry.path for entry in files] == [("g.yaml",), ("f.yaml",)]
    assert files[1].rewrites == ((("a",), ARG_X),)


def test_include_and_argument() -> None:
    """Arguments keep their default and choices, includes what they are given."""
    body = """
return LaunchDescription([
    DeclareLaunchArgument('x', default_value='a', choices=['a', 'b'], description='which'),
    IncludeLaunchDescription(PythonLaunchDescriptionSource('f.launch.py'), launch_arguments={'x': 'b'}.items())])
"""
    argument, include = read(body)
    assert isinstance(argument, Argument)
    assert (argument.name, argument.default, argument.choices) == ("x", ("a",), ("a", "b"))
    assert isinstance(include, Include)
    assert (include.path, include.arguments) == (("f.launch.py",), (("x", ("b",)),))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("def f(:", "launch-syntax"),
        ("x = 1", "launch-no-entry"),
        ("def generate_launch_description():\n    return build()", "launch-unread"),
        ("def generate_launch_description():\n    LaunchDescription([])", "launch-returns-nothing"),
        ("def generate_launch_description():\n" + "    x = [x for x in range(1000)]\n" * 200, "launch-too-long"),
        ("x = " + "(" * 5_000, "launch-syntax"),
        ("x = " + "-" * 20_000 + "1", "launch-too-deep"),
        ("#" * 600_000, "launch-too-large"),
    ],
)
def test_what_cannot_be_read_is_told_within_a_second(text: str, code: str) -> None:
    """Broken and hostile files give one diagnostic that says what to do."""
    started = time.process_time()
    parsed = parse_launch_python(text.encode())
    assert [entry.code for entry in parsed.diagnostics] == [code]
    assert time.process_time() - started < 1


@pytest.mark.parametrize(
    "body",
    [
        "x = [1]\nx.append(x)\nreturn LaunchDescription(x)",
        "x = 'a' * 10 ** 9\nreturn LaunchDescription([])",
        "return f()\n",
        "while True:\n    pass\nreturn LaunchDescription([])",
        "x = [0] * 10 ** 12\nreturn LaunchDescription([])",
    ],
)
def test_nothing_runs(body: str) -> None:
    """Endless loops, recursion and huge values end at once."""
    text = "def f():\n    return f()\ndef generate_launch_description():\n"
    started = time.process_time()
    parse_launch_python((text + "".join(f"    {line}\n" for line in body.splitlines())).encode())
    assert time.process_time() - started < 1


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="abx=()[]{}'.,:+%if \n", max_size=80))
def test_never_raises(text: str) -> None:
    """No text breaks the reader."""
    described = f"def generate_launch_description():\n    return LaunchDescription([Node({text})])"
    for data in (text.encode(), described.encode()):
        assert is_told(data, parse_launch_python(data))


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("names = ['a', 'b']\nnames.remove('a')", ["b"]),
        ("names = ['a', 'b']\ndel names[0]", ["b"]),
        ("names = ['b', 'a']\nnames.sort()\nnames.pop()", ["a"]),
        ("names = ['a', 'b']\nif LaunchConfiguration('x').perform(c) == 'c':\n    names.remove('a')", ["a", "b"]),
        ("names = []\nfor n in ['a', 'b', 'c']:\n    if n == 'b':\n        continue\n    names.append(n)", ["a", "c"]),
        ("names = []\nfor n in ['a', 'b', 'c']:\n    if n == 'c':\n        break\n    names.append(n)", ["a", "b"]),
        ("def first():\n    for n in ['a', 'b']:\n        return n\nnames = [first()]", ["a"]),
    ],
)
def test_lists_and_loops(body: str, names: list[str]) -> None:
    """What a file takes from a list is not started, and a loop ends where it says so."""
    nodes = "return LaunchDescription([Node(package='p', executable='e', name=n) for n in names])"
    assert [each.name for each in read(f"{body}\n{nodes}") if isinstance(each, Node)] == [(name,) for name in names]


def test_actions_of_a_branch_that_returns_them() -> None:
    """A function that returns actions in one branch only gives them under its condition."""
    before = (
        "def start():\n    if LaunchConfiguration('x').perform(c) == 'a':\n"
        "        return [Node(package='p', executable='e', name='n')]\n"
    )
    (found,) = read("return LaunchDescription(start())", before)
    assert isinstance(found, Group)
    assert found.condition == (Substitution("equals", (ARG_X, ("a",))),)


def test_a_description_that_others_make_is_an_action_that_is_not_read() -> None:
    """It is not empty: who asks what the file starts or declares hears that this is not known."""
    made = parse_launch_python(
        b"from helpers import made\n\ndef generate_launch_description():\n    return made('arm')\n"
    )
    nothing = parse_launch_python(b"def generate_launch_description():\n    LaunchDescription([])\n")
    assert [each.facts.actions for each in (made, nothing)] == [(Unread(line=4, text="made('arm')"),), ()]  # type: ignore[union-attr]
