#!/usr/bin/env python3
"""Installs culm and builds and runs the programs of the guide against what was installed.

usage: run.py --build FOLDER --cmake PROGRAM
"""

import argparse
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
LIBRARY = ROOT / "doc/guide/library.md"
COUPLING = ROOT / "doc/guide/coupling.md"
TURBINE = ROOT / "inputs/turbine/nrel5mw/turbine_operation.xml"
C = ["cc", "-std=c99", "-pedantic-errors", "-Wall", "-Wextra", "-Werror"]


def block(page, language, number=0):
    """A block of a page in a language, the first one or another."""
    return re.findall(rf"```{language}\n(.*?)```\n", page.read_text(), re.DOTALL)[number]


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                          **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Installed:
    """culm in a folder of its own, and programs that use it."""

    def __init__(self, folder, build, cmake):
        self.folder, self.cmake = folder, cmake
        self.prefix = folder / "installed"
        run(cmake, "--install", build, "--prefix", self.prefix)
        self.library = next(self.prefix.glob("lib*/**/libculm.so")).parent

    def build_cpp(self, page):
        source = self.folder / f"cpp_{page.stem}"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(block(LIBRARY, "cmake"))
        (source / "driver.cpp").write_text(block(page, "cpp"))
        run(self.cmake, "-S", source, "-B", source / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(self.cmake, "--build", source / "build")
        return source / "build/driver"

    def build_c(self, text, name):
        (self.folder / f"{name}.c").write_text(text)
        run(*C, self.folder / f"{name}.c", f"-I{self.prefix}/include", f"-L{self.library}",
            f"-Wl,-rpath,{self.library}", "-lculm", "-lm", "-o", self.folder / name)
        return self.folder / name

    def run_python(self, text, name, *arguments):
        (self.folder / f"{name}.py").write_text(text)
        environment = {**os.environ, "PYTHONPATH": str(self.prefix / "share/culm/python"),
                       "PYTHONDONTWRITEBYTECODE": "1"}
        return run(sys.executable, self.folder / f"{name}.py", *arguments, env=environment)

    def check_symbols(self):
        """The library shows the functions of its header and nothing else."""
        declared = set(re.findall(r"CULM_API .*?(culm_\w+)\(", (self.prefix / "include/culm.h").read_text()))
        shown = {line.split()[-1] for line in
                 run("nm", "-D", "--defined-only", self.library / "libculm.so").splitlines()}
        if declared != shown:
            sys.exit(f"culm.h and libculm.so differ in {sorted(declared ^ shown)[:20]}")


def check_library(culm):
    from_cpp = run(culm.build_cpp(LIBRARY), TURBINE)
    from_python = culm.run_python(block(LIBRARY, "python"), "library", TURBINE)
    print(f"C++: {from_cpp}Python: {from_python}", end="")
    without_wind = -0.016  # [m]
    if from_cpp != from_python or float(from_cpp) < without_wind + 0.1:
        sys.exit("the programs do not agree, or the wind did not push the nacelle")


def check_history(culm):
    """A run of the installed program, read as a pandas frame."""
    if importlib.util.find_spec("pandas") is None:
        print("no pandas: the frame of a history is not tested")
        return
    deck, results = ROOT / "inputs/control/speed_control.xml", culm.folder / "history"
    run(culm.prefix / "bin/culm", "run", deck, "--output", results)
    print(culm.run_python((HERE / "history.py").read_text(), "history", results), end="")


def check_coupling(culm):
    deck = culm.folder / "mast.xml"
    deck.write_text(block(COUPLING, "xml"))
    texts = [run(culm.build_cpp(COUPLING), deck), run(culm.build_c(block(COUPLING, "c"), "driver"), deck),
             culm.run_python(block(COUPLING, "python"), "coupling", deck)]
    print(*texts, sep="", end="")
    top, work = (float(word) for word in re.findall(r"([-.\d]+) [mJ]", texts[0]))
    if len(set(texts)) > 1 or top < 0.1 or work < 1.0:
        sys.exit("the programs do not agree, or the wind did not push the mast")
    print(run(culm.build_c((HERE / "errors.c").read_text(), "errors"), deck), end="")
    print(culm.run_python((HERE / "arrays.py").read_text(), "arrays", deck), end="")
    print(culm.run_python((HERE / "results.py").read_text(), "results", deck, culm.prefix / "bin/culm", culm.folder, ROOT / "inputs"), end="")
    check_couple(culm, deck)
    check_socket(culm, deck, work)
    check_wing(culm)
    check_leader(culm, deck, texts[0])
    check_fmu(culm, deck, texts[0])
    culm.check_symbols()


def check_fmu(culm, deck, text):
    """The mast as an FMU, blown at by an importer in C, which repeats steps from a state that it keeps."""
    fmu, folder = culm.folder / "mast.fmu", culm.folder / "fmu"
    run(culm.prefix / "bin/culm", "export", "fmu", deck, "--output", fmu)
    with zipfile.ZipFile(fmu) as packed:
        packed.extractall(folder)
    description = ElementTree.parse(folder / "modelDescription.xml").getroot()
    variables = {one.get("name"): one for one in description.iter("Float64")}
    sizes = [int(one.get("start")) for one in variables["skin.motion"].findall("Dimension")]
    if sizes != [6, 6] or variables["skin.force"].get("valueReference") != "16":
        sys.exit("the description of the FMU has other ports")
    identifier = description.find("CoSimulation").get("modelIdentifier")
    run(*C, HERE / "importer.c", f"-I{culm.prefix}/share/culm/fmu", "-ldl", "-lm", "-o", culm.folder / "importer")
    found = run(culm.folder / "importer", folder, identifier, "0.02", culm.folder / "blown_fmu")
    print(f"FMU: {found}", end="")
    rows = len((culm.folder / "blown_fmu/history.csv").read_text().splitlines())
    if found != text or rows != 52:
        sys.exit("the FMU does something else than the programs")


def check_couple(culm, deck):
    """The verb, with a mast that is pushed: what the structure loses the partner gains."""
    push = [word for name, value in (("Type", "Line Force"), ("Structure", "mast"), ("Force", "{57, 10, 0}"),
                                     ("Function", "Constant")) for word in ("--set", f"Loads/push/{name}={value}")]
    text = run(culm.prefix / "bin/culm", "couple", deck, "--partner", "added-mass", "--mass", "5", *push,
               "--output", culm.folder / "pushed")
    print(text, end="")
    work, share = (float(re.search(words + r"\s+([-+.\de]+)", text).group(1))
                   for words in ("work on the structure", "gap .* J,"))
    if not work < -1.0 or not abs(share) < 1e-8:
        sys.exit("the partner got nothing, or what it got is not what the structure lost")
    command = [culm.prefix / "bin/culm", "couple", HERE.parents[1] / "inputs/coupling/ports.xml", "--port", "strips",
               "--partner", "added-mass", "--mass", "10", "--scheme", "explicit", "--output", culm.folder / "loose"]
    loose = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if loose.returncode != 8 or "too loose" not in loose.stderr:
        sys.exit("a loose coupling loses energy, and nobody says so")


def check_socket(culm, deck, work):
    """The wind as a program of its own does the same work."""
    script = culm.folder / "wind.py"
    script.write_text(block(COUPLING, "python", 1))
    address = f"unix:{culm.folder}/wind"
    wind = subprocess.Popen([sys.executable, str(script), address],
                            env={**os.environ, "PYTHONPATH": str(culm.prefix / "share/culm/python")})
    text = run(culm.prefix / "bin/culm", "couple", deck, "--partner", "socket", "--address", address, "--output",
               culm.folder / "blown")
    if wind.wait(60) != 0:
        sys.exit("the wind did not come to its end")
    found = float(re.search(r"work on the structure\s+([-+.\de]+)", text).group(1))
    print(f"over a socket: {found} J")
    if abs(found - work) > 1e-6 * abs(work):
        sys.exit("the wind over a socket does another work")


def start(culm, script, address):
    return subprocess.Popen([sys.executable, str(script), address], stdout=subprocess.PIPE, text=True,
                            env={**os.environ, "PYTHONPATH": str(culm.prefix / "share/culm/python")})


def check_wing(culm):
    """A flexible wing in an air stream comes to rest where its bending has taken a part of the lift away."""
    deck, script, address = culm.folder / "wing.xml", culm.folder / "air.py", f"unix:{culm.folder}/air"
    deck.write_text(block(COUPLING, "xml", 1))
    script.write_text(block(COUPLING, "python", 2))
    air = start(culm, script, address)
    text = run(culm.prefix / "bin/culm", "couple", deck, "--partner", "socket", "--address", address, "--output",
               culm.folder / "flown")
    air.communicate(timeout=60)
    last = (culm.folder / "flown/history.csv").read_text().splitlines()[-1].split(",")
    attempts = float(re.search(r"([.\d]+) attempts per window", text).group(1))
    print(f"wing: tip at {last[3]} m, {attempts} attempts per window")
    # under the lift of a wing that does not turn the beam would bend by q L^4 / 8 EI = 0.34 m
    if air.returncode != 0 or not 0.15 < float(last[3]) < 0.3 or not 2.0 < attempts < 10.0:
        sys.exit("the wing does not fly as it should")


def check_leader(culm, deck, expected):
    """The wind that leads gives the digits of the one that holds culm in its own process."""
    script, address = culm.folder / "leading_wind.py", f"unix:{culm.folder}/leader"
    script.write_text(block(COUPLING, "python", 3))
    wind = start(culm, script, address)
    run(culm.prefix / "bin/culm", "serve", deck, "--at", address, "--output", culm.folder / "led", "--quiet")
    found = wind.communicate(timeout=60)[0]
    print(f"leading over a socket: {found}", end="")
    if wind.returncode != 0 or found != expected:
        sys.exit("the wind that leads does not agree")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--cmake", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="culm-consumer-") as path:
        culm = Installed(pathlib.Path(path), options.build, options.cmake)
        check_library(culm)
        check_history(culm)
        check_coupling(culm)


if __name__ == "__main__":
    main()
