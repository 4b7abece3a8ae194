"""Writes a deck with ports as an FMU (FMI 3.0, co-simulation) that other programs drive step by step."""

import datetime
import hashlib
import io
import pathlib
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

from .errors import CulmError
from .resolved_deck import ResolvedDeck
from .whole_file import refuse_to_replace, write_whole

PLATFORM = "x86_64-linux"
PER_PORT = 16  # value references, as src/fmi/fmu.cpp counts them
UNITS = {"N": dict(kg=1, m=1, s=-2), "N.m": dict(kg=1, m=2, s=-2), "m": dict(m=1), "J": dict(kg=1, m=2, s=-2), "s": dict(s=1)}
# name, causality, numbers per point, unit where all numbers have one, what it is
VARIABLES = (
    ("force", "input", 3, "N", "mean over the step"),
    ("moment", "input", 3, "N.m", "about the points, mean over the step"),
    ("reference", "local", 3, "m", "position in the reference"),
    ("position", "output", 3, "m", "at the end of the step"),
    ("rotation", "output", 9, None, "against the reference, a matrix row by row"),
    ("velocity", "output", 6, None, "and angular velocity at the end of the step [m/s, rad/s]"),
    ("acceleration", "output", 6, None, "and angular acceleration, mean of the last step of culm [m/s2, rad/s2]"),
    ("motion", "output", 6, None, "displacement and rotation vector in the step, what loads work on [m, rad]"),
    ("work", "output", 0, "J", "of force and moment in the step"),
)


def declare(parser):
    parser.add_argument("format", choices=("fmu",), help="what to write: an FMU of FMI 3.0")
    parser.add_argument("deck", type=pathlib.Path, help="input deck, XML, with ports")
    parser.add_argument("--output", type=pathlib.Path, help="file to write; here, with the name of the deck, if not given")


def main(arguments, program):
    output = arguments.output or pathlib.Path(arguments.deck.stem + ".fmu")
    refuse_to_replace(output, b"PK", "FMU")
    library = pathlib.Path(program.path).resolve().parents[1] / "share/culm/fmu/culm_fmu.so"
    if not library.exists():
        raise CulmError(f"there is no '{library}': culm was built without it", 6)
    deck = ResolvedDeck.of(program, arguments.deck)
    identifier = "culm_" + "".join(c if c.isascii() and c.isalnum() else "_" for c in arguments.deck.stem)
    try:
        with tempfile.TemporaryDirectory(prefix="culm") as folder:
            resources = _write_resources(pathlib.Path(folder), deck, arguments.deck)
            description = _describe(resources / "deck.xml", identifier, arguments.deck.stem, program)
            archive = io.BytesIO()
            with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as fmu:
                fmu.writestr("modelDescription.xml", description)
                fmu.write(library, f"binaries/{PLATFORM}/{identifier}.so")
                for path in sorted(resources.iterdir()):
                    fmu.write(path, f"resources/{path.name}")
            write_whole(output, archive.getvalue())
    except OSError as error:
        raise CulmError(f"cannot write '{output}': {error.strerror}", 6) from error
    print(output)
    return 0


def _write_resources(folder, deck, source):
    """The deck with all defaults, and beside it the files that it reads."""
    files = deck.only_files(source)
    # those that differ in their endings stay beside each other
    stems = sorted({path.with_suffix("") for path in files.values()})
    copies = {name: f"{stems.index(path.with_suffix(''))}_{path.name}" for name, path in files.items()}
    for name, copy in copies.items():
        (folder / copy).write_bytes(files[name].read_bytes())
    (folder / "deck.xml").write_text(deck.with_files(copies), encoding="utf-8")
    return folder


def _describe(deck, identifier, name, program):
    sys.path.append(str(pathlib.Path(program.path).resolve().parents[1] / "share/culm/module"))  # of the build tree
    import culm

    simulation = culm.Simulation(str(deck))
    if not simulation.ports:
        raise CulmError("the deck has no port: another program could neither see nor load it", 3)
    stepper = simulation.begin()
    root = ElementTree.Element(
        "fmiModelDescription", fmiVersion="3.0", modelName=name.encode("utf-8", "replace").decode(), variableNamingConvention="flat",
        instantiationToken=hashlib.sha256(deck.read_bytes()).hexdigest(), generationTool=f"culm {program.call('--version').stdout.splitlines()[0]}",
        generationDateAndTime=datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
    )
    ElementTree.SubElement(
        root, "CoSimulation", modelIdentifier=identifier, canHandleVariableCommunicationStepSize="true",
        canGetAndSetFMUState="true", canBeInstantiatedOnlyOncePerProcess="false", canSerializeFMUState="false",
    )
    units = ElementTree.SubElement(root, "UnitDefinitions")
    for unit, powers in UNITS.items():
        base = {key: str(power) for key, power in powers.items()}
        ElementTree.SubElement(ElementTree.SubElement(units, "Unit", name=unit), "BaseUnit", base)
    ElementTree.SubElement(
        root, "DefaultExperiment", startTime=repr(stepper.time), stopTime=repr(stepper.final_time),
        stepSize=repr(stepper.proposal - stepper.time),
    )
    variables = ElementTree.SubElement(root, "ModelVariables")
    structure = ElementTree.Element("ModelStructure")
    ElementTree.SubElement(variables, "Float64", name="time", valueReference="0", causality="independent",
                           variability="continuous", unit="s")
    results = ElementTree.SubElement(
        variables, "String", name="results", valueReference="1", causality="parameter", variability="fixed",
        description="folder for results as those of culm run; none are written if empty",
    )
    ElementTree.SubElement(results, "Start", value="")
    for number, port in enumerate(simulation.ports):
        _add_port(simulation.port(port), port, (number + 1) * PER_PORT, variables, structure)
    for output in structure.findall("Output"):
        ElementTree.SubElement(structure, "InitialUnknown", output.attrib)
    root.append(structure)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)


def _add_port(port, name, first, variables, structure):
    for number, (quantity, causality, width, unit, what) in enumerate(VARIABLES):
        variable = ElementTree.SubElement(
            variables, "Float64", name=f"{name}.{quantity}", valueReference=str(first + number), causality=causality,
            variability="constant" if causality == "local" else "continuous", description=what,
        )
        if unit:
            variable.set("unit", unit)
        if causality == "input":
            variable.set("start", " ".join(["0"] * (width * len(port))))
        elif causality == "local":
            variable.set("start", " ".join(map(repr, port.reference.ravel().tolist())))
        else:
            variable.set("initial", "calculated")
            ElementTree.SubElement(structure, "Output", valueReference=str(first + number))
        for size in (len(port), width) if width else ():
            ElementTree.SubElement(variable, "Dimension", start=str(size))
