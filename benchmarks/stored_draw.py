"""Draws releases that follow each other from a folder of clones, each second pair with a tree that uses it."""

from __future__ import annotations

import random
import re
import subprocess
import sys
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Final

import msgspec

_VERSION: Final = "*[0-9].[0-9]*"
_NAMES: Final = re.compile(r"<name>\s*([\w-]+)")
_DEPENDS: Final = re.compile(r"<\w*depend\b[^>]*>\s*([\w-]+)")


class Drawn(msgspec.Struct, frozen=True):
    """Two releases of a repository, and a clone that uses them; None for none."""

    repo: Path
    old: str
    new: str
    consumer: Path | None = None

    @property
    def name(self) -> str:
        """The pair in one line."""
        used = f" for {self.consumer.name}" if self.consumer is not None else ""
        return f"{self.repo.name} {self.old}..{self.new}{used}"


def drawn(clones: Path, count: int, seed: int) -> list[Drawn]:
    """Draw pairs from the clones in turn; every second one with a consumer, where one depends on its packages."""
    chance = random.Random(seed)
    repos = sorted(path for path in clones.iterdir() if (path / ".git").exists() or (path / "HEAD").exists())
    pairs = {repo: _shuffled(list(pairwise(releases(repo))), chance) for repo in repos}
    turns = [repo for turn in range(count) for repo in repos if turn < len(pairs[repo])][:count]
    return [
        Drawn(repo, *pairs[repo].pop(), _consumer(repo, repos, chance) if number % 2 else None)
        for number, repo in enumerate(turns)
    ]


def _consumer(repo: Path, repos: Sequence[Path], chance: random.Random) -> Path | None:
    names = set(_NAMES.findall(_manifests(repo)))
    others = [each for each in repos if each != repo]
    users = [each for each in others if names & set(_DEPENDS.findall(_manifests(each)))]
    return chance.choice(users or others) if others else None


def _manifests(repo: Path) -> str:
    """The lines of all package.xml of a clone that name a package."""
    found = _git(repo, "grep", "-h", "-I", "-E", "<name>|depend", "HEAD", "--", "*package.xml")
    return found.decode("utf-8", "replace")


def releases(repo: Path) -> list[str]:
    """Return the release tags of a clone, the oldest first."""
    return _git(repo, "tag", "--list", _VERSION, "--sort=version:refname").decode().split()


def _shuffled(pairs: list[tuple[str, str]], chance: random.Random) -> list[tuple[str, str]]:
    chance.shuffle(pairs)
    return pairs


def _git(repo: Path, *words: str) -> bytes:
    done = subprocess.run(["git", "-C", str(repo), *words], capture_output=True, check=False)
    if done.returncode > 1:
        sys.exit(f"git {' '.join(words)} in {repo} ended with status {done.returncode}:\n{done.stderr.decode()}")
    return done.stdout
