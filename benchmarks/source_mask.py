"""Blanks comments and the inside of strings, keeping every offset and every line."""

from __future__ import annotations

import re

_CPP = re.compile(
    r"""//(?:\\\r?\n|[^\n])*"""
    r"""|/\*.*?(?:\*/|\Z)"""
    r"""|R"(?P<tag>[^\s()\\"]{0,16})\(.*?\)(?P=tag)\""""
    r'''|"(?:\\.|[^"\\\n])*"'''
    r"""|(?<![0-9a-zA-Z])'(?:\\.|[^'\\\n])+'""",
    re.DOTALL,
)
_PYTHON = re.compile(
    r"""\#[^\n]*"""
    r'''|"""(?:\\.|[^\\])*?(?:"""|\Z)'''
    r"""|\'\'\'(?:\\.|[^\\])*?(?:\'\'\'|\Z)"""
    r'''|"(?:\\.|[^"\\\n])*"'''
    r"""|'(?:\\.|[^'\\\n])*'""",
    re.DOTALL,
)


def mask_cpp(text: str) -> str:
    """C++ without comments; strings and characters become `_` of the same length."""
    return _CPP.sub(_blank, text)


def mask_python(text: str) -> str:
    """Python without comments; strings and docstrings become `_` of the same length."""
    return _PYTHON.sub(_blank, text)


def _blank(match: re.Match[str]) -> str:
    fill = " " if match.group().startswith(("/", "#")) else "\0"
    return re.sub(r"[^\n]", fill, match.group())
