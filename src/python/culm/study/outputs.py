"""What a study leaves behind: table, study.csv, study.png, study.html."""

import csv
import pathlib

from .. import drawing
from ..footnotes import Footnotes
from ..page import Page
from . import advice

BAND = "0.9"
LEAST_DRAWN = 1e-14  # relative error


def columns_and_rows(judgement):
    """Texts of the table: settings, cost, errors, remark."""
    titles = [*judgement.measure.parts, *(w.name for w in judgement.plan.watched if w.drift)]
    held_out = [*judgement.held_out.parts, *(w.name for w in judgement.plan.held_out if w.drift)]
    names = [axis.leaf for axis in judgement.axes]
    columns = [*names, "CPU [s]", "spread", *titles, *(f"({title})" for title in held_out), ""]
    best = {id(point) for point in advice.front(judgement.points.values())}
    footnotes = Footnotes()
    rows = []
    for index, point in judgement.points.items():
        values = [axis.value(i) for axis, i in zip(judgement.axes, index)]
        if not point.succeeded:
            empty = ["–"] * (2 + len(titles) + len(held_out))
            rows.append([*values, *empty, f"failed: {point.record.outcome}"])
            continue
        times = point.record.times
        rows.append(
            [
                *values,
                f"{point.record.cpu:.3g}",
                f"{min(times):.3g}–{max(times):.3g}",
                *(f"{point.errors[title]:.2e}" for title in titles),
                *(f"{point.held_out[title]:.2e}" for title in held_out),
                _remark(point, id(point) in best, footnotes),
            ]
        )
    return columns, rows


def broken_promises(judgement):
    """What the marks in the table stand for; empty where all runs kept their promises."""
    footnotes = Footnotes()
    for point in judgement.points.values():
        footnotes.mark(point.record.broken)
    return footnotes.lines


def table(columns, rows):
    """Aligned text."""
    cells = [columns, *rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(columns))]
    return "\n".join(
        "  ".join(f"{cell:>{width}}" for cell, width in zip(row[:-1], widths)) + f"  {row[-1]}".rstrip()
        for row in cells
    )


def orders(judgement):
    """Lines such as 'step: 2.00 ± 0.03 (scheme=Conserving, from 4 differences)'."""
    return [
        f"order in {judgement.axes[line.axis].leaf}: {_order(line)}"
        + (f", {judgement.label_of(line.combination)}" if line.combination else "")
        for line in judgement.lines
    ]


def write_csv(judgement, path):
    """One line per run: settings, outcome, times, errors, uncertainty of the reference."""
    first = next(point for point in judgement.points.values() if point.succeeded)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(
            [axis.name for axis in judgement.axes]
            + ["outcome", "cpu median [s]", "cpu least [s]", "cpu most [s]"]
            + [f"error of {title}" for title in first.errors]
            + [f"error of {title}, held out" for title in first.held_out]
            + ["uncertainty of the reference", "broken promises"]
        )
        for index, point in judgement.points.items():
            values = [axis.value(i) for axis, i in zip(judgement.axes, index)]
            if not point.succeeded:
                writer.writerow([*values, f"{point.record.outcome}: {point.record.reason}"])
                continue
            times = point.record.times
            numbers = [point.record.cpu, min(times), max(times), *point.errors.values()]
            numbers += [*point.held_out.values(), point.uncertainty]
            broken = "; ".join(point.record.broken)
            writer.writerow([*values, "done", *(f"{number:.6g}" for number in numbers), broken])


