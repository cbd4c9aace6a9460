"""Where the corpus lies, and the interface parts in it."""

from __future__ import annotations

from pathlib import Path

import msgspec

from ecm_corpus.interface import InterfaceCase, read_interface
from ecm_corpus.narrative import Narrative, read_narrative
from ecm_corpus.results import Results
from ecm_extract.errors import InputError


def corpus_folder(given: str | None) -> Path:
    """The folder with `cases/`: the one given, or that of the checkout this package lies in.

    Raises:
        InputError: there is none.
    """
    folder = Path(given) if given is not None else Path(__file__).resolve().parents[1]
    if not (folder / "cases" / "interface").is_dir():
        message = f"{folder} holds no cases/interface"
        raise InputError(message, "the corpus is part of the source repository: name its folder with --corpus DIR")
    return folder


def interface_of(case: str, folder: Path) -> InterfaceCase:
    """The interface part of a case.

    Raises:
        InputError: there is no such case, or its file is wrong.
    """
    path = folder / "cases" / "interface" / f"{case}.yaml"
    if Path(case).name != case or not path.is_file():
        message = f"no case is called {case!r}"
        raise InputError(message, f"cases are the files in {path.parent}")
    return read_interface(path)


def interfaces(folder: Path) -> list[InterfaceCase]:
    """The interface parts of all cases, by id."""
    return [read_interface(path) for path in sorted((folder / "cases" / "interface").glob("*.yaml"))]


def narratives(folder: Path) -> dict[str, Narrative]:
    """The narrative parts of all cases, by id. A blind run must not call this."""
    found = [read_narrative(path) for path in sorted((folder / "cases" / "narrative").glob("*.yaml"))]
    return {narrative.case: narrative for narrative in found}


def read_results(path: Path) -> Results:
    """Results of a blind run.

    Raises:
        InputError: the file cannot be read, or is something else.
    """
    try:
        return msgspec.json.decode(path.read_bytes(), type=Results)
    except OSError as error:
        message = f"cannot read {path}: {error.strerror}"
        raise InputError(message, "ecm-extract blind --all --clones DIR -o corpus writes it") from error
    except (msgspec.DecodeError, RecursionError) as error:
        message = f"{path}: {error}"
        raise InputError(message, "results are what `ecm-extract blind` writes") from error
