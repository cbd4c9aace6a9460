"""Many objects out of one `git cat-file --batch`, streamed in the order asked for."""

import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from threading import Thread
from typing import IO

from ecm_extract.errors import GitError, ToolError
from ecm_extract.tree.git_repo import TIMEOUT_S, GitRepo

_MAX_RESTARTS = 100


def read_objects(repo: GitRepo, ids: Sequence[str]) -> Iterator[tuple[str, bytes | None]]:
    """Id and content of each object; None where the repository does not have it, or has it damaged.

    Git gives up at a damaged object, so the rest is asked for again, a bounded number of times.

    Raises:
        GitError: git is missing, or the repository has too many damaged objects.
    """
    done = 0
    for _ in range(_MAX_RESTARTS):
        for name, data in _until_damage(repo, ids[done:]):
            done += 1
            yield name, data
        if done == len(ids):
            return
        yield ids[done], None
        done += 1
    message = f"More than {_MAX_RESTARTS} objects of {repo.name} are damaged."
    raise GitError(message, "Check the repository with `git fsck`.")


def _until_damage(repo: GitRepo, ids: Sequence[str]) -> Iterator[tuple[str, bytes | None]]:
    if not ids:
        return
    with repo.process("cat-file", "--batch", "--buffer") as process:
        stdin, stdout = pipes(process)
        with _fed(stdin, ids):
            try:
                yield from _answers(stdout, ids)
            finally:
                # The feeder may wait on a full pipe when the caller stops early.
                process.kill()


def describe_objects(repo: GitRepo, names: Sequence[str]) -> list[tuple[str, str] | None]:
    """Id and type (`commit`, `tree`, `blob`, `tag`) of each object name; None where there is none.

    Names come by standard input, so none can be taken for an option; they must hold no line break.
    """
    request = "".join(f"{name}\n" for name in names).encode("utf-8", "surrogateescape")
    _, out = repo.run("cat-file", "--batch-check", stdin=request)
    lines = out.decode("utf-8", "surrogateescape").splitlines()
    return [_described(line) for line in lines]


def _described(line: str) -> tuple[str, str] | None:
    parts = line.split(" ")
    is_object = len(parts) == 3 and parts[1] in ("commit", "tree", "blob", "tag") and parts[2].isdigit()
    return (parts[0], parts[1]) if is_object else None


@contextmanager
def _fed(stdin: IO[bytes], ids: Sequence[str]) -> Iterator[None]:
    """Feed from a thread: git stops reading while its output waits, and a single thread would deadlock."""
    feeder = Thread(target=_feed, args=(stdin, ids), daemon=True)
    feeder.start()
    try:
        yield
    finally:
        feeder.join(TIMEOUT_S)


def _feed(stdin: IO[bytes], ids: Sequence[str]) -> None:
    """A pipe that broke or was closed is nothing to tell of here: who reads the answers sees that they end."""
    request = "".join(f"{name}\n" for name in ids).encode("ascii")
    with suppress(BrokenPipeError, ValueError):
        stdin.write(request)
    with suppress(BrokenPipeError, ValueError):
        stdin.close()


def _answers(stdout: IO[bytes], ids: Sequence[str]) -> Iterator[tuple[str, bytes | None]]:
    for name in ids:
        header = stdout.readline().split()
        if len(header) == 2 and header[1] == b"missing":
            yield name, None
            continue
        if len(header) != 3:
            return
        size = int(header[2])
        data = stdout.read(size + 1)[:-1]
        if len(data) != size:
            return
        yield name, data


def pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes]]:
    """Standard input and output of a process that was started with both as pipes."""
    if process.stdin is None or process.stdout is None:
        message = "git was started without pipes."
        raise ToolError(message)
    return process.stdin, process.stdout
