"""board.h5: the scoreboard as HDF5, to be read without this repository.

    /                       attributes: what it is, schema, truths_sha256, programs_sha256, plants_sha256, suite_seeds,
                            cases, left_out (names of cases whose plant was not exact: in no rate)
    /cases                  one entry per case, the same order everywhere: case (folder), drawn (name), tier, seed,
                            seal, concealed, expected, snr_eff, wanted_snr, joint, controller, law, noise, train
    /methods/M/cases        verdict, names, false_names, right, n_named, level and iou of the first effect,
                            parameter_error, gap_closed, loop_ratio, seconds, reason; texts are lists joined by ", "
    /methods/M/table        one entry per row of the table: words, value, low, high, n, hits, pass, pass_holds, stretch,
                            ...
    /methods/M/confusion/effects, families     rows, columns, counts [row][column]
    /methods/M/power        tier, size, then hits, n, low, high of exact, class, family, guess (three of them),
                            false_name
    /methods/M/confidence   bins: from, to, n, stated, right, low, high; attributes n, brier, ece

Every dataset has the attributes unit and long_name. What is unknown is NaN, a count that is unknown -1. Texts have a
fixed length (UTF-8).
"""

import math

import h5py
import numpy as np

UNITS = {"seconds": "s"}
LONG = {
    "snr_eff": "smallest effect: rms of the residual after baseline refit over the noise",
    "wanted_snr": "size each effect was made with",
    "low": "one-sided 95 % lower bound",
    "high": "one-sided 95 % upper bound",
    "iou": "shared over joint occupancy of reported and true region",
    "gap_closed": "(baseline - augmented) / (baseline - oracle) relative error on unseen data; "
                  "oracle: true laws, recorded motion",
    "loop_ratio": "closed-loop position error of the unseen recording, after over before",
    "seal": "SHA-256 of the sealed truth",
    "level": "how the first true effect was found",
    "parameter_error": "relative error of the main parameter",
    "train": "motion of the training recording",
}


def put(group, name, values, long_name=None):
    """A list of texts, truths, whole numbers or numbers (None: unknown) as one dataset."""
    if all(isinstance(value, str) for value in values):
        longest = max((len(value.encode()) for value in values), default=1)
        data = np.array([value.encode() for value in values], dtype=h5py.string_dtype("utf-8", max(1, longest)))
    elif all(isinstance(value, (bool, int)) or value is None for value in values) and any(
        value is not None for value in values
    ):
        data = np.array([-1 if value is None else int(value) for value in values], dtype=np.int64)
    else:
        data = np.array([math.nan if value is None else value for value in values], dtype=np.float64)
    dataset = group.create_dataset(name, data=data)
    dataset.attrs["unit"] = UNITS.get(name, "1")
    dataset.attrs["long_name"] = long_name or LONG.get(name, name.replace("_", " "))


def put_rows(group, rows, keys):
    for key in keys:
        put(group, key, [row[key] for row in rows])


def _joined(words):
    return ", ".join(words)


def _first(case, key):
    return case["found"][0][key] if case["found"] else None


def write_cases(group, cases):
    put(group, "case", [c["case"] for c in cases])
    put_rows(group, cases, ("drawn", "tier", "seal", "expected", "wanted_snr"))
    put(
        group,
        "seed",
        [int(c["drawn"].rsplit(":", 1)[1]) if c["drawn"] else None for c in cases],
        "seed in the name of a drawn case",
    )
    put(group, "concealed", [_joined(c["concealed"]) for c in cases])
    put(group, "snr_eff", [min((f["snr"] for f in c["found"]), default=c["snr"]) for c in cases])
    for part in ("joint", "controller", "law", "noise", "train"):
        put(group, part, [str(c["rig"].get(part, "")) for c in cases])


def write_method(group, method):
    cases, said = method["cases"], group.create_group("cases")
    put_rows(said, cases, ("verdict", "right", "n_named", "gap_closed", "loop_ratio", "seconds", "reason"))
    put(said, "names", [_joined(name for name, *_ in c["names"]) for c in cases])
    put(said, "false_names", [_joined(c["false_names"]) for c in cases])
    put(said, "level", [_first(c, "level") or "" for c in cases])
    for key in ("iou", "parameter_error"):
        put(said, key, [_first(c, key) for c in cases])
    keys = method["table"][0].keys()
    put_rows(group.create_group("table"), method["table"], keys)
    for kind, matrix in method["confusion"].items():
        here = group.create_group(f"confusion/{kind}")
        if matrix["rows"]:
            put(here, "rows", matrix["rows"], "what was concealed")
            put(here, "columns", matrix["columns"], "what was said first, or the verdict without a name")
            here.create_dataset("counts", data=np.array(matrix["counts"], dtype=np.int64)).attrs.update(
                {"unit": "1", "long_name": "cases [row][column]"})
    if method["power"]:
        power = group.create_group("power")
        put_rows(power, method["power"], ("tier", "size"))
        for level in ("exact", "class", "family", "guess", "false_name"):
            put_rows(power.create_group(level), [row[level] for row in method["power"]], ("hits", "n", "low", "high"))
    sure = group.create_group("confidence")
    for key in ("n", "brier", "ece"):
        known = method["confidence"][key]
        sure.attrs[key] = math.nan if known is None else known
    if method["confidence"]["bins"]:
        put_rows(sure, method["confidence"]["bins"], ("from", "to", "n", "stated", "right", "low", "high"))


def write(path, board):
    """board: what score.board_of returns."""
    suite = board["suite"]
    unfinished = path.with_suffix(".h5.new")
    with h5py.File(unfinished, "w") as file:
        file.attrs.update(
            {
                "title": "Torquescope scoreboard of concealed effects",
                "schema": board["schema"],
                "cases": suite["cases"],
                "truths_sha256": suite["truths_sha256"],
                "suite_seeds": np.array(suite["suite_seeds"], dtype=np.int64),
            }
        )
        for key in ("programs_sha256", "plants_sha256"):
            file.attrs[key] = ", ".join(suite[key])
        file.attrs["left_out"] = _joined(one["case"] for one in suite["left_out"])
        write_cases(file.create_group("cases"), next(iter(board["methods"].values()))["cases"])
        for name, method in board["methods"].items():
            group = file.create_group(f"methods/{name}")
            group.attrs["method"] = name
            write_method(group, method)
    unfinished.replace(path)
