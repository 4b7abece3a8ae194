"""What begins, jumps or ends within steps of time: loads that adaptive steps must not walk over, pulses that fixed
steps do not see, and prescribed motions with corners."""

import math

from deck_text import ends_with, entry, listed, rows
from driver import Case

RUN = "run deck.xml --output out --quiet"
BODY = entry("body", Type="Rigid Body", Position="{0, 0, 0}", Mass="1", Inertia="{1, 1, 1}")
SPRING = entry("spring", Type="Directed Ground Spring", Node="body", Direction="{1, 0, 0}", Stiffness="1")
FORCE = entry("push", Type="Force", Node="body", Force="{1, 0, 0}", Function="f")


def motion(function, step, end, *loads, adaptive="", constraints="", watched="Velocity", others=""):
    analysis = (f'<ParameterList name="motion"><Parameter name="Type" value="Dynamic"/><Parameter name="End Time" value="{end}"/>'
                f'<Parameter name="Step" value="{step}"/>{adaptive}</ParameterList>')
    history = (entry("place", Type="Displacement", Node="body") + entry("speed", Type=watched, Node="body") +
               entry("held", Type="Reaction", Node="body"))
    return (f'<ParameterList name="culm">{listed("Structures", BODY, others)}{listed("Functions", function)}'
            f'{listed("Loads", *loads)}{listed("Constraints", constraints)}{listed("Analyses", analysis)}'
            f'{listed("Output", listed("History", history))}</ParameterList>')


def switched_on(name, **function):
    """At 9 s, for the last second on a spring, while steps have grown for as long as all rested."""
    return Case(f"adaptive steps see a load that begins: {name}", 0, args=RUN, leaves=["out"], ranks=True,
                deck=motion(entry("f", **function), 0.1, 10, SPRING, FORCE, adaptive=entry("Adaptive", Tolerance="1e-6")),
                check=ends_with("place ux [m]", 1 - math.cos(1), 2e-3))


def pulse(name, speed, impulse, **function):
    """Of a free body, whose speed in the end is the impulse that steps of 0.1 s take."""
    return Case(f"a pulse of which steps lose or make a part is told: {name}", 0, args=RUN, leaves=["out"],
                deck=motion(entry("f", **function), 0.1, 1, FORCE),
                says=["warning: function 'f' has a pulse that ends within the time step", f"its impulse so far is {impulse} s"],
                check=ends_with("speed vx [m/s]", speed, 1e-9))


def blown(step, momentum, says):
    """A free bar of 1 kg in a field that goes to and fro in 0.0102 s."""
    bar = entry("tube", Type="Stiffness Values", EA="1e5", GA1="1e5", GA2="1e5", EI1="10", EI2="10", GIp="10", rhoA="1", rhoI1="1e-3", rhoI2="1e-3")
    line = entry("Curve", Type="Line", From="{0, 0, 0}", To="{1, 0, 0}", Elements="2", Up="{0, 0, 1}")
    structure = entry("bar", Type="Beam", Section="tube", Fidelity="Rigid").replace("</ParameterList>", f"{line}</ParameterList>")
    deck = (listed("Sections", bar) + listed("Structures", structure) +
            listed("Fields", entry("gusts", Type="Formula", Z="sin(2*pi*t/0.0102)")) +
            listed("Loads", entry("wind", Type="Field Force", Structure="bar", Field="gusts", Function="Constant")) +
            listed("Analyses", entry("motion", Type="Dynamic", Step=step, End_Time="0.255")) +
            listed("Output", listed("History", entry("swing", Type="Momentum"))))

    def check(folder, _):
        largest = max(abs(row["swing lz [N s]"]) for row in rows(folder))
        return "" if abs(largest - momentum) < 0.02 * momentum else f"momentum is {largest}, not {momentum}"

    return Case(f"a field that goes to and fro, by steps of {step} s", 0, args=RUN, leaves=["out"], says=says,
                errors=None if says else [], deck=f'<ParameterList name="culm">{deck}</ParameterList>', check=check)


