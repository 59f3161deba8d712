"""One arm from its name to its line of the board: made, sealed, diagnosed, scored, and not made twice.

    one_arm.py TORQUESCOPE MAKE_ARM_CASE FOLDER

A spring at the elbow of the five-joint arm. So that it takes seconds the job asks for a few laws only; boards ask for
all (scripts/proof --arms). Exit code 77 where there is no MuJoCo.
"""
import json
import pathlib
import shutil
import sys

import run_arm_suite

NAME = "law:crs:3:spring:4:1"
FEW = 'effects = ["spring", "stribeck", "asymmetric_viscous"]'


class QuickSuite(run_arm_suite.Suite):
    def make(self, folder, name):
        super().make(folder, name)
        job = self.out / "open" / folder / "job.toml"
        text = job.read_text()
        assert 'effects = "all"' in text or FEW in text
        job.write_text(text.replace('effects = "all"', FEW))


def main(program, make_case, folder):
    if not make_case or not pathlib.Path(make_case).is_file():
        print("skipped: without MuJoCo (libmujoco-dev) there is no plant of arms")
        return 77
    out = pathlib.Path(folder)
    shutil.rmtree(out, ignore_errors=True)
    suite = QuickSuite(pathlib.Path(program).resolve(), pathlib.Path(make_case).resolve(), out.resolve(), threads=1)
    (case,) = run_arm_suite.wanted_cases(NAME, suite.make_case)
    suite.run(case, NAME)
    assert "truth.json" not in {path.name for path in (out / "open" / case).iterdir()}
    assert run_arm_suite.score_arms.score([out], [case]) == 0
    (row,) = json.loads((out / "arms_board.json").read_text())["cases"]
    assert row["right_family"] and row["exact_or_class"] and not row["false_joints"], row
    assert not suite.diagnose(case), "the same command does not begin anew"
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
