"""usage: in_fresh_environment.py SOURCE FOLDER BUILD CXX

`pip install .` of SOURCE in a new virtual environment, then test_package.py and the notebook with what it installed.
The environment is made anew in FOLDER; BUILD keeps what was compiled for the next time. Code 77, "skipped", where
there is no venv or no PyPI.
"""

import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SKIPPED = 77
FROM_PYPI = ["scikit-build-core>=0.10", "nanobind>=2.4"]  # what pyproject.toml asks for first
NOTEBOOK = ["nbclient", "ipykernel"]


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def environment(folder, needed):
    """The Python of a new environment; skips where PyPI does not give the packages needed."""
    shutil.rmtree(folder, ignore_errors=True)
    made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, text=True)
    if made.returncode != 0:
        skip(f"no virtual environment can be made (Debian: python3-venv): {made.stdout.strip()[:200]}")
    python = folder / "bin" / "python"
    reached = subprocess.run([python, "-m", "pip", "download", "-q", "--no-deps", "--retries", "0", "--timeout", "15",
                              "-d", folder / "reached", *needed], capture_output=True, text=True)
    if reached.returncode != 0:
        skip("PyPI is not reached from here")
    return python


def main(source, folder, build, compiler):
    source, folder = pathlib.Path(source), pathlib.Path(folder)
    python = environment(folder / "environment", FROM_PYPI)
    settings = {"build-dir": build, "cmake.define.CMAKE_CXX_COMPILER": compiler}
    subprocess.run([python, "-m", "pip", "install", "-q", f"{source}[all]", *NOTEBOOK,
                    *(f"--config-settings={key}={value}" for key, value in settings.items())], check=True)
    # away from the source, so that only what was installed is found
    for script, arguments in (("test_package.py", [source]), ("run_notebook.py", [source / "jobs/diagnosis.ipynb"])):
        subprocess.run([python, "-B", HERE / script, *map(str, arguments)], cwd=folder, check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
