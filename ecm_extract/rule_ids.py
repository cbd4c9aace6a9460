"""Ids of rules as people write them: in any case; where several may be meant, also the beginning of an id."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from ecm_extract.errors import InputError


def rule_id(text: str) -> str:
    """Return an id in its one spelling."""
    return text.strip().upper()


def rule_named(text: str, known: Collection[str]) -> str:
    """Return the id that a text names.

    Raises:
        InputError: there is no such rule.
    """
    found = rule_id(text)
    if found not in known:
        raise _unknown(text)
    return found


def rules_meant(texts: Iterable[str], known: Collection[str]) -> frozenset[str]:
    """Return the ids that texts name or begin: `lnt001`, or `LNT0` for all that begin so.

    Raises:
        InputError: a text means no rule.
    """
    return frozenset(rule for text in texts for rule in _begun_by(text, known))


def _begun_by(text: str, known: Collection[str]) -> list[str]:
    start = rule_id(text)
    found = [rule for rule in known if rule.startswith(start)] if start else []
    if not found:
        raise _unknown(text)
    return [start] if start in found else found


def _unknown(text: str) -> InputError:
    return InputError(f"there is no rule {text!r} here", "`ecm-extract rules` lists them")