def pushed_block(settings, place, says):
    """A block of 50 N on a spring of 1 kN/m, pushed by 40 N and left: friction of 15 N holds it where it can."""
    block = entry("block", Type="Rigid Body", Position="{0, 0, 0.0495}", Mass="5", Inertia="{1, 1, 1}")
    turns = [entry(f"turn {axis}", Type="Rotation", Node="block", Axis=axis) for axis in ("{1, 0, 0}", "{0, 1, 0}", "{0, 0, 1}")]
    loads = [entry("weight", Type="Gravity", Acceleration="{0, 0, -10}"),
             entry("floor", Type="Plane Contact", Node="block", Radius="0.05", Area="1", Stiffness="1e5", Friction="0.3"),
             entry("spring", Type="Directed Ground Spring", Node="block", Direction="{1, 0, 0}", Stiffness="1000"),
             entry("push", Type="Force", Node="block", Force="{1, 0, 0}", Function="f")]
    deck = (listed("Structures", block) + listed("Constraints", *turns) + listed("Loads", *loads) +
            listed("Functions", entry("f", Type="Table", Times="{0, 1, 2}", Values="{0, 40, 0}")) +
            listed("Analyses", entry("slide", Type="Static", Final_Level="2", **settings)) +
            listed("Output", listed("History", entry("place", Type="Displacement", Node="block"))))
    return Case(f"friction and a load that turns back, {settings}", 0, args=RUN, leaves=["out"], says=says, errors=None if says else [],
                deck=f'<ParameterList name="culm">{deck}</ParameterList>', check=ends_with("place ux [m]", place, 1e-5))


FITS = ["initial velocities were made to fit the constraints"]


def driven(name, step, end, way, speed, function="", says=FITS, **drive):
    """A body of 1 kg, moved by 0.1 m times a function."""
    constraint = entry("drive", Type="Rigid Support", Node="body", Translation="{0.1, 0, 0}", **drive)

    checks = [ends_with("place ux [m]", way, 1e-9)]
    if speed is not None:
        checks += [ends_with("speed vx [m/s]", speed, 1e-9), ends_with("held Fx [N]", 0, 1e-6)]

    def check(folder, output):
        return next((found for found in (one(folder, output) for one in checks) if found), "")

    return Case(f"a prescribed motion with corners: {name}", 0, args=RUN, leaves=["out"], says=says,
                deck=motion(function, step, end, constraints=constraint), check=check)


def damped(scheme, is_told, **settings):
    """Whether a run says that rates lag in its scheme."""
    note = f"where '{scheme}' does not balance forces: it is of first order in the step here"
    more = "".join(f'<Parameter name="{key.replace("_", " ")}" value="{value}"/>'
                   for key, value in {"Scheme": scheme, **settings}.items())
    damper = entry("damper", Type="Directed Ground Damper", Node="body", Direction="{1, 0, 0}", Damping="0.8")
    name = " ".join([scheme, *settings.values()])
    return Case(f"rates of the middle of steps: {name}", 0, leaves=["out"], errors=[], prints=[note] * is_told,
                never=[note] * (not is_told), deck=motion("", 0.1, 1, SPRING, damper, adaptive=more))


def speed_below(limit):
    """A check of all rows."""
    def check(folder, _):
        fastest = max(abs(row["speed vx [m/s]"]) for row in rows(folder))
        return "" if fastest <= limit else f"the body goes by {fastest} m/s"

    return check


