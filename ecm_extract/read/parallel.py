"""Parse source files on all cores.

Workers are forked, so they inherit the tree without a copy; the parent parses a share itself, and children hand
back encoded facts through a pipe: parsing two shares on two cores costs one pickle of nothing.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection

import msgspec
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.select import SourceKind, is_python_script
from ecm_extract.tree import FileDiagnostic, Tree, printable

Task = tuple[str, SourceKind]
MIN_PARALLEL = 40
BATCH = 24


class ParsedFile(msgspec.Struct, frozen=True, array_like=True):
    """One parsed source file on its way between processes."""

    path: str
    facts: SourceFile
    diagnostics: tuple[Diagnostic, ...]
    size: int = 0


class _Batch(msgspec.Struct, frozen=True, array_like=True):
    """What a worker sends: parsed files, and at the end what its tree could not read."""

    files: tuple[ParsedFile, ...]
    unread: tuple[FileDiagnostic, ...] = ()
    last: bool = False


def parse_sources(
    tree: Tree, tasks: Sequence[Task], jobs: int | None, done: Callable[[int], None]
) -> list[ParsedFile]:
    """Parse all files, in the order of `tasks`; what cannot be read is reported to the tree.

    Args:
        tree: where to read.
        tasks: path and kind of each file.
        jobs: processes in all; None takes one per core.
        done: called with the number of files finished since the last call.
    """
    count = jobs or os.cpu_count() or 1
    if count <= 1 or len(tasks) < MIN_PARALLEL:
        return list(_parse(tree, tasks, done))
    shares = _shares(tasks, count)
    context = get_context("fork")
    receivers: list[Connection] = []
    workers = []
    for share in shares[1:]:
        receiver, sender = context.Pipe(duplex=False)
        worker = context.Process(target=_work, args=(tree, share, sender), daemon=True)
        worker.start()
        sender.close()
        receivers.append(receiver)
        workers.append(worker)
    results: dict[str, ParsedFile] = {}
    collectors = [_Collector(receiver) for receiver in receivers]
    for parsed in _parse(tree, shares[0], done):
        results[parsed.path] = parsed
    for collector in collectors:
        for batch in collector.batches():
            done(len(batch.files))
            results.update((parsed.path, parsed) for parsed in batch.files)
            for diagnostic in batch.unread:
                tree.report(diagnostic)
    for worker in workers:
        worker.join()
    _report_lost(tree, tasks, results, workers)
    return [results[path] for path, _ in tasks if path in results]


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

    def batches(self) -> Iterable[_Batch]:
        """Return what the worker sent, after it has ended."""
        self._thread.join()
        decoder = msgspec.msgpack.Decoder(_Batch)
        return [decoder.decode(raw) for raw in self._raw]


def _work(tree: Tree, share: Sequence[Task], sender: Connection) -> None:
    before = len(tree.diagnostics)
    encoder = msgspec.msgpack.Encoder()
    pending: list[ParsedFile] = []
    for parsed in _parse(tree, share, lambda count: None):
        pending.append(parsed)
        if len(pending) >= BATCH:
            sender.send_bytes(encoder.encode(_Batch(tuple(pending))))
            pending = []
    sender.send_bytes(encoder.encode(_Batch(tuple(pending), tuple(tree.diagnostics[before:]), True)))
    sender.close()


def _parse(tree: Tree, tasks: Sequence[Task], done: Callable[[int], None]) -> Iterable[ParsedFile]:
    kinds = dict(tasks)
    for path, data in tree.read_many([path for path, _ in tasks]):
        done(1)
        parsed = parse_source(data, kinds[path])
        if parsed is not None:
            yield ParsedFile(path, parsed.facts, parsed.diagnostics, len(data))


def parse_source(data: bytes, kind: SourceKind) -> Parsed[SourceFile] | None:
    """Parse one source file; None for a script that is not Python."""
    if kind == "cpp":
        from ecm_parsers.source.cpp import parse_cpp

        return parse_cpp(data)
    if kind == "script" and not is_python_script(data):
        return None
    from ecm_parsers.source.python import parse_python

    return parse_python(data)


def _shares(tasks: Sequence[Task], count: int) -> list[list[Task]]:
    """Deal the files out in turn: neighbours are alike, so shares take about the same time."""
    return [list(tasks[start::count]) for start in range(count)]


def _report_lost(
    tree: Tree, tasks: Sequence[Task], results: dict[str, ParsedFile], workers: Sequence[object]
) -> None:
    """A worker that was killed costs its remaining files, and says so."""
    failed = [worker for worker in workers if getattr(worker, "exitcode", 0)]
    if not failed:
        return
    for path, kind in tasks:
        if path not in results and kind != "script":
            message = "The process that read this file was stopped. Run again with --jobs 1 to see why."
            tree.report(FileDiagnostic("error", "worker-lost", printable(path), 0, message))
