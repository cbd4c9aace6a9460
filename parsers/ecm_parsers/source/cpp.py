"""C++ source and headers, read by tree-sitter: also code that does not compile."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.source import cpp_text
from ecm_parsers.source.cpp_dead import without_dead
from ecm_parsers.source.cpp_declarations import DeclarationReader
from ecm_parsers.source.cpp_macro_calls import Expanded, with_macro_calls
from ecm_parsers.source.cpp_mentions import mentions
from ecm_parsers.source.cpp_parser import MAX_SECONDS, TooSlowError, first_error, parse_tree
from ecm_parsers.source.cpp_place import Place
from ecm_parsers.source.facts import Macro, Replacement, SourceFile

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tree_sitter import Tree

MAX_BYTES = 4_000_000
MACROS_CUT = "cpp-macros-cut"
"""Code of what is said where macros are not put in."""


def parse_cpp(data: bytes, brought: Sequence[Replacement] = ()) -> Parsed[SourceFile]:
    """Read one C++ file.

    Args:
        data: the file's bytes, any encoding that keeps ASCII.
        brought: macros of the headers that it includes, by which it calls something.

    Returns:
        Its facts; what the grammar could not read is one `info` diagnostic with the first such line.
    """
    if len(data) > MAX_BYTES:
        message = f"{len(data)} bytes of C++ were not read: the limit is {MAX_BYTES}. Exclude generated files."
        return Parsed(SourceFile("cpp"), (Diagnostic("warning", "cpp-too-large", 0, message, cut=True),))
    expanded = with_macro_calls(without_dead(data), brought)
    data = expanded.data
    try:
        tree, read = parse_tree(data)
    except TooSlowError:
        message = f"This C++ was not read: its syntax takes more than {MAX_SECONDS:g} s. Exclude generated files."
        return Parsed(SourceFile("cpp"), (Diagnostic("warning", "cpp-too-slow", 0, message, cut=True),))
    reader = DeclarationReader(read)
    reader.read(tree.root_node, Place())
    written = cpp_text.registrations(data)
    macros = tuple([Macro(name, args, line, reader.namespace_at(line)) for name, args, line in written])
    facts = msgspec.structs.replace(
        reader.facts(macros),
        mentions=mentions(tree.root_node, read),
        exported=expanded.exported,
        undecided=expanded.undecided,
    )
    return Parsed(facts, (*_of_macros(expanded), *_diagnostics(tree)))


def _of_macros(expanded: Expanded) -> Iterator[Diagnostic]:
    if expanded.is_cut:
        message = "More stands for macros than is put in; what they declare is not told. Exclude generated files."
        yield Diagnostic("warning", MACROS_CUT, 0, message, cut=True)


def _diagnostics(tree: Tree) -> tuple[Diagnostic, ...]:
    node = first_error(tree.root_node)
    if node is None:
        return ()
    line = node.start_point[0] + 1
    message = "Part of the file is not C++ that can be read without a preprocessor; declarations there may be missing."
    return (Diagnostic("info", "cpp-syntax", line, message),)
