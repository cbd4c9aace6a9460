"""Parse source files on all cores.

Workers are forked, so they inherit the tree without a copy; the parent parses along, and children hand back
encoded facts through a pipe.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

import msgspec
from ecm_parsers.result import Parsed
from ecm_parsers.source.facts import SourceFile

from ecm_extract.processes import forked
from ecm_extract.read.parsed_file import BlobFacts, ParsedFile, Task
from ecm_extract.read.select import SourceKind, is_python_script
from ecm_extract.tree import FileDiagnostic, Tree, Unread, blob_id, printable

MIN_PARALLEL = 40
BATCH = 12


class _Batch(msgspec.Struct, frozen=True, array_like=True):
    """What a worker sends: parsed files, and at the end what its tree could not read."""

    files: tuple[ParsedFile, ...]
    unread: tuple[FileDiagnostic, ...] = ()


class SourceParse:
    """The parse of many files under way: workers run from `start` on, the caller joins in with `finish`."""

    def __init__(self, tree: Tree, tasks: Sequence[Task], jobs: int | None) -> None:
        self.tree = tree
        self.tasks = tasks
        count = jobs or os.cpu_count() or 1
        self._others = count - 1 if len(tasks) >= MIN_PARALLEL else 0
        self._context = get_context("fork")
        self._next = self._context.Value("i", 0)
        self._workers: list[BaseProcess] = []
        self._collectors: list[_Collector] = []

    def start(self) -> None:
        """Fork the workers; they inherit the tree without a copy."""
        for _ in range(self._others):
            receiver, sender = self._context.Pipe(duplex=False)
            worker = forked(self._work, sender)
            sender.close()
            self._collectors.append(_Collector(receiver))
            self._workers.append(worker)

    def finish(self, done: Callable[[int], None]) -> list[ParsedFile]:
        """Parse along until nothing is left; return all files in the order of the tasks.

        Args:
            done: called with the number of files finished since the last call.
        """
        results = {parsed.path: parsed for parsed in self._batches(done)}
        for collector in self._collectors:
            for batch in collector.batches():
                done(len(batch.files))
                results.update((parsed.path, parsed) for parsed in batch.files)
                for diagnostic in batch.unread:
                    self.tree.report(diagnostic)
        for worker in self._workers:
            worker.join()
        self._report_lost(results)
        return [results[path] for path, _ in self.tasks if path in results]

    def _batches(self, done: Callable[[int], None]) -> Iterator[ParsedFile]:
        """Take batches off the common counter, so that nobody waits for the slowest share."""
        while True:
            with self._next.get_lock():
                start = self._next.value
                self._next.value += BATCH
            if start >= len(self.tasks):
                return
            yield from _parse(self.tree, self.tasks[start : start + BATCH], done)

    def _work(self, sender: Connection) -> None:
        before = frozenset(self.tree.diagnostics)
        encoder = msgspec.msgpack.Encoder()
        pending: list[ParsedFile] = []
        for parsed in self._batches(lambda count: None):
            pending.append(parsed)
            if len(pending) >= BATCH:
                sender.send_bytes(encoder.encode(_Batch(tuple(pending))))
                pending = []
        unread = tuple(entry for entry in self.tree.diagnostics if entry not in before)
        sender.send_bytes(encoder.encode(_Batch(tuple(pending), unread)))
        sender.close()

    def _report_lost(self, results: Mapping[str, ParsedFile]) -> None:
        """A worker that was killed costs its remaining files, and says so."""
        if all(worker.exitcode == 0 for worker in self._workers):
            return
        unread = {diagnostic.path for diagnostic in self.tree.diagnostics}
        for path, _ in self.tasks:
            if path not in results and printable(path) not in unread:
                message = "The process that read this file was stopped. Run again with --jobs 1 to see why."
                shown = printable(path)
                self.tree.report(FileDiagnostic("error", "worker-lost", shown, 0, message, Unread(shown, "unreadable")))


class _Collector:
    """Drains a pipe beside the parent's own parsing, so that a full pipe never stops a worker."""

    def __init__(self, receiver: Connection) -> None:
        self._receiver = receiver
        self._raw: list[bytes] = []
        self._thread = threading.Thread(target=self._drain, daemon=True)
        self._thread.start()

    def _drain(self) -> None:
        try:
            while True:
                self._raw.append(self._receiver.recv_bytes())
        except (EOFError, OSError):
            return

    def batches(self) -> list[_Batch]:
        """Return what the worker sent, after it has ended."""
        self._thread.join()
        decoder = msgspec.msgpack.Decoder(_Batch)
        return [decoder.decode(raw) for raw in self._raw]


def _parse(tree: Tree, tasks: Sequence[Task], done: Callable[[int], None]) -> Iterator[ParsedFile]:
    kinds = dict(tasks)
    for path, data in tree.read_many([path for path, _ in tasks]):
        done(1)
        yield ParsedFile(path, blob_id(data), _content(data, parse_source(data, kinds[path])))


def _content(data: bytes, parsed: Parsed[SourceFile] | None) -> BlobFacts:
    return BlobFacts(len(data), None) if parsed is None else BlobFacts(len(data), parsed.facts, parsed.diagnostics)


def parse_source(data: bytes, kind: SourceKind) -> Parsed[SourceFile] | None:
    """Parse one source file; None for a script that is not Python."""
    if kind == "cpp":
        from ecm_parsers.source.cpp import parse_cpp

        return parse_cpp(data)
    if kind == "script" and not is_python_script(data):
        return None
    from ecm_parsers.source.python import parse_python

    return parse_python(data)
