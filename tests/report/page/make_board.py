"""Scoreboards for the tests of their page: made by the scorer itself from truths and verdicts made by hand."""

import json
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[3] / "bench" / "boards" / "concealed"))

import gather  # noqa: E402
import judge  # noqa: E402
import score  # noqa: E402
from example_cases import clean, drawn, effect, true_effect, truth, verdict  # noqa: E402

SIZES = (0.25, 0.5, 1.0, 2.0, 4.0)
FAMILIES = {
    "stribeck": "reversal",
    "presliding": "reversal",
    "speed_drag": "velocity_law",
    "spring": "static_position",
    "gravity": "static_position",
    "position_dependent_friction": "static_position",
    "cogging": "order_locked",
    "delay": "acceleration",
    "friction_drift": "time",
    "load_dependent_friction": "load",
    "periodic_disturbance": "outside",
}
REASON = "Joint 1 loses 0.13 N m extra below 0.047 rad/s in both directions: Stribeck friction (p < 0.005)."


def named(*names):
    said = [{**effect(name, FAMILIES[name]), "q": 0.001 * (i + 1)} for i, name in enumerate(names)]
    return {**verdict("named", said), "reason": REASON}


def concealing(*names, snr):
    return truth(
        effects=[{**true_effect(name, [FAMILIES[name]], snr=snr), "form": "law of two harmonics"} for name in names],
        snr=snr,
    )


def single_cases():
    """Every effect at every size: found from SNR 1 on, but for some that are taken for another or not seen."""
    effects = list(FAMILIES)
    for i, name in enumerate(effects):
        for seed, size in enumerate(SIZES, 1):
            others = {1: named(effects[(i + 3) % len(effects)]), 5: verdict("unexplained"), 7: None, 8: {}}
            found = verdict("none") if size < 1.0 else others.get((i + 2 * seed) % 9, named(name))
            yield drawn(concealing(name, snr=size), f"T1:{name}:{size:g}:{seed}", size), found


def all_cases():
    for seed in range(1, 31):
        yield drawn(clean(), f"T0:{seed}"), verdict("none") if seed != 9 else named("cogging")
    yield from single_cases()
    for seed, size in enumerate((1.0, 2.0, 4.0) * 2, 1):
        for effects, said in (
            (("stribeck", "spring"), ("spring", "stribeck")),
            (("stribeck", "spring", "cogging"), ("cogging", "spring")),
        ):
            name = f"T{len(effects)}:{'+'.join(effects)}:{size:g}:{seed}"
            yield drawn(concealing(*effects, snr=size), name, size), named(*said)
    for name in ("outside_sloshing", "outside_hidden_shaft"):
        yield drawn(truth("unexplained", [true_effect("", ())]), f"T4:{name}:2:1", 2.0), verdict("unexplained")
    yield drawn(truth("insufficient"), "T5:one_direction+stribeck:2:1", 2.0), verdict("insufficient")
    yield drawn({**clean(), "expected": "measurement", "may_name": ["delay"]}, "T6:stamps:1"), named("stribeck")
    yield drawn(clean(), "T7:gains:1"), verdict("none")


def board(cases, rivals=(), left_out=()):
    cases = list(cases)
    judged = lambda answer: [judge.judge(made, answer(said)) for made, said in cases]
    methods = {gather.OURS: judged(lambda said: said)}
    for i, j in enumerate(methods[gather.OURS]):
        j.seconds = 5.0 + 40.0 * (i % 13 == 0) + 0.1 * i
    methods.update({rival: judged(lambda said: named("stribeck")) for rival in rivals})
    suite = {
        "cases": len(cases),
        "truths_sha256": "0123456789abcdef" * 4,
        "suite_seeds": [0],
        "programs_sha256": ["a" * 64],
        "plants_sha256": ["b" * 64],
        "left_out": left_out,
    }
    return score.board_of(gather.Gathered(methods, suite))


CHAOTIC = [{"case": "T1:backlash:2:5", "folder": "698e4f66b498", "step_error": 0.37}]
KINDS = {"board": lambda: board(all_cases(), ("lasso_cross_validation", "iid_f_tests"), CHAOTIC),
         # nothing concealed, nothing found: most of the page has nothing to show
         "board_few": lambda: board(list(all_cases())[:2])}


def real():
    """real.json of bench/boards/real/run_real.py: what was written by hand stands for what was measured."""
    case = {"case": "lab_joint_3", "verdict": "class", "names": [{"name": "cogging", "equivalent": ["torque_ripple"]}],
            "rows": "unseen", "before": 0.88, "after": 0.132, "explained": None, "grade": "right", "why": "",
            "truth": "seven waves per turn", "seconds": 62.0}
    vain = {**case, "case": "wrist", "verdict": "named", "names": [{"name": "contact", "equivalent": []}],
            "after": 0.9, "grade": "wrong", "why": "the held-out error is no lower", "truth": ""}
    part = {**case, "case": "slide", "verdict": "partly", "names": [{"name": "delay", "equivalent": []}],
            "before": 0.06, "after": 0.03, "explained": 0.714, "truth": ""}
    silent = {**case, "case": "sweep", "verdict": "insufficient", "names": [], "rows": "", "before": None,
              "after": None, "grade": None, "why": "no answer is given"}
    earlier = {key: value for key, value in case.items() if not key.startswith("explained")}
    return {"schema": 1, "grades": {"right": 3, "acceptable": 0, "useless": 0, "wrong": 1}, "with_names": 4,
            "gains_nothing": 1, "cases": [case, vain, part, silent, {**earlier, "case": "earlier"}]}


def write(kind, path):
    path.write_text(json.dumps(KINDS[kind]()))
