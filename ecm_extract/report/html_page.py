"""The frame of every HTML report: one file, no script, nothing fetched.

Elements are built, never pasted together, so that no name of somebody's file becomes markup.
"""

from __future__ import annotations

from typing import Final

from lxml import html
from lxml.html import builder as tag

from ecm_extract.report.terminal import one_line

_WIDEST: Final = 4000
_STYLE: Final = """
:root { color-scheme: light dark; --line: #8884; --soft: #8881; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
code { font: 13px ui-monospace, monospace; overflow-wrap: anywhere; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .3rem .6rem .3rem 0; border-bottom: 1px solid var(--line); }
details.finding { border: 1px solid var(--line); border-radius: 6px; margin: .5rem 0; padding: .4rem .8rem; }
summary { cursor: pointer; } summary p { margin: .2rem 0 0; } summary > * { margin-right: .6rem; }
.rule, .note { opacity: .75; font-size: .9em; }
.change { width: 11rem; } .why { width: 32%; }
.choices label { margin-right: 1.2rem; }
.chip { border-radius: 4px; padding: 0 .4rem; color: #fff; background: #57606a; font-size: .85em; white-space: nowrap; }
.chip.error, .chip.breaking, .chip.reject { background: #b42318; }
.chip.warning, .chip.review { background: #9a5b00; }
.chip.accept, .chip.fully-compatible { background: #1a7f37; }
body:has(#show-error:not(:checked)) .finding.error, body:has(#show-warning:not(:checked)) .finding.warning,
body:has(#show-info:not(:checked)) .finding.info { display: none; }
"""


def page(title: str, *parts: html.HtmlElement) -> str:
    """Return a whole page with a title and a body."""
    head = tag.HEAD(
        tag.META(charset="utf-8"),
        tag.META(name="viewport", content="width=device-width, initial-scale=1"),
        tag.TITLE(words(title)),
        tag.STYLE(_STYLE),
    )
    text: str = html.tostring(
        tag.HTML(head, tag.BODY(*parts), lang="en"), encoding="unicode", doctype="<!DOCTYPE html>", pretty_print=True
    )
    return text


def words(text: str) -> str:
    """Text of somebody else's file as HTML may hold it: no control characters, bounded."""
    return one_line(text, _WIDEST)


def chip(word: str) -> html.HtmlElement:
    """A short word that stands out, in the color of its class."""
    return tag.SPAN(tag.CLASS(f"chip {word}"), word.replace("_", " "))
