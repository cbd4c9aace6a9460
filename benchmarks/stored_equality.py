"""Whether stored documents say the same as sources: `python benchmarks/stored_equality.py CLONES`.

Pairs of release tags that follow each other are drawn by a seed from the clones of a folder (`stored_draw.py`). Of each
pair `diff` (with another clone as consumer), `check`, `system` of some launch files and `lint` of some packages are
asked from its sources, from extract documents and from folders of package documents (`stored_questions.py`). Printed is
a line for each pair, the first difference of each question that has one, and what documents cost. Status 1 when an
answer differs.
"""

from __future__ import annotations

import argparse
import os
import random
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import msgspec
from extracted import command
from stored_draw import Drawn, drawn
from stored_questions import Documents, Question, Sides, UnreadableError, questions

PAIRS: Final = 20
_FAILED: Final = 2


class Told(msgspec.Struct, frozen=True):
    """What is answered, apart from how the inputs are called, and the seconds that it took."""

    document: Any
    seconds: float


class Costs(msgspec.Struct, frozen=True):
    """Of one pair: bytes of the new document and of it compressed; seconds."""

    size: int
    compressed: int
    write: float
    read: float
    stored: float
    sources: float


class Asked(msgspec.Struct, frozen=True):
    """Which questions are asked: drawn by a seed, those whose names begin with a word."""

    seed: int
    only: str


class Judged(msgspec.Struct, frozen=True):
    """A pair with how often it was asked, and where answers first differ by question."""

    pair: Drawn
    asked: int
    differences: dict[str, str]
    costs: Costs


class Extractor:
    """Documents of trees below a folder, each made once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._made: dict[tuple[Path, str], Documents] = {}

    def documents(self, repo: Path, ref: str) -> Documents:
        """Return the documents of a ref of a clone."""
        key = (repo, ref)
        if key not in self._made:
            self._made[key] = self._make(repo, ref)
        return self._made[key]

    def _make(self, repo: Path, ref: str) -> Documents:
        place = self._folder / f"{repo.name}-{ref.replace('/', '_')}"
        place.mkdir()
        document, folder = place / "extract.json", place / "packages"
        line = ["extract", str(repo), "--ref", ref, "--quiet"]
        started = time.perf_counter()
        document.write_bytes(_run([*line, "--format", "json", "-o", "-"]))
        seconds = time.perf_counter() - started
        _run([*line, "-o", str(folder)])
        return Documents(document, folder, seconds)


def judged(pair: Drawn, extractor: Extractor, work: Path, wanted: Asked) -> Judged:
    """Ask what is wanted of a pair in all forms."""
    old, new = (extractor.documents(pair.repo, ref) for ref in (pair.old, pair.new))
    used = extractor.documents(pair.consumer, "HEAD") if pair.consumer is not None else None
    every = questions(pair, Sides(old, new, used, work), random.Random(wanted.seed))
    asked = [each for each in every if each.name.startswith(wanted.only)]
    answers = [_answered(question) for question in asked]
    found = {each.name: text for each, told in zip(asked, answers, strict=True) if (text := _first_difference(told))}
    sources, stored = (answers[0][0].seconds, answers[0][1].seconds) if answers else (0.0, 0.0)
    return Judged(pair, len(asked), found, _costs(new, stored, sources))


def _answered(question: Question) -> list[Told]:
    """The answer of the sources, then those of the forms of documents."""
    sources = told(question.sources)
    stored = [told(words) for words in question.stored]
    return [_shown_of(sources, question.shown), *(_shown_of(each, question.told) for each in stored)]


def _shown_of(answer: Told, shown: Callable[[Any], Any]) -> Told:
    """What of an answer counts; of one that is empty its status does."""
    document = answer.document
    return Told({**document, "answer": shown(document["answer"])}, answer.seconds) if document["answer"] else answer


def _first_difference(answers: list[Told]) -> str | None:
    sources, *stored = answers
    found = (difference(sources.document, each.document) for each in stored)
    return next((text for text in found if text is not None), None)


def told(words: tuple[str, ...]) -> Told:
    """Ask once."""
    started = time.perf_counter()
    done = subprocess.run([command(), *words], capture_output=True, check=False, env=os.environ)
    answer = msgspec.json.decode(done.stdout) if done.stdout else {}
    return Told({"status": done.returncode, "answer": answer}, time.perf_counter() - started)


def difference(left: Any, right: Any, place: str = "") -> str | None:
    """Return where two documents first differ, and what each says there; None where they are equal."""
    if type(left) is type(right) and isinstance(left, dict) and list(left) == list(right):
        steps = ((f"{place}.{key}", left[key], right[key]) for key in left)
    elif type(left) is type(right) and isinstance(left, list) and len(left) == len(right):
        steps = ((f"{place}[{index}]", *both) for index, both in enumerate(zip(left, right, strict=True)))
    else:
        return None if left == right else f"{place}: {_shown(left, right)} != {_shown(right, left)}"
    return next((text for at, one, other in steps if (text := difference(one, other, at)) is not None), None)


def _shown(value: Any, other: Any) -> str:
    """A value; of a list what the other lacks."""
    if isinstance(value, list) and isinstance(other, list):
        value = {"length": len(value), "alone": [each for each in value if each not in other][:1]}
    return msgspec.json.encode(value).decode()


def _costs(documents: Documents, stored: float, sources: float) -> Costs:
    from ecm_checker.hub.package import decode_documents

    data = documents.document.read_bytes()
    started = time.perf_counter()
    decode_documents(data)
    read = time.perf_counter() - started
    return Costs(len(data), len(zlib.compress(data)), documents.seconds, read, stored, sources)


def _run(arguments: list[str]) -> bytes:
    return _output([command(), *arguments])


def _output(line: list[str]) -> bytes:
    done = subprocess.run(line, capture_output=True, check=False, env=os.environ)
    if done.returncode >= _FAILED and not done.stdout:
        message = f"{' '.join(line)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}"
        raise UnreadableError(message)
    return done.stdout


def report(found: Judged) -> None:
    """Print one pair."""
    costs = found.costs
    print(
        f"{'DIFFERS' if found.differences else 'equal  '} {found.pair.name}, {found.asked} questions: "
        f"{costs.size / 1e6:.1f} MB, {costs.compressed / 1e6:.2f} MB compressed; "
        f"write {costs.write:.2f} s, read {costs.read:.2f} s; "
        f"first answer {costs.stored:.2f} s, of sources {costs.sources:.2f} s",
        flush=True,
    )
    for question, text in found.differences.items():
        print(f"    {question}: {text[:600]}", flush=True)


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path, help="folder of clones, bare or not")
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", metavar="WORD", help="questions whose names begin so, as `lint`")
    arguments = parser.parse_args()
    unequal = asked = skipped = 0
    pairs = drawn(arguments.clones, arguments.pairs, arguments.seed)
    with tempfile.TemporaryDirectory() as folder:
        extractor = Extractor(Path(folder))
        for pair in pairs:
            try:
                found = judged(pair, extractor, Path(folder) / "work", Asked(arguments.seed, arguments.only))
            except UnreadableError as error:
                print(f"skipped {pair.name}: {error}", flush=True)
                skipped += 1
                continue
            report(found)
            unequal += bool(found.differences)
            asked += found.asked
    compared = len(pairs) - skipped
    print(f"{compared} pairs, {compared - unequal} equal; {asked} questions; {skipped} skipped")
    sys.exit(1 if unequal else 0)


if __name__ == "__main__":
    main()
