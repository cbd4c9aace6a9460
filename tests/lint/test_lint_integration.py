"""The snippets of the integration page run as they stand there."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from git_repos import commit_all
from lint_fixtures import FIXTURES, ROOT

PAGE = (ROOT / "docs" / "integration.md").read_text("utf-8")


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A repository with `src`, and the tool on the path."""
    folder = tmp_path / "ws"
    shutil.copytree(FIXTURES / "LNT003" / "good", folder / "src")
    commit_all(folder)
    program = tmp_path / "bin" / "ecm-extract"
    program.parent.mkdir()
    program.write_text(f"#!/bin/sh\nexec {sys.executable} -c 'from ecm_extract.cli import main; main()' \"$@\"\n")
    program.chmod(0o755)
    return folder


def shell(script: str, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    path = f"{folder.parent / 'bin'}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        ["bash", "-e", "-c", script],
        cwd=folder,
        env={**os.environ, "PATH": path, **environment},
        capture_output=True,
        text=True,
    )


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


def test_pre_commit(workspace: Path) -> None:
    """The hook of the page, and the one that the repository brings."""
    hook = yaml.safe_load(blocks("yaml")[0])["repos"][0]["hooks"][0]
    (own,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    assert hook["entry"] == own["entry"]
    assert shell(hook["entry"], workspace).returncode == 0


def test_gitlab_and_colcon(workspace: Path) -> None:
    """Both leave a JUnit file."""
    job = yaml.safe_load(blocks("yaml")[2])["ecm-extract"]
    assert shell("\n".join(job["script"]), workspace).returncode == 0
    assert (workspace / job["artifacts"]["reports"]["junit"]).is_file()
    assert shell(blocks("sh")[0], workspace).returncode == 0
    assert (workspace / "build" / "ecm_extract" / "ecm.xunit.xml").is_file()


@pytest.mark.parametrize(("fail_on", "status"), [("never", 0), ("error", 1)])
def test_action(fail_on: str, status: int, workspace: Path) -> None:
    """The lint step writes SARIF and a summary in both modes, and fails only as a gate."""
    action = yaml.safe_load((ROOT / "action.yml").read_text("utf-8"))
    used = yaml.safe_load(blocks("yaml")[1])[1]["with"]
    assert used.keys() <= action["inputs"].keys()
    launch = workspace / "src" / "demo" / "launch" / "a.launch.xml"
    launch.write_text(launch.read_text().replace("base", "bass"))
    script = action["runs"]["steps"][1]["run"]
    done = shell(
        script, workspace, ECM_PATH="src", ECM_BASE="", ECM_FAIL_ON=fail_on, ECM_SARIF="out.sarif", ECM_PREVIEW="1"
    )
    assert done.returncode == status
    assert "::error file=src/demo/launch/a.launch.xml" in done.stdout
    assert (workspace / "out.sarif").is_file()
    assert "LNT003" in (workspace / "ecm-extract.md").read_text()
