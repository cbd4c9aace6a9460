"""Python sources that do not parse, are hostile, or are large."""

import msgspec
import pytest
from ecm_parsers.result import Parsed
from ecm_parsers.source.expr import Call, Member, Name, Text
from ecm_parsers.source.facts import SourceFile
from ecm_parsers.source.python import MAX_BYTES, parse_python
from hypothesis import given, settings
from hypothesis import strategies as st

SNIPPET = b'''#!/usr/bin/env python
from .a import (b as c, d)
class Driver(Node, metaclass=Meta):
    """Doc."""
    rate: float = 1.0
    def __init__(self, ns='~', *args, **kw):
        super().__init__(f'{ns!r:>3}driver')
        self.pubs = {k: self.create_publisher(T, '/'.join((ns, k)), 10) for k in kw if k}
        self.a, b = rospy.get_param(ns + 'rate', 0x10), lambda m: self.on(m)
        for i, (j, _) in enumerate(args[1:]): print "x %s" % i
        try:
            with open(r'\\d') as f, lock: x = y = (n := f.read(-1))
        except (IOError, OSError), e: raise Bad(e)
        return not x if await x() else [*args]
'''


def round_trips(parsed: Parsed[SourceFile]) -> bool:
    return msgspec.msgpack.decode(msgspec.msgpack.encode(parsed.facts), type=SourceFile) == parsed.facts


def test_facts_survive_the_cache() -> None:
    """What is encoded for the cache decodes to the same facts."""
    assert round_trips(parse_python(SNIPPET))


@given(st.one_of(st.text().map(str.encode), st.binary()))
@settings(max_examples=50, deadline=None)
def test_any_bytes_are_read(data: bytes) -> None:
    """No content makes the parser raise, and its facts can always be cached."""
    assert round_trips(parse_python(data))


@given(st.data())
@settings(max_examples=50, deadline=None)
def test_mutated_source_is_read(data: st.DataObject) -> None:
    """Source with a piece cut out, doubled or replaced is read as far as it goes."""
    start = data.draw(st.integers(0, len(SNIPPET)))
    end = data.draw(st.integers(start, len(SNIPPET)))
    piece = data.draw(
        st.sampled_from([b"", b"(", b")", b"'", b":", b"\n", b"\x00", b"f'{", b"=", SNIPPET[start:end] * 2])
    )
    assert round_trips(parse_python(SNIPPET[:start] + piece + SNIPPET[end:]))


def test_rest_of_a_broken_file_is_read() -> None:
    """A line that does not parse costs one diagnostic, not the file."""
    parsed = parse_python(b"x = 1\ndef f(:\n    pass\nrospy.Publisher('t')\n")
    assert [(one.severity, one.code, one.line) for one in parsed.diagnostics] == [("info", "python-syntax", 2)]
    calls = [one.value for function in parsed.facts.functions for one in function.body if one.kind == "do"]
    assert Call(Member(Name("rospy"), "Publisher"), (Text("t"),), line=4) in calls


def test_call_inside_an_unclosed_call_is_read() -> None:
    """Calls are found in what does not parse as a whole."""
    parsed = parse_python(b"foo(bar('t')\nx = 1\n")
    assert "'bar'" in repr(parsed.facts)


@pytest.mark.parametrize(
    "data",
    [
        b"x = " + b"(" * 10_000 + b"1" + b")" * 10_000,
        b"x = " + b"[" * 10_000,
        b"x = a" + b".b()" * 10_000,
        b"x = a" + b".b" * 10_000,
        b"x = a" + b" + 'a'" * 10_000,
        b"x = " + b"not " * 10_000 + b"a",
        b"x = " + b"-" * 10_000 + b"1",
        b"x = " + b"lambda: " * 10_000 + b"f()",
        b"x = " + b"f(" * 10_000 + b")" * 10_000,
        b"a = " * 10_000 + b"1",
        b"if x:\n" + b"".join(b" " * i + b"if f():\n" for i in range(1, 500)) + b" " * 500 + b"f()",
        b"if a: f()\n" + b"elif b: f()\n" * 10_000,
        b"x = " + b"a if b else " * 10_000 + b"c",
        b"x = " + b"f'{" * 300 + b"a" + b"}'" * 300,
        b"class A: " * 500,
        b"{" * 10_000,
        b"\x00" * 10_000,
        b"x = " + b"9" * 10_000,
        b"x = '" + b"\\N{" * 1000 + b"'",
    ],
    ids=lambda data: data[:16].decode(),
)
def test_deep_nesting_is_bounded(data: bytes) -> None:
    """Nesting of any depth is read to a bound, without recursion errors."""
    assert round_trips(parse_python(data))


def test_what_is_too_deep_is_said() -> None:
    """Left-out depth has a diagnostic with its line."""
    parsed = parse_python(b"\nx = " + b"(" * 1000 + b"1" + b")" * 1000)
    assert [(one.code, one.line) for one in parsed.diagnostics] == [("python-too-deep", 2)]


def test_file_beyond_the_size_bound_is_not_read() -> None:
    """A file that is too large has a diagnostic and no facts."""
    parsed = parse_python(b"x = 1\n" * (MAX_BYTES // 6 + 1))
    assert parsed.facts == SourceFile("python")
    assert [one.code for one in parsed.diagnostics] == ["python-too-large"]


def test_parse_that_takes_too_long_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """A file whose recovery is slow has a diagnostic and no facts, and the next file is read as always."""
    monkeypatch.setattr("ecm_parsers.source.python.MAX_SECONDS", 0.05)
    parsed = parse_python(b"x = '" + b"\\N{" * 20_000 + b"'")
    assert parsed.facts == SourceFile("python")
    assert [one.code for one in parsed.diagnostics] == ["python-too-slow"]
    assert parse_python(b"x = 'a'").facts.constants[0].value == Text("a")


def test_encodings_and_line_ends_do_not_matter() -> None:
    """A byte order mark, CRLF and Latin-1 bytes leave the facts as they are."""
    parsed = parse_python(b"\xef\xbb\xbfx = '''a\r\nb'''\r\ny = '\xe9'\r\n")
    assert [one.value for one in parsed.facts.constants] == [Text("a\nb"), Text("\ufffd")]
