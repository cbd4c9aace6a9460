"""Where the corpus lies, and the interface parts in it."""

from __future__ import annotations

from pathlib import Path

from ecm_corpus.interface import InterfaceCase, read_interface
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
