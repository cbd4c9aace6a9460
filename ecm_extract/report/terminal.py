"""Text from somebody else's files, made safe for a terminal."""

from __future__ import annotations

import re
from typing import Final

# C0 and C1 controls, marks that turn the direction of writing, invisible marks, lone surrogates.
_CONTROL: Final = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ud800-\udfff]")


def one_line(text: str, limit: int = 200) -> str:
    """One line of text without anything that a terminal would act on; longer text is cut with an ellipsis."""
    clean = _CONTROL.sub("�", text)
    return clean if len(clean) <= limit else clean[: limit - 1] + "…"
