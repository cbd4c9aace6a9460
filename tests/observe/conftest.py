"""What all tests of observe share."""

from __future__ import annotations

import pytest

from ecm_extract.observe.ros1 import peer


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """A loaded machine answers late; tests of the bound itself set their own."""
    monkeypatch.setattr(peer, "TIMEOUT_S", 30.0)
