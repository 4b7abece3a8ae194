"""Draws the page of a run: picture of the model, histories, certificate, costs, messages, deck."""

import itertools
import math
import pathlib

from . import effects_table, statistics, stresses
from .errors import CulmError
from .history import History, owners_of, unit_of
from .mode_names import name_modes
from .option_types import finite
from .page import Page
from .quantities import begins_unsolved
from .resolved_deck import ResolvedDeck
from .results import Results, file_part
from .run_file import RunFile
from .whole_file import PAGE, refuse_to_replace


MOST_ROWS = 40  # of a table
MOST_PLOTS = 100  # of the history of an analysis
PLOTS_OF_A_FIGURE = 20  # pictures of many are higher than may be drawn


def declare(parser):
    parser.add_argument("folder", type=pathlib.Path, help="folder with the results of a run")
    parser.add_argument(
        "--output", type=pathlib.Path, help="page to write; report.html in the folder if not given"
    )
    parser.add_argument(
        "--window", type=finite, nargs=2, metavar=("BEGIN", "END"), help="times of statistics [s]; all of each motion if not given"
    )
    parser.add_argument("--quiet", action="store_true", help="do not name the page")


def main(arguments, program):
    del program  # what is drawn stands in the files
    if arguments.window and not arguments.window[0] < arguments.window[1]:
        raise CulmError("--window {:g} {:g}: must end after its beginning".format(*arguments.window))
    path = arguments.folder / "run.h5"
    if not path.exists():
        raise CulmError(f"there is no run.h5 in '{arguments.folder}'", 6)
    output = arguments.output or arguments.folder / "report.html"
    refuse_to_replace(output, PAGE, "page")
    try:
        write_page(Results(path), arguments.folder, output, arguments.window)
    except (KeyError, RuntimeError) as error:  # h5py raises what it likes where a file is damaged
        raise RunFile(path).damaged(error) from error
    except OSError as error:
        raise CulmError(f"{error.filename}: {error.strerror}" if error.filename else str(error), 6) from error
    if not arguments.quiet:
        print(output)
    return 0


def write_page(results, folder, output, window=None):
    from . import drawing

    page = Page(results.title() or folder.name, f"culm {results.version()}")
    outcome = results.report()
    done = outcome.startswith("done")
    page.paragraph(
        "The run came to its end." if done else outcome.split("\n\n")[0] or "No end is recorded.",
        "advice" if done else "warning",
    )
    for finding in results.findings():
        page.paragraph(str(finding), "broken" if finding.is_broken else "warning")
    meshes, last = results.meshes(), results.last_state()
    _add_model(page, meshes, last, drawing)
    _add_stresses(page, results, meshes, last, drawing)
    path = folder / "history.csv"
    history = History(path) if path.exists() else None
    if history is not None and history.names and len(history.levels) > 1:
        parts = _parts(results, history)
        _add_histories(page, results, history, parts, drawing)
        _add_statistics(page, history, parts, window, ResolvedDeck(results.deck()))
    _add_steps(page, results, drawing)
    _add_tables(page, results, drawing)
    _add_effects(page, results, drawing)
    page.heading("Report")
    page.code(outcome or "The run did not come to the end of its report.")
    page.heading("Deck as it was used")
    page.code(results.deck())
    page.write(output)


def _add_figure(page, drawing, figure, description):
    page.figure(figure, description)
    drawing.close(figure)


def _add_model(page, meshes, last, drawing):
    time, state = last
    page.heading("Model")
    figure = drawing.model(meshes, state)
    _add_figure(page, drawing, figure, "reference in grey, last recorded state in blue")
    page.paragraph(f"Grey: reference. Blue: last recorded state, at {time:.6g}, without magnification.")


def _add_stresses(page, results, meshes, last, drawing):
    """Pictures of what the elements carry in the last recorded state."""
    time, state = last
    places = [place for positions in state.values() for place in (positions.min(axis=0), positions.max(axis=0))]
    size = math.dist([min(axis) for axis in zip(*places)], [max(axis) for axis in zip(*places)]) if places else 1.0
    pictures = stresses.of_state(results.cell_fields(), size or 1.0)
    if not pictures:
        return
    page.heading("Stresses")
    figure = drawing.coloured(meshes, state, pictures)
    _add_figure(page, drawing, figure, "; ".join(picture.title for picture in pictures))
    page.paragraph(
        f"In the last recorded state, at {time:.6g}, without magnification; a number for each element, by its forces per section"
        " or, where the deck asks for them, the stresses of its layers."
    )


