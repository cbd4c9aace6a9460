"""Linking one side in another process: the same result, and no result is lost with a process."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from diff_repos import node, package, release

from ecm_extract.cli.run import run
from ecm_extract.parallel_work import Background


def test_the_result_comes_back() -> None:
    assert Background(lambda: {"a": [os.getpid() != os.getppid()]}).result() == {"a": [True]}


def test_a_process_that_dies_costs_time_only() -> None:
    """The work is done here instead."""
    home = os.getpid()

    def work() -> str:
        if os.getpid() != home:
            os._exit(1)
        return "done here"

    assert Background(work).result() == "done here"


def test_the_report_does_not_depend_on_the_number_of_processes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Same bytes for one job and for two."""
    make = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION x)\n"
    for tag, name in (("1.0.0", "tool"), ("2.0.0", "gripper")):
        files = {"package.xml": package("arm", tag), "CMakeLists.txt": make}
        release(tmp_path / "arm", {**files, "src/arm.cpp": node(f'declare_parameter("{name}", "x");')}, tag)
    outputs = set()
    for jobs in ("1", "2"):
        run(["diff", "1.0.0", "2.0.0", "--repo", str(tmp_path / "arm"), "--format", "json", "--jobs", jobs])
        outputs.add(capsys.readouterr().out)
    assert len(outputs) == 1
