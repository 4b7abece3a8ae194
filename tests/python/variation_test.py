"""What --vary understands, and what it says to what it does not."""

import unittest

from culm.errors import CulmError
from culm.resolved_deck import ResolvedDeck
from culm.study import variation

DECK = ResolvedDeck(
    """<ParameterList name="culm">
  <Parameter name="Refinement" value="1"/>
  <ParameterList name="Structures">
    <ParameterList name="tower"><Parameter name="Element" value="Director"/><Parameter name="Order" value="1"/></ParameterList>
    <ParameterList name="blade"><Parameter name="Element" value="Director"/><Parameter name="Order" value="1"/>
      <ParameterList name="Curve"><Parameter name="Elements" value="8"/></ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Analyses">
    <ParameterList name="weight"><Parameter name="Steps" value="2"/></ParameterList>
    <ParameterList name="run-up"><Parameter name="Step" value="0.1"/><Parameter name="Scheme" value="Conserving"/></ParameterList>
    <ParameterList name="stop"><Parameter name="Step" value="0.1"/><Parameter name="Scheme" value="Conserving"/></ParameterList>
  </ParameterList>
</ParameterList>"""
)


def parse(text):
    return variation.parse(text, DECK)


class Ranges(unittest.TestCase):
    def test_divides_down_to_the_end(self):
        self.assertEqual(parse("step=0.04:0.0025/2").values, ["0.04", "0.02", "0.01", "0.005", "0.0025"])

    def test_multiplies_and_stops_before_passing_the_end(self):
        self.assertEqual(parse("mesh=1:10*2").values, ["1", "2", "4", "8"])

    def test_whole_numbers_stay_whole_only_where_all_are(self):
        self.assertEqual(parse("mesh=8:1/2").values, ["1", "2", "4", "8"])
        self.assertEqual(parse("step=1:0.25/2").values, ["1", "0.5", "0.25"])

    def test_is_ordered_from_coarse_to_fine(self):
        self.assertEqual(parse("step=0.1:0.4*2").values, ["0.4", "0.2", "0.1"])
        self.assertEqual(parse("step=0.1,0.4,0.2").values, ["0.4", "0.2", "0.1"])

    def test_goes_on_beyond_the_finest(self):
        axis = parse("step=0.4:0.1/2")
        self.assertEqual(axis.value(4), "0.025")
        self.assertEqual(parse("mesh=1:9*3").value(3), "27")
        self.assertEqual(parse("mesh=4").value(1), "8")

    def test_sizes_shrink(self):
        self.assertEqual([parse("mesh=1:4*2").size(i) for i in range(3)], [1.0, 0.5, 0.25])
        self.assertEqual([parse("step=4:1/2").size(i) for i in range(3)], [4.0, 2.0, 1.0])

    def test_an_unknown_path_is_refined_towards_its_end(self):
        axis = parse("Analyses/stop/Newton/Constraint Tolerance=1e-4:1e-8/100")
        self.assertTrue(axis.is_refined and axis.shrinks)
        self.assertEqual(axis.values, ["0.0001", "1e-06", "1e-08"])


class Lists(unittest.TestCase):
    def test_texts_are_compared(self):
        axis = parse("scheme=Conserving,Generalised-Alpha")
        self.assertFalse(axis.is_refined)
        self.assertEqual(axis.values, ["Conserving", "Generalised Alpha"])

    def test_orders_are_compared(self):
        self.assertFalse(parse("order=1,2,3").is_refined)

    def test_numbers_of_a_path_are_refined_where_they_are_elements(self):
        self.assertTrue(parse("Structures/blade/Curve/Elements=8,16").is_refined)
        self.assertFalse(parse("Structures/blade/Dissipation=0,0.5").is_refined)

    def test_commas_in_braces_are_part_of_a_value(self):
        self.assertEqual(parse("Structures/shell/Mesh/Elements={4, 4},{8, 8}").values, ["{4, 4}", "{8, 8}"])


