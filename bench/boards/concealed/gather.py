"""Reads folders of run_suite.py, shards of one suite or whole ones, into judgements: with the runner the only reader of
truths.

    OUT/sealed/NAME/truth.json, OUT/made.json (seal, plant, program, seconds), OUT/verdicts/NAME.json,
    OUT/results/NAME.h5, OUT/rivals/METHOD/NAME.json (verdict_record.py)

A case that lies in two folders must have the same seal and the same verdict, and a truth must still have the seal it
was made with; Contradiction says which does not. A truth that is not exact (judge.Inexact) is left out for every
method, whatever they answered, and the board names it.
"""

import dataclasses
import hashlib
import json
import math
import pathlib

import judge
import verdict_record

OURS = "torquescope"
SEEDS_PER_SUITE = 100000  # drawn_name.hpp


class Contradiction(ValueError):
    """Truths or verdicts that cannot both be."""


class NoTruth(ValueError):
    """Nothing to score."""


@dataclasses.dataclass
class Source:
    """Where one case lies."""
    name: str
    folder: pathlib.Path
    seal: str
    notes: dict

    def truth(self):
        return json.loads((self.folder / "sealed" / self.name / "truth.json").read_text())

    def verdict(self, method):
        if method != OURS:
            return verdict_record.read(self.folder / "rivals" / method / f"{self.name}.json")
        return verdict_record.read(
            self.folder / "verdicts" / f"{self.name}.json", self.folder / "results" / f"{self.name}.h5"
        )


@dataclasses.dataclass
class Gathered:
    methods: dict   # {method: [Judgement]}; ours first
    suite: dict     # what was judged: see describe()


def seal_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def seal_of_all(sources):
    """One hash for the sealed truths of a suite, whatever order or folders they lie in."""
    return hashlib.sha256("".join(sorted(f"{s.name} {s.seal}\n" for s in sources)).encode()).hexdigest()


def find(folders, names=None):
    """-> {name: Source}; `names` leaves out what an earlier command put into the same folder."""
    found = {}
    for folder in map(pathlib.Path, folders):
        path = folder / "made.json"
        made = json.loads(path.read_text()) if path.exists() else {}
        for truth in sorted(folder.glob("sealed/*/truth.json")):
            name = truth.parent.name
            if names is not None and name not in names:
                continue
            source = Source(name, folder, seal_of(truth), made.get(name, {}))
            if source.notes.get("seal", source.seal) != source.seal:
                raise Contradiction(f"{truth} is not the truth that was sealed: delete {folder / 'sealed' / name} and "
                                    f"{folder / 'open' / name} and make it again")
            if name in found:
                _same(found[name], source)
            # of two, the one that has an answer
            if name not in found or found[name].verdict(OURS) is None:
                found[name] = source
    if not found:
        raise NoTruth(f"no truth in {', '.join(map(str, folders))}")
    return found


def _same(first, second):
    if first.seal != second.seal:
        raise Contradiction(
            f"{first.name}: sealed as {first.seal[:12]} in {first.folder} and as {second.seal[:12]} in {second.folder}"
        )
    one, other = (s.verdict(OURS) for s in (first, second))
    # a verdict that is not there yet contradicts nothing
    if one is not None and other is not None and one != other:
        raise Contradiction(f"{first.name}: another verdict in {second.folder} than in {first.folder}")


def _judged(source, method):
    found = judge.judge(source.truth(), source.verdict(method))
    found.seal = source.seal
    if method == OURS:
        found.seconds = source.notes.get("diagnosed", {}).get("seconds")
    return found


def exact(sources):
    """-> (those with an exact truth, [{case, folder, step_error}] of the others), by their truths alone."""
    kept, left_out = [], []
    for source in sources:
        truth = source.truth()
        try:
            judge.check_truth(truth)
            kept.append(source)
        except judge.Inexact as problem:
            known = problem.step_error if math.isfinite(problem.step_error) else None
            left_out.append({"case": truth.get("drawn") or truth["case"], "folder": source.name, "step_error": known})
    return kept, sorted(left_out, key=lambda one: one["case"])


def _place(judgement):
    """Tier by tier, in the order of seeds."""
    *words, seed = (judgement.drawn or f"{judgement.case}:0").split(":")
    return words[0] if judgement.drawn else "", int(seed), words


def describe(sources, judgements, left_out):
    """Cases judged and left out, the hash of all their truths, suites of their seeds, and the programs that made and
    diagnosed them."""
    seeds = {int(j.drawn.rsplit(":", 1)[1]) // SEEDS_PER_SUITE for j in judgements if j.drawn}
    engines = {s.notes.get("diagnosed", {}).get("engine") for s in sources} - {None}
    plants = {s.notes.get("plant") for s in sources} - {None}
    return {
        "cases": len(judgements),
        "left_out": left_out,
        "truths_sha256": seal_of_all(sources),
        "suite_seeds": sorted(seeds),
        "programs_sha256": sorted(engines),
        "plants_sha256": sorted(plants),
    }


def gather(folders, names=None):
    """-> Gathered; Contradiction, NoTruth, or ValueError of a damaged truth."""
    sources = list(find(folders, names).values())
    kept, left_out = exact(sources)
    if not kept:
        raise NoTruth(f"no exact truth in {', '.join(map(str, folders))}")
    rivals = {path.name for folder in map(pathlib.Path, folders) for path in folder.glob("rivals/*") if path.is_dir()}
    methods = {method: sorted((_judged(source, method) for source in kept), key=_place)
               for method in (OURS, *sorted(rivals - {OURS}))}
    return Gathered(methods, describe(sources, methods[OURS], left_out))
