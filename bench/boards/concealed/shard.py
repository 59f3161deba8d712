"""Which share of the cases is this process's? Names are dealt by their hash, so that each share is a sample of all:
sizes, effects and rigs of the list come round in cycles, and every eighteenth pair had the same size.

    of("3/40", {})                  (3, 40)   shards count from 0
    of(None, os.environ)            the task of a Slurm array, or the process of an srun step; None outside both
"""

import hashlib
import os
import re
import sys


def of(wanted, environment):
    """(index, count) or None when there is one process for everything; ValueError with what to write instead."""
    if wanted is not None:
        match = re.fullmatch(r"(\d+)/(\d+)", wanted)
        if not match or int(match[1]) >= int(match[2]):
            raise ValueError(f"--shard {wanted}: write I/N with I from 0 to N-1, for example 3/40")
        return int(match[1]), int(match[2])
    number = lambda key, default: int(environment.get(key) or default)
    if environment.get("SLURM_ARRAY_TASK_COUNT"):
        # an array may begin anywhere and leave steps out
        place = number("SLURM_ARRAY_TASK_ID", 0) - number("SLURM_ARRAY_TASK_MIN", 0)
        return place // number("SLURM_ARRAY_TASK_STEP", 1), number("SLURM_ARRAY_TASK_COUNT", 1)
    # the batch script itself is process 0 of its tasks as well, but runs alone: only srun numbers its steps
    if environment.get("SLURM_STEP_ID") and number("SLURM_NTASKS", 1) > 1:
        return number("SLURM_PROCID", 0), number("SLURM_NTASKS", 1)
    return None


def share(cases, shard):
    """The cases of this shard, in their order; all of them without one. Shares differ by one case at most."""
    if shard is None:
        return cases
    dealt = sorted(range(len(cases)), key=lambda k: hashlib.sha256(str(cases[k]).encode()).digest())
    return [cases[k] for k in sorted(dealt[shard[0]::shard[1]])]


def main(words):
    """Prints I/N, or nothing when there is one process for everything."""
    try:
        found = of(words[0] if words and words[0] else None, os.environ)
    except ValueError as problem:
        print(problem, file=sys.stderr)
        return 64
    print("" if found is None else f"{found[0]}/{found[1]}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
