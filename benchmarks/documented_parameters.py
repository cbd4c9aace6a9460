"""Documented parameters that contracts have: `python benchmarks/documented_parameters.py TABLE DOCS TREE`.

TABLE says which pages of DOCS (a clone of a documentation in reStructuredText) list the parameters of which packages
of TREE. A parameter is a field of the page (`:name:`); what stands in angle brackets is a name that users choose.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path

import yaml
from extracted import extract

TARGET = 0.98
_FIELD = re.compile(r"^:([^\s:][^\n]*?):\s*$", re.MULTILINE)
_CHOSEN = re.compile(r"\{[^}]*\}|<[^>]*>")


def documented(page: Path) -> list[str]:
    """Names that a page lists, each once, with `<...>` for what users choose."""
    fields = (field.replace("``", "").replace('"', "").strip() for field in _FIELD.findall(page.read_text("utf-8")))
    return [field for field in dict.fromkeys(fields) if " " not in _CHOSEN.sub("*", field)]


def told(tree: Path) -> dict[str, set[tuple[str, ...]]]:
    """Package -> the parameters of its contracts, in parts, `*` for a part that is a pattern."""
    found: dict[str, set[tuple[str, ...]]] = defaultdict(set)
    for package in extract(tree).packages:
        for module in package.modules:
            names = (entry.name for entry in module.signature.interfaces if entry.role == "parameter")
            found[package.name] |= {_parts(name) for name in names}
    return found


def _parts(name: str) -> tuple[str, ...]:
    return tuple(_CHOSEN.sub("*", name).split("."))


def is_told(name: str, names: set[tuple[str, ...]]) -> bool:
    """Whether a documented name is the end of one in a contract: pages leave out names of plugins and groups."""
    wanted = _parts(name)
    own = wanted[1:] if "*" in wanted[0] and len(wanted) > 1 else wanted
    return any(_ends(other, wanted) or other == own for other in names if other[-1] != "*")


def _ends(name: tuple[str, ...], end: tuple[str, ...]) -> bool:
    return len(name) >= len(end) and all(map(_alike, name[-len(end) :], end))


def _alike(one: str, other: str) -> bool:
    return one == other or "*" in one or "*" in other


def pages(table: Mapping[str, Mapping[str, object]], folder: Path) -> Iterator[tuple[Path, Mapping[str, object]]]:
    """The pages that the table has a row for; a row without a page is an error."""
    for pattern, row in table.items():
        found = sorted(folder.glob(pattern))
        if not found:
            sys.exit(f"error: {folder / pattern}: no such page; take the commit that the table names")
        yield from ((page, row) for page in found)


def main() -> int:
    """Print a line per parameter that is not told, and the share that is; status 1 below the target."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path)
    parser.add_argument("docs", type=Path)
    parser.add_argument("tree", type=Path)
    options = parser.parse_args()
    table = yaml.safe_load(options.table.read_text("utf-8"))
    names = told(options.tree)
    count = hits = absent = 0
    for page, row in pages(table["pages"], options.docs / table["below"]):
        own = set().union(*(names[package] for package in row["packages"]))
        for name in documented(page):
            if name in row.get("absent", ()):
                absent += 1
                continue
            count += 1
            hits += is_told(name, own)
            if not is_told(name, own):
                print(f"{page.relative_to(options.docs)}: {name} is told of none of {', '.join(row['packages'])}")
    print(f"documented parameters told: {hits} of {count} ({hits / count:.1%}); {absent} documented that no code reads")
    return int(hits / count < TARGET)


if __name__ == "__main__":
    sys.exit(main())
