"""What a function declared within another one only hands on, and nobody who gets it can change: texts and constants."""

from __future__ import annotations

from ecm_parsers.source.expr import Name, Text

from ecm_extract.infer.effect import Effect
from ecm_extract.infer.effects import Effects, is_plain


def is_left_alone(effect: Effect, around: Effects) -> bool:
    """Tell whether an effect in a function leaves a variable of the one around it as it is: somebody only gets it."""
    return effect.kind == "handed" and (_is_text(effect.key, around) or around.is_constant_value(effect.key))


def _is_text(key: str, around: Effects) -> bool:
    """Whether a variable is declared as a literal text, which nobody can change."""
    body = around.func.fact.body
    if around.python:
        bound = [entry for entry in body if entry.target == Name(key)]
        return bool(bound) and all(is_plain(entry.value) for entry in bound)
    lets = [entry for entry in body if entry.kind == "let" and entry.target == Name(key)]
    fixed = all(isinstance(entry.value, Text) and ("*" in entry.type or entry.type == "auto") for entry in lets)
    return bool(lets) and fixed
