"""What can be taken out of a deck, and by which settings."""

import unittest

from culm import removals
from culm.resolved_deck import ResolvedDeck


def deck(body):
    sections = entry("Sections", {}, entry("bar", {"Type": "Circle"}) + entry("rod", {"Type": "Circle"}))
    return ResolvedDeck(f'<ParameterList name="culm">{sections}{body}</ParameterList>')


def entry(name, parameters, below=""):
    lines = "".join(f'<Parameter name="{key}" value="{value}"/>' for key, value in parameters.items())
    return f'<ParameterList name="{name}">{lines}{below}</ParameterList>'


BEAM = {"Type": "Beam", "Section": "bar", "Element": "Director", "Fidelity": "Full", "Dissipation": "0"}
BEAM |= {"Torsion": "true", "Rotary Inertia": "1"}


def settings(found, effect):
    return [removal.settings for removal in found if removal.effect == effect]


class Removals(unittest.TestCase):
    def test_beams_that_are_alike_go_together(self):
        beams = entry("a", BEAM) + entry("b", BEAM) + entry("c", {**BEAM, "Section": "rod"})
        found = removals.find(deck(entry("Structures", {}, beams)))
        self.assertEqual(
            settings(found, "flexibility"),
            [["Structures/a/Fidelity=Rigid", "Structures/b/Fidelity=Rigid"], ["Structures/c/Fidelity=Rigid"]],
        )

    def test_what_is_off_already_is_not_offered(self):
        beams = entry("a", {**BEAM, "Fidelity": "Rigid"})
        self.assertEqual(removals.find(deck(entry("Structures", {}, beams))), [])

    def test_helical_beams_are_full_or_rigid(self):
        beams = entry("a", {**BEAM, "Element": "Helical"})
        found = removals.find(deck(entry("Structures", {}, beams)))
        self.assertEqual([removal.effect for removal in found], ["flexibility"])

    def test_shells_lose_their_flexibility_one_by_one(self):
        shell = {"Type": "Shell", "Fidelity": "Full", "Enhanced Membrane": "None", "Enhanced Thickness": "None"}
        walls = entry("a", {**shell, "Assumed Strains": "false"}) + entry("b", {**shell, "Assumed Strains": "true"})
        found = removals.find(deck(entry("Structures", {}, walls)))
        self.assertEqual(settings(found, "flexibility"), [["Structures/a/Fidelity=Rigid"], ["Structures/b/Fidelity=Rigid"]])
        self.assertEqual(settings(found, "assumed strains"), [["Structures/b/Assumed Strains=false"]])

    def test_shells_are_linear_where_their_materials_are(self):
        shell = {"Type": "Shell", "Fidelity": "Full", "Enhanced Membrane": "None", "Enhanced Thickness": "None"}
        shell["Assumed Strains"] = "false"
        walls = entry("a", {**shell, "Material": "steel"}) + entry("b", {**shell, "Materials": "{steel, rubber}"})
        materials = entry("steel", {"Type": "Isotropic"}) + entry("rubber", {"Type": "Neo-Hooke"})
        found = removals.find(deck(entry("Structures", {}, walls) + entry("Materials", {}, materials)))
        self.assertEqual(settings(found, "large rotations"), [["Structures/a/Fidelity=Linear"]])

    def test_loads_join_those_that_are_inactive_already(self):
        body = entry("Loads", {}, entry("weight", {"Type": "Gravity"}) + entry("brake", {"Type": "Spring"}))
        body += entry("Analyses", {}, entry("start", {"Type": "Static", "Inactive": "{brake}"}))
        found = removals.find(deck(body))
        self.assertEqual(settings(found, "gravity"), [['Analyses/start/Inactive={"brake", "weight"}']])
        self.assertEqual(settings(found, "spring"), [])

    def test_followers_stop_turning(self):
        loads = entry("push", {"Type": "Follower Force", "Turning": "true"}) + entry("pull", {"Type": "Force"})
        found = removals.find(deck(entry("Loads", {}, loads)))
        self.assertEqual(settings(found, "turning of the load"), [["Loads/push/Turning=false"]])

    def test_torsion_is_held_whatever_the_section(self):
        beams = entry("a", BEAM) + entry("b", BEAM) + entry("c", {**BEAM, "Torsion": "false"})
        beams += entry("d", {**BEAM, "Fidelity": "Linear"})
        found = removals.find(deck(entry("Structures", {}, beams)))
        self.assertEqual(settings(found, "torsion"), [["Structures/a/Torsion=false", "Structures/b/Torsion=false"]])

    def test_rotary_inertia_goes_where_something_heavy_moves(self):
        sections = entry("Sections", {}, entry("bar", {"Type": "Circle", "Density": "7850"}) + entry("rod", {"Type": "Circle"}))
        body = sections + entry("Structures", {}, entry("a", BEAM) + entry("b", {**BEAM, "Section": "rod"}))
        still = entry("Analyses", {}, entry("bend", {"Type": "Static"}))
        moving = entry("Analyses", {}, entry("modes", {"Type": "Modal"}))
        for analyses, wanted in ((still, []), (moving, [["Structures/a/Rotary Inertia=1e-06"]])):
            found = removals.find(ResolvedDeck(f"<ParameterList>{body}{analyses}</ParameterList>"))
            self.assertEqual(settings(found, "rotary inertia"), wanted)

    def test_rotary_inertia_goes_from_mass_matrices(self):
        matrix = "{3, 0, 0, 0, 0, 0, 3, 0, 0, 0, -0.3, 3, 0, 0.3, 0, 0.05, -0.02, 0, 0.08, 0, 0.13}"
        heavy = entry("bar", {"Type": "Stiffness Matrix", "Mass": matrix, "rhoA": "0"})
        massless = entry("rod", {"Type": "Stiffness Matrix", "rhoA": "0"})
        body = entry("Sections", {}, heavy + massless)
        body += entry("Structures", {}, entry("a", BEAM) + entry("b", {**BEAM, "Section": "rod"}))
        body += entry("Analyses", {}, entry("modes", {"Type": "Modal"}))
        found = removals.find(ResolvedDeck(f"<ParameterList>{body}</ParameterList>"))
        self.assertEqual(settings(found, "rotary inertia"), [["Structures/a/Rotary Inertia=1e-06"]])

    def test_damping_is_offered_where_there_is_some(self):
        beams = entry("a", {**BEAM, "Dissipation": "0.3", "Damping": "0"})
        found = removals.find(deck(entry("Structures", {}, beams)))
        self.assertEqual(settings(found, "dissipation"), [["Structures/a/Dissipation=0"]])
        self.assertEqual(settings(found, "damping"), [])
        self.assertEqual(settings(found, "strain damping"), [])

    def test_damping_by_strains_goes_as_a_whole(self):
        beams = entry("a", {**BEAM, "Strain Damping": "{0, 0, 0, 0.1, 0.2, 0}"})
        found = removals.find(deck(entry("Structures", {}, beams)))
        self.assertEqual(settings(found, "strain damping"), [["Structures/a/Strain Damping={0, 0, 0, 0, 0, 0}"]])

    def test_air_on_blades_goes_together_by_its_parts(self):
        strip = {"Type": "Strip", "Chord": "3", "Lag": "Jones", "Apparent Mass": "true"}
        loads = entry("air 1", {**strip, "Structure": "a"}) + entry("air 2", {**strip, "Structure": "b"})
        loads += entry("air 3", {**strip, "Structure": "c", "Lag": "Oye", "Apparent Mass": "false"})
        loads += entry("air 4", {**strip, "Structure": "d", "Lag": "Four States", "Apparent Mass": "false"})
        found = removals.find(deck(entry("Loads", {}, loads)))
        self.assertEqual(settings(found, "lag of the circulation"), [["Loads/air 1/Lag=None", "Loads/air 2/Lag=None"]])
        self.assertEqual(settings(found, "apparent mass"), [["Loads/air 1/Apparent Mass=false", "Loads/air 2/Apparent Mass=false"]])
        self.assertEqual(settings(found, "dynamic stall"), [["Loads/air 3/Lag=None"]])
        self.assertEqual(settings(found, "pressure and separation"), [["Loads/air 4/Lag=Airfoil"]])

    def test_rotors_lose_what_they_induce(self):
        rotor = {"Type": "Rotor", "Induction": "Dynamic", "Losses": "{Tip, Hub}", "Yaw": "Pitt Peters"}
        plain = {"Type": "Rotor", "Induction": "None", "Losses": "{}", "Yaw": "None"}
        found = removals.find(deck(entry("Loads", {}, entry("r", rotor) + entry("p", plain))))
        self.assertEqual(settings(found, "induction"), [["Loads/r/Induction=None"]])
        self.assertEqual(settings(found, "dynamic inflow"), [["Loads/r/Induction=Steady"]])
        self.assertEqual(settings(found, "tip losses"), [['Loads/r/Losses={"Hub"}']])
        self.assertEqual(settings(found, "hub losses"), [['Loads/r/Losses={"Tip"}']])
        self.assertEqual(settings(found, "skewed wake"), [["Loads/r/Yaw=None"]])

    def test_towers_leave_the_wind_alone(self):
        both = entry("a", {"Type": "Uniform"}, entry("Tower Influence", {"Upstream": "Bak", "Downstream": "Eames"}))
        one = entry("b", {"Type": "Gust"}, entry("Tower Influence", {"Upstream": "Potential", "Downstream": "None"}))
        found = removals.find(deck(entry("Flows", {}, both + one + entry("c", {"Type": "Uniform"}))))
        self.assertEqual(
            settings(found, "wind in front of the tower"),
            [["Flows/a/Tower Influence/Upstream=None"], ["Flows/b/Tower Influence/Upstream=None"]],
        )
        self.assertEqual(settings(found, "wake of the tower"), [["Flows/a/Tower Influence/Downstream=None"]])

    def test_winds_lose_their_shear(self):
        flows = entry("power", {"Type": "Power Law", "Exponent": "0.14"}) + entry("even", {"Type": "Power Law", "Exponent": "0"})
        flows += entry("log", {"Type": "Log Law", "Roughness": "0.03"})
        found = removals.find(deck(entry("Flows", {}, flows)))
        self.assertEqual(settings(found, "shear of the wind"), [["Flows/power/Exponent=0"], ["Flows/log/Roughness=1e-300"]])

    def test_free_wakes_become_prescribed(self):
        lattice = entry("a", {"Type": "Vortex Lattice"}, entry("Wake", {"Motion": "Free"}))
        lattice += entry("b", {"Type": "Vortex Lattice"}, entry("Wake", {"Motion": "Prescribed"}))
        found = removals.find(deck(entry("Loads", {}, lattice)))
        self.assertEqual(settings(found, "free wake"), [["Loads/a/Wake/Motion=Prescribed"]])


