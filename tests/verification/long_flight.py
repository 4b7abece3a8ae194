#!/usr/bin/python3
"""Free flight over 1e5 steps, with and without dissipation; hard cases.

Page: doc/verification/long_flight.md.
"""

from verify import figure, main, save  # puts culm_runs on the path

import culm_runs

culm_runs.TIME_LIMIT = 900  # s; these runs are long on purpose
FLIGHTS = ("beam", "chain", "rotor")
DAMPED = "flight/rotor_damped.xml"
BLADES = ("one", "two", "three")
# what rounding leaves of a step acts in the next one, so it does not add up
MOMENTUM = 1e-11


def long_run(step, steps):
    return [f"Analyses/motion/Step={step}", f"Analyses/motion/End Time={step * steps}",
            f"Output/Every={steps // 10}"]


def check_balances(report, run, what):
    report.check(f"{what}: exit code", run.exit, 0, 0)
    report.holds("energy balance, relative", run.drift("energy balance"), 1e-9)
    report.holds("linear momentum, relative", run.drift("linear momentum"), MOMENTUM)
    report.holds("angular momentum, relative", run.drift("angular momentum"), MOMENTUM)
    report.holds("constraints, relative", run.drift("constraints"), 1e-10)


def verify_flights(culm, report, steps):
    report.title(f"Free flight over {steps} steps of 2 ms")
    for flight in FLIGHTS:
        run = culm.run(f"flight/{flight}.xml", long_run(2e-3, steps), quiet=False)
        check_balances(report, run, flight)


def total_energies(history):
    # the first row is written before the analysis sets the initial velocities
    return history.column("energy total [J]")[1:]


def largest_rise(energies):
    return max(after - before for before, after in zip(energies, energies[1:]))


def verify_dissipation(culm, report, steps):
    report.title(f"Rotor with dissipation of stresses and velocities over {steps} steps of 10 ms")
    run = culm.run(DAMPED, long_run(1e-2, steps), quiet=False)
    check_balances(report, run, "rotor_damped")
    energies = total_energies(run.history)
    report.holds("largest rise of the energy in a step, relative",
                 largest_rise(energies) / energies[0], 1e-13)


def spin_loss(culm, chi, spin=6):
    spins = [f"Initial Conditions/{name}/Angular Velocity={{0, 0, {spin}}}"
             for name in ("hub", *BLADES)]
    chis = [f"Structures/{name}/Velocity Dissipation={chi}" for name in BLADES]
    still = ["Initial Conditions/kick/Velocity={0, 0, 0}"]
    history = culm.history(DAMPED, spins + chis + still)
    energies = total_energies(history)
    return (energies[0] - energies[-1]) / energies[0]


def verify_spin(culm, report):
    report.title("Steady spin, 200 steps")
    for chi in (0.2, 0.5, 1.0):
        # the blades start unstretched; the vibration that follows is what is lost
        report.holds(f"energy lost with {chi}", spin_loss(culm, chi), 2e-3)


def verify_hard_cases(culm, report):
    report.title("Hard cases finish without a cut")
    for deck in ("mass_ratio", "stiffness_ratio", "two_hinges", "large_step", "quick_spin"):
        run = culm.run(f"hard/{deck}.xml", quiet=False)
        report.check(f"{deck}: exit code", run.exit, 0, 0)
        report.holds("energy balance, relative", run.drift("energy balance"), 1e-9)
        report.holds("constraints, relative", run.drift("constraints"), 1e-10)
        report.check("steps cut back", 0 if " 0 cut back" in run.output else 1, 0, 0)


def verify(culm, report):
    verify_flights(culm, report, 10000)
    verify_dissipation(culm, report, 5000)
    verify_spin(culm, report)
    verify_hard_cases(culm, report)


def fine(culm, report):
    verify_flights(culm, report, 100000)
    verify_dissipation(culm, report, 100000)


def plot(culm, path):
    fig, (energy, tip) = figure(2)
    for chi in (0.0, 0.1, 0.5):
        chis = [f"Structures/{name}/{kind}={chi}" for name in BLADES
                for kind in ("Dissipation", "Velocity Dissipation")]
        history = culm.history(DAMPED, chis + ["Analyses/motion/End Time=4"])
        total = total_energies(history)
        times = history.levels[1:]
        energy.plot(times, [e - total[0] for e in total], label=f"dissipation {chi}")
        tip.plot(times, history.column("energy strain [J]")[1:], label=f"dissipation {chi}")
    energy.set(title="rotor", xlabel="time [s]", ylabel="change of the total energy [J]")
    tip.set(title="rotor", xlabel="time [s]", ylabel="strain energy [J]")
    energy.legend()
    save(fig, path)


main(verify, plot, fine)
