"""Which ROS API call sites does the extraction have? `python benchmarks/sites.py REPO [--misses] [--json]`.

A site is *found* when an interface of a fitting role has evidence on the lines of the call, *typed* when that
interface has a type (transforms have none and do not count), *named* when its name is resolved (confidence
literal, folded or default) and has no hole. Sites come from the regular expressions of site_oracle.py.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import msgspec
from extracted import RESOLVED, Index, Interface, extract
from site_oracle import EXCLUSIONS, Site, load_rows, scan
from source_files import IsTest, walk

TARGETS = {"found": 97.0, "typed": 97.0, "named": 90.0}


class Result(msgspec.Struct, frozen=True):
    """What the extraction knows of one site; `typed` is None where a type makes no sense."""

    site: Site
    found: bool
    typed: bool | None
    named: bool


class Share(msgspec.Struct, frozen=True):
    """Numbers of one line of the table."""

    sites: int
    found: int
    typed: int
    typable: int
    named: int


def judge(site: Site, index: Index) -> Result:
    """Compare one site with the interfaces on its lines."""
    near = index.overlapping(site.path, site.line, site.end_line)
    fitting = [one for one in near if one.role in site.row.roles]
    typed = any(one.type for one in fitting) if site.row.typed else None
    return Result(site, bool(fitting), typed, any(map(is_named, fitting)))


def is_named(one: Interface) -> bool:
    """Tell whether a name is told whole: what is said to be sure and has a hole is not."""
    return one.confidence in RESOLVED and "{" not in one.name


def share(results: Iterable[Result]) -> Share:
    """Count the results of one group."""
    some = list(results)
    return Share(
        sites=len(some),
        found=sum(one.found for one in some),
        typed=sum(one.typed is True for one in some),
        typable=sum(one.typed is not None for one in some),
        named=sum(one.named for one in some),
    )


def oracle(root: Path, is_test: IsTest) -> tuple[list[Site], Counter[str], Counter[str]]:
    """All sites of a tree, what the rules excluded, and which files were left out."""
    rows, excluded, skipped = load_rows(), Counter[str](), Counter[str]()
    sites = [site for source in walk(root, is_test, skipped) for site in scan(source, rows, excluded)]
    return sites, excluded, skipped


def table(results: list[Result]) -> list[tuple[str, Share]]:
    """Rows of the table: each form, then the total of the API and of the wrappers."""
    forms = dict.fromkeys(row.form for row in load_rows())
    lines = [(form, share(one for one in results if one.site.row.form == form)) for form in forms]
    totals = [
        ("TOTAL", share(one for one in results if one.site.row.family == "api")),
        ("wrappers of helpers", share(one for one in results if one.site.row.family == "wrapper")),
    ]
    return [line for line in lines if line[1].sites] + totals


def _percent(part: int, whole: int) -> str:
    return f"{100 * part / whole:6.1f} %" if whole else "      - "


def _print_table(lines: list[tuple[str, Share]]) -> None:
    print(f"{'form':26}{'sites':>7}{'found':>10}{'typed':>10}{'named':>10}")
    for form, one in lines:
        cells = (
            _percent(one.found, one.sites),
            _percent(one.typed, one.typable),
            _percent(one.named, one.sites),
        )
        print(f"{form:26}{one.sites:7}" + "".join(f"{cell:>10}" for cell in cells))
    wanted = ", ".join(f"{what} {value:g} %" for what, value in TARGETS.items())
    print(f"{'to reach (TOTAL)':26}{'':7}{wanted}")


def _print_left_out(excluded: Counter[str], skipped: Counter[str]) -> None:
    print("left out by the oracle:")
    for reason, count in sorted(excluded.items()):
        print(f"  {count:6} {reason}: {EXCLUSIONS[reason]}")
    print("files not read: " + (", ".join(f"{count} {why}" for why, count in sorted(skipped.items())) or "none"))


def missing(result: Result) -> list[str]:
    """Which of found, typed and named a site lacks."""
    if not result.found:
        return ["found"]
    return [what for what, good in (("typed", result.typed is not False), ("named", result.named)) if not good]


def _misses(results: list[Result]) -> list[dict[str, Any]]:
    return [
        {
            "path": one.site.path,
            "line": one.site.line,
            "form": one.site.row.form,
            "text": one.site.text,
            "lacks": lacks,
        }
        for one in results
        if (lacks := missing(one))
    ]


def _print_misses(results: list[Result]) -> None:
    for miss in _misses(results):
        print(f"{miss['path']}:{miss['line']}: not {', '.join(miss['lacks'])} [{miss['form']}]: {miss['text']}")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repo", type=Path, help="a work tree")
    parser.add_argument("--json", action="store_true", help="print JSON instead of the table")
    parser.add_argument("--misses", action="store_true", help="print every site that lacks something")
    parser.add_argument("--extraction", type=Path, metavar="FILE", help="JSON that ecm-extract wrote before")
    parser.add_argument("--count", action="store_true", help="only count the sites, extract nothing")
    return parser.parse_args()


def main() -> None:
    """Run the benchmark; status 1 when a figure of the total is not reached."""
    from ecm_extract.test_code import is_test_path

    options = _arguments()
    sites, excluded, skipped = oracle(options.repo, is_test_path)
    if options.count:
        print(f"{options.repo.name}: {share(_unseen(sites)).sites} sites, {len(sites)} with wrappers")
        return
    index = Index(extract(options.repo, options.extraction))
    results = [judge(site, index) for site in sites]
    lines = table(results)
    if options.json:
        forms = {form: msgspec.to_builtins(one) for form, one in lines}
        print(json.dumps({"repo": options.repo.name, "forms": forms, "excluded": excluded, "misses": _misses(results)}))
    else:
        _print_table(lines)
        _print_left_out(excluded, skipped)
        if options.misses:
            _print_misses(results)
    sys.exit(0 if _reached(dict(lines)["TOTAL"]) else 1)


def _unseen(sites: list[Site]) -> list[Result]:
    return [Result(site, False, None, False) for site in sites if site.row.family == "api"]


def _reached(total: Share) -> bool:
    parts = {
        "found": (total.found, total.sites),
        "typed": (total.typed, total.typable),
        "named": (total.named, total.sites),
    }
    return all(whole == 0 or 100 * part / whole >= TARGETS[what] for what, (part, whole) in parts.items())


if __name__ == "__main__":
    main()
