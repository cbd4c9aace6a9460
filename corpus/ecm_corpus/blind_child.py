"""The process of one blind run: an interface part comes in on standard input, results leave on standard output.

It is told where the clones are and nothing else, and shuts itself out of the narratives before it reads anything.
"""

from __future__ import annotations

import sys
from pathlib import Path

import msgspec

from ecm_corpus.guard import shut_out_narratives
from ecm_corpus.interface import InterfaceCase
from ecm_corpus.results import StateResult


class Order(msgspec.Struct, frozen=True):
    """What the process is to do: judge the states of a case with the clones of a folder."""

    case: InterfaceCase
    clones: str
    cache: bool


class Answer(msgspec.Struct, frozen=True):
    """What it found: results by state, files of the store by SHA-256, or what is wrong."""

    states: dict[str, StateResult] = {}
    files: dict[str, bytes] = {}
    wrong: str = ""


def answer(order: Order) -> Answer:
    """Judge every state of a case; what is wrong with one is told, not raised."""
    from ecm_corpus.judge import judge
    from ecm_extract.errors import EcmError
    from ecm_extract.extraction_model import Options

    states, files = dict[str, StateResult](), dict[str, bytes]()
    try:
        for name, state in order.case.states.items():
            judged = judge(state, Path(order.clones), Options(jobs=1, cache=order.cache))
            states[name] = judged.result
            files.update(judged.files)
    except EcmError as error:
        return Answer(wrong=str(error))
    return Answer(states, files)


def main() -> None:
    """Run as a process of its own."""
    shut_out_narratives()
    order = msgspec.msgpack.decode(sys.stdin.buffer.read(), type=Order)
    sys.stdout.buffer.write(msgspec.msgpack.encode(answer(order)))


if __name__ == "__main__":
    main()
