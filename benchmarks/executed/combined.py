"""Programs that combine what holds a text, what changes it and who reads it: each of one with each of the others.

What a grammar draws seldom has the three at once that a value needs to be stale.
"""

from __future__ import annotations

import random
import tomllib
from itertools import product
from pathlib import Path
from string import Template
from textwrap import indent
from typing import NamedTuple

FOLDER = Path(__file__).parent / "combined"
Entry = dict[str, str]
PARTS = ("made", "changed", "used")


class Combined(NamedTuple):
    """A program by what it combines."""

    name: str
    text: str


def programs(language: str, number: int, seed: str) -> list[Combined]:
    """Return so many of all the combinations of a language, `cpp` or `python`; the same for the same seed."""
    table = tomllib.loads((FOLDER / f"{language}.toml").read_text("utf-8"))
    every = list(product(*(table[part].items() for part in PARTS)))
    chosen = random.Random(seed).sample(every, min(number, len(every)))
    return [
        Combined(
            "-".join(name for name, _ in entries), _text(language, table, [entry for _, entry in entries], f"p{at}")
        )
        for at, entries in enumerate(chosen)
    ]


def _text(language: str, table: dict[str, dict[str, Entry]], entries: list[Entry], space: str) -> str:
    held = {"obj": entries[0]["obj"], "methods": "\n".join(entry.get("methods", "") for entry in entries)}
    outside = [_filled(entry.get("outside", ""), held) for entry in entries]
    body = [_filled(entry["text"], held) for entry in entries]
    return {"cpp": _cpp, "python": _python}[language](table["head"]["text"], outside, body, space)


def _filled(text: str, held: dict[str, str]) -> str:
    return Template(text).safe_substitute(held)


def _cpp(head: str, outside: list[str], body: list[str], space: str) -> str:
    inside = indent("\n".join(body), "    ")
    return (
        f"{head}namespace {space} {{\n" + "\n".join(outside) + "\ninline void run(int argc) {\n"
        f'    auto node = std::make_shared<rclcpp::Node>("node");\n{inside}\n}}\n}}\n'
        f"#ifndef BATCH\nint main(int argc, char ** argv) {{ {space}::run(argc); return 0; }}\n#endif\n"
    )


def _python(head: str, outside: list[str], body: list[str], _: str) -> str:
    module = "\n".join([head, *outside])
    inside = indent("\n".join(body), "    ")
    return f'{module}\ndef main():\n    node = Node("node")\n{inside}\nif __name__ == "__main__":\n    main()\n'
