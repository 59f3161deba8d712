"""What the measurements need: where programs are, and how to run an earlier build in turns with today's."""
import dataclasses
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from measure import Run, environment  # noqa: E402, F401


class Missing(Exception):
    """A peer or a recording that is not here; its text says how to get it."""


@dataclasses.dataclass
class Context:
    build: pathlib.Path
    was: pathlib.Path | None  # an earlier build
    peers_python: pathlib.Path
    recordings: pathlib.Path
    folder: pathlib.Path  # for files of a run

    def builds(self):
        """Of today, then the earlier one."""
        return [self.build, *([self.was] if self.was else [])]

    def program(self, build):
        return build / "bin/torquescope"

    def in_turns(self, rounds, measure):
        """The least of measure(build) over rounds: (today's, the earlier build's or None)."""
        found = [[measure(build) for build in self.builds()] for _ in range(rounds)]
        best = [min(one) for one in zip(*found)]
        return best[0], best[1] if self.was else None

    def by_peers(self, *command):
        """What a script prints in the Python of the peers; other scripts beside it are found."""
        done = subprocess.run([str(self.peers_python), "-B", *map(str, command)], env=environment(),
                              capture_output=True, text=True)
        if done.returncode != 0:
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            raise Missing(f"{pathlib.Path(str(command[0])).name} failed: {last}; scripts/install-peers --bench gets "
                          "what it needs")
        return done.stdout
