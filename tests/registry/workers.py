"""What the tests of concurrency run in processes of their own."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import msgspec
from ecm_checker.hub.package import Package

from ecm_extract.registry.publish import Origin, make_ready, publish
from ecm_extract.registry.questions import Asked, who_uses
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify


def variant(package: Package, writer: int, number: int) -> Package:
    """A release of its own; two writers have each pair of neighbours in common."""
    return msgspec.structs.replace(package, version=f"1.{writer // 2}.{number}")


def write(url: str, document: str, writer: int, count: int) -> int:
    """Publish releases, each in a transaction."""
    package = msgspec.json.decode(Path(document).read_bytes(), type=Package)
    with Registry(url) as registry:
        for number in range(count):
            ready = [make_ready(variant(package, writer, number))]
            with registry.writing() as session:
                publish(session, ready, Origin("robot"))
            sys.stdout.write(f"{number}\n")
            sys.stdout.flush()
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


if __name__ == "__main__":
    write(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
