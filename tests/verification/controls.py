#!/usr/bin/python3
"""Signals, controllers and actuators. Page: doc/verification/controls.md."""

import functools
import math

import numpy as np
from scipy.integrate import simpson, solve_ivp
from verify import figure, gain, main, save

ROTOR, PITCH = "control/speed_control.xml", "control/pitch_actuator.xml"
VARIABLE = "control/variable_speed.xml"
TURBINE = "turbine/nrel5mw/turbine_control.xml"
J, T, P, I, SET_POINT = 2.0, 0.2, 3.0, 4.0, 1.5
RATED = 12.1 * 2.0 * math.pi / 60.0


def poles(gain=1.0):
    return np.roots([J * T, J, gain * P, gain * I])


def rotor_at(times):
    """Speed and moment of the motor, exactly: a linear system with the torque sin(t)^2."""
    # angular velocity, moment, integral; then 1, cos(2t), sin(2t), whose sum is the torque
    A = np.zeros((6, 6))
    A[0, 1], A[0, 3], A[0, 4] = 1 / J, 0.5 / J, -0.5 / J
    A[1, 0], A[1, 1], A[1, 2], A[1, 3] = -P / T, -1 / T, 1 / T, P * SET_POINT / T
    A[2, 0], A[2, 3] = -I, I * SET_POINT
    A[4, 5], A[5, 4] = -2.0, 2.0
    values, vectors = np.linalg.eig(A)
    start = np.linalg.solve(vectors, np.array([0, 0, 0, 1, 1, 0], dtype=complex))
    states = [(vectors @ (np.exp(values * t) * start)).real for t in times]
    return np.array([s[0] for s in states]), np.array([s[1] for s in states])


def rotor_error(culm, step):
    history = culm.history(ROTOR, [f"Analyses/motion/Step={step}", "Output/Every=1"])
    times = np.array(history.levels)
    moment = np.array(history.column("motor [1]"))
    return np.abs(moment - rotor_at(times)[1]).max()


def verify_rotor(culm, report):
    report.title("Rotor with a PI controller and a lag")
    table = culm.table("modes/modes", ROTOR)
    found = [complex(table.at(row, "eigenvalue real [1/s]"), table.at(row, "eigenvalue imaginary [1/s]"))
             for row in (2, 3)]
    wanted = sorted((p for p in poles() if p.imag >= 0.0), key=abs)
    for one, other in zip(found, wanted):
        report.relative(f"pole {other:.4f}, real part", one.real, other.real, 1e-9)
        report.check("imaginary part", one.imag, other.imag, 1e-9)
    errors = [rotor_error(culm, step) for step in (0.02, 0.01, 0.005)]
    report.note(f"largest error of the motor's moment at 0.02, 0.01, 0.005 s: {errors}")
    for coarse, fine in zip(errors, errors[1:]):
        report.check("order of the step", math.log2(coarse / fine), 2.0, 0.02)
    run = culm.run(ROTOR, quiet=False)
    report.holds("energy balance", run.drift("energy balance"), 1e-11)


def verify_schedule(culm, report):
    report.title("Gains that follow a signal: P and I over 1 + v / 'Halved At'")
    for halved_at in (0.5, 1.0, 4.0):
        controller = "Signals/controller"
        table = culm.table("modes/modes", ROTOR, [f"{controller}/Schedule Signal=Constant", f"{controller}/Halved At={halved_at}"])
        parts = [table.column(f"eigenvalue {part} [1/s]") for part in ("real", "imaginary")]
        found = [complex(real, imaginary) for real, imaginary in zip(*parts)]
        for pole in poles(1.0 / (1.0 + 1.0 / halved_at)):
            if pole.imag < 0.0:
                continue
            apart = min(abs(one - pole) for one in found)
            report.holds(f"halved at {halved_at:g}: pole {pole:.4f}, relative,", apart / abs(pole), 1e-9)


def torque(speed):
    """Of the generator at variable speed."""
    return max(min(np.interp(speed, [1.0, 1.4, 2.0], [0.0, 2.0, 8.0]), 12.0 / speed), 0.5)


@functools.cache
def variable_motion(end):
    """Speed, filtered speed and limited integral of the rotor at variable speed, by an integrator of its own."""

    def rates(t, y):
        speed, filtered, excess = y
        drive = 3.0 + 5.0 * math.sin(1.3 * t)
        beyond = min(max(excess, 0.0), 0.2) - excess
        return [(drive - torque(filtered)) / 2.0, (speed - filtered) / 0.2, filtered - 1.6 + beyond / 0.05]

    return solve_ivp(rates, (0.0, end), [1.5, 1.5, 0.0], dense_output=True, rtol=1e-10, atol=1e-12, max_step=1e-3).sol


def variable_at(times):
    """Filtered speed, limited integral, powers of wind and generator."""
    speed, filtered, excess = variable_motion(round(float(times[-1]), 9))(times)
    powers = [[(3.0 + 5.0 * math.sin(1.3 * t)) * v, -torque(behind) * v] for t, v, behind in zip(times, speed, filtered)]
    return filtered, excess, np.transpose(powers)


