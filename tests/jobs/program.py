"""Runs the built torquescope in a pipe or on a pseudo-terminal and keeps what it said."""

import dataclasses
import os
import pty
import re
import signal
import subprocess
import time

PROGRAM = os.environ.get("TORQUESCOPE", "torquescope")
# far beyond what any of these commands needs: a hang is a failure, not a slow machine; presets with a sanitizer say
# how many times as long
SECONDS = 60 * int(os.environ.get("TORQUESCOPE_TIMES_AS_LONG", "1"))


@dataclasses.dataclass
class Outcome:
    code: int
    out: str
    err: str

    @property
    def said(self):
        """stderr without its [codes], every run of blanks one space: words, wherever the lines broke."""
        return " ".join(re.sub(r"\[\d\d\]\n", "\n", self.err).split())


def environment(changes=None):
    """A plain one: no colour wishes, no batch system, UTF-8."""
    wishes = ("NO_COLOR", "CLICOLOR_FORCE", "CI", "SLURM_JOB_ID", "SLURM_CPUS_PER_TASK")
    kept = {key: value for key, value in os.environ.items() if key not in wishes}
    kept.update({"LC_ALL": "C.UTF-8", "TERM": "xterm", "OMP_NUM_THREADS": "2"})
    kept.update(changes or {})
    return kept


def run(*arguments, folder=None, changes=None):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, env=environment(changes), stdin=subprocess.DEVNULL,
                          capture_output=True, timeout=SECONDS, check=False)
    return Outcome(done.returncode, done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace"))


def run_on_terminal(*arguments, folder=None, changes=None):
    """stdout and stderr on one pseudo-terminal; returns the code and all that was written."""
    main, other = pty.openpty()
    process = subprocess.Popen([PROGRAM, *arguments], cwd=folder, env=environment(changes), stdin=subprocess.DEVNULL,
                               stdout=other, stderr=other)
    os.close(other)
    written = b""
    while True:
        try:
            piece = os.read(main, 65536)
        except OSError:  # the other side is closed
            break
        if not piece:
            break
        written += piece
    os.close(main)
    return process.wait(timeout=SECONDS), written.decode("utf-8", "replace")


def start(*arguments, folder=None):
    return subprocess.Popen([PROGRAM, *arguments], cwd=folder, env=environment(), stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def wait_for_line(process, words):
    """Reads stderr until a line holds the words; False when it ended before."""
    deadline = time.monotonic() + SECONDS
    while time.monotonic() < deadline:
        line = process.stderr.readline().decode("utf-8", "replace")
        if not line:
            return False
        if words in line:
            return True
    return False


def interrupt(process):
    process.send_signal(signal.SIGINT)


def plain(text):
    """Text of a terminal without colours and carriage returns, and without lines that were redrawn."""
    text = re.sub(r"\x1b\[[0-9;]*m", "", text.replace("\r\n", "\n"))
    return "\n".join(line.split("\r")[-1] for line in text.split("\n"))
