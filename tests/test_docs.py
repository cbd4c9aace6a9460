"""The manual and the README say what is so."""

from __future__ import annotations

import re
from pathlib import Path

import click
from ecm_checker.contract import Interface
from ecm_checker.fields import FIELDS

from ecm_extract.cli.app import app

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
