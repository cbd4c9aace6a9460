"""Functions and macros of the tree: how arguments reach the body (cmake-commands(7), "function" and "macro")."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final

import msgspec
from ecm_parsers.cmake_blocks import Block, Branch, Step
from ecm_parsers.cmake_tokens import Argument

from ecm_extract.cmake.values import Value

_REFERENCE: Final = re.compile(r"\$\{(\w+)\}")


class Function(msgspec.Struct, frozen=True):
    """A command that a file of the tree defines; `policies` are those that held there, and hold where it runs."""

    is_macro: bool
    params: tuple[str, ...]
    body: tuple[Step, ...]
    policies: Mapping[str, Value]


def _named(function: Function, args: tuple[str, ...]) -> dict[str, str]:
    """The texts of parameters and of `ARGC`, `ARGV`, `ARGN`, `ARGV0` and so on."""
    found = {"ARGC": str(len(args)), "ARGV": ";".join(args), "ARGN": ";".join(args[len(function.params) :])}
    found |= {f"ARGV{at}": text for at, text in enumerate(args)}
    return found | dict(zip(function.params, args, strict=False))


def bound(function: Function, args: tuple[str, ...]) -> dict[str, Value]:
    """Return the variables of a function's scope that its call sets."""
    return {name: Value((text,)) for name, text in _named(function, args).items()}


def substituted(function: Function, args: tuple[str, ...]) -> tuple[Step, ...]:
    """Return the body of a macro with its arguments written in: they are no variables there."""
    texts = _named(function, args)
    return tuple(_step(step, texts) for step in function.body)


def _step(step: Step, texts: dict[str, str]) -> Step:
    if isinstance(step, Block):
        branches = tuple(
            Branch(_written(each.header, texts), tuple(_step(inner, texts) for inner in each.body))
            for each in step.branches
        )
        return msgspec.structs.replace(step, branches=branches)
    return msgspec.structs.replace(step, args=_written(step.args, texts))


def _written(args: tuple[Argument, ...], texts: dict[str, str]) -> tuple[Argument, ...]:
    return tuple(_argument(argument, texts) if "${" in argument.text else argument for argument in args)


def _argument(argument: Argument, texts: dict[str, str]) -> Argument:
    if argument.form == "bracket":
        return argument
    text = _REFERENCE.sub(lambda match: texts.get(match[1], _left(match)), argument.text)
    form = "argument" if argument.form == "plain" else argument.form
    return msgspec.structs.replace(argument, text=text, form=form)


def _left(match: re.Match[str]) -> str:
    """What is no argument is a variable, but for one of those that the macro was not given."""
    return "" if re.fullmatch(r"ARGV\d+", match[1]) else match[0]
