"""For programs: the whole score as one document (`ecm-corpus/score/1`)."""

from __future__ import annotations

import msgspec

from ecm_corpus.score import Score


def render(score: Score) -> str:
    """The score as JSON, with the properties of each row of the ledger written out."""
    plain = msgspec.to_builtins(score)
    for row, entry in zip(plain["ledger"], score.ledger, strict=True):
        row |= {"strict": entry.strict, "attributed": entry.attributed}
    return msgspec.json.format(msgspec.json.encode({"schema": "ecm-corpus/score/1", **plain}), indent=1).decode() + "\n"
