"""Names with open parts: in fields, and in the one text that tables and older documents have."""

from __future__ import annotations

import pytest
from ecm_checker.hub.local_name import LocalName, OpenPart, Parts, joined, shown
from ecm_checker.hub.name_notation import read_name
from ecm_checker.hub.running import RunningEndpoint, as_local, as_written
from hypothesis import given
from hypothesis import strategies as st

TEXTS = st.text(alphabet="ab/{}$=~. ", max_size=8)
SPACES = st.sampled_from(["", "arm", "{robot}"])
OPEN = st.builds(OpenPart, st.sampled_from(["node", "plugin", "nobody"]), TEXTS)
PARAMETERS = st.builds(OpenPart, st.just("parameter"), TEXTS, st.tuples(TEXTS))
NAMES = st.builds(LocalName, st.lists(TEXTS | OPEN | PARAMETERS, max_size=4).map(joined), SPACES)


@given(NAMES)
def test_a_name_is_read_as_it_was_written(name: LocalName) -> None:
    """Whatever braces are in its texts: a document holds them in fields."""
    found = as_local(as_written(name))
    assert (joined(found.parts), found.space) == (name.parts, name.space)


@pytest.mark.parametrize(
    ("text", "parts", "space"),
    [
        ("/scan", ("/scan",), ""),
        ("", ("",), ""),
        ("{in arm}~/out", ("~/out",), "arm"),
        ("${topic=odom}_raw", (OpenPart("parameter", "topic", ("odom",)), "_raw"), ""),
        ("${topic={name}}", (OpenPart("parameter", "topic", (OpenPart("nobody", "name"),)),), ""),
        ("{node}/a", (OpenPart("node"), "/a"), ""),
        ("{node namespace}/a", (OpenPart("namespace"), "/a"), ""),
        ("{parent namespace}/{item}", (OpenPart("above"), "/", OpenPart("nobody", "item")), ""),
    ],
)
def test_the_text_of_tables_and_older_documents(text: str, parts: Parts, space: str) -> None:
    assert read_name(text) == LocalName(parts, space)


@pytest.mark.parametrize(
    ("part", "text"),
    [
        (OpenPart("parameter", "topic", ("odom",)), "odom"),
        (OpenPart("parameter", "topic", (OpenPart("nobody", "item"),)), "{item}"),
        (OpenPart("node"), "{node}"),
        (OpenPart("plugin", "name"), "{name}"),
    ],
)
def test_what_nobody_tells_is_shown_as_its_default_or_as_open(part: OpenPart, text: str) -> None:
    assert shown(["/", part]) == f"/{text}"


def test_an_endpoint_without_names_of_its_own_is_called_as_in_its_contract() -> None:
    """A brace in it is a brace."""
    endpoint = RunningEndpoint("publisher", "/{in arm}out", "a.py", 1)
    assert endpoint.local_names == (LocalName(("/{in arm}out",)),)
