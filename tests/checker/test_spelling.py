"""Names that are computed in part: what they may mean has their text in it."""

from __future__ import annotations

from ecm_checker.hub.provision import HOLE
from ecm_checker.match.spelling import graph_name_matches, parameter_name_matches, text_pattern
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

_PIECES = st.sampled_from(["a", "b", "fps", "_", ".", "/", "~/", HOLE])
_OFFERED = st.lists(_PIECES, min_size=1, max_size=6).map("".join)
_USED = st.lists(st.sampled_from(["a", "b", "fps", "_", ".", "/", "~/", "{x}"]), min_size=1, max_size=6).map("".join)


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(_OFFERED, st.lists(_OFFERED, max_size=3), _USED)
def test_whatever_matches_has_the_text(offered: str, others: list[str], used: str) -> None:
    """So that nothing is lost where names are narrowed down by it."""
    if graph_name_matches(offered, used) or parameter_name_matches(offered, used):
        assert text_pattern([*others, offered]).search(used)


def test_other_names_do_not() -> None:
    """Else nothing would be narrowed down."""
    found = text_pattern([f"{HOLE}_fps", f"enable_{HOLE}"])
    assert [name for name in ("color_fps", "color.enable_x", "fps_color", "rate") if found.search(name)] == [
        "color_fps",
        "color.enable_x",
    ]
