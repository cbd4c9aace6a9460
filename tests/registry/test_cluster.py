"""Indexing by the workers of a Dask cluster: a real one on this machine."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from clones import clone_of_three

from ecm_extract.errors import InputError
from ecm_extract.registry.cluster import Cluster
from ecm_extract.registry.index import jobs_of, run, split_known
from ecm_extract.registry.releases import list_releases
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify

distributed = pytest.importorskip("distributed", reason="Dask is not installed: pip install 'ecm-extract[dask]'")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """Of a scheduler that has two workers."""
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": ":0", "silence_logs": 50}
    with distributed.LocalCluster(**options) as cluster:
        yield cluster.scheduler_address


@pytest.mark.parametrize("url", ["postgresql"], indirect=True)
def test_a_cluster_does_the_same(url: str, address: str, tmp_path: Path) -> None:
    """Both workers write to one server; a second run has nothing to do."""
    jobs = jobs_of(clone_of_three(tmp_path / "robot"), None)
    with Registry.create(url) as registry:
        assert [each.state for each in run(url, jobs, Cluster(address))] == ["indexed"] * 3
        assert split_known(registry, jobs)[0] == []
        with registry.reading() as session:
            assert len(list_releases(session)) == 3
            assert verify(session).problems == ()


def test_a_job_that_fails_is_told(address: str) -> None:
    """The others come back."""
    done = {each.job: each for each in Cluster(address).do(int, ["1", "two", "3"])}
    assert (done["1"].result, done["3"].result) == (1, 3)
    assert "invalid literal" in done["two"].error


def test_no_scheduler_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """And how one is begun."""
    monkeypatch.setattr("ecm_extract.registry.cluster._WAIT_S", 0.5)
    with pytest.raises(InputError, match="no Dask scheduler"):
        list(Cluster("tcp://127.0.0.1:9").do(str, [1]))


@pytest.mark.parametrize(("workers", "threads", "wanted"), [(0, 1, "has no worker"), (1, 2, "several threads")])
def test_workers_that_cannot_do_it_are_told(workers: int, threads: int, wanted: str) -> None:
    """Rather than waited for."""
    options = {"processes": False, "dashboard_address": ":0", "silence_logs": 50}
    with (
        distributed.LocalCluster(n_workers=workers, threads_per_worker=threads, **options) as cluster,
        pytest.raises(InputError, match=wanted),
    ):
        list(Cluster(cluster.scheduler_address).do(str, [1]))
