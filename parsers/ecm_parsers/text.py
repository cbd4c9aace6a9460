"""Bytes of a text artefact -> text with LF line ends, whatever editor wrote them."""

import codecs

from ecm_parsers.result import Diagnostic

_UTF16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_NUL = "\0"


def decode(data: bytes) -> tuple[str, tuple[Diagnostic, ...]]:
    """Read bytes as UTF-8, or as UTF-16 when marked, or else as latin-1, which cannot fail.

    Line ends become LF and the byte order mark is dropped, so line numbers are those of an editor.
    NULs become spaces: no artefact means them, and the libraries behind the parsers end a text at one.

    Returns:
        The text, and a diagnostic for each doubt about it.
    """
    text, doubts = _decode_utf16(data) if data.startswith(_UTF16_MARKS) else _decode_utf8(data)
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    if _NUL in text:
        line = text.count("\n", 0, text.index(_NUL)) + 1
        message = "The text holds NUL bytes, read as spaces. Check that this is a text file."
        doubts = (*doubts, Diagnostic("warning", "text-nul", line, message))
        text = text.replace(_NUL, " ")
    return text, doubts


def _decode_utf8(data: bytes) -> tuple[str, tuple[Diagnostic, ...]]:
    try:
        return data.decode("utf-8"), ()
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
    message = "The text is not UTF-8 and is read as latin-1. Save it as UTF-8."
    return data.decode("latin-1"), (Diagnostic("warning", "text-not-utf8", line, message),)


def _decode_utf16(data: bytes) -> tuple[str, tuple[Diagnostic, ...]]:
    text = data.decode("utf-16", errors="replace")
    if "\ufffd" not in text:
        return text, ()
    line = text.count("\n", 0, text.index("\ufffd")) + 1
    message = "The text is marked as UTF-16 but does not decode as such. Save it as UTF-8."
    return text, (Diagnostic("warning", "text-bad-utf16", line, message),)
