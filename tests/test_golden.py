"""A golden file that does not say what is said fails the test, and so does one that is not there."""

from __future__ import annotations

from pathlib import Path

import pytest
from golden_files import Golden

AS_USUAL = Golden(update=False)


@pytest.mark.parametrize(("kept", "said"), [("a\n", "b\n"), ("a\n", ""), ("a\n", "a"), (None, "a\n"), (None, "")])
def test_a_golden_file_that_differs_fails(kept: str | None, said: str, tmp_path: Path) -> None:
    if kept is not None:
        (tmp_path / "kept.txt").write_text(kept)
    with pytest.raises(pytest.fail.Exception, match="--update-golden"):
        AS_USUAL.check(tmp_path / "kept.txt", said)


def test_one_that_is_the_same_passes(tmp_path: Path) -> None:
    (tmp_path / "kept.txt").write_text("a\n")
    AS_USUAL.check(tmp_path / "kept.txt", "a\n")
    assert (tmp_path / "kept.txt").read_text() == "a\n"
