"""The freeze: verdicts count only when the checker is the pinned one."""

from __future__ import annotations

from ecm_checker.contract import Contract, Identity, Source
from ecm_checker.freeze import content_hash, verify
from ecm_checker.operations.system import system


def test_this_checker_is_the_pinned_one() -> None:
    """After a change of rules or model: `ecm-extract check --freeze`, and say why in the commit."""
    assert verify().holds


def test_every_report_carries_the_hash() -> None:
    """Who reads a verdict can tell which rules gave it."""
    module = Contract(Identity("ecm.a.b", "a", "node", None, Source(None, None, "."), 2))
    assert system([module]).checker == content_hash()
    assert len(content_hash()) == 64
