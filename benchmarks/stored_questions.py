"""What is asked of a pair of releases twice: of its sources, and of its stored documents.

Every question is the words of `ecm-extract` for both ways, and what of the two answers must be equal: all of it, but
for how the inputs are called.
"""

from __future__ import annotations

import io
import random
import re
import subprocess
import tarfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, Final, TypeVar

import msgspec
from stored_draw import Drawn

from ecm_extract.discover import IGNORE_MARKERS
from ecm_extract.lint.catalogue import catalogue
from ecm_extract.test_code import is_test_package

LAUNCHES: Final = 2
"""Launch files of a release whose systems are asked for."""
FOLDERS: Final = 1
"""Packages of a release that are linted with the others as documents."""
OF_ONE_TREE: Final = frozenset(entry.rule.id for entry in catalogue() if entry.rule.of_one_tree)
"""Rules that are not asked of documents, which `lint` says."""
_Each = TypeVar("_Each")
_JSON: Final = ("--format", "json")


class UnreadableError(Exception):
    """A clone that lacks what git is asked for, as one without its large files."""


class Documents(msgspec.Struct, frozen=True):
    """An extract document and a folder of package documents of one tree, and the seconds that writing took."""

    document: Path
    folder: Path
    seconds: float

    @property
    def forms(self) -> tuple[Path, Path]:
        """Both ways to name them."""
        return self.document, self.folder


class Question(msgspec.Struct, frozen=True):
    """One question.

    Attributes:
        name: what is asked. sources: the words that ask the sources.
        stored: the words that ask stored documents, one for each form. shown: what of an answer of the sources counts;
            told: the same of an answer of documents.
    """

    name: str
    sources: tuple[str, ...]
    stored: tuple[tuple[str, ...], ...]
    shown: Callable[[Any], Any]
    told: Callable[[Any], Any]


class Sides(msgspec.Struct, frozen=True):
    """The documents of a pair, of its consumer, and a folder for work trees."""

    old: Documents
    new: Documents
    used: Documents | None
    work: Path


def questions(pair: Drawn, sides: Sides, chance: random.Random) -> Iterator[Question]:
    """Yield all that is asked of a pair."""
    yield diff(pair, sides)
    yield check(pair, sides.new)
    launches = [path for path in _paths(pair) if ".launch" in path]
    yield from (system(pair, sides.new, path) for path in _some(launches, LAUNCHES, chance))
    yield from lints(pair, sides, chance)


def diff(pair: Drawn, sides: Sides) -> Question:
    """What changed and whom it breaks."""
    end = ("--repo", str(pair.repo), *_JSON, "--fail-on", "never")
    used = ("--consumer", f"{pair.consumer}@HEAD") if pair.consumer is not None else ()
    forms = zip(sides.old.forms, sides.new.forms, sides.used.forms if sides.used else (None, None), strict=True)
    stored = tuple(
        ("diff", str(old), str(new), *end, *(("--consumer", str(consumer)) if consumer else ()))
        for old, new, consumer in forms
    )
    return Question("diff", ("diff", pair.old, pair.new, *end, *used), stored, _without_refs, _without_refs)


def _without_refs(answer: Any) -> Any:
    for side in ("old", "new"):
        del answer[side]["ref"]
    return answer


def check(pair: Drawn, new: Documents) -> Question:
    """What of the newer release would not run together."""
    sources = ("check", f"{pair.repo}@{pair.new}", *_JSON, "--quiet")
    stored = tuple(("check", str(form), *_JSON, "--quiet") for form in new.forms)
    return Question("check", sources, stored, _without_inputs, _without_inputs)


def _without_inputs(answer: Any) -> Any:
    """The lines of `not_asked` name the inputs."""
    del answer["not_asked"]
    return answer


def system(pair: Drawn, new: Documents, launch: str) -> Question:
    """What a launch file of the newer release starts."""
    sources = ("system", launch, "--workspace", str(pair.repo), "--ref", pair.new, *_JSON)
    stored = tuple(("system", str(form), launch, *_JSON) for form in new.forms)
    return Question(f"system {launch}", sources, stored, _all, _all)


