"""Equilibria: what acts at once, what stands at rest, what turns before it buckles."""

import pathlib

from deck_text import ends_with, entry, listed
from driver import Case

INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs"
RUN = "run deck.xml --output out --quiet"
HOSE = (INPUTS / "beam/hose.xml").read_text()
PLANK = (INPUTS / "buckling/tippling.xml").read_text()

MOUNT = "{5e3, 0, 0, 0, 0, 0, 5e3, 0, 0, 0, 0, 5e3, 0, 0, 0, 8e3, 0, 0, 8e3, 0, 8e3}"
# A machine on mounts, with an arm that is on mounts, too: nothing holds them but springs.
MACHINE = """<ParameterList name="culm">""" + "".join((
    listed("Sections", entry("arm", Type="Circle", Radius="0.04", Young_Modulus="1e9", Poisson_Ratio="0.3", Density="2000")),
    listed("Structures",
           listed("arm", entry("Curve", Type="Line", From="{0, 0, 0}", To="{1, 0.2, 0}", Elements="2"))
           .replace('name="arm">', 'name="arm"><Parameter name="Type" value="Beam"/><Parameter name="Section" value="arm"/>'),
           entry("machine", Type="Rigid Body", Position="{1, 0.2, 0}", Mass="10", Centre="{0.1, 0.05, 0}", Inertia="{0.5, 0.6, 0.7}")),
    listed("Constraints", entry("hinge", Type="Revolute Joint", First="arm/last", Second="machine", Axis="{0, 1, 0}")),
    listed("Loads",
           entry("foot", Type="Restoring", Node="arm/first", Stiffness=MOUNT),
           entry("mount", Type="Restoring", Node="machine", Stiffness=MOUNT),
           "%s"),
    listed("Analyses",
           entry("weight", Type="Static", Steps="1"),
           entry("rest", Type="Dynamic", Step="0.01", End_Time="1.2")),
)) + "</ParameterList>"

CASES = [
    *(
        Case(f"a hose whose weight acts at once, {kind}", 0, deck=HOSE, args="run deck.xml --output out", leaves=["out"],
             change=change, silent=False, ranks=True,
             prints=["note: what acts in full at level 0, such as loads that follow 'Constant', was taken up there in "],
             check=ends_with("end uz [m]", -2.8753288817, 1e-8))
        for kind, change in (
            ("Static", []),
            ("Path", [('<Parameter name="Type" value="Static"/>\n      <Parameter name="Steps" value="2"/>',
                       '<Parameter name="Type" value="Path"/>\n      <Parameter name="First Increment" value="0.5"/>\n'
                       '      <Parameter name="Final Level" value="1"/>'),
                      ('<ParameterList name="weight">', entry("touch", Type="Force", Node="hose/last", Force="{0, 0, -1e-9}")
                       + '<ParameterList name="weight">')]),
        )
    ),
    Case("a hose whose weight grows", 0, deck=HOSE, args="run deck.xml --output out", leaves=["out"], silent=False,
         never=["was taken up"],
         change=[('value="Gravity"/>', 'value="Gravity"/><Parameter name="Function" value="Ramp"/>'),
                 ('name="Steps" value="2"', 'name="Steps" value="40"')],
         check=ends_with("end uz [m]", -2.8753288817, 1e-8)),
    *(
        Case(f"{what} at rest on mounts", 0, deck=MACHINE % load, args="run deck.xml --output out", leaves=["out"],
             never=["BROKEN", "broken"], silent=False, ranks=True)
        for what, load in (
            ("weight", entry("weight", Type="Gravity")),
            ("a moment", entry("push", Type="Moment", Node="arm/first", Moment="{3, 20, 10}", Function="Constant")),
        )
    ),
    Case("a plank that is soft in its plane, too", 0, deck=PLANK, args=RUN, leaves=["out"],
         change=[('name="Height" value="4"', 'name="Height" value="1.2"')],
         says=["warning: mode 1, factor "], never=["mode 2, factor"]),
    Case("a plank that is stiff in its plane", 0, deck=PLANK, args=RUN, leaves=["out"], never=["turns 'beam/last'"]),
]
