"""`ecm-extract extract` over a core that is replaced by a hand-made extraction."""

from __future__ import annotations

import json
import sys
import types
from pathlib import Path
from typing import Any

import pytest
import yaml
from extractions import demo, make_extraction

from ecm_extract.cli.run import run
from ecm_extract.extraction_model import Extraction, Options

MANIFEST = "base/ecm.base.driver.ecm.yaml"


class Core:
    """Stands in for the core and remembers what it was asked."""

    def __init__(self) -> None:
        self.extraction = demo()
        self.options = Options()
        self.opened: tuple[Any, ...] = ()

    def extract(self, _tree: object, options: Options) -> Extraction:
        self.options = options
        return self.extraction

    def open_tree(self, *arguments: object) -> object:
        self.opened = arguments
        return object()


@pytest.fixture
def core(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Core:
    core = Core()
    module = types.ModuleType("ecm_extract.extraction")
    module.extract = core.extract  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "ecm_extract.extraction", module)
    monkeypatch.setattr("ecm_extract.tree.open_tree", core.open_tree)
    monkeypatch.chdir(tmp_path)
    return core


def test_the_default_command_is_extract(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    """`ecm-extract PATH` writes manifests beside the person and prints the summary."""
    assert run(["robot"]) == 0
    out, err = capsys.readouterr()
    assert core.opened == ("robot", None)
    assert "2 packages" in out
    assert "ecm-manifests" in out
    assert err == ""
    assert yaml.safe_load(Path("ecm-manifests", MANIFEST).read_text())["ecm"]["package"] == "base"


@pytest.mark.parametrize("arguments", [["--quiet", "robot"], ["extract", "robot", "-q"]])
def test_quiet_prints_nothing(core: Core, capsys: pytest.CaptureFixture[str], arguments: list[str]) -> None:
    """Options may come first, too."""
    assert run(arguments) == 0
    assert capsys.readouterr() == ("", "")
    assert Path("ecm-manifests", MANIFEST).is_file()


def test_json_to_standard_output(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    """The document and nothing else, so that it may be piped; the summary is on standard error."""
    assert run(["robot", "--format", "json", "-o", "-"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["schema"] == "ecm-extract/extract/1"
    assert "2 packages" in err
    assert not Path("ecm-manifests").exists()


def test_yaml_to_standard_output(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    """One stream of YAML documents."""
    assert run(["robot", "-o", "-", "-q"]) == 0
    assert len(list(yaml.safe_load_all(capsys.readouterr().out))) == 1


def test_json_into_a_folder(core: Core) -> None:
    """The document has a fixed name there."""
    assert run(["robot", "--format", "json", "-o", "out"]) == 0
    assert json.loads(Path("out/extract.json").read_text())["packages"]


def test_summary_writes_nothing(core: Core, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """A look at a tree leaves no trace."""
    assert run(["robot", "--format", "summary"]) == 0
    assert "2 packages" in capsys.readouterr().out
    assert not list(tmp_path.iterdir())


def test_an_option_without_effect_is_refused(core: Core) -> None:
    """No flag is passed over in silence."""
    assert run(["robot", "--format", "summary", "-o", "out"]) == 2


def test_options_reach_the_core(core: Core) -> None:
    """Each option says what it says."""
    arguments = [
        "--ref",
        "1.2.0",
        "--include-tests",
        "--config",
        "my.toml",
        "--jobs",
        "3",
        "-q",
    ]
    assert run(["robot", *arguments]) == 0
    assert core.opened == ("robot", "1.2.0")
    assert core.options == Options(include_tests=True, config="my.toml", jobs=3, hub=True)


def test_a_tree_without_packages_is_wrong_input(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    """An empty answer would look like a robot without interfaces."""
    core.extraction = make_extraction()
    assert run(["robot"]) == 2
    assert "package.xml" in capsys.readouterr().err


def test_the_default_folder_may_not_be_a_link(core: Core, tmp_path: Path) -> None:
    """The repository that is read could have brought it, pointing anywhere."""
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    Path("ecm-manifests").symlink_to(elsewhere)
    assert run(["robot"]) == 2
    assert not list(elsewhere.iterdir())
    assert run(["robot", "-o", "ecm-manifests"]) == 0


def test_a_tree_that_is_not_there_is_told(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """The path is named."""
    module = types.ModuleType("ecm_extract.extraction")
    module.extract = None  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "ecm_extract.extraction", module)
    assert run(["/no/such/folder"]) == 2
    assert "/no/such/folder" in capsys.readouterr().err


@pytest.mark.parametrize("files", [{}, {"README.md": ""}, {"a/package.xml": "<package/>", "a/COLCON_IGNORE": ""}])
def test_nothing_to_read(tmp_path: Path, files: dict[str, str], capsys: pytest.CaptureFixture[str]) -> None:
    """A folder that holds nothing, or nothing that the project lets be read, has no contracts."""
    for path, text in files.items():
        (tmp_path / "ws" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "ws" / path).write_text(text)
    (tmp_path / "ws").mkdir(exist_ok=True)
    assert run([str(tmp_path / "ws"), "--format", "summary"]) == 2
    assert ("COLCON_IGNORE" in capsys.readouterr().err) == ("a/COLCON_IGNORE" in files)


def test_a_manifest_that_is_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What could be read is shown, and that it is not the whole."""
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "package.xml").write_text("<package><name>a</na")
    assert run([str(tmp_path), "--format", "summary"]) == 2
    assert "not read: 1 package.xml that cannot be read as one: a/package.xml" in capsys.readouterr().err


def test_the_default_folder_keeps_itself_out_of_git(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nobody commits manifests by accident; a folder that was named may be meant to be committed."""
    monkeypatch.chdir(tmp_path)
    robot = Path(__file__).parents[2] / "fixtures" / "arm_robot"
    assert run(["extract", str(robot), "-q"]) == 0
    assert (tmp_path / "ecm-manifests" / ".gitignore").read_text().splitlines()[-1] == "*"
    assert run(["extract", str(robot), "-q", "-o", "named"]) == 0
    assert not (tmp_path / "named" / ".gitignore").exists()
    capsys.readouterr()
