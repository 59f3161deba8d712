"""The runner with a folder made up of simulated recordings: what it runs, keeps, grades and leaves alone.

    test_run_real.py MAKE_CASE

The recordings are of the independent plant (concealed). A stand-in for the engine reads the recording that its job
names, for a wrong path must show, and says what the case's name is in SAYS.
"""

import contextlib
import io
import json
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

import run_real

MAKE_CASE = None
JOB = """[experiment]
name = "made_up"

[recording]
train = "../rig/train.csv"
validate = "../rig/validate.csv"

[diagnose]
effects = "all"
twins = 200
"""
SAYS = {  # case: verdict, names, error after (0.4 before)
    "acceptable": ("unexplained", [], 0.4),
    "gains_nothing": ("named", ["stribeck"], 0.399),
    "part": ("partly", ["stribeck"], 0.2),
    "right": ("named", ["stribeck"], 0.1),
    "useless": ("insufficient", [], 0.4),
    "wrong": ("named", ["cogging"], 0.1),
}
STAND_IN = """#!{python}
import json, pathlib, re, sys
job = pathlib.Path(sys.argv[2])
text = job.read_text()
for key in ("train", "validate"):
    name = re.search(key + ' = "(.*)"', text)[1]
    assert (job.parent / name).read_text().count("\\n") > 1000, name
with open("{calls}", "a") as calls:
    calls.write(json.dumps([job.stem, re.search("twins = .*", text)[0], sys.argv[3:]]) + "\\n")
verdict, names, after = json.loads('{says}')[job.stem]
effects = [dict(name=name, equivalent=[], parameters=[]) for name in names]
joint = dict(effects=effects, baseline=dict(validation_relerr=0.4), augmented=dict(validation_relerr=after))
if verdict == "partly":
    joint["explained"] = dict(share=0.714)
out = sys.argv[sys.argv.index("--json") + 1]
json.dump(dict(schema=1, verdict=verdict, reason="", joints=[joint]), open(out, "w"))
"""


class RunReal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.rig = pathlib.Path(folder.name) / "clean_1"
        subprocess.run([MAKE_CASE, "--clean", "1", folder.name], check=True, capture_output=True)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.at = pathlib.Path(folder.name)
        self.folder, self.out, self.calls = self.at / "recordings", self.at / "out", self.at / "calls.txt"
        (self.folder / "jobs").mkdir(parents=True)
        shutil.copytree(self.rig, self.folder / "rig")
        for name in SAYS:
            (self.folder / "jobs" / f"{name}.toml").write_text(JOB)
        answer = {"needs": [["stribeck"]], "acceptable": ["unexplained"], "useless": ["insufficient"]}
        self.answer(dict.fromkeys(SAYS, answer))
        self.program = self.at / "stand_in"
        self.program.write_text(STAND_IN.format(python=sys.executable, calls=self.calls, says=json.dumps(SAYS)))
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)

    def answer(self, cases):
        (self.folder / "answers.json").write_text(json.dumps({"cases": cases}))

    def run_real(self, *options, folder=None):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = run_real.main([str(self.program), str(folder or self.folder), str(self.out), *options])
        return code, out.getvalue(), err.getvalue()

    def called(self):
        return [json.loads(line) for line in self.calls.read_text().splitlines()] if self.calls.exists() else []

    def test_each_grade_is_given_and_counted(self):
        before = sorted(path.name for path in self.folder.rglob("*"))
        code, text, error = self.run_real("--twins", "60", "--threads", "1")
        self.assertEqual(code, 0, error)
        board = json.loads((self.out / "real.json").read_text())
        grades = {row["case"]: row["grade"] for row in board["cases"]}
        self.assertEqual(grades, {name: {"gains_nothing": "wrong", "part": "right"}.get(name, name) for name in SAYS})
        self.assertEqual(board["grades"], {"right": 2, "acceptable": 1, "useless": 1, "wrong": 2})
        self.assertEqual((board["gains_nothing"], board["with_names"]), (1, 4))
        self.assertIn("right 2, acceptable 1, useless 1, wrong 2", text)
        part = next(row for row in board["cases"] if row["case"] == "part")
        self.assertEqual(part["explained"], 0.714)
        self.assertRegex(text, r"part +right +partly +unseen +40\.0 +20\.0 +71 ")
        self.assertRegex(text, r"right +right +named +unseen +40\.0 +10\.0 +- ")
        self.assertEqual({(twins, one[-2:] == ["--threads", "1"]) for _, twins, one in self.called()},
                         {("twins = 60", True)})
        self.assertEqual(sorted(path.name for path in self.folder.rglob("*")), before)
        self.assertIn("twins = 200", (self.folder / "jobs" / "right.toml").read_text())

    def test_what_is_finished_is_not_run_again(self):
        self.run_real("--only", "right", "--only", "wrong")
        self.assertEqual([name for name, *_ in self.called()], ["right", "wrong"])
        code, text, _ = self.run_real("--only", "right")
        self.assertEqual((code, len(self.called())), (0, 2))
        self.assertIn("(kept)", text)
        # another number of replicates, another recording, another program: again
        self.run_real("--only", "right", "--twins", "30")
        self.assertEqual(len(self.called()), 3)
        os.utime(self.folder / "rig" / "train.csv", (1, 1))
        self.run_real("--only", "right", "--twins", "30")
        self.assertEqual(len(self.called()), 4)
        self.program.write_text(self.program.read_text() + "\n")
        self.run_real("--only", "right", "--twins", "30")
        self.assertEqual(len(self.called()), 5)

    def test_an_answer_may_name_a_job_elsewhere_in_the_folder(self):
        deep = self.folder / "repro" / "one"
        deep.mkdir(parents=True)
        (deep / "right.toml").write_text(JOB.replace("../rig", "../../rig"))
        self.run_real("--only", "right")  # whose tree has the folder as a link
        self.answer({"repro/one/right": {"needs": [["stribeck"]]}})
        code, _, error = self.run_real("--only", "repro", "--twins", "9")
        self.assertEqual((code, self.called()[-1][:2]), (0, ["right", "twins = 9"]), error)
        self.assertIn("twins = 200", (deep / "right.toml").read_text())

    def test_a_program_that_fails_is_useless(self):
        self.program.write_text(f"#!{sys.executable}\nimport sys\nsys.exit('cannot')\n")
        code, text, _ = self.run_real("--only", "right")
        self.assertEqual(code, 0)
        self.assertIn("useless 1", text)
        self.assertIn("no answer", text)

    def test_without_the_folder_it_says_so_and_does_nothing(self):
        code, text, _ = self.run_real(folder=self.at / "nowhere")
        self.assertEqual(code, 0)
        self.assertIn("skipped: no folder", text)
        self.assertFalse(self.out.exists())

    def test_answers_without_a_job_are_refused_before_anything_runs(self):
        self.answer({"absent": {}})
        code, _, error = self.run_real()
        self.assertEqual((code, self.called()), (66, []))
        self.assertIn("cases.absent: there is no job", error)
        (self.folder / "answers.json").unlink()
        self.assertEqual(self.run_real()[0], 66)
        self.answer({"right": {}})
        self.assertEqual(self.run_real("--only", "left")[0], 64)


if __name__ == "__main__":
    MAKE_CASE = os.path.abspath(sys.argv.pop())
    sys.exit(unittest.main())