def _add_histories(page, results, history, parts, drawing):
    page.heading("Histories")
    owners = owners_of(history.names, results.quantities())

    def title_and_unit(column):
        return owners[column][0], unit_of(column)

    plots = [(key, list(columns)) for key, columns in itertools.groupby(history.names, key=title_and_unit)]
    for name, kind, rows in parts:
        if len(parts) > 1:
            page.paragraph(f"{name}, {kind}:")
        groups = []
        for (title, unit), columns in plots[:MOST_PLOTS]:
            curves = {
                owners[column][1] or title: history.columns[column][rows] for column in columns
            }
            groups.append((title, unit, history.levels[rows], curves))
        label = "time [s]" if kind == "Dynamic" else "level" if kind else "time [s] or level"
        for first in range(0, len(groups), PLOTS_OF_A_FIGURE):
            figure = drawing.histories(groups[first : first + PLOTS_OF_A_FIGURE], label, is_path=kind == "Path")
            _add_figure(page, drawing, figure, f"histories of the quantities of the deck, {name}")
    if len(plots) > MOST_PLOTS:
        page.paragraph(f"{len(plots) - MOST_PLOTS} more plots are not drawn; their numbers are in history.csv.")


def _add_statistics(page, history, parts, window, deck):
    """Of all columns of all motions, over a window of time."""
    begin, end = window or (-math.inf, math.inf)
    rounding = 1e-9 * (end - begin) if window else 0.0  # of times, which are sums of steps
    owners = owners_of(history.names, deck.names_in("Output/History"))
    tables = []
    skipped = set()
    for name, kind, rows in parts:
        kept = [row for row in range(*rows.indices(len(history.levels))) if begin - rounding <= history.levels[row] <= end + rounding]
        if kind != "Dynamic" or len(kept) < 2:
            continue
        times = [history.levels[row] for row in kept]
        table = []
        for column in history.names:
            values = [history.columns[column][row] for row in kept]
            # accelerations and reactions begin with the first step
            is_unsolved = not math.isfinite(values[0]) or begins_unsolved(*owners[column], deck)
            first = 1 if history.steps[kept[0]] == 0 and is_unsolved else 0
            if len(values) - first < 2 or not all(math.isfinite(value) for value in values[first:]):
                skipped.add(column)  # what does not exist all the time
                continue
            found = statistics.of_column(times[first:], values[first:])
            numbers = [found.mean, found.least, found.largest, found.deviation, *found.equivalents.values()]
            table.append([column, *(f"{number:.6g}" for number in numbers)])
        if table:
            tables.append((f"{name}, from {times[0]:.6g} to {times[-1]:.6g} s:", table))
    if window and not tables:
        raise CulmError(f"--window {begin:g} {end:g}: holds less than two steps of a motion; {_motions(history, parts)}")
    if not tables:
        return
    page.heading("Statistics")
    columns = ["quantity", "mean", "least", "largest", "standard deviation"]
    columns += [f"equivalent range, exponent {m}" for m in statistics.EXPONENTS]
    for text, table in tables:
        page.paragraph(text)
        page.table(columns, table[:MOST_ROWS])
        if len(table) > MOST_ROWS:
            page.paragraph(f"{len(table) - MOST_ROWS} more columns are in history.csv.")
    if skipped:
        page.paragraph("Not there all the time, so without a line: " + ", ".join(name for name in history.names if name in skipped) + ".")
    page.paragraph(
        "Equivalent range: repeated once a second it does the damage of all ranges, counted as rainflow (ASTM E1049), that the "
        "rule of Palmgren and Miner adds up for a material whose life falls by this power of the range."
    )


def _motions(history, parts):
    """Where motions begin and end, in words."""
    spans = []
    for name, kind, rows in parts:
        levels = history.levels[rows]
        if kind == "Dynamic":
            spans.append(f"'{name}' goes from {levels[0]:g} to {levels[-1]:g} s")
    return ", ".join(spans) or "the run has none"


def _parts(results, history):
    """Name and type of each analysis that made steps, and its rows of the history."""
    analyses = results.analyses()
    parts = []
    first = 0
    for number, rows in itertools.groupby(history.analyses):
        last = first + len(list(rows))
        if last > first + 1:  # a start alone is a point
            parts.append((*analyses[number], slice(first, last)))
        first = last
    return parts


