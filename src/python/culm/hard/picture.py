"""Margins as bars."""

import math

from .. import drawing
from .terminal import KINDS

COLOURS = {
    "good": "tab:green",
    "cut back": "tab:cyan",
    "failed": "tab:blue",
    "inaccurate": "tab:orange",
    "wrong": "tab:red",
    "faulty": "black",
}


def draw(entries, path):
    """One bar per case on a logarithmic axis, coloured by what happens beyond."""
    shown = [one for one in reversed(entries) if not math.isnan(one.margin)]
    figure, axes = drawing.plot(width=8.0, height=1.0 + 0.19 * len(shown))
    ax = axes[0][0]
    for kind, colour in COLOURS.items():
        places = [i for i, one in enumerate(shown) if one.kind == kind]
        if places:
            widths = [shown[i].margin for i in places]
            ax.barh(places, widths, color=colour, label=KINDS[kind], height=0.7)
    for i, one in enumerate(shown):
        end = ">" if one.is_open else ""
        ax.text(one.margin * 1.15, i, f"{end} {one.margin:.2g}", va="center", fontsize=6.5)
    drawing.scale_log(ax, "x")
    ax.set(xlabel="last good value over advised value", ylim=(-0.7, len(shown) - 0.3))
    ax.set_xlim(1.0, 100 * max([one.margin for one in shown], default=1.0))
    labels = [f"{one.name}  [{one.keys}]" for one in shown]
    ax.set_yticks(range(len(shown)), labels, fontsize=7)
    ax.grid(axis="y", visible=False)
    ax.legend(title="beyond the margin", loc="lower right", fontsize=7, title_fontsize=7)
    figure.savefig(path, dpi=110, format="png")  # whatever its ending
    drawing.close(figure)
