"""Instance graphs against documents: `python benchmarks/systems.py CLONES_DIR [FILE...]`.

Each file of benchmarks/systems names a launch file and what a document says of the running system. Printed are recall
by kind of channel, what is missing, and the channels of the graph that the document does not name.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path

import yaml

KINDS = {"topics": "topic", "services": "service", "actions": "action"}
FOLDER = Path(__file__).parent / "systems"


def graph(truth: dict[str, object], clones: Path) -> dict[str, object]:
    """The system document of a truth file."""
    launches = truth["launch"]
    environment = truth.get("env") or {}
    assert isinstance(launches, list)
    assert isinstance(environment, dict)
    given = [f"--env={name}={value}" for name, value in environment.items()]
    program = [sys.executable, "-c", "from ecm_extract.cli import main; main()"]
    place = ["--workspace", str(clones / str(truth["tree"])), "--format", "json"]
    output = subprocess.run([*program, "system", *launches, *place, *given], check=True, capture_output=True).stdout
    found: dict[str, object] = json.loads(output)
    return found


def names(document: dict[str, object], kind: str) -> set[str]:
    """Names of all channels of a kind."""
    channels = document["channels"]
    assert isinstance(channels, list)
    return {channel["name"] for channel in channels if channel["kind"] == kind}


def report(path: Path, clones: Path) -> None:
    truth = yaml.safe_load(path.read_text("utf-8"))
    document = graph(truth, clones)
    outside = truth.get("outside") or {}
    print(f"{path.stem}: {truth['document']}")
    for key, kind in KINDS.items():
        wanted = [name for name in truth.get(key) or [] if name not in outside]
        if not wanted:
            continue
        found = names(document, kind)
        hits = [name for name in wanted if name in found]
        print(f"  {key}: {len(hits)} of {len(wanted)} ({len(hits) / len(wanted):.0%})")
        for name in wanted:
            if name not in found:
                print(f"    - {name}")
        further = sorted(found - set(truth[key]))
        patterns = [name for name in further if "{" in name]
        print(f"    {len(further)} further, {len(patterns)} of them by pattern: {', '.join(further[:12])}")
    for name, why in outside.items():
        print(f"  o {name}: {why}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path)
    parser.add_argument("file", nargs="*", type=Path, default=sorted(FOLDER.glob("*.yaml")))
    arguments = parser.parse_args()
    for path in arguments.file:
        report(path, arguments.clones)


if __name__ == "__main__":
    main()
