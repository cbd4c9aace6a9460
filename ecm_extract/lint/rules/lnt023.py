"""LNT023: a key of a parameter file is a sentence: a comment that lost its sign."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.parameter_yaml import parse_parameter_yaml

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT023",
    name="parameter_key_is_text",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="the file sets a parameter that nobody reads, or does not load at all",
    resolution="put a # before the text",
)
_FOLDERS = ("param", "params", "config", "cfg", "yaml")
_SENTENCE = re.compile(r"[(){}]|\S+\s+\S+\s+\S+")

_TEMPLATE = re.compile(r"\$\{[^}]*\}|\{\{.*?\}\}")
"""What a program fills in before the file is loaded."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report keys with brackets or of three words and more, in folders for parameter files."""
    for package in workspace.packages:
        for entry in package.root.files:
            folders = entry.path.split("/")[:-1]
            wanted = entry.path.endswith((".yaml", ".yml")) and any(folder in _FOLDERS for folder in folders)
            if wanted and not is_test_path(entry.path, package.root.path):
                read = workspace.files.parsed(entry.path, parse_parameter_yaml)
                for setting in read.facts.sets if read is not None else ():
                    if _SENTENCE.search(_TEMPLATE.sub("", setting.name)) and "$(" not in setting.name:
                        text = f"the key `{setting.name[:60]}` is a sentence"
                        evidence = [Evidence(entry.path, setting.line, column=setting.column or None)]
                        entity = Entity("parameter", setting.name, owner=setting.node or "")
                        yield RULE.finding(text, entity, package.name, evidence, certainty="likely")
