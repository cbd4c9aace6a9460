"""`[extract] exclude`: patterns of a `.gitignore`."""

from pathlib import Path

import pytest

from ecm_extract.config import parse_config
from ecm_extract.discover import discover
from ecm_extract.errors import ConfigError
from ecm_extract.exclusion import Exclusion
from ecm_extract.tree import Unread, open_tree, unread_of

FILES = ("a.py", "pkg/b.py", "pkg/gen/c.py", "pkg/gen/deep/d.py", "gen/e.py")


@pytest.mark.parametrize(
    ("patterns", "kept"),
    [
        (["pkg/*.py"], {"a.py", "pkg/gen/c.py", "pkg/gen/deep/d.py", "gen/e.py"}),
        (["pkg/**/*.py"], {"a.py", "gen/e.py"}),
        (["**/gen/**"], {"a.py", "pkg/b.py"}),
        (["gen/"], {"a.py", "pkg/b.py"}),
        (["/gen"], {"a.py", "pkg/b.py", "pkg/gen/c.py", "pkg/gen/deep/d.py"}),
        (["*.py", "!a.py"], {"a.py"}),
        (["# pkg"], set(FILES)),
        ([], set(FILES)),
    ],
)
def test_patterns(tmp_path: Path, patterns: list[str], kept: set[str]) -> None:
    """`*` stays within a folder, `**` is any depth, a name without a slash holds anywhere, `!` takes back."""
    for name in FILES:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    assert {entry.path for entry in Exclusion(patterns).kept(open_tree(tmp_path))} == kept


def test_each_pattern_is_told(tmp_path: Path) -> None:
    """Also one that leaves out nothing here: another ref may hold what it means."""
    (tmp_path / "a.py").write_text("")
    tree = open_tree(tmp_path)
    Exclusion(["*.py", "nothing"]).kept(tree)
    assert unread_of(tree.diagnostics) == (Unread("*.py", "excluded"), Unread("nothing", "excluded", carries=False))


def test_an_excluded_package_is_none(tmp_path: Path) -> None:
    """A package.xml that is left out makes no package."""
    (tmp_path / "vendor").mkdir()
    (tmp_path / "vendor" / "package.xml").write_text("<package/>")
    (tmp_path / "package.xml").write_text("<package/>")
    assert [root.path for root in discover(open_tree(tmp_path), Exclusion(["vendor"]))] == [""]


def test_a_wrong_pattern_is_an_error_of_the_configuration() -> None:
    """With its line, and before anything is read."""
    with pytest.raises(ConfigError, match=r"ecm.toml:2: extract.exclude"):
        parse_config(b'[extract]\nexclude = ["!"]\n')
