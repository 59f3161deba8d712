"""The tables of the page as rows of finished words; page.html only sets them."""

import re

from . import quantities as q, seed, words


def equation(study):
    """The stored line with signs people use: 'ddq' as q̈, and so on."""
    text = study.model.equation or ""
    for plain, sign in (("ddq", "q\u0308"), ("dq", "q\u0307"), ("tau", "τ")):
        text = re.sub(rf"\b{plain}\b", sign, text)
    return text


def parameters(study):
    """{"head": [...], "rows": [[...]]}: value and intervals of every estimator for every parameter."""
    head = ["parameter", "unit"] + (["truth"] if study.truth_known else [])
    for e in study.estimators:
        head.append(e.label)
        head += [words for _, words in _intervals(e)]
    rows = []
    for index, (name, unit) in enumerate(zip(study.model.names, study.model.units)):
        e = study.lead
        error = words.Z95 * e.standard_error[0][index] if e.standard_error is not None else None
        # enough to show four digits of a value, however wide its interval
        decimals = max(q.decimals_for(error), q.decimals_for(None, e.chosen[index]))
        row = [name.replace("_", " "), q.unit(unit)]
        row += [q.fixed(study.model.truth[index], decimals)] if study.truth_known else []
        for e in study.estimators:
            row.append(q.fixed(e.chosen[index], decimals))
            row += [q.fixed(words.Z95 * errors[0][index], decimals) for errors, _ in _intervals(e)]
        rows.append(row)
    return {"head": head, "rows": rows}


def _intervals(e):
    """[(standard errors, their column)] that the file has."""
    known = ((e.standard_error, "± 95 %, HAC"), (e.standard_error_naive, "± if white"))
    return [(errors, words) for errors, words in known if errors is not None]


def joint_form(study):
    """The same friction as viscous, Coulomb and offset; None when the terms do not allow it."""
    names, e = study.model.joint_form_names, study.ols
    if names is None or e is None or e.joint_form is None:
        return None
    said = []
    for name, unit, value, error in zip(
        names, study.model.joint_form_units, e.joint_form[0], e.joint_form_standard_error[0]
    ):
        decimals = q.decimals_for(words.Z95 * error, value)
        said.append(f"{name.replace('_', ' ')} {q.fixed(value, decimals)} ± "
                    + q.with_unit(q.fixed(words.Z95 * error, decimals), unit))
    return q.listed(said)


def correlation(study):
    """Of the regressor's columns: parameters of effects and loops have none."""
    names = [name.replace("_", " ") for name in study.model.names[:len(study.health.correlation)]]
    return {
        "head": [""] + names,
        "rows": [[name] + [q.fixed(value, 2) for value in row] for name, row in zip(names, study.health.correlation)],
    }


def estimators(study):
    """MSE in one unit, or where simulations are judged by another channel than rows, each with its own; the column of
    the floor, or of the fitness of simulations, goes where nobody has it."""
    squares = [q.square(study.error_unit(e)) for e in study.estimators]
    one = squares[0] if len(set(squares)) == 1 else ""
    by_floor, by_fitness = len(study.rolled) < len(study.estimators), bool(study.rolled)
    head = ["estimator", f"MSE, median {one}".strip(), *(["above the floor"] if by_floor else []),
            *(["fitness"] if by_fitness else []), "best MSE", "worst MSE", "std over runs", "evaluations",
            "runs ended by"]
    rows = []
    for e, square in zip(study.estimators, squares):
        several = int(e.runs) > 1
        mse = q.number(e.mse_median, 4)
        gap, fitness = ("–", q.number(e.gap_median, 4)) if e.rolls_out else (q.number(max(e.gap_median, 0.0), 2), "–")
        rows.append([e.label, mse if one else f"{mse} {square}".strip(), *([gap] if by_floor else []),
                     *([fitness] if by_fitness else []),
                     q.number(e.mse_best, 4) if several else "–", q.number(e.mse_worst, 4) if several else "–",
                     q.number(e.mse_std, 2) if several else "–",
                     q.whole(e.evaluations_total) if e.evaluations_total else "–", words.stop_reasons(e)])
    return {"head": head, "rows": rows}


def beside_the_paper(study):
    """Tables 3 and 4 of the paper with ours in them; None when this job is not a study of it."""
    if not study.is_seed_study:
        return None
    ours = {label: next((e for e in study.estimators if e.kind == label.lower()), None) for label in seed.TABLE_3}
    labels = list(seed.TABLE_3)
    third = {"head": ["parameter", "unit"] + [f"{label}, paper" for label in labels]
             + [f"{label}, here" for label in labels if ours[label]], "rows": []}
    for index, (name, unit) in enumerate(zip(study.model.names, study.model.units)):
        third["rows"].append(
            [name.replace("_", " "), q.unit(unit)]
            + [q.fixed(seed.TABLE_3[label][index], 4) for label in labels]
            + [q.fixed(ours[label].parameters_mean[index], 4) for label in labels if ours[label]]
        )
    fourth = {
        "head": ["", "MSE, paper", "std, paper", "std at most", "MSE, here", "std of the residual, here"],
        "rows": [],
    }
    for label in labels:
        mse, deviation = seed.TABLE_4[label]
        e = ours[label]
        fourth["rows"].append([label, q.fixed(mse, 5), q.fixed(deviation, 3), q.fixed(seed.largest_deviation(label), 3),
                               q.fixed(e.mse_median, 5) if e else "–", q.fixed(e.residual_std_median, 3) if e else "–"])
    return {"third": third, "fourth": fourth, "most": q.listed(row[3] for row in fourth["rows"]),
            "claimed": q.listed(row[2] for row in fourth["rows"]),
            "fade_change": q.percent(seed.TABLE_4["FADE"][0] / seed.TABLE_4["OLS"][0] - 1)}


def provenance(study):
    """[(what, value)] for the fold at the end."""
    p = study.provenance
    told = [("program", study.creator), ("started", p.started), ("finished", p.finished),
            ("took", q.seconds(p.seconds) if p.seconds is not None else None), ("machine", p.host),
            ("threads", f"{p.threads} ({p.threads_reason})" if p.threads_reason else p.threads),
            ("vector instructions", p.vector_target), ("version", p.version), ("compiler", p.compiler),
            ("build", p.build_type), ("HDF5", p.hdf5_version), ("Eigen", p.eigen_version), ("seed", study.job.seed),
            ("job sha256", study.job.sha256), ("result sha256", study.digest)]
    for which, data in (("training", study.train), ("validation", study.validate)):
        if data is not None:
            told += [(f"{which} data", f"{name}, sha256 {digest}")
                     for name, digest in zip(data.recordings or [], data.sha256 or [])]
    return [(what, value) for what, value in told if value not in (None, "")]


def filters(study):
    """How the samples were made from the recording."""
    data = study.train
    said = []
    if data.cutoff_hz:
        said.append(
            f"motion low-passed at {q.tick(data.cutoff_hz)} Hz" + (f", order {data.order}" if data.order else "")
        )
    if data.parallel_cutoff_hz:
        said.append(f"both sides of the equation at {q.tick(data.parallel_cutoff_hz)} Hz")
    if data.kept_rate_hz and data.rate_hz and data.kept_rate_hz != data.rate_hz:
        said.append(f"kept at {q.tick(data.kept_rate_hz)} Hz of {q.tick(data.rate_hz)} Hz")
    return (said[0][0].upper() + said[0][1:] + "".join(f"; {text}" for text in said[1:]) + ".") if said else ""
