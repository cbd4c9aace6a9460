"""Records of packages survive being written and read: whatever a package provides and requires."""

from __future__ import annotations

from typing import Any

import msgspec
from ecm_checker.contract import Qos
from ecm_checker.hub.kinds import kinds, uses
from ecm_checker.hub.package import Hub, encode_hub, provided, provision, provisions
from ecm_checker.hub.provision import Form, Line, Provision
from ecm_checker.hub.requirement import Given, Requirement
from ecm_checker.json_data import json_data
from hypothesis import given, settings
from hypothesis import strategies as st

TEXT = st.text(st.characters(codec="utf-8"), max_size=12)
NAMES = st.lists(TEXT, max_size=3).map(tuple)
LINE = st.tuples(TEXT, st.integers(0, 9999))
PLAIN = st.none() | st.booleans() | st.integers(-(2**63), 2**63 - 1) | st.floats(allow_nan=False) | TEXT
VALUE = st.recursive(
    PLAIN, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXT, inner, max_size=3), max_leaves=6
).map(json_data)
QOS = st.none() | st.just(Qos())
FORM = st.builds(Form, types=NAMES, required=st.integers(0, 4), returns=TEXT, names=NAMES, line=st.integers(0, 99))
GIVEN = st.none() | st.builds(Given, count=st.none() | st.integers(0, 9), names=NAMES, takes=TEXT, types=NAMES)


@st.composite
def provisions_made(draw: st.DrawFn) -> Provision:
    """A provision; the calls that lead to it begin with its own line, and one call leads nowhere."""
    others: list[Line] = draw(st.lists(LINE, max_size=3, unique=True))
    path, line = draw(LINE)
    rest = [each for each in others if each != (path, line)]
    made: Provision = draw(
        st.builds(
            Provision,
            kind=st.sampled_from(sorted(kinds())),
            package=st.just("alpha"),
            owner=TEXT,
            name=TEXT,
            path=st.just(path),
            line=st.just(line),
            facet=TEXT,
            node=st.none() | TEXT,
            sharers=NAMES,
            others=NAMES,
            chain=st.just(((path, line), *rest) if rest else ()),
            type=st.none() | TEXT,
            default=VALUE,
            forms=st.lists(FORM, max_size=2).map(tuple),
            bases=NAMES,
            qos=QOS,
            ros=st.sampled_from([None, 1, 2]),
            deprecated=st.none() | TEXT,
            open=st.booleans(),
            written=TEXT,
        )
    )
    return made


REQUIREMENTS = st.builds(
    Requirement, use=st.sampled_from(sorted(uses())), name=TEXT, value=VALUE, qos=QOS, given=GIVEN, ignored=NAMES
)
HUBS = st.builds(
    Hub,
    manifest=st.none() | TEXT,
    provides=st.lists(provisions_made().map(provided), max_size=3).map(tuple),
    requires=st.lists(REQUIREMENTS, max_size=3).map(tuple),
    bound=NAMES,
    quoted=NAMES,
    interfaces=st.dictionaries(TEXT, VALUE, max_size=2),
    files=st.dictionaries(TEXT, TEXT, max_size=2),
    notes=st.dictionaries(TEXT, NAMES, max_size=2),
)


def again(record: Any) -> Any:
    """A record written and read."""
    return msgspec.json.decode(msgspec.json.encode(record), type=type(record))


@settings(max_examples=60, deadline=None)
@given(provisions_made())
def test_a_provision_is_what_it_was(made: Provision) -> None:
    assert provision("alpha", again(provided(made))) == made


@settings(max_examples=60, deadline=None)
@given(REQUIREMENTS)
def test_a_requirement_is_what_it_was(made: Requirement) -> None:
    assert again(made) == made


@settings(max_examples=40, deadline=None)
@given(HUBS)
def test_a_hub_is_what_it_was_and_is_written_the_same_again(made: Hub) -> None:
    read = msgspec.json.decode(encode_hub(made), type=Hub)
    assert read == made
    assert encode_hub(read) == encode_hub(made)
    assert provisions("alpha", read) == provisions("alpha", made)
