"""The workers of a Dask cluster, which may be on other machines: they open the same registry and the same clones."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager
from importlib.metadata import version
from typing import Any, Final, TypeVar

from ecm_extract.errors import InputError
from ecm_extract.registry.workers import Done

_WAIT_S: Final = 10
_Job = TypeVar("_Job")
_Result = TypeVar("_Result")


class Cluster:
    """The workers that a Dask scheduler has when it is asked, and those that come later."""

    def __init__(self, address: str) -> None:
        """Name the scheduler: `tcp://HOST:8786`."""
        self._address = address

    def do(self, work: Callable[[_Job], _Result], jobs: Sequence[_Job]) -> Iterator[Done[_Job, _Result]]:
        """Do jobs and yield each when it is done.

        Raises:
            InputError: Dask is not installed, the scheduler is not there, or its workers cannot do them.
        """
        with _client(self._address) as client:
            _require_workers(client, self._address)
            futures = client.map(work, jobs, pure=False)
            by_key = {future.key: job for future, job in zip(futures, jobs, strict=True)}
            try:
                for future in _as_completed(futures, client):
                    yield _done(future, by_key[future.key])
            finally:
                client.cancel(futures)


def require_shared(url: str) -> None:
    """Make sure that a registry can be written by several machines.

    Raises:
        InputError: it is a file.
    """
    if url.startswith("sqlite"):
        message = "the workers of a cluster cannot share a registry that is a file"
        raise InputError(message, "name a server: --registry postgresql://USER@HOST/NAME")


@contextmanager
def _client(address: str) -> Iterator[Any]:
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        message = f"--dask needs the Python package {error.name}"
        raise InputError(message, "pip install 'ecm-extract[dask]'") from error
    try:
        client = Client(address, timeout=_WAIT_S, set_as_default=False)
    except (OSError, ValueError) as error:
        message = f"there is no Dask scheduler at {address}"
        raise InputError(message, "start one with `dask scheduler`; it tells its address") from error
    with client:
        yield client


def _require_workers(client: Any, address: str) -> None:
    """A worker of another version would store other contents under the same releases."""
    threads = client.nthreads()
    if not threads:
        message = f"the scheduler at {address} has no worker"
        raise InputError(message, f"start some with `dask worker {address} --nthreads 1`")
    if max(threads.values()) > 1:
        message = f"workers at {address} have several threads, and an extraction needs a process of its own"
        raise InputError(message, f"start them with `dask worker {address} --nworkers N --nthreads 1`")
    try:
        found = set(client.run(_version).values())
    except Exception as error:  # whatever happened there is raised here
        found = {str(error)}
    if found != {_version()}:
        message = f"the workers at {address} have {', '.join(sorted(found))}, and this is {_version()}"
        raise InputError(message, "install the same version on all of them: pip install 'ecm-extract[dask]'")


def _version() -> str:
    return f"ecm-extract {version('ecm-extract')}"


def _as_completed(futures: Sequence[Any], client: Any) -> Iterator[Any]:
    from distributed import as_completed

    return iter(as_completed(futures, loop=client.loop))


def _done(future: Any, job: _Job) -> Done[_Job, Any]:
    try:
        error = future.exception()
    except CancelledError as cancelled:  # the scheduler went away
        error = cancelled
    if error is not None:
        return Done(job, None, str(error) or type(error).__name__)
    return Done(job, future.result())
