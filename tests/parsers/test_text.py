"""Text artefacts are read whatever their encoding and line ends."""

import codecs

import pytest
from ecm_parsers.text import decode
from hypothesis import given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"a\nb", "a\nb"),
        (b"a\r\nb\rc", "a\nb\nc"),
        (codecs.BOM_UTF8 + b"a", "a"),
        ("é\n".encode("utf-16"), "é\n"),
        (codecs.BOM_UTF16_BE + "é\r\n".encode("utf-16-be"), "é\n"),
        (b"", ""),
    ],
)
def test_encodings_of_editors_read_without_doubt(data: bytes, text: str) -> None:
    """UTF-8 and marked UTF-16 give the same text, with LF line ends and no byte order mark."""
    assert decode(data) == (text, ())


@pytest.mark.parametrize(
    ("data", "text", "code", "line"),
    [
        (b"a\n\xe9", "a\né", "text-not-utf8", 2),
        (b"a\n\nb\0c", "a\n\nb c", "text-nul", 3),
        (codecs.BOM_UTF16_LE + b"a", "\ufffd", "text-bad-utf16", 1),
    ],
)
def test_doubtful_text_says_where(data: bytes, text: str, code: str, line: int) -> None:
    """Whatever had to be guessed is a diagnostic on the line of its first occurrence."""
    read, diagnostics = decode(data)
    assert read == text
    assert [(found.code, found.line) for found in diagnostics] == [(code, line)]


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=200))
def test_any_bytes_decode(data: bytes) -> None:
    """Decoding never raises, and never leaves a carriage return or a NUL."""
    text, _ = decode(data)
    assert not set(text) & {"\r", "\0"}
