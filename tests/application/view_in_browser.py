"""The page of a run in a browser: nothing on its console, nothing asked of the network, and what it shows as a user
goes through it is what the run recorded. Ends with 77 where there is no browser."""

import argparse
import pathlib
import sys
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "src/python"), str(ROOT / "tests/kit")]
from browser import Browser, find_browser  # noqa: E402
from culm.program import Program  # noqa: E402

INPUTS = ROOT / "inputs"
SKIPPED = 77
SINGLE = 1e-6  # relative, of 32 bits


class Page:
    """What a user sees and does."""

    def __init__(self, browser, path):
        self.browser = browser
        self.path = path

    def open(self, fragment=""):
        self.browser.open(f"file://{self.path}{fragment}")

    def text(self, name):
        return self.browser.run(f"document.getElementById('{name}').textContent")

    @property
    def address(self):
        return self.browser.run("window.location.hash")

    def numbers(self):
        """Of what is picked, by their labels, with all digits."""
        rows = self.browser.run(
            "[...document.querySelectorAll('#picked-numbers tr')].map((r) => [r.cells[0].textContent, r.cells[1].title])"
        )
        return {label: float(value) for label, value in rows}

    def slide(self, place):
        """Moves the slider, which sends its event."""
        self.browser.run(
            f"(() => {{ const s = document.getElementById('time'); s.value = {place};"
            " s.dispatchEvent(new Event('input')); })()"
        )

    def choose(self, name, value):
        self.browser.run(
            f"(() => {{ const s = document.getElementById('{name}'); s.value = '{value}';"
            " s.dispatchEvent(new Event('change')); })()"
        )


class Check:
    def __init__(self):
        self.complaints = []

    def equal(self, found, expected, what):
        if found != expected:
            self.complaints.append(f"{what}: {found!r}, expected {expected!r}")

    def close(self, found, expected, scale, what):
        if not abs(found - expected) <= SINGLE * scale:
            self.complaints.append(f"{what}: {found}, expected {expected}")


def check_picked(check, page, file, state, element, node):
    """Every number of the panel against the file."""
    step = file[f"steps/{state:06}"]
    shown = page.numbers()
    u = step["displacement"][node]
    most = max(numpy.abs(one["displacement"]).max() for one in file["steps"].values())
    for k, name in enumerate("xyz"):
        check.close(shown[f"displacement {name} [m]"], u[k], most, f"displacement {name}")
        check.close(shown[f"{name} [m]"], step["position"][node, k], 2540.0, name)
    check.close(shown["displacement [m]"], numpy.linalg.norm(u), most, "displacement")
    names = list(file["mesh/shell"].attrs["resultant_names"])
    for name, value in zip(names, step["resultants"][element]):
        [found] = [shown[label] for label in shown if label.startswith(f"{name} (")]
        check.close(found, value, abs(value), name)


