#!/usr/bin/python3
"""HY-1, HY-9: beams on hinges, energy over long times. Page: doc/verification/hinges.md."""

from verify import figure, main, save

BEAM, BARS = "beam/hinged_beam.xml", "joint/driven_bars.xml"


def energies(history):
    return {part: history.column(f"energy {part} [J]")
            for part in ("kinetic", "strain", "potential", "total")}


def verify_beam(culm, report):
    report.title("Hinged beam, 2.4 s (HY-1)")
    for settings in ([], ["Structures/beam/Element=Helical"], ["Structures/beam/Order=2"],
                     ["Analyses/motion/Step=0.02"]):
        run = culm.run(BEAM, settings, quiet=False)
        report.check(f"{settings}: exit code", run.exit, 0, 0)
        parts = energies(run.history)
        report.holds("largest total energy over the largest kinetic",
                     max(abs(e) for e in parts["total"]) / max(parts["kinetic"]), 1e-9)


def verify_bars(culm, report):
    report.title("Three driven bars, 20 s (HY-9)")
    run = culm.run(BARS, quiet=False)
    report.check("exit code", run.exit, 0, 0)
    report.check("steps cut back", run.cut_back(), 0, 0)
    report.holds("energy less work of the drive, relative", run.drift("energy balance"), 1e-9)
    report.holds("constraints, relative", run.drift("constraints"), 1e-10)
    total = energies(run.history)["total"]
    top = max(total)
    at = run.history.levels[total.index(top)]
    report.note(f"largest energy {top:.4g} J at {at:.2f} s")
    still = total[run.history.row(5.0) :]
    report.holds("drift of the energy from 5 to 20 s over the largest",
                 max(abs(e - still[0]) for e in still) / top, 1e-9)
    start = run.history.row(5.0)
    spread = max(energies(run.history)["kinetic"][start:]) / top
    report.note(f"meanwhile up to {spread:.2f} of the largest energy is kinetic")


def verify(culm, report):
    verify_beam(culm, report)
    verify_bars(culm, report)


def plot(culm, path):
    fig, axes = figure(2)
    for ax, deck, title in zip(axes, (BEAM, BARS), ("hinged beam", "three driven bars")):
        history = culm.history(deck)
        for part, values in energies(history).items():
            ax.plot(history.levels, values, "k" if part == "total" else "", label=part)
        ax.set(title=title, xlabel="t [s]", ylabel="energy [J]")
        ax.legend()
    save(fig, path)


main(verify, plot)
