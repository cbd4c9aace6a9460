"""What a command line names: a graph or a recording to look at, and the contracts of what should be there."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.contract import Contract

from ecm_extract.check_inputs import launched_contracts, whole_subject
from ecm_extract.errors import InputError
from ecm_extract.observe.model import Observation

_MASTER: Final = "http://localhost:11311"
_LARGEST_DOMAIN: Final = 232


class Target(msgspec.Struct, frozen=True):
    """What to look at: exactly one of them.

    Attributes:
        ros1: URI of a master; empty for that of the environment. dds: domain; empty for that of the environment.
        bags: recordings. seconds: how long to look. once: look once and do not listen.
    """

    ros1: str | None = None
    dds: str | None = None
    bags: tuple[str, ...] = ()
    seconds: float = 10.0
    once: bool = False


class Promised(msgspec.Struct, frozen=True):
    """Where contracts are: paths of manifests, documents or trees; launch files with arguments of one workspace."""

    paths: tuple[str, ...] = ()
    workspace: str | None = None
    launch: tuple[str, ...] = ()
    cache: bool = True


def observations(target: Target) -> Iterator[Observation]:
    """Yield what is seen, again and again; the last one is the whole.

    Raises:
        InputError: there is nothing to look at, or it cannot be read.
    """
    chosen = [target.ros1 is not None, target.dds is not None, bool(target.bags)]
    if sum(chosen) != 1:
        message = "name one thing to look at"
        raise InputError(message, "--ros1 [URI], --dds [DOMAIN] or --bag FILE")
    if target.ros1 is not None:
        from ecm_extract.observe.ros1 import watch_ros1

        uri = target.ros1 or os.environ.get("ROS_MASTER_URI", "") or _MASTER
        yield from watch_ros1(uri, target.seconds, once=target.once)
    elif target.dds is not None:
        yield from _dds(_domain(target.dds), target)
    else:
        from ecm_extract.observe.bag import observe_bags

        yield observe_bags([Path(name) for name in target.bags])


def promised_contracts(given: Promised) -> tuple[Contract, ...]:
    """Contracts of what should be there; those of a launch with its interface packages, whose types it uses.

    Raises:
        InputError: a path holds none, or a launch file is named without its workspace.
    """
    if given.launch and given.workspace is None:
        message = "--launch names a file of a workspace"
        raise InputError(message, "add --workspace DIR")
    found = [each for path in given.paths for each in whole_subject(path, given.cache).contracts]
    if given.workspace is not None:
        read = whole_subject(given.workspace, given.cache).contracts
        found += _launched(given, read) if given.launch else read
    return tuple(found)


def _launched(given: Promised, read: Sequence[Contract]) -> Iterator[Contract]:
    """Nodes of the launch, each as of the release of its package, and interface packages."""
    assert given.workspace is not None
    versions = {each.ecm.package: each.ecm.version for each in read}
    for each in launched_contracts(given.workspace, given.launch, given.cache).contracts:
        identity = msgspec.structs.replace(each.ecm, version=versions.get(each.ecm.package))
        yield msgspec.structs.replace(each, ecm=identity)
    yield from (each for each in read if each.ecm.kind == "interface")


def _dds(domain: int, target: Target) -> Iterator[Observation]:
    try:
        from ecm_extract.observe.dds import watch_dds
    except ImportError as error:
        message = f"DDS needs Eclipse Cyclone DDS, which is not installed ({error})"
        raise InputError(message, "pip install 'ecm-extract[dds]'") from None
    yield from watch_dds(domain, target.seconds, once=target.once)


def _domain(text: str) -> int:
    number = text or os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not number.isdigit() or int(number) > _LARGEST_DOMAIN:
        message = f"{number!r} is no domain"
        raise InputError(message, f"a domain is a number from 0 to {_LARGEST_DOMAIN}")
    return int(number)