def moment_is(value, tolerance):
    """A check of the second half of all rows."""
    def check(folder, _):
        moments = [-row["held Mz [N m]"] for row in rows(folder)]
        away = max(abs(abs(m) - value) for m in moments[len(moments) * 3 // 4:])
        return "" if away <= tolerance else f"moments are {away} N m away"

    return check


def eliminated_hinge():
    """Off the axis, struck: the hinge shows the impulse m c Omega of 2 kg at 0.5 m."""
    body = entry("body", Type="Rigid Body", Position="{0.5, 0, 0}", Mass="2", Inertia="{1, 1, 1}")
    pin = entry("pin", Type="Revolute Support", Node="body", Axis="{0, 0, 1}", Offset="{-0.5, 0, 0}")
    drive = entry("drive", Type="Angular Velocity", Node="body", Axis="{0, 0, 1}", Function="f", Angular_Velocity="2")

    def check(folder, _):
        found = max(abs(row["held Fy [N]"]) for row in rows(folder))
        return "" if abs(found - 200.0) <= 2.0 else f"the hinge shows {found} N, not 200 N"

    return Case("a support without equations shows the blow of a drive", 0, args=RUN, leaves=["out"],
                deck=motion(entry("f", Type="Heaviside", Start="0.5"), 0.01, 0.6, constraints=pin + drive).replace(BODY, body),
                check=check)


def spun(name, at_end, says=(), still=False, **function):
    """A body on a hinge whose speed is prescribed."""
    pin = entry("pin", Type="Revolute Support", Node="body", Axis="{0, 0, 1}")
    drive = entry("drive", Type="Angular Velocity", Node="body", Axis="{0, 0, 1}", Function="f", **{"Angular Velocity": "1"})
    return Case(f"a prescribed angular velocity that jumps: {name}", 0, args=RUN, leaves=["out"], says=says,
                deck=motion(entry("f", **function), 0.01, 1, constraints=pin + drive, watched="Angular Velocity"),
                check=moment_is(1.0, 0.01) if still else ends_with("speed wz [rad/s]", at_end, 1e-4))


def spinning(deck, *nodes):
    """The deck with initial velocities of these nodes, about the origin."""
    starts = (entry(f"start of {node}", Type="Velocity", Node=node, Angular_Velocity="{3, 5, 2}", About="{0, 0, 0}") for node in nodes)
    return deck[: -len("</ParameterList>")] + listed("Initial Conditions", *starts) + "</ParameterList>"


OFF_CENTRE = entry("body", Type="Rigid Body", Position="{0, 0, 0}", Centre="{0.1, 0.2, 0.05}", Mass="1", Inertia="{1, 2, 2.5}")


def flying_pair():
    """Two free bodies whose joint follows a table: no blow changes momenta or the balance of energy."""
    second = entry("second", Type="Rigid Body", Position="{1, 0, 0}", Centre="{0.1, 0.2, 0.05}", Mass="2", Inertia="{1, 1, 0.5}")
    between = {"First": "body", "Second": "second", "Axis": "{0, 0, 1}"}
    joint = entry("hinge", Type="Revolute Joint", Position="{0.4, 0, 0}", **between)
    drive = entry("drive", Type="Joint Angle", Angle="1", Function="f", **between)
    deck = motion(PIECES, 0.01, 2, constraints=joint + drive, others=second).replace(BODY, OFF_CENTRE)
    return Case("a joint of two free bodies whose angle has corners", 0, args="run deck.xml --output out", leaves=["out"], ranks=True,
                deck=spinning(deck, "body", "second"), says=FITS, prints=["  angular momentum "], never=["BROKEN", "constraints do not allow"])


def beside():
    """A free body that spins beside one on a saw: it feels nothing of its corners."""
    light = entry("light", Type="Rigid Body", Position="{3, 0, 0}", Mass="1e-6", Inertia="{1e-6, 1e-6, 1e-6}")
    saw = entry("f", Type="Table", Times="{" + ", ".join(f"{0.01 * i:g}" for i in range(101)) + "}",
                Values="{" + ", ".join(str(i % 2) for i in range(101)) + "}")
    drive = entry("drive", Type="Rigid Support", Node="light", Translation="{1e-3, 0, 0}", Function="f")
    deck = motion(saw, 0.01, 1, constraints=drive, others=light, watched="Energy").replace(BODY, OFF_CENTRE)
    return Case("a body beside a drive with corners keeps its energy", 0, args=RUN, leaves=["out"],
                deck=spinning(deck.replace(entry("speed", Type="Energy", Node="body"), entry("speed", Type="Energy")), "body"),
                says=FITS, check=same_energy)


def same_energy(folder, _):
    energies = [row["speed total [J]"] for row in rows(folder)]
    away = max(abs(energy - energies[2]) for energy in energies[2:]) / energies[2]
    return "" if away <= 1e-7 else f"the energy changes by {away}"


def turned(name, angle, tolerance, **function):
    """By an angular velocity of 2 rad/s times a function for a second, in steps of 0.1 s."""
    turn = entry("f", **function)
    drive = entry("drive", Type="Angular Velocity", Node="body", Axis="{0, 0, 1}", Angular_Velocity="2", Function="f")
    hinge = entry("hinge", Type="Revolute Support", Node="body", Axis="{0, 0, 1}")
    deck = motion(turn, 0.1, 1, constraints=hinge + drive)
    deck = deck.replace('<ParameterList name="History">', '<ParameterList name="History">' + entry("turn", Type="Rotation", Node="body"))
    return Case(f"an angular velocity turns by its integral: {name}", 0, args=RUN, leaves=["out"], deck=deck,
                says=["a prescribed angular velocity takes all of it"] if "pulse" in name else [],
                check=ends_with("turn rz [rad]", angle, tolerance))


def impact(speed, share):
    """Of a ball on a plane that takes energy, damping times speed 0.5 and 2."""
    plane = entry("ground", Type="Plane Contact", Node="body", Radius="0.1", Area="1", Stiffness="1e5", Damping="0.5")
    start = listed("Initial Conditions", entry("fall", Type="Velocity", Node="body", Velocity=f"{{0, 0, -{speed}}}"))
    deck = motion("", 0.0001, 0.04, plane).replace('"{0, 0, 0}"/><Parameter name="Mass"', '"{0, 0, 0.11}"/><Parameter name="Mass"')
    return Case(f"an impact with {speed} m/s leaves the speed of Hunt and Crossley", 0, args=RUN, leaves=["out"],
                deck=deck[: -len("</ParameterList>")] + start + "</ParameterList>",
                check=ends_with("speed vz [m/s]", share * speed, 1e-3 * speed))


PIECES = entry("f", Type="Table", Times="{0, 0.5, 0.8, 1.4, 3}", Values="{0, 1, 0.2, 0.2, 1}")

CASES = [
    turned("a formula", 2 / 3, 1e-12, Type="Expression", Expression="t^2"),
    turned("a pulse about the end of a step", 0.08, 1e-10, Type="Table", Times="{0, 0.56, 0.6, 0.64, 1}", Values="{0, 0, 1, 0, 0}"),
    turned("a jump", 0.9, 1e-12, Type="Heaviside", Start="0.55"),
    turned("a jump of a formula", 0.9, 1e-4, Type="Expression", Expression="t &lt; 0.55 ? 0 : 1"),
    impact(1, 0.7484),
    impact(4, 0.4107),
    Case("a pulse is told with what it is to a prescribed motion", 0, args=RUN, leaves=["out"],
         deck=motion(entry("f", Type="Table", Times="{0, 0.58, 0.6, 0.62, 1}", Values="{0, 0, 1, 0, 0}"), 0.1, 1,
                     constraints=entry("drive", Type="Rigid Support", Node="body", Translation="{0.1, 0, 0}", Function="f")),
         says=["warning: function 'f' has a pulse that ends within the time step", "its impulse so far is 0.02 s, of which loads take 0 s",
               "a prescribed position goes straight from its value at one end of a step to that at the other"]),
    switched_on("a jump", Type="Heaviside", Start="9"),
    switched_on("a table", Type="Table", Times="{0, 9, 9.001, 20}", Values="{0, 0, 1, 1}"),
    switched_on("a formula", Type="Expression", Expression="t > 9 ? 1 : 0"),
    pulse("about the end of a step", 0, 0.04, Type="Table", Times="{0, 0.56, 0.6, 0.64, 1}", Values="{0, 0, 1, 0, 0}"),
    pulse("of one step and a half", 0.1, 0.15, Type="Square", Duration="0.15"),
    Case("a pulse that only the middle of a step sees acts", 0, args=RUN, leaves=["out"], never=["never acts"],
         deck=motion(entry("f", Type="Table", Times="{0, 0.011, 0.015, 0.019}", Values="{0, 0, 1, 0}"), 0.01, 0.05, FORCE),
         says=["warning: function 'f' has a pulse that begins and ends within the time step from 0.01 s to 0.02 s"],
         check=ends_with("speed vx [m/s]", 0.01, 1e-12)),
    blown("0.0005", 0.0102 / math.pi, []),
    blown("0.01", 0.1623, ["warning: the field of Field Force 'wind' goes up and down within the time step from 0 s to 0.01 s"]),
    pushed_block({"Steps": "4"}, 0.015, []),
    pushed_block({"Steps": "3", "Levels": "{1}"}, 0.015, []),
    pushed_block({"Steps": "3"}, 0.0114, ["warning: function 'f' turns between the levels 0.666667 and 1.33333 of a step, 0.33 of its largest value"]),
    driven("a ramp that ends with a step", 0.01, 2, 0.1, 0),
    driven("a ramp that ends within a step", 0.03, 2.1, 0.1, 0),
    driven("a table", 0.01, 2, 0.05, 0.05, PIECES, Function="f"),
    driven("a jump", 0.01, 2, 0.1, 0, entry("f", Type="Heaviside", Start="0.5"), says=[], Function="f"),
    driven("one that a formula hides leaves velocities that alternate", 0.01, 2, 0.09, None,
           entry("f", Type="Expression", Expression="t &lt; 0.9 ? t : 0.9"), Function="f",
           says=[*FITS, "of the velocities at the end at 'body/0', by Rigid Support 'drive'"]),
    flying_pair(),
    beside(),
    spun("at the end of a step", 1, Type="Heaviside", Start="0.5"),
    spun("within a step", 1, Type="Heaviside", Start="0.505"),
    spun("at the start, away from rest", 2, says=[*FITS, "at 'body/0', by Angular Velocity 'drive'"], Type="Table",
           Times="{0, 0.5, 0.6, 2}", Values="{1, 1, 2, 2}"),
    Case("a load that begins to rise late in a step is no pulse", 0, args=RUN, leaves=["out"], errors=[],
         deck=motion(entry("f", Type="Table", Times="{0, 0.505, 2}", Values="{0, 0, 1}"), 0.01, 2, FORCE),
         check=ends_with("speed vx [m/s]", 0.7475, 1e-5)),
    spun("a corner within a step", 0.505, still=True, Type="Table", Times="{0, 0.495, 2.495}", Values="{0, 0, 2}"),
    Case("a rise much shorter than the step behind it", 0, args=RUN, leaves=["out"], says=[],
         deck=motion(entry("f", Type="Table", Times="{0, 0.5, 0.5001, 2}", Values="{0, 0, 1, 1}"), 0.01, 1,
                     constraints=entry("drive", Type="Rigid Support", Node="body", Translation="{0.1, 0, 0}", Function="f")),
         check=speed_below(20.1)),
    eliminated_hinge(),
    Case("a prescribed motion without corners does not", 0, args=RUN, leaves=["out"], errors=[],
         deck=motion(entry("f", Type="Expression", Expression="t &lt; 1 ? (1 - cos(pi*t))/2 : 1"), 0.01, 2,
                     constraints=entry("drive", Type="Rigid Support", Node="body", Translation="{0.1, 0, 0}", Function="f")),
         check=ends_with("place ux [m]", 0.1, 1e-9)),
    Case("a smooth rotation that comes to rest has no corner", 0, args=RUN, leaves=["out"], errors=[],
         deck=motion(entry("f", Type="Expression", Expression="t &lt; 1 ? t^3*(10 - 15*t + 6*t^2) : 1"), 0.01, 1.5,
                     constraints=entry("pin", Type="Revolute Support", Node="body", Axis="{0, 0, 1}") +
                     entry("drive", Type="Rotation", Node="body", Axis="{0, 0, 1}", Angle="1", Function="f") +
                     entry("bond", Type="Rigid Connection", Node="arm", Master="body"),
                     others=entry("arm", Type="Rigid Body", Position="{1, 0, 0}", Mass="1", Inertia="{1, 1, 1}")),
         check=ends_with("place ux [m]", 0, 1e-9)),
    damped("Trapezoidal", True),
    damped("Generalised Alpha", True),
    damped("Generalised Alpha", False, Spectral_Radius="1"),
    damped("Conserving", False),
]
