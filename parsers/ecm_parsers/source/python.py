"""Python sources, versions 2 and 3, as facts."""

from __future__ import annotations

from functools import cache
from time import monotonic

import tree_sitter_python
from tree_sitter import Language, Node, Parser

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.source.facts import Function, SourceFile
from ecm_parsers.source.python_body import STATEMENTS
from ecm_parsers.source.python_decl import DECLARATIONS
from ecm_parsers.source.python_expr import EXPRESSIONS
from ecm_parsers.source.python_lambda import LAMBDAS
from ecm_parsers.source.python_private import with_private_names
from ecm_parsers.source.python_scan import Scan

MAX_BYTES = 2_000_000
MAX_SECONDS = 5.0

_BOM = b"\xef\xbb\xbf"
_EXPRESSIONS = {**EXPRESSIONS, **LAMBDAS}
_HANDLERS = {**STATEMENTS, **DECLARATIONS}


def parse_python(data: bytes) -> Parsed[SourceFile]:
    """Read the facts of a Python source file, also of one that does not fully parse.

    Args:
        data: content of the file.

    Returns:
        Its facts; the module body is the function `<module>`. Diagnostics: `python-too-large` and
        `python-too-slow` when nothing was read, `python-syntax` at the first place that does not parse,
        `python-too-deep` at the first statement or expression that is nested too deeply to be read.
    """
    if len(data) > MAX_BYTES:
        message = f"The file has more than {MAX_BYTES} bytes and was not read. Split it, or exclude generated code."
        return _unread("python-too-large", message)
    data = data.removeprefix(_BOM)
    root = syntax_tree(data)
    if root is None:
        message = f"The file took more than {MAX_SECONDS} s to parse and was not read. Correct its syntax."
        return _unread("python-too-slow", message)
    scan = Scan(data, _EXPRESSIONS, _HANDLERS)
    scan.block(root)
    read = _source_file(scan, root)
    return Parsed(with_private_names(read) if scan.has_private else read, _diagnostics(scan, root))


def _unread(code: str, message: str) -> Parsed[SourceFile]:
    return Parsed(SourceFile("python"), (Diagnostic("error", code, 0, message, cut=True),))


def syntax_tree(data: bytes) -> Node | None:
    """Syntax tree of a source; None when it takes too long, as recovery from some errors is quadratic."""
    parser = _parser()
    end = monotonic() + MAX_SECONDS
    try:
        tree = parser.parse(
            lambda offset, _point: data[offset:], progress_callback=lambda _offset, _error: monotonic() > end
        )
    except ValueError:
        # Without it the parser would go on with this source at the next call.
        parser.reset()
        return None
    return tree.root_node


@cache
def _parser() -> Parser:
    return Parser(Language(tree_sitter_python.language()))


def _source_file(scan: Scan, root: Node) -> SourceFile:
    end_line = root.end_point[0] + 1
    module = Function("<module>", "", (), "", 1, end_line, tuple(scan.frame.body), flow=scan.frame.flow.flow())
    return SourceFile(
        language="python",
        imports=tuple(scan.imports),
        classes=tuple(sorted(scan.classes, key=lambda one: one.line)),
        functions=(module, *sorted(scan.functions, key=lambda one: one.line)),
        constants=tuple(scan.constants),
        shebang=_shebang(scan.data),
    )


def _shebang(data: bytes) -> str:
    if not data.startswith(b"#!"):
        return ""
    return data[:1000].partition(b"\n")[0].decode("utf-8", "replace").strip()


def _diagnostics(scan: Scan, root: Node) -> tuple[Diagnostic, ...]:
    found: list[Diagnostic] = []
    if root.has_error:
        message = "This does not parse as Python; the rest of the file was read. Correct the syntax here."
        found.append(Diagnostic("info", "python-syntax", _error_line(root), message))
    if scan.cut_line:
        message = "What is nested too deeply here was left out. Flatten it, or move it into functions."
        found.append(Diagnostic("warning", "python-too-deep", scan.cut_line, message))
    return tuple(found)


def _error_line(root: Node) -> int:
    """Line of the first node that does not parse."""
    node = root
    while not (node.is_error or node.is_missing):
        broken = next((child for child in node.children if child.has_error), None)
        if broken is None:
            break
        node = broken
    return node.start_point[0] + 1
