"""Words of our own that no user should have to learn: not in what the program and its pages say, nor in the documents.

    plain_words.py ROOT        texts of the C++ and Python sources, templates of pages, and documents for users; names
                               and comments of the engine

A text is a string with a space in it: keys of JSON, HDF5 and jobs are single words, and scripts of users hold them.
"""

import io
import pathlib
import re
import sys
import tokenize

INSTEAD = {
    r"\b[Tt]wins?\b": "replicate (simulated recording of the fitted model)",
    r"\b[Uu]nseen\b": "validation, or held-out",
    r"\brelerr\b": "relative error, or error",
    r"\b[Ll]ess than none\b": "negative",
    r"\b[Ll]aws?\b": "effect; of a loop, controller",
    r"\b[Nn]obody sees\b|\bbears out\b|\brespect that\b": "a plain sentence",
}
# words that are keys, or that a reader of the source alone meets
KEYS = re.compile(r"list laws|effects, laws|"
                  r"\(twins \+ 1\)|\"twins\\?\"|twins = |\btwins 1\b|\[twins?\]|\"unseen\"|relerr\[")
# of effects: their own sentences may speak of a law of nature by its name
NAMED_LAWS = re.compile(r"(?:Ohm|Coulomb|Stribeck|Hooke|Newton)'s law|[Pp]ower law")
DOCUMENTS = ("README.md", "CHANGELOG.md", "jobs/README.md", "engine/diagnose/METHOD.md",
             "engine/infer/decision/THEORY.md", "engine/store/RESULT_FORMAT.md",
             "engine/data/health/README.md", "engine/effects/README.md", "scripts/report/torquescope/README.md",
             "bench/README.md")
# names and comments of the engine: replicate, validation, and effect or controller
OF_CODE = re.compile(r"\w*(?:[Tt]win|[Uu]nseen|(?<![a-z])[Ll]aws?(?![a-z]))\w*")
NAMES_KEPT = re.compile(r"\w*(?:velocity|power)_law\w*|[Ss]et-valued law")  # of effects, and a term of mechanics
C_TEXT = re.compile(r'"(?:[^"\\\n]|\\.)*"')
CODE = re.compile(r"```.*?```|`[^`\n]*`|\]\([^)]*\)|^    .*$", re.DOTALL | re.MULTILINE)


def faults(text):
    """[(word, what to write instead)]."""
    plain = NAMED_LAWS.sub("", KEYS.sub("", text))
    return [(found[0], instead) for pattern, instead in INSTEAD.items() for found in re.finditer(pattern, plain)]


def words_in_code(source):
    """[(line, word)] of names and comments, without what stands between quotes."""
    for number, line in enumerate(source.split("\n"), 1):
        plain = NAMES_KEPT.sub("", NAMED_LAWS.sub("", C_TEXT.sub("", line)))
        yield from ((number, word) for word in OF_CODE.findall(plain))


def texts_of_cpp(source):
    """[(line, text)]."""
    for number, line in enumerate(source.split("\n"), 1):
        line = re.sub(r"^\s*#include.*|(?:^|\s)//.*", "", line)
        if "TORQUESCOPE_EXPECT" in line:
            continue
        for found in C_TEXT.findall(line):
            if " " in found:
                yield number, found


def texts_of_python(source):
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type != tokenize.STRING or " " not in token.string:
            continue
        # names between braces are the program's own
        yield token.start[0], re.sub(r"\{[^{}]*\}", "", token.string)


def texts_of_template(source):
    markup = re.compile(r"\{#.*?#\}|\{%.*?%\}|\{\{.*?\}\}|<[^>]*>", re.DOTALL)
    shown = markup.sub(lambda found: "\n" * found[0].count("\n"), source)
    yield from enumerate(shown.split("\n"), 1)


def texts_of_document(source):
    shown = CODE.sub(lambda found: "\n" * found[0].count("\n"), source)
    yield from enumerate(shown.split("\n"), 1)


def places(root):
    """[(name, line, text)] of all that users read."""
    report = root / "scripts" / "report"
    kinds = [(sorted((root / "engine").rglob("*.[ch]pp")), texts_of_cpp),
             (sorted(report.rglob("*.py")), texts_of_python), (sorted(report.rglob("*.html")), texts_of_template),
             ([root / name for name in DOCUMENTS], texts_of_document)]
    for paths, texts_of in kinds:
        for path in paths:
            for line, text in texts_of(path.read_text(encoding="utf-8")):
                yield path.relative_to(root).as_posix(), line, text


def main(root):
    # the check sees what it is for
    assert faults("what clean twins leave") and faults("less than none")
    assert not faults("write twins = 200") and not faults("a power law of the speed")
    assert list(words_in_code("LawQuestion one;  // of a twin")) == [(1, "LawQuestion"), (1, "twin")]
    assert not list(words_in_code('write("twins", EffectFamily::velocity_law);  // power law: flawless'))
    found = [f"{name}:{line}: \"{word}\": {instead}" for name, line, text in places(root)
             for word, instead in faults(text)]
    found += [f"{path.relative_to(root)}:{line}: \"{word}\": replicate, validation, effect or controller"
              for path in sorted((root / "engine").rglob("*.[ch]pp"))
              for line, word in words_in_code(path.read_text(encoding="utf-8"))]
    print("\n".join(found) or "no words of our own in what users read")
    return bool(found)


sys.exit(main(pathlib.Path(sys.argv[1])))
