"""The lines of jobs/slurm/README.md about PBS, Flux and xargs, run as they stand: the merged result is that of one
process, byte for byte.

xargs is the real one; `qsub` and `flux` are stand-ins that set the variables of the real ones, task after task.
"""

import filecmp
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import program
import simulated_job

HERE = os.path.dirname(os.path.abspath(__file__))
README = os.path.join(HERE, "..", "..", "jobs", "slurm", "README.md")

# an array of a script, or one command after `--`; both begin in another folder than the one of the call
QSUB = r"""#!/bin/bash
export PBS_O_WORKDIR=$PWD
cd "$HOME" || exit 1
while [ $# -gt 1 ] && [ "$1" != -- ]; do echo "$1" >> "$PBS_O_WORKDIR/qsub.options"; shift; done
if [ "$1" = -- ]; then shift; exec "$@" >&2; fi
range=$(sed -n 's/^#PBS -J //p' "$PBS_O_WORKDIR/$1")
for PBS_ARRAY_INDEX in $(seq "${range%-*}" "${range#*-}"); do
  export PBS_ARRAY_INDEX
  bash "$PBS_O_WORKDIR/$1" >&2 || exit
done
echo '7[].server'
"""
# every copy of a command
FLUX = r"""#!/bin/bash
[ "$1" = submit ] || exit 64
shift
while [ "${1#-}" != "$1" ]; do
  case $1 in --cc=*) range=${1#--cc=} ;; esac
  shift
done
for FLUX_JOB_CC in $(seq "${range%-*}" "${range#*-}"); do
  export FLUX_JOB_CC
  "$@" || exit
done
"""


def documented():
    """The blocks by their names."""
    with open(README, encoding="utf-8") as file:
        return dict(re.findall(r"<!-- arrays: (\S+) -->\n```sh\n(.*?)```", file.read(), re.DOTALL))


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.blocks = documented()
        cls.home = tempfile.mkdtemp(prefix="torquescope_arrays_")
        cls.addClassCleanup(shutil.rmtree, cls.home)
        cls.programs = os.path.join(cls.home, "bin")
        os.mkdir(cls.programs)
        for name, text in (("qsub", QSUB), ("flux", FLUX)):
            path = os.path.join(cls.programs, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            os.chmod(path, 0o755)
        os.symlink(program.PROGRAM, os.path.join(cls.programs, "torquescope"))
        cls.whole = cls.folder()
        cls.sh(cls.whole, "torquescope run lab.toml --threads 1")

    @classmethod
    def folder(cls):
        folder = tempfile.mkdtemp(dir=cls.home)
        with open(os.path.join(folder, "lab.toml"), "w", encoding="utf-8") as file:
            file.write(simulated_job.job([{"name": "de", "population": 10, "generations": 15}],
                                         experiment={"name": "lab", "runs": 6}))
        return folder

    @classmethod
    def sh(cls, folder, text):
        environment = {**os.environ, "PATH": cls.programs + ":" + os.environ["PATH"], "HOME": cls.home}
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", text], cwd=folder, env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{done.returncode}: {text}\n{done.stderr}")

    def assert_same(self, folder):
        self.assertTrue(filecmp.cmp(os.path.join(folder, "lab.h5"), os.path.join(self.whole, "lab.h5"), shallow=False))
        self.assertFalse(os.path.exists(os.path.join(folder, "lab.h5.parts")))

    def test_every_block_is_one_of_these_tests(self):
        self.assertEqual(set(self.blocks), {"xargs", "share.pbs", "pbs", "flux"})

    def test_xargs(self):
        folder = self.folder()
        self.sh(folder, self.blocks["xargs"])
        self.assert_same(folder)

    def test_pbs(self):
        folder = self.folder()
        with open(os.path.join(folder, "share.pbs"), "w", encoding="utf-8") as file:
            file.write(self.blocks["share.pbs"])
        self.sh(folder, self.blocks["pbs"])
        self.assert_same(folder)
        with open(os.path.join(folder, "qsub.options"), encoding="utf-8") as file:
            self.assertEqual(file.read().split(), ["-W", "depend=afterok:7[].server"])

    def test_flux(self):
        folder = self.folder()
        self.sh(folder, self.blocks["flux"])
        self.assert_same(folder)


if __name__ == "__main__":
    unittest.main()
