"""The plot of the paper: recall of each method with its 95 % interval, a panel for each substrate."""

from __future__ import annotations

import io
from typing import Any, Final

from ecm_corpus.score import Recall, Score

_WIDTH: Final = 3.4
_HEIGHT: Final = 3.6
_STRICT: Final = "#1b6ca8"
_STYLE: Final = "#9cc3e6"
_PAPER: Final = "#222222"


def render(score: Score) -> str:
    """The plot as SVG; the same score gives the same bytes."""
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot

    substrates = list(dict.fromkeys(row.substrate for row in score.recall))
    with mpl.rc_context({"svg.hashsalt": "ecm", "svg.fonttype": "none", "font.size": 8}):
        size = (_WIDTH * max(1, len(substrates)), _HEIGHT)
        figure, axes = pyplot.subplots(1, max(1, len(substrates)), figsize=size, squeeze=False, sharey=True)
        for panel, substrate in zip(axes[0], substrates, strict=False):
            _panel(panel, [row for row in score.recall if row.substrate == substrate])
        axes[0][0].set_ylabel("recall")
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper right", frameon=False, ncols=3)
        figure.tight_layout(rect=(0, 0, 1, 0.93))
        stream = io.StringIO()
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
        pyplot.close(figure)
    return stream.getvalue()


def _panel(panel: Any, rows: list[Recall]) -> None:
    for offset, color, label in ((-0.2, _STRICT, "strict"), (0.2, _STYLE, "paper-style")):
        shares = [row.strict if label == "strict" else row.paper_style for row in rows]
        heights = [share.hits / share.total if share.total else 0.0 for share in shares]
        below = [max(0.0, height - share.low) for height, share in zip(heights, shares, strict=True)]
        above = [max(0.0, share.high - height) for height, share in zip(heights, shares, strict=True)]
        places = [at + offset for at in range(len(rows))]
        panel.bar(places, heights, 0.38, color=color, label=label, yerr=[below, above], capsize=2, ecolor="#777777")
    known = [(at, row.paper / row.strict.total) for at, row in enumerate(rows) if row.paper is not None]
    panel.plot([at for at, _ in known], [height for _, height in known], "D", ms=4, color=_PAPER, label="paper")
    panel.set_title(f"{rows[0].substrate} (N = {rows[0].strict.total})")
    panel.set_xticks(range(len(rows)), [row.method.replace(" (", "\n(") for row in rows], rotation=30, ha="right")
    panel.set_ylim(0, 1.04)
    panel.spines[["top", "right"]].set_visible(False)