def variable_error(history):
    times = np.array(history.levels)
    speed, excess, _ = variable_at(times)
    return [np.abs(np.array(history.column(name)) - wanted).max()
            for name, wanted in (("speed [1]", speed), ("turned too far [1]", excess))]


def verify_variable_speed(culm, report):
    report.title("Rotor at variable speed: table, power over speed, least, greatest, limited integral")
    run = culm.run(VARIABLE, ["Analyses/motion/Step=0.0025"], quiet=False)
    coarse, fine = map(variable_error, (culm.history(VARIABLE, ["Analyses/motion/Step=0.02"]), run.history))
    for name, a, b in zip(("filtered speed", "limited integral"), coarse, fine):
        report.holds(f"{name} at 0.0025 s", b, 1e-4)
        # corners lie within steps, here early and there late
        report.check(f"{name}: order of the step", math.log2(a / b) / 3.0, 2.0, 0.6)
    report.title("The same: works of wind and generator, each on its account")
    times = np.linspace(0.0, 10.0, 4001)
    books = run.books()
    for account, power in zip(("wind", "generator"), variable_at(times)[2]):
        report.relative(f"{account} [J]", books[f"work of loads, {account}"], float(simpson(power, x=times)), 1e-4)
    report.holds("books: gain less the works [J]", abs(gain(books)), 1e-9 * books["work of loads, wind"])
    for what, speed, drive, slope in (("table", 1.5, 3.0, 10.0), ("constant power", 2.4, 5.0, -12.0 / 2.4**2)):
        table = culm.table("modes/modes", VARIABLE, [
            f"W={speed}", f"M={drive}", "swing=0", "end=0.01", "Signals/turned too far/Initial=-0.1",
            "Analyses/modes/Type=Modal", "Analyses/modes/Modes=3"])
        found = [complex(a, b) for a, b in zip(*(table.column(f"eigenvalue {part} [1/s]") for part in ("real", "imaginary")))]
        for pole in np.roots([J * T, J, slope]):
            if pole.imag >= 0.0:
                report.holds(f"{what}: pole {pole:.4f}, relative,", min(abs(one - pole) for one in found) / 5.0, 1e-6)


def actuator_at(times, step=1e-4):
    """The actuator of the deck by Runge and Kutta's method, with steps that meet its switches."""
    omega, zeta, rate = 2.0 * math.pi * 1.5, 0.7, 0.6

    def acceleration(t, angle, velocity):
        command = 0.0 if t < 0.2 else 0.3 if t < 3.0 else 1.0
        wanted = max(-rate, min(rate, omega / (2 * zeta) * (command - angle)))
        return 2 * zeta * omega * (wanted - velocity)

    angle, velocity, values, now = 0.0, 0.0, [], 0
    for time in times:
        while now < round(time / step):
            t = (now + 1e-9) * step  # behind a switch
            v1, a1 = velocity, acceleration(t, angle, velocity)
            v2 = velocity + step / 2 * a1
            a2 = acceleration(t + step / 2, angle + step / 2 * v1, v2)
            v3 = velocity + step / 2 * a2
            a3 = acceleration(t + step / 2, angle + step / 2 * v2, v3)
            v4 = velocity + step * a3
            a4 = acceleration(t + (1 - 2e-9) * step, angle + step * v3, v4)
            angle += step / 6 * (v1 + 2 * v2 + 2 * v3 + v4)
            velocity += step / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            now += 1
        values.append(angle)
    return np.array(values)


def verify_actuator(culm, report):
    report.title("Blade on a pitch actuator")
    errors = []
    for step in (0.01, 0.005):
        run = culm.run(PITCH, [f"Analyses/motion/Step={step}", "Output/Every=10"], quiet=False)
        times = np.array(run.history.levels)
        pitch = np.array(run.history.column("pitch [1]"))
        angle = np.array(run.history.column("angle [rad]"))
        report.holds(f"joint angle against the actuator, step {step}", np.abs(angle - pitch).max(), 1e-12)
        report.holds("energy less work of the drive", run.drift("energy balance"), 1e-11)
        passed = np.diff(times)
        rates = np.abs(np.diff(pitch))[passed > 0.0] / passed[passed > 0.0]
        report.holds("rate beyond its limit of 0.6 rad/s", max(rates) - 0.6, 1e-9)
        errors.append(np.abs(pitch - actuator_at(times)).max())
    report.note(f"largest error of the angle at 0.01, 0.005 s: {errors}")
    report.holds("error of the angle at 0.005 s [rad]", errors[1], 1e-4)
    table = culm.table("modes/modes", PITCH)
    rows = range(1, 5)
    damped = [row for row in rows if table.at(row, "damping ratio") > 0.5]
    report.check("actuator among the modes", len(damped), 1, 0)
    size = abs(complex(table.at(damped[0], "eigenvalue real [1/s]"),
                       table.at(damped[0], "eigenvalue imaginary [1/s]")))
    report.relative("its undamped frequency [Hz]", size / (2 * math.pi), 1.5, 1e-9)
    report.check("its damping ratio", table.at(damped[0], "damping ratio"), 0.7, 1e-9)


