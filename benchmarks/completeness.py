"""Share of modules for which each required field of the contract is filled.

    python benchmarks/completeness.py TREE|extract.json ... [--before extract.json ...]

A document is what `ecm-extract extract --format json -o -` writes, so that two versions of the tool can be compared.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from ecm_checker.fields import required_fields


def modules_of(source: str) -> list[dict[str, object]]:
    """The modules of a document, or of a tree that is extracted now."""
    if Path(source).is_file():
        text = Path(source).read_bytes()
    else:
        command = [
            sys.executable,
            "-c",
            "from ecm_extract.cli import main; main()",
            "extract",
            source,
            "--format",
            "json",
            "-o",
            "-",
            "-q",
        ]
        text = subprocess.run(command, check=True, capture_output=True).stdout
    return [module for package in json.loads(text)["packages"] for module in package["modules"]]


def shares(sources: Iterable[str]) -> tuple[int, dict[str, float]]:
    """Number of modules, and the share that fills each required field."""
    found = [module for source in sources for module in modules_of(source)]
    missing = Counter(path for module in found for path in _missing(module))
    return len(found), {path: 1 - missing[path] / max(len(found), 1) for path in required_fields()}


def _missing(module: dict[str, object]) -> list[str]:
    identity = module["ecm"]
    return list(identity["missing"]) if isinstance(identity, dict) else []


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", nargs="+")
    parser.add_argument("--before", nargs="+", default=[])
    arguments = parser.parse_args()
    count, now = shares(arguments.source)
    _, before = shares(arguments.before) if arguments.before else (0, {})
    print(f"{count} modules")
    print(f"{'field':<34}{'before':>9}{'now':>9}" if before else f"{'field':<34}{'now':>9}")
    for path, share in now.items():
        earlier = f"{before[path]:>9.0%}" if before else ""
        print(f"{path:<34}{earlier}{share:>9.0%}")


if __name__ == "__main__":
    main()
