"""Only tables decide by words of the vocabulary: a new role, kind or use is a row, and the parser that fills it."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import pytest
from ecm_checker.hub.kinds import kinds, uses
from ecm_checker.hub.roles import roles

ROOT: Final = Path(__file__).resolve().parents[1]
OURS: Final = ("ecm_extract", "parsers/ecm_parsers", "checker/ecm_checker", "corpus/ecm_corpus")

ROLES_TOLD: Final = {
    "ecm_extract/description/simulator.py": "what a sensor of a simulator is in the graph",
    "ecm_extract/observe/bag/connections.py": "what a recorded connection is",
    "ecm_extract/observe/dds/names.py": "what the prefixes of ROS 2 topics in DDS mean",
    "ecm_extract/observe/ros1/master.py": "the lists that the master of ROS 1 answers with",
    "ecm_extract/observe/ros1/session.py": "what the master of ROS 1 does not know",
    "ecm_extract/system/bridges.py": "what the directions of a bridge are in the graph",
}
"""Files that say what is read there is of a role, each the only one for what it reads; the list only gets shorter."""

OTHER_KINDS: Final = {
    "ecm_extract/cmake/blocks.py": "blocks of CMake",
    "ecm_extract/cmake/installs.py": "targets of CMake",
    "ecm_extract/cmake/targets.py": "targets of CMake",
    "ecm_extract/entities/packaging.py": "targets of CMake",
    "ecm_extract/entities/program_files.py": "targets of CMake",
    "ecm_extract/entities/python_names.py": "targets of CMake",
    "ecm_extract/link/linker.py": "kinds of modules",
    "ecm_extract/link/owning/modules.py": "kinds of modules",
    "ecm_extract/link/naming/names.py": "holes of values",
    "ecm_extract/link/owning/ownership.py": "kinds of modules",
    "ecm_extract/link/owning/registry.py": "targets of CMake",
    "ecm_extract/link/running/values.py": "holes of values",
    "ecm_extract/lint/rules/lnt041.py": "targets of CMake",
    "ecm_extract/lint/rules/lnt043.py": "targets of CMake",
    "ecm_extract/read/installed.py": "targets of CMake",
    "parsers/ecm_parsers/launch/substitutions.py": "substitutions of launch files",
}
"""Files in which something else has a `kind` that is called as one of names; the list only gets shorter."""

LISTED: Final = {
    "ecm_extract/entities/packaging.py": "targets of CMake that are programs and libraries",
    "ecm_extract/lint/rules/lnt041.py": "targets of CMake that are programs and libraries",
    "ecm_extract/observe/ros1/master.py": "the lists that the master of ROS 1 answers with",
    "ecm_extract/system/bridges.py": "what the directions of a bridge are in the graph",
    "parsers/ecm_parsers/sros_policy.py": "what a policy of SROS 2 grants",
}
"""Files with a list of words that are also words of roles or kinds; the list only gets shorter."""


def _trees() -> Iterator[tuple[str, ast.AST]]:
    for folder in OURS:
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield str(path.relative_to(ROOT)), ast.parse(path.read_text("utf-8"))


def _texts(node: ast.AST) -> set[str]:
    return {each.value for each in ast.walk(node) if isinstance(each, ast.Constant) and isinstance(each.value, str)}


def _names(node: ast.AST) -> set[str]:
    return {each.attr if isinstance(each, ast.Attribute) else each.id for each in ast.walk(node) if _is_named(each)}


def _is_named(node: ast.AST) -> bool:
    return isinstance(node, ast.Attribute | ast.Name)


def _compared(column: str, words: set[str]) -> Iterator[str]:
    """Files in which a column is compared with words of the vocabulary."""
    for path, tree in _trees():
        tests = (node for node in ast.walk(tree) if isinstance(node, ast.Compare | ast.MatchValue))
        if any(column in _names(node) and _texts(node) & words for node in tests):
            yield path


def _grouped(words: set[str]) -> Iterator[str]:
    """Files with a collection of several words, none of which is another one."""
    for path, tree in _trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.Set | ast.Tuple | ast.List) and len(node.elts) > 1:
                texts = {each.value for each in node.elts if isinstance(each, ast.Constant)}
                if len(texts) == len(node.elts) and texts <= words:
                    yield path


def test_roles_are_told_once() -> None:
    """A word of a role stands where something is read, and nowhere else: all others ask its row.

    `parameter` is a kind of name, of a condition and of a file as well, and is bounded where it is compared.
    """
    words = set(roles()) - set(kinds())
    told = Counter(path for path, tree in _trees() for node in ast.walk(tree) for _ in _texts_of(node) & words)
    assert set(told) == set(ROLES_TOLD)
    assert sum(told.values()) <= 14


def _texts_of(node: ast.AST) -> set[str]:
    return {node.value} if isinstance(node, ast.Constant) and isinstance(node.value, str) else set()


@pytest.mark.parametrize(("column", "words"), [("role", set(roles())), ("use", set(uses()))])
def test_no_decision_by_the_word_of_a_role_or_use(column: str, words: set[str]) -> None:
    """A new row is treated as its columns say, not left out by a list that nobody thought of."""
    assert list(_compared(column, words)) == []


def test_no_decision_by_the_word_of_a_kind() -> None:
    """The same of kinds of names."""
    assert sorted(_compared("kind", set(kinds()))) == sorted(OTHER_KINDS)


@pytest.mark.parametrize("words", [set(roles()), set(kinds())], ids=["roles", "kinds"])
def test_no_list_of_words(words: set[str]) -> None:
    """What several kinds or roles have in common is a column of their rows."""
    assert set(_grouped(words)) <= set(LISTED)


def test_rows_name_rows() -> None:
    """A word that a row has for another row is one of the tables."""
    for row in roles().values():
        assert row.provides in {"", *kinds()}
        assert {row.peer, row.behind} <= {"", *roles()}
        assert {row.use, row.joins} <= {"", *uses()}
    for kind in kinds().values():
        assert kind.owned_by in {"", *kinds()}
    for use in uses().values():
        assert set(use.of) <= set(kinds())