def _all(answer: Any) -> Any:
    return answer


def lints(pair: Drawn, sides: Sides, chance: random.Random) -> Iterator[Question]:
    """Some packages and the consumer, with everything beside them in the tree and with it as documents."""
    tree = _checked_out(pair, sides.work)
    manifests = [Path(path).parent for path in _read(pair) if Path(path).name == "package.xml"]
    folders = [tree / "provider" / path for path in _some(manifests, FOLDERS, chance) if path != Path()]
    if pair.consumer is not None:
        folders.append(tree / "consumer")
    for folder in folders:
        yield _lint(tree, folder, sides)


def _lint(tree: Path, folder: Path, sides: Sides) -> Question:
    inside = folder.relative_to(tree).as_posix()
    documents = [(new, *((used,) if used else ())) for new, used in _beside(folder, sides)]
    end = ("--preview", *_JSON, "--fail-on", "never")
    stored = tuple(
        ("lint", str(folder), *(word for each in form for word in ("--documents", str(each))), *end)
        for form in documents
    )
    shown = _below(f"{inside}/", ("provider/", "consumer/"))
    return Question(f"lint {inside}", ("lint", str(tree), *end), stored, shown, _below("", ('document:[^/"]+/',)))


def _beside(folder: Path, sides: Sides) -> Iterator[tuple[Path, Path | None]]:
    """The documents of what lies beside a folder, by form; those of what lies in it count for nothing."""
    used = sides.used.forms if sides.used is not None else (None, None)
    yield from zip(sides.new.forms, used, strict=True)


def _below(folder: str, others: tuple[str, ...]) -> Callable[[Any], Any]:
    """Findings whose first line is in a folder, the paths in them from there; of other trees without what names these.

    Args:
        folder: whose findings count.
        others: patterns of how paths of other trees begin.
    """
    begins = re.compile(f'"(?:{"|".join(others)})')

    def shown(answer: Any) -> Any:
        told = [each for each in answer["findings"] if each["evidence"] and each["rule"] not in OF_ONE_TREE]
        found = [each for each in told if each["evidence"][0]["path"].startswith(folder)]
        texts = [msgspec.json.encode(each).decode() for each in found]
        return [
            msgspec.json.decode(text) for text in sorted(begins.sub('"', text.replace(folder, "")) for text in texts)
        ]

    return shown


def _checked_out(pair: Drawn, work: Path) -> Path:
    tree = work / f"{pair.repo.name}-{pair.new}".replace("/", "_")
    if not tree.is_dir():
        unpack(pair.repo, pair.new, tree / "provider")
        if pair.consumer is not None:
            unpack(pair.consumer, "HEAD", tree / "consumer")
    return tree


def unpack(repo: Path, ref: str, folder: Path) -> None:
    """Write the files of a ref into a new folder; UnreadableError where the clone lacks some."""
    folder.mkdir(parents=True)
    with tarfile.open(fileobj=io.BytesIO(_git(repo, "archive", ref))) as archive:
        archive.extractall(folder, filter="data")


def _paths(pair: Drawn) -> list[str]:
    return _git(pair.repo, "ls-tree", "-r", "--name-only", "-z", pair.new).decode("utf-8", "replace").split("\0")


def _read(pair: Drawn) -> list[str]:
    """The paths outside of folders that are left out: whoever lints one of these by its name asks for another tree."""
    paths = [path for path in _paths(pair) if not is_test_package(path.rpartition("/")[0])]
    ignored = {str(Path(path).parent) for path in paths if Path(path).name in IGNORE_MARKERS}
    return [path for path in paths if ignored.isdisjoint(str(folder) for folder in Path(path).parents)]


def _some(found: Sequence[_Each], count: int, chance: random.Random) -> list[_Each]:
    return chance.sample(found, min(count, len(found)))


def _git(repo: Path, *words: str) -> bytes:
    done = subprocess.run(["git", "-C", str(repo), *words], capture_output=True, check=False)
    if done.returncode:
        message = f"git {' '.join(words)} in {repo} ended with status {done.returncode}:\n{done.stderr.decode()}"
        raise UnreadableError(message)
    return done.stdout
