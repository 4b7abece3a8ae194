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


if __name__ == "__main__":
    unittest.main()