class RemovalsInMedia(unittest.TestCase):
    def test_waves_shrink_and_currents_stop(self):
        sea = {"Type": "Irregular Waves", "Height": "6", "Stretching": "Wheeler"}
        current = entry("Current", {"Type": "Table", "Speeds": "{1, 0.5}"})
        components = {"Type": "Wave Components", "Heights": "{1, 2}", "Stretching": "None"}
        flows = entry("sea", sea, current) + entry("swell", components) + entry("pool", {"Type": "Still Water"})
        found = removals.find(deck(entry("Flows", {}, flows)))
        self.assertEqual(settings(found, "waves"), [["Flows/sea/Height=6e-06"], ["Flows/swell/Heights={1e-06, 2e-06}"]])
        self.assertEqual(settings(found, "stretching of the waves"), [["Flows/sea/Stretching=None"]])
        self.assertEqual(settings(found, "current"), [["Flows/sea/Current/Speeds={0.0, 0.0}"]])

    def test_members_lose_buoyancy_drag_mass_and_growth(self):
        member = {"Type": "Morison", "Buoyancy": "true", "Drag": "1", "Drags": "{1, 0.7}", "Axial Drag": "0", "End Drag": "0.5"}
        member |= {"Added Mass": "1", "Axial Added Mass": "0", "End Added Mass": "0", "Growth": "0.1"}
        found = removals.find(deck(entry("Loads", {}, entry("waves", member))))
        self.assertEqual(settings(found, "buoyancy"), [["Loads/waves/Buoyancy=false"]])
        self.assertEqual(settings(found, "drag of the water"), [["Loads/waves/Drags={0.0, 0.0}", "Loads/waves/End Drag=0.0"]])
        self.assertEqual(settings(found, "added mass"), [["Loads/waves/Added Mass=0.0"]])
        self.assertEqual(settings(found, "growth"), [["Loads/waves/Growth=0.0"]])

    def soil(self, curve):
        pile = {**BEAM, "Order": "2"}
        soil = {"Type": "Soil", "Structure": "pile", "Ground": "{0, 0, -20}", "Down": "{0, 0, -1}"}
        body = entry("Structures", {}, entry("pile", pile, entry("Curve", curve)))
        body += entry("Loads", {}, entry("soil", soil))
        return deck(body + entry("Analyses", {}, entry("start", {"Type": "Static", "Inactive": "{push}"})))

    def test_soil_becomes_rigid(self):
        line = {"Type": "Polyline", "Points": "{0, 0, -30, 0, 0, -10, 0, 0, 0}", "Elements": "{2, 1}"}
        found = removals.find(self.soil(line))
        self.assertEqual(
            settings(found, "flexibility of the soil"),
            [[
                'Node Sets/rigid ground of soil/Nodes={"pile/0", "pile/1", "pile/2"}',
                "Constraints/rigid ground of soil/Type=Rigid Support",
                "Constraints/rigid ground of soil/Node=rigid ground of soil",
                'Analyses/start/Inactive={"push", "soil"}',
            ]],
        )
        self.assertEqual(settings(found, "soil"), [])

    def test_soil_around_a_curve_goes_as_a_load(self):
        found = removals.find(self.soil({"Type": "Arc", "Elements": "4"}))
        self.assertEqual(settings(found, "flexibility of the soil"), [])
        self.assertEqual(settings(found, "soil"), [['Analyses/start/Inactive={"push", "soil"}']])

    def test_friction_gradients_and_yielding_go(self):
        loads = entry("bed", {"Type": "Plane Contact", "Friction": "0.3", "Damping": "0"})
        loads += entry("sun", {"Type": "Temperature", "Gradient": "{0, 150}"})
        steel = entry("steel", {"Type": "Isotropic"}, entry("Plasticity", {"Yield Stress": "2e8"}))
        found = removals.find(deck(entry("Loads", {}, loads) + entry("Materials", {}, steel)))
        self.assertEqual(settings(found, "friction"), [["Loads/bed/Friction=0"]])
        self.assertEqual(settings(found, "gradient of temperature"), [["Loads/sun/Gradient={0.0, 0.0}"]])
        self.assertEqual(settings(found, "yielding"), [["Materials/steel/Plasticity/Yield Stress=200000000000000.0"]])


if __name__ == "__main__":
    unittest.main()
