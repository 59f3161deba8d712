"""What one method said about one case, in the one form the scorer reads.

Ours        OUT/verdicts/NAME.json, the document of `torquescope diagnose --json`; its ranking and the closed-loop
            simulation are read from OUT/results/NAME.h5 (engine/store/RESULT_FORMAT.md, /diagnosis)
A rival     OUT/rivals/METHOD/NAME.json, one file per case, NAME being the folder of the case:
              {"case": NAME, "verdict": one of VERDICTS,
               "effects": [{"name", "family"}, ...]}            strongest first, words of `torquescope list effects`
            An effect may also have  "equivalent": [names], "q" or "confidence" (0 to 1: chance that the name is right),
            "region": {"axis", "from", "to"} or {"axis", "places": [[from, to], ...]}, "parameters": [{"name", "value",
            "ci95"}]; the record "ranking": [{"name", "family"}] (named or not, strongest first), "unseen": {"before",
            "after"} (relative errors on the unseen recording), "reason", "seconds".
A rival is judged by the same functions against the same truths. What a method does not say is not scored; a file that
is missing is a case without an answer.
"""

import json

VERDICTS = ("none", "named", "class", "partly", "unexplained", "insufficient", "data_fault")


class Invalid(ValueError):
    """The verdict does not follow its schema."""


def of(verdict):
    """The record of a parsed verdict of either kind; Invalid when it is neither."""
    try:
        record = _of_diagnosis(verdict) if "joints" in verdict else dict(verdict)
        if record["verdict"] not in VERDICTS:
            raise Invalid(f"no verdict is called {record['verdict']}")
        for effect in record["effects"]:
            effect["name"], effect["family"]
    except (KeyError, TypeError, IndexError, AttributeError) as problem:
        raise Invalid(f"{type(problem).__name__}: {problem}") from problem
    return {"ranking": [], "unseen": None, "loop": None, "seconds": None, "reason": "", **record}


def _of_diagnosis(verdict):
    if verdict["schema"] != 1:
        raise Invalid("another schema")
    record = {"verdict": verdict["verdict"], "effects": [], "reason": verdict.get("reason", "")}
    record.update({key: verdict[key] for key in ("ranking", "loop", "seconds") if key in verdict})
    if verdict["joints"]:
        joint = verdict["joints"][0]
        record["effects"] = [
            _placed(effect, verdict.get("places", {}).get(effect["name"])) for effect in joint["effects"]
        ]
        record["unseen"] = {"before": joint["baseline"]["validation_relerr"],
                            "after": (joint.get("augmented") or {}).get("validation_relerr")}
    return record


def _placed(effect, places):
    """A region on both sides of zero is two intervals; the document has the stronger one, the result has both."""
    return {**effect, "region": {**effect["region"], "places": places}} if places and effect.get("region") else effect


def confidence_of(effect):
    """Chance of being right that a name states: one minus the false discovery rate it was named at; None when it states
    none."""
    if effect.get("confidence") is not None:
        return effect["confidence"]
    return None if effect.get("q") is None else 1.0 - effect["q"]


def read(path, result=None):
    """The parsed verdict with what its result adds; None when missing, empty when it is no JSON: both are failures."""
    try:
        verdict = json.loads(path.read_text())
    except FileNotFoundError:
        return None
    except ValueError:
        return {}
    if not isinstance(verdict, dict):
        return {}
    return {**verdict, **_beside(result)} if result is not None and result.exists() else verdict


def _text(word):
    return word.decode() if isinstance(word, bytes) else str(word)


def _beside(path):
    """Ranking of the first joint's candidates, strongest first, and the closed loop of its last recording."""
    import h5py  # only here: verdicts can be judged without it
    found = {}
    with h5py.File(path, "r") as file:
        joint = file.get("diagnosis/joint_1", {})
        if "candidates" in joint:
            columns = (map(_text, joint["candidates"][key][()]) for key in ("names", "families", "decisions"))
            found["ranking"] = [{"name": name, "family": family} for name, family, decision in zip(*columns)
                                if decision != "not tested"]
        if "forward" in joint:
            before, after = (float(joint["forward"][key][-1]) for key in ("before_rms", "after_rms"))
            found["loop"] = {"before": before, "after": after}
        found["places"] = {_text(effect.attrs["name"]): [list(map(float, place)) for place in
                                                         zip(effect["places/from"], effect["places/to"])]
                           for effect in joint.get("effects", {}).values() if "places" in effect}
    return found
