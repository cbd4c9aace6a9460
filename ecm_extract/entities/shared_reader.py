"""A reader that parses no blob twice within one run."""

from __future__ import annotations

from collections.abc import Mapping

from ecm_parsers.source.facts import SourceFile

from ecm_extract.cache.blobs import Blob
from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.parsed_file import BlobFacts
from ecm_extract.read.reader import Progress, Reader


class SharedReader(Reader):
    """Takes the facts of blobs that another tree of the run holds too.

    Attributes:
        parsed: facts by blob id, shared between the readers of a run.
    """

    parsed: dict[str, SourceFile]

    def read(self, jobs: int | None, progress: Progress | None = None) -> list[PackageFacts]:
        """Return the facts of every package, those of known blobs included."""
        packages = super().read(jobs, progress)
        for package in packages:
            for path, facts in package.sources.items():
                if path in self.blobs:
                    self.parsed[self.blobs[path]] = facts
        return packages

    def _wants_blobs(self) -> bool:
        return True

    def _known(self, wanted: Mapping[str, Blob]) -> dict[str, BlobFacts]:
        shared = {path: facts for path, blob in wanted.items() if (facts := self._shared(blob)) is not None}
        rest = {path: blob for path, blob in wanted.items() if path not in shared}
        return super()._known(rest) | shared

    def _shared(self, blob: Blob) -> BlobFacts | None:
        kind, name = blob
        facts = self.parsed.get(name)
        language = "cpp" if kind == "cpp" else "python"
        return None if facts is None or facts.language != language else BlobFacts(0, facts)
