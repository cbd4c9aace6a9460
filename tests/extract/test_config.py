from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.config import MAX_CONFIG_BYTES, Config, Extract, locate, parse_config
from ecm_extract.errors import ConfigError
from ecm_extract.link.declaring.forms import Form

FULL = b"""
promise = ["wire", "graph"]
externals = ["/clock"]
[extract]
exclude = ["third_party/**"]
include_tests = true
[severity]
RES001 = "off"
[[form]]
callee = "make_publisher"
role = "publisher"
name = "arg:0"
[[form]]
callee = "read_setting"
role = "parameter"
"""


def test_all_keys() -> None:
    """Every key is read; rows of forms are checked like the bundled ones."""
    assert parse_config(FULL) == Config(
        extract=Extract(exclude=("third_party/**",), include_tests=True),
        forms=(Form("make_publisher", "publisher", name="arg:0"), Form("read_setting", "parameter")),
        severity={"RES001": "off"},
        promise=("wire", "graph"),
        externals=("/clock",),
    )


@pytest.mark.parametrize("data", [b"", b"\xef\xbb\xbf# only a comment\r\n"])
def test_defaults(data: bytes) -> None:
    """An empty file is the default configuration."""
    assert parse_config(data) == Config()


@pytest.mark.parametrize(
    ("text", "line", "key"),
    [
        ('\n[extract]\nexclude = ["a"]\nexlude = []', 4, "extract.exlude"),
        ("[extract]\r\n\r\ninclude_tests = 'yes'", 3, "extract.include_tests"),
        ("extract.include_tests = 3", 1, "extract.include_tests"),
        ('[severity]\nA = "off"\nVER001 = "loud"', 3, "severity.VER001"),
        ("[severity]\nA = [1]", 2, "severity.A"),
        ('# comment\npromise = [\n"wire",\n"peace"]', 2, "promise"),
        ('externals = "x"', 1, "externals"),
        ("\nform = 3", 2, "form"),
        ("[extract]\ninclude_tests = true\n[nonsense]\nb = 2", 3, "nonsense"),
        ("[[form]]\ncallee = 'f'\nrole = 'publisher'\n[[form]]\ncallee = 'g'\nrole = 'nobody'", 6, "form.role"),
        ("[[form]]\ncallee = 'f'\nrole = 'publisher'\nname = 'first'", 1, "form"),
        ("extract = 1", 1, "extract"),
        ("[extract]\nexclude = [\n", 3, ""),
        ("a = 1\na = 2", 1, ""),
        ("[extract\n", 1, ""),
    ],
)
def test_mistakes(text: str, line: int, key: str) -> None:
    """A mistake names the file, its line and the key."""
    with pytest.raises(ConfigError) as error:
        parse_config(text.encode(), "my/ecm.toml")
    assert (error.value.key, error.value.path) == (key, "my/ecm.toml")
    assert error.value.line == line or not key
    assert error.value.line > 0
    assert str(error.value).startswith("my/ecm.toml:")
    assert error.value.exit_status == 2


@pytest.mark.parametrize(
    "data", [b"a = " + b"[" * 50_000, b"#" * (MAX_CONFIG_BYTES + 1), b"a = \xff", b"\0", b"a = \x1b[31m"]
)
def test_hostile(data: bytes) -> None:
    """Deep, huge or undecodable text is an error of the input like any other."""
    with pytest.raises(ConfigError) as error:
        parse_config(data)
    assert "\x1b" not in str(error.value)


@settings(max_examples=50)
@given(st.text(alphabet='[]="a.\n1{}, #severityformextract', max_size=60))
def test_any_text(text: str) -> None:
    """Any text gives a configuration or a ConfigError."""
    with suppress(ConfigError):
        assert isinstance(parse_config(text.encode()), Config)


def test_locate_row() -> None:
    """The line of a column is found in the row that is meant."""
    text = "[[form]]\nb = 1\n[[form]]\nb = 2\n"
    assert locate(text, ("form", 1, "b")) == 4
    assert locate(text, ("form", 1, "missing")) == 3
    assert locate(text, ("nothing",)) == 0