def check_states(check, browser, run):
    page = Page(browser, run / "view.html")
    page.open()
    with h5py.File(run / "run.h5") as file:
        times = [step.attrs["time"] for step in file["steps"].values()]
        check.equal(page.text("title"), file["deck"].attrs["title"], "title")
        check.equal(page.text("time-text"), f"level 1 · state {len(times)} of {len(times)}", "last state")
        page.slide(40)
        check.equal(page.text("time-text"), f"level {times[40]:.5g} · state 41 of {len(times)}", "state of the slider")
        browser.press("ArrowLeft")
        check.equal(page.address, "#state=40", "address after a key")
        # from the address: element 27, and the first of its nodes
        page.open("#state=40&pick=shell/27")
        node = int(file["mesh/shell/connectivity"][4 * 27])
        check.equal(page.text("picked-name"), f"shell, element 27, node {node}", "picked by the address")
        check_picked(check, page, file, 39, 27, node)
        page.slide(70)
        check_picked(check, page, file, 70, 27, node)
        # with the pointer, in the middle of the shell
        browser.click(240, 330)
        words = page.text("picked-name").split(";")[0].split(", ")
        check.equal(words[0], "shell", "picked by the pointer")
        element, node = (int(word.split(" ")[1]) for word in words[1:])
        check.equal(node in file["mesh/shell/connectivity"][4 * element : 4 * element + 4], True, "node of the element")
        check_picked(check, page, file, 70, element, node)
        page.choose("field", "M11")
        page.choose("range", "one")
        moments = [row[3] for row in file["steps/000070/resultants"]]
        ticks = browser.run("[...document.querySelectorAll('#bar-ticks li')].map((t) => t.textContent.replace('−', '-'))")
        check.equal(page.text("bar-title"), "M11 (bending moment) [N m/m]", "title of the bar")
        for tick, expected in ((ticks[0], max(moments)), (ticks[-1], min(moments))):
            check.equal(abs(float(tick) - expected) <= 1e-4 * abs(expected), True, f"bar ends at {tick}, not {expected}")
    before = browser.picture()
    browser.click_on("#directors")
    check.equal("directors=1" in page.address, True, "directors in the address")
    check.equal(browser.picture() != before, True, "directors in the picture")
    browser.click_on("#directors")
    check.equal(browser.picture() == before, True, "picture without directors")
    browser.click_on("#play")
    browser.run("new Promise((done) => setTimeout(done, 500))")
    browser.click_on("#play")
    check.equal(page.text("time-text").startswith("level "), True, "time after playing")


def check_shapes(check, browser, run, names):
    page = Page(browser, run / "view.html")
    page.open()
    offered = browser.run("[...document.getElementById('show').options].map((o) => o.text)")
    check.equal(offered, ["states", *(f"modes: {name}" for name in names)], "shapes offered")
    check.equal(page.text("time-text"), "phase 0°", "first shape")
    first = browser.picture()
    page.choose("show", "modes/2")
    check.equal(page.address, "#shape=modes/2", "address of a shape")
    second = browser.picture()
    page.slide(24)
    check.equal(page.text("time-text"), "phase 180°", "half a period")
    check.equal(len({first, second, browser.picture()}), 3, "different pictures")


def check_ghost(check, browser, path):
    page = Page(browser, path)
    page.open()
    check.equal("with finer in orange" in page.text("subtitle"), True, "the other run is named")
    before = browser.picture()
    browser.click_on("#ghost")
    check.equal(browser.picture() != before, True, "the other run in the picture")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    found = find_browser()
    if found is None:
        print("there is no browser: install chromium")
        sys.exit(SKIPPED)
    check = Check()
    with tempfile.TemporaryDirectory(prefix="culm") as name, Browser(found) as browser:
        folder = pathlib.Path(name)

        def made(deck, place, *settings):
            run = program.run(INPUTS / deck, folder / place, settings)
            if not run.succeeded:
                sys.exit(run.errors)
            return run.folder

        def view(*arguments):
            done = program.call("view", *arguments)
            if done.returncode != 0:
                sys.exit(done.stderr)

        roof = made("shell/hinged_roof_path.xml", "roof")
        view(roof)
        check_states(check, browser, roof)
        modes = made("modes/cantilever.xml", "modes")
        view(modes)
        with h5py.File(modes / "run.h5") as file:
            names = list(file["analyses/modes/shapes"].attrs["names"])
        check_shapes(check, browser, modes, names)
        made("flight/spaghetti_3d.xml", "coarse")
        made("flight/spaghetti_3d.xml", "finer", "Analyses/motion/Step=0.01")
        view(folder / "coarse", folder / "finer", "--output", folder / "both.html")
        check_ghost(check, browser, folder / "both.html")
        check.equal(browser.complaints, [], "console and network")
    for complaint in check.complaints:
        print(f"FAILED: {complaint}")
    sys.exit(1 if check.complaints else 0)


if __name__ == "__main__":
    main()
