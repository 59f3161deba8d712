"""Sixty seconds of clang's libFuzzer for every reader of foreign files, and what comes of its findings.

A finding in our code fails. Where a foreign library crashes, loops or swallows memory (HDF5, matio: neither is compiled
with the sanitizers, both are known to), the built program must turn the same file into a refusal, because it reads it
in a child.

Use: scripts/test --full; by hand, with TORQUESCOPE_FUZZ_SECONDS=600 for longer and ... minute.py hdf5 for one of them:
     TORQUESCOPE=build/release/bin/torquescope FUZZERS=build/fuzz/tests/fuzz /usr/bin/python3 tests/fuzz/minute.py
"""

import concurrent.futures
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
FUZZERS = os.path.abspath(os.environ["FUZZERS"])
os.environ["TORQUESCOPE"] = os.path.abspath(os.environ["TORQUESCOPE"])
os.environ["MAKE_SEGMENT"] = os.path.join(FUZZERS, "make_segment")
sys.path.insert(0, os.path.join(HERE, "..", "jobs"))

import program  # noqa: E402
import seeds  # noqa: E402

SECONDS = int(os.environ.get("TORQUESCOPE_FUZZ_SECONDS", "60"))
PATIENCE = 60  # seconds beyond these
LIMITS = ["-timeout=10", "-rss_limit_mb=2048", "-malloc_limit_mb=1024"]
FOREIGN = {"hdf5", "mat5", "segment"}


def sanitized():
    # no memory is an answer a library has to live with; what HDF5 loses of a broken file is lost with the child
    return {
        **os.environ,
        "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1",
        "UBSAN_OPTIONS": "print_stacktrace=1",
    }


def fuzzer(reader, folder, *arguments):
    # libFuzzer has no limit of time for its own report of a flood: it visits every piece of memory, which took hours
    # once
    process = subprocess.Popen(
        [os.path.join(FUZZERS, "fuzz_" + reader), *LIMITS, *arguments],
        cwd=folder,
        env=sanitized(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        out, report = process.communicate(timeout=SECONDS + PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, report = process.communicate()
    return subprocess.CompletedProcess(process.args, process.returncode, out, report)


def ours(report):
    """Is the first function that is neither the sanitizer's nor libc's one of ours, in any of the stacks?"""
    if "runtime error:" in report:  # nothing else is compiled with that sanitizer
        return True
    for stack in re.split(r"\n(?!\s+#\d)", report):
        for function in re.findall(r"^\s+#\d+ 0x\w+ in (.*)", stack, re.MULTILINE):
            if re.search(r"torquescope::|toml::", function):
                return True
            if re.match(r"(H5|Mat_|Inflate|inflate|ReadNext|Read|SZ_|aec_|adler|crc)", function):
                break
    return False


def is_handled(reader, folder, path):
    """The built program refuses (or reads) the file, and lives."""
    if reader == "segment":
        return program.run("show", path, "--verify", folder=folder).code in (0, 65)
    with open(os.path.join(folder, "job.toml"), "w", encoding="utf-8") as file:
        file.write(seeds.JOB % path)
    return program.run("check", "job.toml", folder=folder).code in (0, 65, 78)


def judge(reader, folder, path):
    """What is wrong with it, or None."""
    again = fuzzer(reader, folder, path)
    if again.returncode == 0:
        return None  # the end of the time, not of the process
    report = again.stdout + again.stderr
    if reader not in FOREIGN or ours(report):
        return report
    return None if is_handled(reader, folder, path) else "the program does not refuse it\n" + report


def minute(reader, home):
    folder = os.path.join(home, "of_" + reader)
    found, corpus = os.path.join(folder, "found"), os.path.join(folder, "corpus")
    os.makedirs(found)
    os.mkdir(corpus)
    words = os.path.join(HERE, reader + ".dict")
    # a child that crashes is replaced, and the search goes on
    ran = fuzzer(
        reader,
        folder,
        corpus,
        os.path.join(home, reader),
        *(["-dict=" + words] if os.path.exists(words) else []),
        "-fork=1",
        "-ignore_crashes=1",
        "-ignore_ooms=1",
        "-ignore_timeouts=1",
        f"-max_total_time={SECONDS}",
        "-max_len=65536",
        "-artifact_prefix=found/",
    )
    tried = re.findall(r"^#(\d+): cov: (\d+)", ran.stderr, re.MULTILINE)
    bad = 0
    names = sorted(os.listdir(found))
    for name in names:
        report = judge(reader, folder, os.path.join(found, name))
        if report:
            bad += 1
            kept = os.path.join(FUZZERS, f"finding.{reader}.{name}")
            shutil.copy(os.path.join(found, name), kept)
            print(f"{reader}: kept as {kept}\n{report[:6000]}", file=sys.stderr)
    inputs, edges = tried[-1] if tried else (0, 0)
    print(
        f"{reader}: {inputs} inputs, {edges} edges, {len(names)} crashes, hangs or floods, {len(names) - bad} of them "
        "in a library, "
        f"refused by the program; {bad} ours",
        flush=True,
    )
    return bad == 0 and int(inputs) > 0


def main(readers):
    with tempfile.TemporaryDirectory(prefix="torquescope_fuzz_") as home:
        seeds.make(home)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            return 0 if all(list(pool.map(lambda reader: minute(reader, home), readers))) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or list(seeds.MAKERS)))
