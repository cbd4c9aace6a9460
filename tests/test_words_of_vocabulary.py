"""Only tables decide by words of the vocabulary: a new role, kind or use is a row, and the parser that fills it."""

from __future__ import annotations

from collections import Counter
from typing import Final

import pytest
from ecm_checker.hub.kinds import kinds, uses
from ecm_checker.hub.roles import roles
from own_sources import sources

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
    "ecm_extract/link/running/own_names.py": "holes of values",
    "ecm_extract/lint/rules/lnt041.py": "targets of CMake",
    "ecm_extract/lint/rules/lnt043.py": "targets of CMake",
    "ecm_extract/read/installed.py": "targets of CMake",
    "parsers/ecm_parsers/python/library.py": "substitutions of texts",
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


def _compared(column: str, words: set[str]) -> list[str]:
    """Files in which a column is compared with words of the vocabulary."""
    return [
        source.path
        for source in sources()
        if any(column in test.names and test.texts & words for test in source.compared)
    ]


def test_roles_are_told_once() -> None:
    """A word of a role stands where something is read, and nowhere else: all others ask its row.

    `parameter` is a kind of name, of a condition and of a file as well, and is bounded where it is compared.
    """
    words = set(roles()) - set(kinds())
    told = Counter(source.path for source in sources() for text in source.texts if text in words)
    assert set(told) == set(ROLES_TOLD)
    assert sum(told.values()) <= 14


@pytest.mark.parametrize(("column", "words"), [("role", set(roles())), ("use", set(uses()))])
def test_no_decision_by_the_word_of_a_role_or_use(column: str, words: set[str]) -> None:
    """A new row is treated as its columns say, not left out by a list that nobody thought of."""
    assert _compared(column, words) == []


def test_no_decision_by_the_word_of_a_kind() -> None:
    """The same of kinds of names."""
    assert sorted(_compared("kind", set(kinds()))) == sorted(OTHER_KINDS)


@pytest.mark.parametrize("words", [set(roles()), set(kinds())], ids=["roles", "kinds"])
def test_no_list_of_words(words: set[str]) -> None:
    """What several kinds or roles have in common is a column of their rows."""
    listed = {source.path for source in sources() if any(group <= words for group in source.groups)}
    assert listed <= set(LISTED)


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
