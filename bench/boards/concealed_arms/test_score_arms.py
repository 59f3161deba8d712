"""The scorer of arms: made-up verdicts against made-up truths, and the table of their rates."""
import contextlib
import io
import json
import pathlib
import tempfile

import score_arms


def truth(kind="clean", **more):
    return {"case": f"{kind}:test", "kind": kind, "arm": "crs", "joints": 3, "motion": "sines", "snr": 2.0, **more}


SPRING = truth("law", law="spring", families=["static_position"], joint=2)
TILT = truth("law", law="gravity_direction", families=["static_position"], joint=0)
LATE = truth("decoy", decoy="late", joint=2, may_name=["delay", "actuator_lag"])
SWAPPED = truth("decoy", decoy="swapped", joint=2, other=3, may_name=[])


def said(word="named", verdicts=("none", "none", "none"), **names):
    """names: j2=[("spring", "static_position", "cable")], arm=[...]: name, family, the rest of the class"""
    joints = [{"joint": j, "verdict": verdicts[j - 1],
               "effects": [{"name": name, "family": family, "equivalent": kin}
                           for name, family, *kin in names.get(f"j{j}", [])]} for j in (1, 2, 3)]
    whole = [{"name": name, "family": family, "equivalent": kin} for name, family, *kin in names.get("arm", [])]
    return {"verdict": word, "reason": "", "joints": joints, "arm": {"effects": whole}}


def judged(one_truth, verdict):
    row = score_arms.judged(one_truth, verdict, {})
    return [row[key] for key in ("right_joint", "right_family", "exact_or_class", "told", "false_joints")]


def laws():
    spring, cable, drag = (("spring", "static_position"), ("cable", "static_position", "spring"),
                           ("speed_drag", "velocity_law"))
    assert judged(SPRING, said(j2=[spring])) == [True, True, True, False, []]
    assert judged(SPRING, said(j2=[cable])) == [True, True, True, False, []], "a class with it"
    assert judged(SPRING, said(j2=[("cogging", "static_position")])) == [True, True, False, False, []], "its family"
    assert judged(SPRING, said(j2=[drag])) == [True, False, False, False, [2]]
    assert judged(SPRING, said(j2=[spring, drag])) == [True, True, True, False, [2]], "one right, one invented"
    assert judged(SPRING, said(j1=[spring])) == [False, False, False, False, [1]], "another joint"
    assert judged(SPRING, said(j1=[spring], j2=[spring])) == [False, False, False, False, [1]]
    assert judged(SPRING, said("none")) == [False, False, False, False, []]
    assert judged(SPRING, None)[4] == [1, 2, 3], "silence is no caution"


def the_whole_arm():
    tilt, zero, spring = (("gravity_direction", "static_position"), ("joint_zero", "static_position"),
                          ("spring", "static_position"))
    assert judged(TILT, said(arm=[tilt])) == [True, True, True, False, []]
    assert judged(TILT, said(arm=[(*zero, "gravity_direction")])) == [True, True, True, False, []], "a class with it"
    assert judged(TILT, said(arm=[tilt], j2=[spring])) == [False, False, False, False, [2]]
    assert judged(TILT, said(j2=[spring])) == [False, False, False, False, [2]], "of one joint alone"
    assert judged(TILT, said("none")) == [False, False, False, False, []]
    assert judged(SPRING, said(arm=[tilt])) == [False, False, False, False, [0]]


def decoys():
    delay, spring = ("delay", "acceleration"), ("spring", "static_position")
    assert judged(LATE, said(j2=[delay]))[3:] == [True, []]
    assert judged(LATE, said("none"))[3:] == [False, []]
    assert judged(LATE, said(j1=[delay]))[3:] == [False, []], "not the late joint"
    assert judged(LATE, said(j2=[spring]))[3:] == [False, [2]]
    assert judged(SWAPPED, said("unexplained", ("none", "none", "unexplained")))[3:] == [True, []]
    assert judged(SWAPPED, {"verdict": "data_fault", "reason": "", "joints": []})[3:] == [True, []]
    assert judged(SWAPPED, said(j3=[spring]))[3:] == [False, [3]]


def board():
    """Two folders of a suite become one table; a truth that was changed is refused."""
    with tempfile.TemporaryDirectory() as place:
        outs = [pathlib.Path(place) / name for name in ("a", "b")]
        for out, one, verdict in zip(outs, (SPRING, truth()), (said(j2=[("spring", "static_position")]), said("none"))):
            (out / "sealed" / "x").mkdir(parents=True)
            (out / "verdicts").mkdir()
            score_arms.truth_path(out, "x").write_text(json.dumps(one))
            (out / "verdicts" / "x.json").write_text(json.dumps(verdict))
            facts = {"name": one["case"], "seal": score_arms.seal(out, "x"), "diagnosed": {"seconds": 1.0}}
            (out / "made.json").write_text(json.dumps({"x": facts}))
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            assert score_arms.main([*map(str, outs), "--markdown"]) == 0
        assert "| One law, SNR >= 1: right family there | 100.0 % (1 of 1) | 5.0 to 100.0 % | >= 90 % |" in \
            printed.getvalue(), printed.getvalue()
        assert len(json.loads((outs[0] / "arms_board.json").read_text())["cases"]) == 2
        score_arms.truth_path(outs[0], "x").write_text("{}")
        with contextlib.redirect_stderr(io.StringIO()):
            assert score_arms.score(outs) == 65
            assert score_arms.score([pathlib.Path(place) / "nothing"]) == 66


laws()
the_whole_arm()
decoys()
board()
print("verdicts of arms are judged as the scorer says")
