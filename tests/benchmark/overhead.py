#!/usr/bin/python3
"""What keeping watch costs: ledger, certificate and evaluation of what is watched, as shares of one run.

usage: tests/benchmark/overhead.py --culm build/release/src/culm --benchmark build/release/tests/benchmark/culm_benchmark
       after cmake --build build/release --target culm_benchmark
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.program import Program  # noqa: E402

# deck, settings: two mechanisms of some hundred unknowns, and a larger beam
RUNS = [
    ("turbine/nrel5mw/turbine_operation", ["T=20", "stop=30", "end=50"]),
    ("flight/rotor", []),
    ("flight/spaghetti_3d", ["Refinement=10"]),
]


def scope_cost(program):
    """Seconds that one scope of the ledger takes."""
    command = [program, "--benchmark_filter=BM_LedgerScope", "--benchmark_format=json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return 1e-9 * json.loads(done.stdout)["benchmarks"][0]["cpu_time"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--benchmark", required=True)
    arguments = parser.parse_args()
    scope = scope_cost(arguments.benchmark)
    print(f"one scope of the ledger: {1e9 * scope:.0f} ns")
    print(f"{'deck':40} {'ledger':>8} {'certificate':>12} {'watch':>8} {'sum':>8}")
    for deck, settings in RUNS:
        with tempfile.TemporaryDirectory(prefix="culm") as folder:
            path = ROOT / "inputs" / f"{deck}.xml"
            run = Program(arguments.culm).run(path, folder, settings)
            if not run.succeeded:
                sys.exit(f"{deck}: {run.outcome}\n{run.errors}")
            effects = run.results.effects()
        total = sum(e.seconds for e in effects)
        shares = [
            scope * sum(e.calls for e in effects) / total,
            *(sum(e.seconds for e in effects if e.name == name) / total for name in ("Certificate", "Quantities")),
        ]
        cells = [f"{100.0 * share:.2f} %" for share in [*shares, sum(shares)]]
        print(f"{deck:40} {cells[0]:>8} {cells[1]:>12} {cells[2]:>8} {cells[3]:>8}")


if __name__ == "__main__":
    main()