def verify_delay(culm, report):
    report.title("Feedback within the step and one step late")
    run = culm.run("control/delay.xml", ["Output/Every=1"], quiet=False)
    times = np.array(run.history.levels)
    omega = math.sqrt(150.0)
    late = np.array(run.history.column("late uz [m]"))
    swings = [np.abs(late[(times >= begin) & (times < begin + 0.6)]).max() for begin in (0.0, 4.4)]
    report.relative("growth one step late [1/s]", math.log(swings[1] / swings[0]) / 4.4, 50 * 0.01 / 4, 0.01)
    errors = []
    for step in (0.01, 0.005):
        history = culm.history("control/delay.xml", ["Output/Every=1", f"h={step}"])
        times = np.array(history.levels)
        errors.append(np.abs(np.array(history.column("prompt uz [m]")) - np.sin(omega * times) / omega).max())
    report.check("order within the step", math.log2(errors[0] / errors[1]), 2.0, 0.02)
    report.holds("energy balance", run.drift("energy balance"), 1e-11)


def verify_turbine(culm, report):
    report.title("NREL 5 MW with speed and pitch control, 60 s")
    run = culm.run(TURBINE, quiet=False)
    history = run.history
    times = np.array(history.levels)
    speed = np.array(history.column("speed [1]"))
    held = speed[times > 25.0]
    report.note(f"speed from 25 s on: {held.min() / RATED:.4f} to {held.max() / RATED:.4f} of the rated one")
    report.holds("speed off the rated one", np.abs(held / RATED - 1.0).max(), 0.03)
    # amplitude of the answer of the loop, as a rigid rotor has it, to the torque that changes
    inertia, w = 4.38e7, 0.6
    s = 0.5j
    answer = abs(s / (inertia * s * s + (1.4 * w * inertia * s + w * w * inertia) / (0.1 * s + 1.0)))
    late = speed[times > 45.0]
    report.relative("amplitude of the speed under the changing torque",
                    (late.max() - late.min()) / 2.0, 0.2 * 4.18e6 * answer, 0.05)
    pitch = np.array(history.column("pitch 1 [1]"))
    angle = np.array(history.column("blade 1 [rad]"))
    report.holds("blade against its actuator [rad]", np.abs(angle + pitch).max(), 1e-11)
    report.holds("energy balance", run.drift("energy balance"), 1e-11)
    report.check("steps cut back", run.cut_back(), 0, 0)
    table = culm.table("modes/modes", TURBINE, ["end=0.02"])
    real = [table.at(row, "eigenvalue real [1/s]") for row in range(1, 21)]
    imaginary = [table.at(row, "eigenvalue imaginary [1/s]") for row in range(1, 21)]
    omega = 2 * math.pi * 1.6
    wanted = complex(-0.8 * omega, 0.6 * omega)
    count = sum(abs(complex(a, b) - wanted) < 1e-6 * omega for a, b in zip(real, imaginary))
    report.check("pitch actuators among the modes", count, 3, 0)
    report.check("lag of the generator among the modes", sum(abs(a + 10.0) < 1e-5 for a in real), 1, 0)


def verify(culm, report):
    verify_rotor(culm, report)
    verify_schedule(culm, report)
    verify_variable_speed(culm, report)
    verify_actuator(culm, report)
    verify_delay(culm, report)
    verify_turbine(culm, report)


def plot(culm, path):
    fig, axes = figure(3)
    history = culm.history(ROTOR, ["Output/Every=1"])
    axes[0].plot(history.levels, history.column("speed [1]"), label="speed [rad/s]")
    axes[0].plot(history.levels, history.column("motor [1]"), label="motor [N m]")
    times = np.linspace(0.0, 10.0, 41)
    for values in rotor_at(times):
        axes[0].plot(times, values, "k.", markersize=3)
    axes[0].set(title="rotor, PI controller and lag", xlabel="t [s]")
    history = culm.history(PITCH)
    axes[1].plot(history.levels, history.column("pitch [1]"), label="actuator [rad]")
    axes[1].plot(history.levels, history.column("tip uz [m]"), label="tip uz [m]")
    axes[1].set(title="blade on a pitch actuator", xlabel="t [s]")
    history = culm.history(TURBINE)
    axes[2].plot(history.levels, np.array(history.column("speed [1]")) / RATED, label="speed / rated")
    axes[2].plot(history.levels, np.array(history.column("generator torque [1]")) / 4.18e6,
                 label="generator torque / rated")
    axes[2].plot(history.levels, np.array(history.column("pitch 1 [1]")) * 10, label="pitch [0.1 rad]")
    axes[2].set(title="NREL 5 MW", xlabel="t [s]")
    for ax in axes:
        ax.legend()
    save(fig, path)


main(verify, plot)
