"""Contracts of releases that should run somewhere: what `observe` compares with."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_checker.contract import Contract
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.environments import running
from ecm_extract.registry.releases import find_release, package_of_release


def contracts_of_releases(session: Session, specs: Sequence[str], environment: str | None) -> tuple[Contract, ...]:
    """Return the contracts of releases.

    Args:
        session: one that reads.
        specs: releases; each takes the place of the one of its package that the environment runs.
        environment: whose releases run too; None for none.

    Raises:
        InputError: a release is not stored, or nothing is recorded of the environment.
    """
    runs = {each.package: each for each in running(session, environment)} if environment is not None else {}
    if environment is not None and not runs:
        message = f"nothing is recorded of the environment {environment}"
        raise InputError(message, f"record what it runs: `ecm-extract registry record {environment} RELEASE...`")
    runs |= {each.package: each for each in (find_release(session, spec) for spec in specs)}
    return tuple(module for each in runs.values() for module in package_of_release(session, each).contracts())