class Places(unittest.TestCase):
    def test_a_short_name_stands_for_all_places(self):
        self.assertEqual(parse("step=1,2").settings(0), ["Analyses/run-up/Step=2", "Analyses/stop/Step=2"])

    def test_an_element_has_an_order(self):
        axis = parse("element=Director-2,Helical")
        self.assertEqual(
            sorted(axis.settings(0)),
            sorted(
                f"Structures/{name}/{value}"
                for name in ("tower", "blade")
                for value in ("Element=Director", "Order=2")
            ),
        )
        self.assertEqual(axis.settings(1), ["Structures/tower/Element=Helical", "Structures/blade/Element=Helical"])

    def test_a_star_is_any_one_name(self):
        self.assertEqual(parse("Structures/*/Curve/Elements=4,8").places, ["Structures/blade/Curve/Elements"])

    def test_a_variable_of_the_deck_is_left_to_the_program(self):
        self.assertEqual(parse("N=4,8").settings(0), ["N=4"])


class Pairs(unittest.TestCase):
    def test_advance_together(self):
        axes = variation.pair([parse("scheme=Conserving,Trapezoidal"), parse("step=4,2"), parse("mesh=1,2")], ["step", "mesh"])
        self.assertEqual(len(axes), 2)
        self.assertEqual(axes[0].settings(1), ["Analyses/run-up/Step=2", "Analyses/stop/Step=2", "Refinement=2"])
        self.assertEqual(axes[0].settings(2)[-1], "Refinement=4")

    def test_set_what_each_of_them_sets(self):
        (axis,) = variation.pair([parse("step=4,2"), parse("mesh=1,2")], ["step", "mesh"])
        self.assertEqual(axis.paths(), {"Analyses/run-up/Step", "Analyses/stop/Step", "Refinement"})
        with self.assertRaisesRegex(CulmError, "varies Refinement"):
            variation.refuse_set(["Refinement=3"], [(axis.name, axis.paths())])

    def test_differing_numbers_are_an_error(self):
        with self.assertRaisesRegex(CulmError, "step 2, mesh 3"):
            variation.pair([parse("step=4,2"), parse("mesh=1,2,4")], ["step", "mesh"])


class Overlaps(unittest.TestCase):
    def says(self, *texts, paired=()):
        with self.assertRaisesRegex(CulmError, "both '.*' and '.*' set .*: only the last one would count"):
            variation.pair([parse(text) for text in texts], paired)

    def test_are_refused(self):
        self.says("step=4,2", "Analyses/stop/Step=2,1")
        self.says("Analyses/*/Step=4,2", "Analyses/stop/Step=2,1", paired=["Analyses/*/Step", "Analyses/stop/Step"])
        self.says("element=Director-1,Director-2", "order=1,2")

    def test_are_none_where_other_parts_of_a_name_are_set(self):
        self.assertEqual(len(variation.pair([parse("element=Director,Helical"), parse("order=1,2")], [])), 2)


class Errors(unittest.TestCase):
    def says(self, text, pattern):
        with self.assertRaisesRegex(CulmError, pattern):
            parse(text)

    def test_name_that_is_nearly_one(self):
        self.says("stepp=1,2", "did you mean 'step'")

    def test_nothing_given(self):
        self.says("step", "expected name=values")
        self.says("step=1,,2", "a value is empty")

    def test_wrong_way(self):
        self.says("step=1:2/2", "leads away")

    def test_wrong_range(self):
        self.says("step=1:2", "first:last")
        self.says("step=0:2*2", "positive ends")
        self.says("step=1:2*1", "other than 1")
        self.says("step=1:1e999*2", "positive ends")
        self.says("step=1e-300:1e300*2", "positive ends")

    def test_endless_range(self):
        self.says("step=1:1e9*1.01", "more than 64")

    def test_twice_the_same(self):
        self.says("step=1,2,1", "given twice")

    def test_what_the_deck_has_not(self):
        self.says("fidelity=Full,Linear", "no Structures/\\*/Fidelity")
        self.says("Structures/*/Thickness=1,2", "no parameter of the deck")


class Between(unittest.TestCase):
    def test_is_rounded_to_the_finer_side(self):
        axis = parse("step=0.04:0.01/2")
        self.assertEqual(axis.between(0, 1, 0.5), "0.028")
        self.assertEqual(parse("mesh=4:16*2").between(0, 1, 0.4), "6")

    def test_is_none_where_nothing_is_left(self):
        self.assertIsNone(parse("mesh=1:4*2").between(0, 1, 0.5))


if __name__ == "__main__":
    unittest.main()
