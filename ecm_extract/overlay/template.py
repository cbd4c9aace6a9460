"""The overlay that a person starts from: only the fields that could not be known, each explained with an example."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from types import MappingProxyType

from ecm_checker.contract import Contract
from ecm_checker.fields import FIELDS
from ecm_parsers.overlay_yaml import SCHEMA

from ecm_extract.shipped import shipped

_MEANINGS = {row.path: row.meaning for row in FIELDS}


@cache
def examples() -> Mapping[str, str]:
    """Return an example by field, as YAML in one line."""
    return MappingProxyType(shipped("overlay/examples.toml")["examples"])


def overlay_template(package: str, contracts: Iterable[Contract]) -> str:
    """Return the text of an overlay for a package; it declares nothing until lines are uncommented.

    Args:
        package: its name.
        contracts: of its modules; those that miss nothing are left out.
    """
    return "\n".join([*_head(package), *(line for contract in contracts for line in _module(contract))]) + "\n"


def _head(package: str) -> Iterator[str]:
    yield f"# What no tool can read off the sources of {package}. Remove the # of a line and correct its value."
    yield "# A field that stays commented out is undeclared, which is not the same as none."
    yield f"schema: {SCHEMA}"
    yield "modules:"


def _module(contract: Contract) -> Iterator[str]:
    missing = [path for path in contract.missing if not path.startswith("ecm.")]
    if not missing:
        return
    yield ""
    yield f"  {_key(contract.ecm.module_id.rsplit('.', 1)[-1])}:"
    section = ""
    for path in missing:
        name, _, field = path.partition(".")
        if name != section:
            section = name
            yield f"    {section}:"
        yield f"      # {_MEANINGS[path]}"
        yield f"      # {field}: {examples()[path]}"


def _key(text: str) -> str:
    return text if text.replace("_", "").isalnum() and not text[0].isdigit() else f'"{text}"'
