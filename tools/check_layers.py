#!/usr/bin/env python3
"""Checks that packages include only what they may.

A package may include its own headers and those of the packages in its DEPENDS list, directly or
through another one. External libraries are visible to the packages named below and nowhere else.
CMake already refuses most of the rest when linking; this also catches headers that happen to be
in the default search path, and says which rule was broken.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PACKAGES = ROOT / "packages"

TPETRA = {"assembly", "solver"}
TEUCHOS = TPETRA | {"deck"}
MPI = TPETRA | {"parallel", "output", "analysis", "simulation"}

# (what is included, who may, in public headers as well?)
EXTERNAL = [
    (r"mpi\.h$", MPI, True),
    (r"Teuchos_.*", TEUCHOS, False),
    (r"Kokkos_Core\.hpp$", TPETRA | {"simulation"}, False),
    (r"(Tpetra|Kokkos(?!_Core)|Thyra|Xpetra).*", TPETRA, False),
    (r"(NOX|LOCA|Amesos2|Anasazi|Belos|Ifpack2|MueLu|Stratimikos)[_.A-Z].*", {"solver"}, False),
    (r"Spectra/.*", {"solver"}, False),
    (r"[sdcz]mumps_c\.h$", {"solver"}, False),
    (r"metis\.h$", {"parallel"}, False),
    (r"(hdf5|H5).*", {"output", "simulation"}, False),
    (r"libxml/.*", {"deck"}, False),
    (r"muParser.*", {"base"}, False),
]
# The one public header that shows Trilinos types, and who may include it, in sources only.
SHOWS_TRILINOS = "culm/assembly/tpetra.hpp"
TRILINOS_TYPE = re.compile(r"\b(Teuchos|Tpetra|Kokkos)::")

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def read_dependencies(folder):
    """The words after DEPENDS in a package's CMakeLists.txt."""
    text = re.sub(r"#.*", "", (folder / "CMakeLists.txt").read_text())
    call = re.search(r"culm_add_package\(([^)]*)\)", text)
    if not call:
        return None
    keyword = None
    found = []
    for word in call.group(1).split():
        if word.isupper() and word in {"DEPENDS", "EXTERNAL", "PRIVATE", "PRECOMPILE", "RANKS"}:
            keyword = word
        elif keyword == "DEPENDS":
            found.append(word)
    return found


def close(direct):
    """All packages that each one reaches; a circle is an error."""
    reached = {}

    def visit(name, path):
        if name in path:
            sys.exit("layers: the packages depend on each other in a circle: "
                     + " -> ".join(path + [name]))
        if name not in reached:
            everything = set()
            for below in direct.get(name, []):
                everything |= {below} | visit(below, path + [name])
            reached[name] = everything
        return reached[name]

    for name in direct:
        visit(name, [])
    return reached


def check_file(path, package, visible):
    in_public_header = path.relative_to(PACKAGES / package).parts[0] == "include"
    shows_trilinos = str(path).endswith("include/" + SHOWS_TRILINOS)
    for number, line in enumerate(path.read_text().splitlines(), 1):
        place = f"{path.relative_to(ROOT)}:{number}"
        if in_public_header and not shows_trilinos and TRILINOS_TYPE.search(line):
            yield f"{place}: a public header names a type of Trilinos"
        match = INCLUDE.match(line)
        if not match:
            continue
        header = match.group(1)
        if header == SHOWS_TRILINOS and (package not in TPETRA or in_public_header):
            yield f"{place}: {header} is for sources of {' and '.join(sorted(TPETRA))}"
        own = re.match(r"culm/([^/]+)/", header)
        if own:
            if own.group(1) != package and own.group(1) not in visible:
                yield f"{place}: package {package} does not depend on {own.group(1)} ({header})"
            continue
        for pattern, allowed, public in EXTERNAL:
            if not re.match(pattern, header):
                continue
            if package not in allowed:
                yield f"{place}: package {package} must not see {header}"
            elif in_public_header and not public and not shows_trilinos:
                yield f"{place}: {header} belongs into src/, not into a public header"


def main():
    direct = {}
    for folder in sorted(PACKAGES.iterdir()):
        if (folder / "CMakeLists.txt").exists():
            dependencies = read_dependencies(folder)
            if dependencies is None:
                sys.exit(f"layers: no culm_add_package(...) in {folder.name}/CMakeLists.txt")
            direct[folder.name] = dependencies
    visible = close(direct)

    files = 0
    errors = []
    for package in direct:
        for path in sorted((PACKAGES / package).rglob("*.[ch]pp")):
            files += 1
            errors += check_file(path, package, visible[package])
    for error in errors:
        print(error)
    print(f"layers: {files} files in {len(direct)} packages, {len(errors)} errors")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
