"""The plants that conceal physics and the engine that looks for it share nothing but the recordings.

Of joints: this folder, sticking and servo; of whole arms: concealed_arms. No include of engine/ or kernels/ in them, no
engine library linked to them, and nobody but the scorers reads a truth.
"""

import pathlib
import re
import sys

FOREIGN = re.compile(r'^\s*#\s*include\s+[<"](?:\.\./)*(?:engine|kernels|torquescope|support)/[^>"]+[>"]', re.MULTILINE)
LINK = re.compile(r"torquescope_(?!flags\b)\w+|torquescope::\w+")
PLANTS = ("concealed", "concealed_arms", "sticking", "servo")
READERS = {"ablation_score.py", "calibrate.py", "test_calibrate.py", "gather.py", "test_gather.py", "test_run_suite.py",
           "score_arms.py", "one_arm.py", "independent.py", "run.py", "grade.py", "test_cases.py", "test_sets.py"}


def foreign_includes(sources):
    return [
        f"{path} includes the engine: {hit.strip()}" for path, text in sources.items() for hit in FOREIGN.findall(text)
    ]


def teeth():
    assert foreign_includes({"a.cpp": '#include "engine/base/error.hpp"', "b.cpp": '#  include "../../kernels/x.hpp"',
                             "c.cpp": '#include "concealed/plant.hpp"\n#include <vector>'}).__len__() == 2


def main(root):
    teeth()
    root = pathlib.Path(root)
    plants = [root / "bench" / "boards" / name for name in PLANTS]
    files = [path for plant in plants for path in plant.rglob("*")]
    sources = {p.relative_to(root).as_posix(): p.read_text() for p in files if p.suffix in (".hpp", ".cpp")}
    assert len(sources) > 30, "too few sources found: is this the source tree?"
    found = foreign_includes(sources)
    found += [f"{plant.name}/CMakeLists.txt links {hit}" for plant in plants
              for hit in LINK.findall((plant / "CMakeLists.txt").read_text())]
    # and the other way round: the engine neither includes the plant nor knows its truth
    for folder in ("engine", "kernels", "scripts", "jobs"):
        for path in (root / folder).rglob("*"):
            if not path.is_file() or path.suffix in (".h5", ".gz"):
                continue
            text = path.read_text(errors="replace")
            # a person may be told where the truth lies; nothing may open it
            text = re.sub(r"^echo .*$", "", text, flags=re.MULTILINE)
            if "truth.json" in text or re.search(r'#\s*include\s+"(?:concealed(?:_arms)?|sticking|servo)/', text):
                found.append(f"{path.relative_to(root)} looks at the concealed plant")
    for path in files:
        if path.suffix == ".py" and path.name not in READERS and "truth.json" in path.read_text():
            found.append(f"{path.name} reads a truth: only the scorer may")
    print("\n".join(found) or f"{len(sources)} sources of the concealed plants: none shares a header with the engine")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
