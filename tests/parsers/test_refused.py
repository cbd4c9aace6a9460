"""What the readers of Python, YAML and package.xml refuse."""

from __future__ import annotations

import pytest
from ecm_parsers.package_refused import refused_manifest
from ecm_parsers.python_refused import refused_by_every_python, refused_by_python3
from ecm_parsers.yaml_refused import MAX_BYTES, refused_by_every_yaml

PYTHON = [
    ("a = 1\n", 0, 0),
    ("", 0, 0),
    ("if a\n    b = 1\n", 1, 1),
    ("def f():\n'''Text.'''\n", 2, 2),
    ("a = 1\n<<<<<<< HEAD\nb = 1\n=======\nb = 2\n>>>>>>> x\n", 2, 2),
    ("f(a,\n\nb = 1\nc = 2\n", 1, 1),
    ("print 'a'\n", 1, 0),
    ("print 'a' % b, c\n", 1, 0),
    ("exec '%s = v' % k\n", 1, 0),
    ("try:\n    f()\nexcept E, e:\n    pass\n", 3, 0),
    ("a = `b`\n", 1, 0),
    ("a = 0777\n", 1, 0),
    ("a = b.None\n", 1, 0),
    ("asyncio.async(f())\n", 1, 0),
    ("if a:\n        b = 1\n\tc = 2\n", 3, 0),
    ("def f(self, (a, b)):\n    pass\n", 1, 0),
    ("type A = int\n", 0, 0),
    ("def f[T](a: T) -> T:\n    return a\n", 0, 0),
    ("class A[T]:\n    pass\n", 0, 0),
    ('a = f"{b["c"]}"\n', 0, 0),
    ("match a:\n    case 1:\n        pass\n", 0, 0),
]


@pytest.mark.parametrize(("text", "of_3", "of_every"), PYTHON)
def test_python(text: str, of_3: int, of_every: int) -> None:
    """A mistake is told with its line; what an older or newer Python takes is none."""
    found = [refused_by_python3(text.encode()), refused_by_every_python(text.encode())]
    assert [each.line if each is not None else 0 for each in found] == [of_3, of_every]


def test_python_that_cannot_be_judged() -> None:
    """Neither depth nor size of a stranger's file stops the reader."""
    deep = b"(" * 100_000
    assert refused_by_every_python(b"a = 1\n" * 400_000) is None
    assert refused_by_python3(b"a = " + b"-" * 100_000 + b"1\n") is None
    refused_by_python3(deep)
    refused_by_every_python(deep)


YAML = [
    ("a: 1\n", 0),
    ("", 0),
    ("a: 1\n<<<<<<< HEAD\nb: 1\n=======\nb: 2\n>>>>>>> x\nc:\n  d: 1\n", 3),
    ("a:\n\tb: 1\n", 2),
    ("a: b: c\n", 1),
    ("a: [1, 2\nb: 3\n", 2),
    ("a: !degrees 90\n---\nb: 1\n", 0),
    ("%YAML:1.0\na: 1\n", 0),
    ("a: $(eval 1): b\n", 0),
    ("0: {a:{b: 1}}\n", 0),
    ("[" * 20_000 + "]" * 20_000, 0),
]


@pytest.mark.parametrize(("text", "line"), YAML)
def test_yaml(text: str, line: int) -> None:
    """What one reader takes is not refused."""
    found = refused_by_every_yaml(text.encode())
    assert (found.line if found is not None else 0) == line


def test_large_yaml() -> None:
    """The reader in Python would take minutes."""
    assert refused_by_every_yaml(b"a: [" + b"1, " * (MAX_BYTES // 3)) is None


COVERED = "another tag has the <test_depend> on b already"
MANIFESTS = [
    ("1", "<run_depend>b</run_depend>", ""),
    ("1", "<exec_depend>b</exec_depend>", "format 1 has no <exec_depend>"),
    ("1", "<depend>b</depend>", "format 1 has no <depend>"),
    ("1", "<build_depend>b</build_depend><test_depend>b</test_depend>", COVERED),
    ("2", "<build_depend>b</build_depend><test_depend>b</test_depend>", ""),
    ("2", "<run_depend>b</run_depend>", "format 2 has no <run_depend>"),
    ("2", '<depend condition="$A == 1">b</depend>', "<depend> of format 2 has no attribute 'condition'"),
    ("3", '<depend condition="$A == 1">b</depend><group_depend>g</group_depend>', ""),
    ("3", "<run_depend>b</run_depend>", "format 3 has no <run_depend>"),
    ("3", "<depend>b</depend><exec_depend>b</exec_depend>", "another tag has the <exec_depend> on b already"),
    ("3", "<conflict>a</conflict>", ""),
    ("3", "<depend>a</depend>", "the package has a <depend> on itself"),
    ("3", "<depend>b<depend>c</depend></depend>", "<depend> holds another element"),
    ("3", "<name>c</name>", "there is more than one <name>"),
    ("3", "<description>With <b>bold</b> words.</description>", ""),
    ("3", '<url x:y="1" xmlns:x="u">z</url>', ""),
    ("4", "", "there is no format '4'"),
]


@pytest.mark.parametrize(("form", "body", "wrong"), MANIFESTS)
def test_manifest(form: str, body: str, wrong: str) -> None:
    """Each format has tags of its own."""
    found = refused_manifest(f'<package format="{form}"><name>a</name>{body}</package>'.encode())
    assert (found.wrong if found is not None else "") == wrong


NAMES = [("a_b", True), ("A-1", True), ("a b", False), ("a.b", False), ("_a", False)]


@pytest.mark.parametrize(("name", "is_right"), NAMES)
def test_name_of_a_package(name: str, is_right: bool) -> None:
    """Capitals and dashes are taken for the sake of old packages."""
    assert (refused_manifest(f"<package><name>{name}</name></package>".encode()) is None) is is_right


def test_what_is_no_manifest() -> None:
    """Another file may have its name."""
    assert refused_manifest(b"<Package><x/></Package>") is None
    assert refused_manifest(b"") is None
