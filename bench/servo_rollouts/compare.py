"""Records of a servo: the published friction models M1 to M6 in numpy, fitted by CMA-ES, beside our program.

    python3 bench/servo_rollouts/compare.py BUILD RECORDS [--models M1 M4 M6] [--seconds 150] [--members 32]
                                            [--step-ms 1] [--seed 1]

BUILD: a build folder with bin/torquescope, or that program; RECORDS: a folder (servo_records.py). Everybody gets the
same records and one thread. A fit: all training records simulated once for one set of parameters. Seconds are CPU
seconds: of a search (cma_search.py), without reading, until it ends or has used --seconds; ours are those of the whole
process. Errors are mean absolute ones of the position over all samples. CMA-ES is the package `cma` of PyPI.
"""
import argparse
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"  # before numpy is imported
try:
    import numpy  # noqa: F401
except ImportError as absent_numpy:
    sys.exit(f"left out: {absent_numpy}; python3-numpy of the system or of PyPI has it")
import cma_search  # noqa: E402
import friction_models  # noqa: E402
import ours  # noqa: E402
import servo_records  # noqa: E402
import servo_simulation  # noqa: E402
from ours import Missing  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from measure import print_table  # noqa: E402

ERRORS = ["who", "parameters", "fits", "CPU s", "train, mrad", "unseen, mrad", "end"]
RATES = ["fits/s, one thread", "numpy, in the search", f"numpy, {cma_search.CROWD} at once", "our lanes", "ratio",
         "rms in numpy, mrad", "rms in our lanes, mrad"]
LANES = "bench/servo_rollouts/bench_servo_rollouts"


def say(line):
    print(line, file=sys.stderr, flush=True)


def mrad(rad):
    return "" if rad is None else f"{1000 * rad:.2f}"


def searched(wanted, training, validation):
    """A finished search of each model, with its errors."""
    found = []
    for model in wanted.models:
        search = cma_search.search(model, training, wanted.seconds, wanted.members, wanted.seed, found)
        search.train, search.rms = (value[0] for value in servo_simulation.errors(model, search.unit[None], training))
        search.crowd_rate = cma_search.crowd_rate(search, training)
        search.validation = servo_simulation.errors(model, search.unit[None], validation)[0][0] if validation else None
        say(f"{model}: {search.fits} fits, {mrad(search.train)} mrad; "
            + ", ".join(f"{name} {value:.4g}" for name, value in search.numbers().items()))
        found.append(search)
    return found


def error_rows(searches, diagnosed, seconds):
    rows = [[f"{search.model}, numpy and CMA-ES", len(search.unit), search.fits, f"{search.seconds:.0f}",
             mrad(search.train), mrad(search.validation), "; ".join(search.ends)] for search in searches]
    if diagnosed:
        laws = ", ".join(one["name"] for one in diagnosed["kept"]) or "no law"
        for who, key, when, cpu_s, end in (("torquescope, the job's model", "parameters_before", "before", "", ""),
                                           ("torquescope diagnose", "parameters", "after", f"{seconds:.0f}", laws)):
            both = [mrad(diagnosed["error"][part][when]) for part in ("train", "validate")]
            rows.append([who, len(diagnosed[key]), "", cpu_s, *both, end])
    return rows


def rate_rows(searches, lanes):
    """The ratio is that to the faster of both ways in numpy."""
    rows = []
    for search in searches:
        rates, lane = [search.fits / search.seconds, search.crowd_rate], lanes.get(search.model)
        ours_too = ([f"{lane['fits_per_second']:.4g}", f"{lane['fits_per_second'] / max(rates):.3g}",
                     mrad(search.rms), mrad(lane["rms_rad"])] if lane else ["", "", mrad(search.rms), ""])
        rows.append([search.model, *[f"{rate:.4g}" for rate in rates], *ours_too])
    for case, who in (("before", "torquescope, the job's model"), ("after", "torquescope, with what it named")):
        if lane := lanes.get(case):
            rows.append([who, "", "", f"{lane['fits_per_second']:.4g}", "", "", mrad(lane["rms_rad"])])
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("records", type=pathlib.Path)
    parser.add_argument("--models", nargs="+", choices=friction_models.MODELS, default=["M1", "M4", "M6"])
    parser.add_argument("--seconds", type=float, default=150.0, help="CPU seconds of each search, at most")
    parser.add_argument("--members", type=int, default=32)
    parser.add_argument("--step-ms", type=float, default=1.0, help="of the simulation in numpy, and of our lanes")
    parser.add_argument("--seed", type=int, default=1)
    wanted = parser.parse_args()
    records = servo_records.read_all(wanted.records)
    groups = [[record for record in records if record.role == role] for role in ("train", "validate")]
    if not groups[0]:
        print(f"left out: {wanted.records} holds no records of a servo (a manifest.csv, or train/ and unseen_load/)")
        return
    step_s, load = wanted.step_ms / 1000, os.getloadavg()[0]
    training, validation = [servo_records.Ticks(group, step_s) if group else None for group in groups]
    missing, searches, lanes, seconds, diagnosed = [], [], {}, None, None
    program = wanted.build if wanted.build.is_file() else wanted.build / "bin/torquescope"
    try:
        searches = searched(wanted, training, validation)
    except ImportError as absent:
        missing.append(f"CMA-ES: {absent}; pip install cma gets it")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        try:
            seconds, diagnosed = ours.diagnosis(program, records, folder)
        except Missing as absent:
            missing.append(str(absent))
        cases = {search.model: ours.numbers_of(search.model, search.numbers()) for search in searches}
        if diagnosed:
            for case, key in (("before", "parameters_before"), ("after", "parameters")):
                cases[case] = {one["name"]: one["value"] for one in diagnosed[key]}
        try:
            lanes = ours.lanes(wanted.build / LANES, groups[0], cases, step_s, folder)
        except Missing as absent:
            missing.append(str(absent))
    print(f"{len(groups[0])} records to fit with {len(training.measured)} samples, {len(groups[1])} unseen; "
          f"{wanted.members} members, {wanted.seconds:g} CPU s a search, steps of {wanted.step_ms:g} ms")
    print_table(ERRORS, error_rows(searches, diagnosed, seconds))
    print()
    print_table(RATES, rate_rows(searches, lanes))
    print(f"load {load:.1f} at the start, {os.getloadavg()[0]:.1f} at the end, {os.cpu_count()} cores")
    for line in missing:
        print(f"left out: {line}")


if __name__ == "__main__":
    main()
