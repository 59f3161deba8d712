"""A sound arm recorded for seconds, with noise: short and noisy is no mistake of its set-up."""

from arm_files import draw_case
from kind_arm_consistent import first_seconds


def draw(rng, folder):
    seconds, noise, off = rng.uniform(4, 10), rng.uniform(0.02, 0.2), rng.uniform(0.0, 0.5)
    case = draw_case(rng, off=off)
    case.train = first_seconds(rng, case.train, seconds, noise)
    case.write(rng, folder)

    def judge(call):
        check = call("check", "job.toml")
        if "lines" not in check.document:
            return check.text[-300:]
        said = [line["text"] for line in check.document["lines"] if line["topic"] in ("arm_setup", "arm_changes_at")]
        return f"{seconds:.1f} s, noise {noise:.2f}, {len(case.joints)} joints: {said}" if said else None

    return judge
