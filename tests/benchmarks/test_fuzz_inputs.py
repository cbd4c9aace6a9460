"""Inputs of the fuzzer: the same seed makes the same ones, and none is larger than the bound."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest
from fuzz_inputs import KINDS, MAX_BOMB, bomb, mutant

_TEXT = "<a>1</a>\nword 2\n" * 10


@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_makes_the_same_inputs(kind: str) -> None:
    """A failure can be made again from its seed."""
    one, two = ([make(random.Random(seed)) for seed in range(20) for make in _makers(kind)] for _ in range(2))
    assert one == two
    assert max(map(len, one)) <= MAX_BOMB + len(_TEXT)


def _makers(kind: str) -> tuple[Callable[[random.Random], str], ...]:
    return (
        lambda chance: mutant(_TEXT, [_TEXT], chance),
        lambda chance: bomb(KINDS[kind], _TEXT, chance),
    )
