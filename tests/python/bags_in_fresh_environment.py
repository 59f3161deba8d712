"""usage: bags_in_fresh_environment.py SOURCE FOLDER

test_bags.py with what the extra `ros` of pyproject.toml brings, in a new virtual environment in FOLDER; nothing is
compiled. Code 77, "skipped", where there is no venv or no PyPI.
"""

import pathlib
import subprocess
import sys
import tomllib

from in_fresh_environment import HERE, environment

WRITER = "mcap"


def main(source, folder):
    source, folder = pathlib.Path(source), pathlib.Path(folder)
    project = tomllib.loads((source / "pyproject.toml").read_text())["project"]
    packages = [*project["optional-dependencies"]["ros"], WRITER]
    python = environment(folder / "environment", packages)
    subprocess.run([python, "-m", "pip", "install", "-q", *project["dependencies"], *packages], check=True)
    subprocess.run([python, "-B", HERE / "test_bags.py", source / "scripts" / "report"], cwd=folder, check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
