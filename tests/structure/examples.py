"""The worked examples of engine/README.md compile: every block of C++ that includes something, as a file of its own.

    examples.py ROOT COMPILER [FLAG...]
"""

import pathlib
import re
import subprocess
import sys
import tempfile

LEAST = 3  # an effect, an optimiser, a reader


def main(root, *compiler):
    document = pathlib.Path(root) / "engine" / "README.md"
    blocks = [one for one in re.findall(r"^```cpp\n(.*?)^```", document.read_text(), re.DOTALL | re.MULTILINE)
              if "#include" in one]
    assert len(blocks) >= LEAST, f"{document} has {len(blocks)} examples, {LEAST} are expected"
    failed = 0
    for block in blocks:
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "example.cpp"
            source.write_text(block)
            done = subprocess.run([*compiler, "-fsyntax-only", str(source)], capture_output=True, text=True)
        print(block.splitlines()[0], "compiles" if done.returncode == 0 else f"does not compile:\n{done.stderr}")
        failed += done.returncode != 0
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
