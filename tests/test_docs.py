"""The manual and the README say what is so."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import click
import msgspec
import pytest
from ecm_checker.contract import Interface
from ecm_checker.fields import FIELDS

from ecm_extract.answers.accepted_file import Accepted, parse_accepted
from ecm_extract.cli.app import app
from ecm_extract.config import Config, parse_config

ROOT = Path(__file__).parent.parent
MANUAL = ROOT / "docs"


def test_manual_has_every_field() -> None:
    """Each field is explained, with what the table of fields says of it."""
    page = (MANUAL / "manifest.md").read_text("utf-8")
    for row in FIELDS:
        required = "yes" if row.required else "no"
        assert f"| `{row.path}` | {required} | {row.meaning} |" in page or row.path.startswith("ecm.")


def test_manual_has_every_key_of_an_interface() -> None:
    """A reader of the JSON document finds each key."""
    page = (MANUAL / "manifest.md").read_text("utf-8")
    assert not [key for key in Interface.__struct_fields__ if f"| `{key}` |" not in page]


def test_manual_has_every_command_and_option() -> None:
    """An option that is not in the manual is not there for most people."""
    page = (MANUAL / "cli.md").read_text("utf-8")
    context = click.Context(app)
    for name in app.list_commands(context):
        command = app.get_command(context, name)
        assert command is not None
        assert f"## {name}" in page
        options = [option for each in command.params if isinstance(each, click.Option) for option in each.opts]
        assert not [option for option in options if option not in page]


def _keys(record: type[msgspec.Struct], above: str = "") -> Iterator[str]:
    """Dotted keys of a configuration as people write them; a mapping has keys of the user's own."""
    for each in msgspec.structs.fields(record):
        inner = [kind for kind in (each.type, *get_args(each.type)) if isinstance(kind, type)]
        table = next((kind for kind in inner if issubclass(kind, msgspec.Struct)), None)
        key = f"{above}{each.encode_name}"
        yield from [key] if table is None else _keys(table, f"{key}.")


@pytest.mark.parametrize(("record", "above"), [(Config, ""), (Accepted, "accept.")])
def test_manual_has_every_key_of_the_configuration(record: type[msgspec.Struct], above: str) -> None:
    """What the loader takes is what the page tells, and nothing else."""
    page = (MANUAL / "configuration.md").read_text("utf-8")
    rows = [line.split("|")[1] for line in page.splitlines() if line.startswith("| `")]
    told = {key.removesuffix(".RULE") for row in rows for key in re.findall(r"`([^`]+)`", row)}
    known = set(_keys(record, above))
    assert known - told == set()
    assert {key for key in told if key.startswith("accept.") is bool(above)} - known - {"form", "header"} == set()


def test_the_configuration_of_the_manual_is_right() -> None:
    """The example can be copied."""
    page = (MANUAL / "configuration.md").read_text("utf-8")
    config, accepted = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    assert parse_config(config.encode()).severity == {"LNT017": "info", "LNT042": "off"}
    assert parse_accepted(accepted.encode())[0].scope == "change"


def test_links_lead_somewhere() -> None:
    """Every relative link in the manual, the README and the guide is a file."""
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *MANUAL.rglob("*.md")]
    for page in pages:
        for target in re.findall(r"\]\((?!https?:)([^)#]+)", page.read_text("utf-8")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_readme_names_commands_that_make_knows() -> None:
    """The first lines can be copied."""
    makefile = (ROOT / "Makefile").read_text("utf-8")
    for target in re.findall(r"make (\w+)", (ROOT / "README.md").read_text("utf-8").split("##")[0]):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE)
