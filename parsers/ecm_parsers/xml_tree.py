"""XML of a stranger -> an element tree: no entities, no DTD, no network, bounded in size and depth.

Lenient like the readers that ROS uses (tinyxml): a declaration after blank lines, an unbound prefix or a
document that breaks off still gives the tree up to there, with a diagnostic.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from lxml import etree

from ecm_parsers.result import Diagnostic
from ecm_parsers.text import decode

MAX_BYTES = 8_000_000
MAX_DEPTH = 200
MAX_ATTRIBUTES = 1_000
"""Of one element; libxml2 looks each up among all of them."""
MAX_PROBLEMS = 20
_MAX_CORRECTED = 200_000
_MAX_LINE = 65_535  # what a node of libxml2 can hold
_DECLARATION = re.compile(r"\s*<\?xml\b[^>]{0,200}\?>")
_LATIN = re.compile(r"encoding\s*=\s*[\"'](?:iso-8859-1|latin-?1|windows-1252)[\"']", re.IGNORECASE)
_ENTITY = re.compile(r"<!ENTITY\b")
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
_NOT_LINE_END = re.compile(rb"[^\n]")
_NOT_BLANK = re.compile(r"[^\n]")
_SKIPPED_OR_TAG = re.compile(
    r"""<!--.*?(?:-->|\Z)|<!\[CDATA\[.*?(?:\]\]>|\Z)|<\?.*?(?:\?>|\Z)"""
    r"""|(?P<tag><[A-Za-z_:](?:[^"'>]|"[^"]*"|'[^']*')*+)""",
    re.DOTALL,
)
_NO_XML = Diagnostic("error", "xml-empty", 0, "The file holds no XML. Remove it or give it a root element.")


class XmlTree(msgspec.Struct, frozen=True):
    """The root elements of a document, usually one, and what was wrong with it."""

    roots: tuple[etree._Element, ...]
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def root(self) -> etree._Element | None:
        """The first root element; None when nothing could be read."""
        return self.roots[0] if self.roots else None


def parse_xml(data: bytes, *, many_roots: bool = False) -> XmlTree:
    """Read one XML document.

    Args:
        data: its bytes, at most `MAX_BYTES`.
        many_roots: accept several root elements, as pluginlib does; otherwise all but the first are an error.

    Returns:
        The roots with line numbers of the file, and diagnostics.
    """
    if len(data) > MAX_BYTES:
        return _refused("xml-too-large", 0, f"The file exceeds {MAX_BYTES} bytes and is skipped. Split it.")
    text, doubts = decode(data)
    entity = _ENTITY.search(text)
    if entity:
        line = text.count("\n", 0, entity.start()) + 1
        return _refused("xml-entity", line, "Entity declarations are not read. Write the text itself.")
    if _LATIN.search(text, 0, 300):
        doubts = tuple(doubt for doubt in doubts if doubt.code != "text-not-utf8")
    declaration = _DECLARATION.match(text)
    body = _NOT_BLANK.sub(" ", declaration[0]) + text[declaration.end() :] if declaration else text
    if not body.strip():
        return XmlTree((), (*doubts, _NO_XML))
    return _parse(f"<roots>{body}\n</roots>" if many_roots else body, doubts, many_roots=many_roots)


def without_comments(data: bytes) -> bytes:
    """Return a document with its comments blank; what stands in one is used by nobody. Lines stay where they are."""
    return _COMMENT.sub(lambda match: _NOT_LINE_END.sub(b" ", match[0]), data)


def children(element: etree._Element) -> Iterator[tuple[str, etree._Element]]:
    """Yield own tag (without namespace) and element of each child element; comments are left out."""
    for child in element:
        if isinstance(child.tag, str):
            yield local_name(child), child


def local_name(element: etree._Element) -> str:
    """Return the tag without its namespace or prefix."""
    return str(element.tag).rpartition("}")[2].rpartition(":")[2]


def line_of(element: etree._Element) -> int:
    """Return the 1-based line of the element's start tag, 0 when unknown."""
    line = element.sourceline
    return line if isinstance(line, int) else 0


def text_of(element: etree._Element) -> str:
    """Return all text inside the element with white space collapsed."""
    return " ".join("".join(str(part) for part in element.itertext(tag=etree.Element)).split())


def _parse(body: str, doubts: tuple[Diagnostic, ...], *, many_roots: bool) -> XmlTree:
    parser = etree.XMLParser(
        encoding="utf-8",
        resolve_entities=False,
        load_dtd=False,
        no_network=True,
        huge_tree=False,
        recover=True,
        remove_pis=True,
    )
    try:
        root = etree.fromstring(body.encode("utf-8", "replace"), parser)
    except etree.XMLSyntaxError as error:
        return XmlTree((), (*doubts, _problem(error.lineno or 0, error.msg or ""), _NO_XML))
    diagnostics = (*doubts, *_problems(parser))
    if root is None:
        return XmlTree((), (*diagnostics, _NO_XML))
    if _is_too_deep(root):
        message = f"Elements nest deeper than {MAX_DEPTH}; the file is skipped. Flatten it."
        return XmlTree((), (*diagnostics, Diagnostic("error", "xml-too-deep", 0, message, cut=True)))
    _correct_lines(root, body)
    diagnostics += tuple(_crowded(root))
    roots = tuple(element for _, element in children(root)) if many_roots else (root,)
    return XmlTree(roots, diagnostics if roots else (*diagnostics, _NO_XML))


def _problems(parser: etree.XMLParser) -> tuple[Diagnostic, ...]:
    log = list(parser.error_log)[:MAX_PROBLEMS]
    return tuple(_problem(entry.line, entry.message) for entry in log)


def _problem(line: int, message: str) -> Diagnostic:
    told = f"Not well-formed: {message}. Correct the XML."
    return Diagnostic("warning", "xml-malformed", line, told, wrong=message, advice="Correct the XML")


def _is_too_deep(root: etree._Element) -> bool:
    depth = 0
    for event, _ in etree.iterwalk(root, events=("start", "end")):
        depth += 1 if event == "start" else -1
        if depth > MAX_DEPTH:
            return True
    return False


def _crowded(root: etree._Element) -> Iterator[Diagnostic]:
    """Take the attributes from elements that have too many, and yield what was left out."""
    for element in root.iter(etree.Element):
        count = len(element.attrib)
        if count > MAX_ATTRIBUTES:
            element.attrib.clear()
            message = f"<{local_name(element)[:80]}> has {count} attributes; none is read. Leave {MAX_ATTRIBUTES}."
            yield Diagnostic("error", "xml-too-many-attributes", line_of(element), message)


def _correct_lines(root: etree._Element, body: str) -> None:
    """Set each element's line to where its start tag begins; libxml2 knows only where it ends."""
    starts = [match.start("tag") for match in _SKIPPED_OR_TAG.finditer(body) if match["tag"]]
    if len(starts) > _MAX_CORRECTED or len(starts) != sum(1 for _ in root.iter(etree.Element)):
        return
    line, position = 1, 0
    for element, start in zip(root.iter(etree.Element), starts, strict=True):
        line += body.count("\n", position, start)
        position = start
        if line < _MAX_LINE:
            element.sourceline = line  # type: ignore[assignment]  # the stubs know no setter


def _refused(code: str, line: int, message: str) -> XmlTree:
    return XmlTree((), (Diagnostic("error", code, line, message, cut=True),))
