"""Pictures of histories on the page of a run: many of them, and of names that look like math."""

import types
import unittest

import matplotlib
import pandas

from culm import drawing, reading, report

MATH = ("$x_{$", r"$\frac$", "a$b", r"\$ $ $")


class Page:
    def __init__(self):
        self.paragraphs, self.heights = [], []

    def heading(self, text):
        pass

    def paragraph(self, text, kind=None):
        self.paragraphs.append(text)

    def figure(self, figure, description):
        self.heights.append(figure.get_size_inches()[1])


class Many(unittest.TestCase):
    def page(self, count):
        entries = [f"node {i}" for i in range(count)]
        names = [f"{entry} u{x} [m]" for entry in entries for x in "xyz"]
        history = types.SimpleNamespace(names=names, levels=[0.0, 1.0], columns=dict.fromkeys(names, [0.0, 1.0]))
        page = Page()
        parts = [("weight", "Static", slice(0, 2))]
        report._add_histories(page, types.SimpleNamespace(quantities=lambda: entries), history, parts, drawing)
        return page

    def test_few_are_one_picture(self):
        page = self.page(6)
        self.assertEqual((len(page.heights), page.paragraphs), (1, []))

    def test_many_are_several_of_limited_height(self):
        page = self.page(90)
        self.assertGreater(len(page.heights), 1)
        self.assertLess(max(page.heights), 30.0)  # [inch]
        self.assertEqual(page.paragraphs, [])

    def test_of_too_many_the_first_are_drawn(self):
        page = self.page(20000)
        self.assertEqual(len(page.heights), report.MOST_PLOTS // report.PLOTS_OF_A_FIGURE)
        self.assertEqual(page.paragraphs, ["19900 more plots are not drawn; their numbers are in history.csv."])


class Math(unittest.TestCase):
    def test_a_run_in_python_plots_names_as_they_stand(self):
        for name in MATH:
            run = object.__new__(reading.Run)
            run.analyses, run.quantities = ["weight"], [name]
            index = pandas.MultiIndex.from_tuples([("weight", 0, 0.0), ("weight", 1, 1.0)], names=["analysis", "step", "time"])
            run.history = pandas.DataFrame({f"{name} ux [m]": [0.0, 1.0]}, index)
            with matplotlib.rc_context({"text.parse_math": True}):  # as who imports culm has it
                figure, axes = drawing.plot()
                self.addCleanup(drawing.close, figure)
                run.plot(name, axes[0][0])
                figure.canvas.draw()

    def test_names_are_drawn_as_they_stand(self):
        groups = [(name, name, [0.0, 1.0], {name: [0.0, 1.0], "other": [1.0, 2.0]}) for name in MATH]
        figure = drawing.histories(groups, MATH[0])
        self.addCleanup(drawing.close, figure)
        figure.canvas.draw()

    def test_logarithmic_scales_need_none(self):
        figure, axes = drawing.plot(2)
        self.addCleanup(drawing.close, figure)
        for ax, values in zip(axes[0], ([1e-9, 1.0], [1e-3, 4e-3])):  # the second within one decade
            ax.plot([1.0, 2.0], values)
            drawing.scale_log(ax, "y")
        figure.canvas.draw()
        for ax in axes[0]:
            labels = [label.get_text() for which in ("major", "minor") for label in ax.get_yticklabels(which=which)]
            self.assertTrue(any(labels))
            self.assertFalse([label for label in labels if "$" in label])


if __name__ == "__main__":
    unittest.main()
