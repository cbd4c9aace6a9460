"""Macros that stand before the type which a function returns."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp import parse_cpp

CLASS = "class T\n{\npublic:\n  {}\n  Q_SLOT bool last();\n};\n"


@pytest.mark.parametrize(
    ("line", "returns"),
    [
        ("Q_INVOKABLE QVariantMap look(const QString & frame, double timeout = 0);", "QVariantMap"),
        ("Q_INVOKABLE static std::vector<int> look();", "std::vector<int>"),
        ("MY_TYPE look();", "MY_TYPE"),
        ("MY_TYPE const & look();", "MY_TYPE"),
        ("MY_TYPE * look();", "MY_TYPE"),
    ],
)
def test_a_mark_is_no_type(line: str, returns: str) -> None:
    """What follows it is the type; a type in capitals that stands alone is one."""
    facts = parse_cpp(CLASS.replace("{}", line).encode()).facts
    assert {each.name: each.returns for each in facts.functions} == {"look": returns, "last": "bool"}