def write_reference(judgement, path):
    """The extrapolated history of what was watched, as --reference reads it."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *judgement.measure.columns])
        for level, row in zip(judgement.measure.levels, judgement.reference.value):
            writer.writerow([f"{number:.17g}" for number in (level, *row)])


def draw(judgement):
    """Error against CPU time, and against each refined variation."""
    axes_drawn = list(dict.fromkeys(line.axis for line in judgement.lines))
    figure, axes = drawing.plot(1 + len(axes_drawn), width=5.2, height=4.2)
    styles = {combination: _style(i) for i, combination in enumerate(judgement.combinations())}
    _draw_costs(judgement, axes[0][0], styles)
    for ax, a in zip(axes[0][1:], axes_drawn):
        _draw_lines(judgement, ax, a, styles)
    return figure


def write_page(judgement, title, command, path, figure, promise=None):
    """study.html; returns its picture."""
    page = Page(f"Study: {title}", command)
    page.paragraph(_capital(advice.sentence(judgement)) + ".", "advice")
    if promise:
        page.paragraph(promise, "advice")
    picture = page.figure(figure, "error against CPU time, and against each variation")
    page.paragraph(explanation(judgement))
    for note in judgement.notes:
        page.paragraph(note, "warning")
    if judgement.lines:
        page.heading("Observed orders")
        page.paragraph(
            "From the differences of neighbouring runs, with all other variations at their finest; "
            "95 % confidence. A theory speaks of fine runs: the coarsest are left out where that narrows "
            "the interval."
        )
        page.table(
            ["variation", "of", "order", "from so many differences"],
            [
                [
                    judgement.axes[line.axis].leaf,
                    judgement.label_of(line.combination) or "all",
                    _order(line),
                    line.order.used if line.order else "–",
                ]
                for line in judgement.lines
            ],
        )
    page.heading("Runs")
    broken = [i for i, point in enumerate(judgement.points.values()) if point.record.broken]
    page.table(*columns_and_rows(judgement), broken)
    for line in broken_promises(judgement):
        page.paragraph(line, "broken")
    reasons = [
        f"{judgement.label(i)}: {p.record.reason}" for i, p in judgement.points.items() if not p.succeeded
    ]
    if reasons:
        page.heading("Failures")
        page.code("\n".join(reasons))
    page.write(path)
    return picture


def explanation(judgement):
    """What the errors are."""
    norms = {
        "rms": "root of the mean square over time",
        "max": "largest difference over time",
        "end": "difference at the end",
    }
    norm = norms[judgement.plan.norm]
    text = f"Errors are relative ({norm}) to the reference: {judgement.reference_label}"
    if not judgement.reference_runs and judgement.uncertainty == 0.0:
        return f"{text}."
    return (
        f"{text}, extrapolated; its own uncertainty is {judgement.uncertainty:.1e}. "
        "Runs closer to it than that are not judged."
    )


def _remark(point, is_best, footnotes):
    mark = footnotes.mark(point.record.broken)
    remarks = [mark] if mark else []
    if is_best:
        remarks.append("Pareto")
    if not point.is_judged:
        remarks.append("not judged: within the uncertainty")
    return ", ".join(remarks)


def _order(line):
    if line.order is not None:
        return str(line.order)
    return "none, all differences are rounding" if max(line.errors) < 1e-9 else "none"


def _shown(point):
    return max(point.bound, LEAST_DRAWN)


def _style(i):
    """Of curve i; those that lie upon each other can be told apart."""
    colour = drawing.pyplot.get_cmap("tab10")(i % 10)
    return {"color": colour, "marker": "osD^vP"[i % 6], "ls": ("-", "--", "-.", ":")[i % 4], "ms": 6 - i % 4}


def _draw_costs(judgement, ax, styles):
    best = advice.front(judgement.points.values())
    ax.plot(
        [p.record.cpu for p in best], [_shown(p) for p in best],
        color="0.8", lw=7, marker="o", ms=11, zorder=1, label="Pareto front",
    )
    for combination, style in styles.items():
        points = [
            point
            for index, point in judgement.points.items()
            if point.succeeded and judgement.combination(index) == combination
        ]
        if not points:
            continue
        line = points if len(judgement.refined) < 2 else advice.front(points)
        ax.plot(
            [p.record.cpu for p in line], [_shown(p) for p in line], color=style["color"], ls=style["ls"]
        )
        costs = [p.record.cpu for p in points]
        spread = [
            [cost - min(p.record.times) for cost, p in zip(costs, points)],
            [max(p.record.times) - cost for cost, p in zip(costs, points)],
        ]
        label = judgement.label_of(combination) or None
        shown = [_shown(point) for point in points]
        style = {**style, "ls": ""}
        ax.errorbar(costs, shown, xerr=spread, elinewidth=0.8, label=label, **style)
    _draw_band(ax, judgement.uncertainty)
    drawing.scale_log(ax, "x", "y")
    ax.set(xlabel="CPU time [s]", ylabel="relative error")
    ax.set_title("What accuracy costs")
    low, high = ax.get_xlim()
    numbers = [m * 10.0**k for k in range(-3, 6) for m in (1.0, 2.0, 5.0)]
    if high < 8.0 * low:
        numbers += [m * 10.0**k for k in range(-3, 6) for m in (1.2, 1.5, 3.0, 4.0, 7.0)]
    shown = sorted(number for number in numbers if low <= number <= high)
    if len(shown) < 2:  # costs that hardly differ
        even = drawing.matplotlib.ticker.MaxNLocator(4).tick_values(low, high)
        shown = [number for number in even if low <= number <= high]
    ax.set_xticks(shown, [f"{number:g}" for number in shown])
    ax.set_xticks([], minor=True)
    ax.legend(fontsize=7)


def _draw_lines(judgement, ax, a, styles):
    """A curve per combination; hollow where a run is too close to the limit of its line to judge it."""
    axis = judgement.axes[a]
    lines = [line for line in judgement.lines if line.axis == a]
    guides = {}
    for line in lines:
        style = styles[line.combination]
        name = judgement.label_of(line.combination)
        label = f"{name}: order {_order(line)}" if name else f"order {_order(line)}"
        errors = [max(error, LEAST_DRAWN) for error in line.errors]
        ax.plot(line.numbers, errors, label=label, **style)
        vague = [i for i, error in enumerate(errors) if error <= line.uncertainty or i == len(errors) - 1]
        ax.plot(
            [line.numbers[i] for i in vague], [errors[i] for i in vague], ls="", marker=style["marker"],
            ms=style["ms"], color="white", mec=style["color"], zorder=4,
        )
        if line.order and (line.order.half_width or 1.0) < 0.3:
            guides.setdefault(round(line.order.value), (line, errors))
    for order, (line, errors) in guides.items():
        sizes = [axis.size(0) * (n / line.numbers[0]) ** (1 if axis.shrinks else -1) for n in line.numbers]
        scale = 0.4 * errors[-2] / sizes[-2] ** order
        ax.plot(line.numbers[-3:], [scale * h**order for h in sizes[-3:]], color="0.5", lw=0.8, ls="--")
        end = (line.numbers[-1], scale * sizes[-1] ** order)
        ax.annotate(
            f"order {order}", end, (-2, -10), textcoords="offset points", ha="right", color="0.4", fontsize=7
        )
    drawing.scale_log(ax, "x", "y")
    ax.set(xlabel=axis.leaf, ylabel="relative error to its own limit", title=f"Convergence in {axis.leaf}")
    numbers = sorted({number for line in lines for number in line.numbers})
    ax.set_xticks(numbers, [f"{number:g}" for number in numbers])
    ax.set_xticks([], minor=True)
    ax.legend(fontsize=7, loc="lower left")
    if axis.shrinks:
        ax.invert_xaxis()  # finer to the right, as in all of them


def _draw_band(ax, uncertainty):
    if uncertainty > LEAST_DRAWN:
        label = "uncertainty of the reference"
        ax.axhspan(uncertainty / 3.0, uncertainty, color=BAND, zorder=0, label=label)


def _capital(text):
    return text[:1].upper() + text[1:]


def write_all(judgement, deck, command, folder, promise=None):
    """study.csv, reference.csv, study.png, study.html in the folder of the study."""
    folder = pathlib.Path(folder)
    write_csv(judgement, folder / "study.csv")
    if judgement.plan.reference is None and judgement.measure.parts:
        write_reference(judgement, folder / "reference.csv")
    figure = draw(judgement)
    picture = write_page(judgement, deck, command, folder / "study.html", figure, promise)
    (folder / "study.png").write_bytes(picture)
    drawing.close(figure)
