"""What begins, jumps or ends within steps of time: loads that adaptive steps must not walk over, pulses that fixed
steps do not see, and prescribed motions with corners."""

import math

from deck_text import ends_with, entry, listed
from driver import Case

RUN = "run deck.xml --output out --quiet"
BODY = entry("body", Type="Rigid Body", Position="{0, 0, 0}", Mass="1", Inertia="{1, 1, 1}")
SPRING = entry("spring", Type="Directed Ground Spring", Node="body", Direction="{1, 0, 0}", Stiffness="1")
FORCE = entry("push", Type="Force", Node="body", Force="{1, 0, 0}", Function="f")


def motion(function, step, end, *loads, adaptive="", constraints=""):
    analysis = (f'<ParameterList name="motion"><Parameter name="Type" value="Dynamic"/><Parameter name="End Time" value="{end}"/>'
                f'<Parameter name="Step" value="{step}"/>{adaptive}</ParameterList>')
    history = entry("place", Type="Displacement", Node="body") + entry("speed", Type="Velocity", Node="body")
    return (f'<ParameterList name="culm">{listed("Structures", BODY)}{listed("Functions", function)}'
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


CASES = [
    switched_on("a jump", Type="Heaviside", Start="9"),
    switched_on("a table", Type="Table", Times="{0, 9, 9.001, 20}", Values="{0, 0, 1, 1}"),
    switched_on("a formula", Type="Expression", Expression="t > 9 ? 1 : 0"),
    pulse("about the end of a step", 0, 0.04, Type="Table", Times="{0, 0.56, 0.6, 0.64, 1}", Values="{0, 0, 1, 0, 0}"),
    pulse("of one step and a half", 0.1, 0.15, Type="Square", Duration="0.15"),
    Case("a prescribed motion with a corner leaves velocities that alternate", 0, args=RUN, leaves=["out"],
         deck=motion("", 0.01, 2, constraints=entry("drive", Type="Rigid Support", Node="body", Translation="{0.1, 0, 0}")),
         says=["of the velocities at the end", "is 0 at 'body/0', by Rigid Support 'drive'"], check=ends_with("place ux [m]", 0.1, 1e-9)),
    Case("a prescribed motion without corners does not", 0, args=RUN, leaves=["out"], errors=[],
         deck=motion(entry("f", Type="Expression", Expression="t &lt; 1 ? (1 - cos(pi*t))/2 : 1"), 0.01, 2,
                     constraints=entry("drive", Type="Rigid Support", Node="body", Translation="{0.1, 0, 0}", Function="f")),
         check=ends_with("place ux [m]", 0.1, 1e-9)),
]
