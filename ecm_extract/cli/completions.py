"""What a shell may complete: ids of rules, refs of the repository, packages of the tree.

A completion answers fast or not at all, and never with an error: a person is in the middle of a word.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import wraps
from pathlib import Path
from typing import Final

import click
from click.shell_completion import CompletionItem

from ecm_extract.errors import EcmError

Completer = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]

_WORK_TREE: Final = "."


def _quiet(completer: Completer) -> Completer:
    @wraps(completer)
    def answered(ctx: click.Context, parameter: click.Parameter, start: str) -> list[CompletionItem]:
        with suppress(EcmError, OSError):
            return completer(ctx, parameter, start)
        return []

    return answered


@_quiet
def rules(_ctx: click.Context, _parameter: click.Parameter, start: str) -> list[CompletionItem]:
    """Ids of all rules, with their names."""
    from ecm_extract.rule_pages import rule_names

    return [CompletionItem(rule, help=name) for rule, name in sorted(rule_names().items()) if _begins(rule, start)]


@_quiet
def lint_rules(_ctx: click.Context, _parameter: click.Parameter, start: str) -> list[CompletionItem]:
    """Ids of the rules of lint, with their names."""
    from ecm_extract.rule_pages import lint_rule_ids, rule_names

    names = rule_names()
    return [CompletionItem(rule, help=names[rule]) for rule in sorted(lint_rule_ids()) if _begins(rule, start)]


@_quiet
def refs(ctx: click.Context, _parameter: click.Parameter, start: str) -> list[CompletionItem]:
    """Tags and branches of the repository that the command line names, else of the one here."""
    from ecm_extract.tree.open import open_repo
    from ecm_extract.tree.ref_hints import ref_names

    return _items(ref_names(open_repo(_folder(ctx))), start)


@_quiet
def sides(ctx: click.Context, parameter: click.Parameter, start: str) -> list[CompletionItem]:
    """A side of a comparison: refs, else folders."""
    return refs(ctx, parameter, start) or [CompletionItem(start, type="dir")]


@_quiet
def packages(ctx: click.Context, _parameter: click.Parameter, start: str) -> list[CompletionItem]:
    """Names of the packages of the tree, by the folders that hold them."""
    from ecm_parsers.package_xml import parse

    from ecm_extract.discover import discover
    from ecm_extract.tree import open_tree

    tree = open_tree(_folder(ctx))
    manifests = [root.manifest for root in discover(tree) if root.manifest]
    found = (parse(data).facts for _, data in tree.read_many(manifests))
    return _items({manifest.name for manifest in found if manifest is not None and manifest.name}, start)


def _items(names: Iterable[str], start: str) -> list[CompletionItem]:
    return [CompletionItem(name) for name in sorted(names) if name.startswith(start)]


def _begins(rule: str, start: str) -> bool:
    return rule.startswith(start.upper())


def _folder(ctx: click.Context) -> Path:
    """What the words before name as repository, tree or workspace."""
    for name in ("repo", "path", "workspace"):
        value = ctx.params.get(name)
        if isinstance(value, str) and value:
            return Path(value.partition("@")[0])
    return Path(_WORK_TREE)
