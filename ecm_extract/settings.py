"""Where the configuration of a run comes from: the file that was named, else `ecm.toml` at the root of the tree."""

from __future__ import annotations

from pathlib import Path

from ecm_extract.config import FILE_NAME, Config, parse_config
from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Options
from ecm_extract.tree import Tree


def config_of(tree: Tree, options: Options) -> Config:
    """Return the configuration of an extraction.

    Raises:
        ConfigError: the file is wrong.
        InputError: the named file cannot be read.
    """
    if options.config is not None:
        return _named(Path(options.config))
    if any(entry.path == FILE_NAME for entry in tree.files()):
        return parse_config(tree.read(FILE_NAME), FILE_NAME)
    return Config()


def _named(path: Path) -> Config:
    try:
        return parse_config(path.read_bytes(), str(path))
    except OSError as error:
        message = f"cannot read the configuration {path}: {error.strerror}"
        raise InputError(message, "give --config a readable ecm.toml") from error