def _add_steps(page, results, drawing):
    steps = results.steps()
    if len(steps) < 2:
        return
    page.heading("Convergence")
    levels = [step.time for step in steps]
    figure, axes = drawing.plot(2, height=2.6)
    axes[0][0].plot(levels, [step.iterations for step in steps], ".", ms=3)
    axes[0][0].set(title="Iterations per step", xlabel="time [s] or level")
    for held, label in ((False, None), (True, "held by rounding")):
        chosen = [step for step in steps if step.held == held]
        if chosen:
            residuals = [max(step.residual, 1e-17) for step in chosen]
            axes[0][1].plot([s.time for s in chosen], residuals, ".", ms=3, label=label)
    drawing.scale_log(axes[0][1], "y")
    if any(step.held for step in steps):
        axes[0][1].legend()
    axes[0][1].set(title="Relative residual of accepted steps", xlabel="time [s] or level")
    _add_figure(page, drawing, figure, "iterations and residuals of the steps")


def _add_modes(page, results, drawing, table):
    """Of the modes what people look for first, and pictures of the lowest ones."""
    columns, rows, remarks = table.columns, table.rows, table.remarks
    meshes, shapes = results.meshes(), results.shapes(table.analysis)
    moves = name_modes(meshes, shapes, remarks)
    chosen = [columns.index(one) for one in ("mode", "frequency [Hz]", "damping ratio")]
    shown = [[f"{row[i]:.6g}" for i in chosen] for row in rows[:MOST_ROWS]]
    page.table(
        [*(columns[i] for i in chosen), "moves most", "kinetic energy"],
        [[*row, how, remark] for row, how, remark in zip(shown, moves, remarks)],
    )
    page.paragraph(
        "The structure with most of the kinetic energy, and along which axes it moves against its first node: d1 and d2 of "
        f"its sections, or those of space. Masses and participations: analyses/{file_part(table.analysis)}/modes.csv."
    )
    if shapes:
        titles = [f"{row[0]}: {row[1]} Hz\n{how}" for row, how in zip(shown, moves)][:6]
        _add_figure(page, drawing, drawing.shapes(meshes, shapes, titles), f"shapes of the modes of {table.analysis}")


def _add_diagram(page, drawing, columns, rows):
    """Frequencies and damping of modes over the load level."""
    figure, axes = drawing.plot(columns=2)
    levels = [row[0] for row in rows]
    for axis, title, unit in ((axes[0][0], "frequency", 1.0), (axes[0][1], "damping ratio", 0.01)):
        for i, column in enumerate(columns):
            if column.startswith(title):
                axis.plot(levels, [math.nan if row[i] is None else row[i] / unit for row in rows], ".-",
                          label=f"mode {column.removeprefix(title).split()[0]}")
        axis.set(xlabel="level", ylabel=f"{title} [{'Hz' if unit == 1.0 else '%'}]")
    axes[0][1].axhline(0.0, color="0.5", linewidth=0.8)
    axes[0][0].legend(fontsize="small")
    _add_figure(page, drawing, figure, "frequencies and damping over the level; below zero motions grow")


def _add_tables(page, results, drawing):
    for table in results.tables():
        columns, rows, remarks = table.columns, table.rows, table.remarks
        page.heading(table.title)
        if columns[0] == "level" and "frequency 1 [Hz]" in columns:
            _add_diagram(page, drawing, columns, rows)
        if {"mode", "frequency [Hz]", "damping ratio"} <= set(columns) and remarks and rows:
            _add_modes(page, results, drawing, table)
            continue
        shown = [["" if value is None else f"{value:.6g}" for value in row] for row in rows[:MOST_ROWS]]
        if remarks:
            columns = [*columns, "remark"]
            shown = [[*row, remark] for row, remark in zip(shown, remarks)]
        page.table(columns, shown)
        if len(rows) > len(shown):
            page.paragraph(f"{len(rows) - len(shown)} more rows are in run.h5.")


def _add_effects(page, results, drawing):
    effects = effects_table.merged(results.effects())
    total = sum(effect.seconds for effect in effects)
    if total <= 0.0:
        return
    page.heading("Effects and what they cost")
    figure, axes = drawing.plot(width=6.4, height=0.6 + 0.25 * len(effects))
    shares = [100.0 * effect.seconds / total for effect in effects]
    axes[0][0].barh(range(len(effects)), shares)
    axes[0][0].set_yticks(range(len(effects)), [effect.name for effect in effects])
    axes[0][0].invert_yaxis()
    axes[0][0].set(xlabel="share of the time [%]")
    _add_figure(page, drawing, figure, "share of each effect in the time of the run")
    page.table(effects_table.COLUMNS, effects_table.rows(results.effects()))
