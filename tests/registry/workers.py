"""What the tests of concurrency run in processes of their own.

They are forked off a server that has the registry imported: sixteen processes that import it take longer than what
they do.
"""

from __future__ import annotations

import os
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerContext
from pathlib import Path

import msgspec
from ecm_checker.hub.package import Package

from ecm_extract.registry.publish import Origin, make_ready, publish
from ecm_extract.registry.questions import Asked, who_uses
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify


def context() -> ForkServerContext:
    """Processes that hold nothing of this one, neither connections nor locks."""
    found = get_context("forkserver")
    found.set_forkserver_preload([publish.__module__, who_uses.__module__, Registry.__module__, verify.__module__])
    return found


def variant(package: Package, writer: int, number: int) -> Package:
    """A release of its own; two writers have each pair of neighbours in common."""
    return msgspec.structs.replace(package, version=f"1.{writer // 2}.{number}")


def write(url: str, document: str, writer: int, count: int, done: Connection | None = None) -> int:
    """Publish releases, each in a transaction; what is done is told by its number."""
    package = msgspec.json.decode(Path(document).read_bytes(), type=Package)
    with Registry(url) as registry:
        for number in range(count):
            ready = [make_ready(variant(package, writer, number))]
            with registry.writing() as session:
                publish(session, ready, Origin("robot"))
            if done is not None:
                done.send(number)
    return count


def read(url: str, count: int) -> int:
    """Ask while others write; what is seen is whole."""
    with Registry(url) as registry:
        for _ in range(count):
            with registry.reading() as session:
                assert verify(session).problems == ()
                who_uses(session, "driver", Asked(), EVERYTHING)
    return count


def end_at(job: int) -> str:
    """A worker that dies of one job, as when the system takes its memory."""
    if str(job) == os.environ["ECM_TEST_BAD"]:
        os._exit(9)
    return str(job)
