"""The smallest job that has everything (three runs, a result, segments), and the program with shim.c under it."""

import os
import shutil

import study
from study import simulated_job

SHIM = os.environ["TORQUESCOPE_SHIM"]

JOB = simulated_job.job([{"name": "fade", "population": 10, "generations": 20}], experiment={"name": "tiny"})

RUN = ("run", "job.toml", "--out", "r.h5", "--threads", "1")
MERGE = ("merge", "job.toml", "--out", "r.h5", "--threads", "1")


def shard(index, count):
    return (*RUN, "--shard", f"{index}/{count}")


def changes(folder, **settings):
    """The environment that puts the shim under a process: shim(folder, nth=3, error="EIO")."""
    given = {"SHIM_" + key.upper(): str(value) for key, value in settings.items()}
    # a sanitizer wants to be the first library; of a file that it could not close, HDF5 itself leaks what it knew
    return {
        "LD_PRELOAD": SHIM,
        "SHIM_FOLDER": folder.path,
        "ASAN_OPTIONS": "verify_asan_link_order=0:detect_leaks=0",
        **given,
    }


class ShimmedTest(study.FaultTest):
    JOB = JOB

    def run_in(self, folder, command):
        """As it is, but that fsync waits for no disk: there are thousands of these."""
        return folder.run(*command, changes=changes(folder))

    def copy_of(self, folder):
        path = self.new_path()
        shutil.copytree(folder.path, path, dirs_exist_ok=True)
        return study.Folder(path, self.JOB)

    def prepared(self, *commands):
        """A folder in which these commands have ended well."""
        folder = self.folder(self.JOB)
        for command in commands:
            self.assert_ended(self.run_in(folder, command), 0)
        return folder
