"""Writes copies of a few source files with five faults in them, which TORQUESCOPE_MUTANT=1..5 switches on, one at a
time.

    mutate.py ENGINE_FOLDER OUTPUT_FOLDER

For the tests of the tests alone (mutants.py): the program that people get is made of the files as they are. A text that
is no longer there, or is there twice, ends the build: whoever changes these lines looks here.
"""

import os
import sys

HEAD = """#include <cstdlib>
namespace {
bool mutant(int number) {
  char const* const chosen = std::getenv("TORQUESCOPE_MUTANT");
  return chosen && std::atoi(chosen) == number;
}
}  // namespace
"""

MUTATIONS = {
    "store/temp_file.cpp": [
        # 1: no fsync
        (
            "  return unless_interrupted([&] { return ::fsync(descriptor); });\n",
            "  if (mutant(1)) return 0;\n  return unless_interrupted([&] { return ::fsync(descriptor); });\n",
        ),
        # 4: rename before fsync
        (
            "  if (!failed() && sync_file(descriptor_) != 0) error_number_ = errno;\n",
            "  if (!mutant(4) && !failed() && sync_file(descriptor_) != 0) error_number_ = errno;\n",
        ),
        (
            "  error_number_ = close_file(std::exchange(descriptor_, -1));\n",
            "  if (mutant(4) && sync_file(descriptor_) != 0) error_number_ = errno;\n"
            "  error_number_ = close_file(std::exchange(descriptor_, -1));\n",
        ),
    ],
    # 2: no verification of segments
    "experiment/runs/saved_runs.cpp": [
        ("if (accept(file.facts(), request_)) file.verify();",
         "if (accept(file.facts(), request_) && !mutant(2)) file.verify();")
    ],
    # 3: acknowledged before fsync
    "experiment/runs/run_keeper.cpp": [
        (
            "    std::lock_guard const alone(hdf5_);\n",
            "    if (mutant(3) && setting_.safe) setting_.safe(runs_safe_ + ended);\n    std::lock_guard const "
            "alone(hdf5_);\n",
        )
    ],
    # 5: no checksum
    "store/result_reader.cpp": [
        ("  if (found.sha256 != content_sha256()) throw", "  if (!mutant(5) && found.sha256 != content_sha256()) throw")
    ],
}


def mutated(text, changes):
    for old, new in changes:
        if text.count(old) != 1:
            raise SystemExit(f"mutate.py: {text.count(old)} times instead of once: {old}")
        text = text.replace(old, new)
    return HEAD + text


def main():
    engine, output = sys.argv[1:]
    for name, changes in MUTATIONS.items():
        with open(os.path.join(engine, name), encoding="utf-8") as file:
            text = mutated(file.read(), changes)
        with open(os.path.join(output, os.path.basename(name)), "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main()
