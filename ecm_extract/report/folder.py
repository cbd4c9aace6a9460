"""Writing manifests into a folder: `<package>/<module_id>.ecm.yaml`.

Names of packages and modules come from somebody else's files; whatever they are, nothing is written outside
the folder and no link is followed.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import tempfile
from pathlib import Path
from typing import Final

from ecm_checker.hub.package import SUFFIX as DOCUMENT
from ecm_checker.wire import MANIFEST_SCHEMA

from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Extraction, PackageContracts
from ecm_extract.report.json_document import package_document
from ecm_extract.report.manifest_yaml import SUFFIX, manifest_yaml

_UNSAFE: Final = re.compile(r"[^A-Za-z0-9_.+-]")
_LONGEST_NAME: Final = 120
_IGNORE: Final = ".gitignore"
_IGNORED: Final = (
    b"# Written by ecm-extract. Delete this file to commit the folder, or write elsewhere with -o DIR.\n*\n"
)
_MARK: Final = MANIFEST_SCHEMA.encode()


def write_manifests(extraction: Extraction, out_dir: Path) -> tuple[Path, ...]:
    """Write one manifest per module and the document of each package; what a package no longer has is removed.

    Each file is complete or not there: it is written beside its place and then moved. One that has not changed is left
    as it is.

    Args:
        extraction: what was read.
        out_dir: made when it is not there.

    Returns:
        The files, in the order of the extraction.

    Raises:
        InputError: the folder cannot be written, or a package folder in it is a link.
    """
    written: dict[Path, None] = {}
    try:
        for package in extraction.packages:
            folder = _package_folder(out_dir, package)
            for module in package.modules:
                path = _free(folder / (_safe(module.ecm.module_id) + SUFFIX), package.path, written)
                _write_atomically(path, manifest_yaml(module).encode("utf-8", "replace"))
                written[path] = None
            if package.hub:
                path = _free(folder / (_safe(package.name) + DOCUMENT), package.path, written)
                _write_atomically(path, package_document(extraction, package))
                written[path] = None
        for folder in {path.parent for path in written}:
            _remove_stale(folder, written)
    except OSError as error:
        raise _unwritable(out_dir, error) from error
    return tuple(written)


def write_document(content: bytes, path: Path) -> Path:
    """Write one file; its folder is made when it is not there.

    Raises:
        InputError: it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        _write_atomically(path, content)
    except OSError as error:
        raise _unwritable(path.parent, error) from error
    return path


def keep_out_of_git(folder: Path) -> None:
    """Make a folder ignore itself, as caches of other tools do; a file that is there is left alone.

    Raises:
        InputError: it cannot be written.
    """
    place = folder / _IGNORE
    if not place.exists() and not place.is_symlink():
        write_document(_IGNORED, place)


def _write_atomically(path: Path, content: bytes) -> None:
    """Put a complete file at `path`; a link that is there is replaced, not followed, the same content left alone."""
    if _holds(path, content):
        return
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".ecm-", suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(temporary).chmod(0o644)
        Path(temporary).replace(path)
    except BaseException:
        with contextlib.suppress(OSError):
            Path(temporary).unlink()
        raise


def _holds(path: Path, content: bytes) -> bool:
    """Tell whether a file has this content already: tools that build go by when a file was last changed."""
    if path.is_symlink() or not path.is_file() or not os.access(path, os.R_OK):
        return False
    return path.stat().st_size == len(content) and path.read_bytes() == content


def _unwritable(folder: Path, error: OSError) -> InputError:
    return InputError(f"cannot write to {folder}: {error.strerror}", "choose another folder with -o DIR")


def _package_folder(out_dir: Path, package: PackageContracts) -> Path:
    folder = out_dir / _safe(package.name)
    if folder.is_symlink():
        message = f"{folder} is a symbolic link"
        raise InputError(message, "remove it, or choose another folder with -o DIR")
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _safe(name: str) -> str:
    """A file name for a name; another name gives another file name."""
    safe = _UNSAFE.sub("_", name).lstrip(".")[:_LONGEST_NAME]
    return safe if safe == name and safe else f"{safe or '_'}-{_digest(name)}"


def _free(path: Path, package_path: str, taken: dict[Path, None]) -> Path:
    """The path itself, or a variant of it when another module has it: packages of one name, in two places."""
    suffix = DOCUMENT if path.name.endswith(DOCUMENT) else SUFFIX
    stem, variant = path.name.removesuffix(suffix), 1
    while path in taken:
        number = f"-{variant}" if variant > 1 else ""
        path = path.with_name(f"{stem}-{_digest(package_path)}{number}{suffix}")
        variant += 1
    return path


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()[:8]


def _remove_stale(folder: Path, written: dict[Path, None]) -> None:
    """A manifest that nothing wrote this time would be taken for a module by whoever reads the folder."""
    for path in [*folder.glob(f"*{SUFFIX}"), *folder.glob(f"*{DOCUMENT}")]:
        if path not in written and not path.is_symlink() and _is_ours(path):
            path.unlink()


def _is_ours(path: Path) -> bool:
    if path.name.endswith(DOCUMENT):
        return True
    with path.open("rb") as file:
        return _MARK in file.read(100)
