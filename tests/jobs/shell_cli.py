"""What shells and programs read of the command line: names and options as data, completions and man pages.

Bash is asked for what it would offer. Zsh, fish, man and mandoc are where they are: without one, its test is skipped.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/shell_cli.py
"""

import functools
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402

ROBOTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "robots")


@functools.cache
def said(*words):
    done = program.run(*words)
    if done.code != 0:
        raise AssertionError(f"{words}: {done.code}\n{done.err}")
    return done.out


def data(*words):
    document = json.loads(said(*words, "--json", "-"))
    if document["schema"] != 1:
        raise AssertionError(document)
    return document


class NamesAsData(unittest.TestCase):
    def test_what_is_listed_is_what_the_table_says(self):
        for kind in ("", "effects", "sections"):
            table = said("list", *kind.split())
            names = [line.split()[0] for line in table.splitlines() if line[:2] == "  " and line[2:3] != " "]
            entries = data("list", *kind.split())["entries"]
            self.assertEqual([entry["name"] for entry in entries], names)
            self.assertTrue(all(set(entry) == {"name", "kind", "title"} for entry in entries))
        self.assertEqual({entry["kind"] for entry in data("list", "effects")["entries"]}, {"effect"})

    def test_everything_listed_is_described(self):
        for entry in data("list", "optimisers")["entries"]:
            described = [one for one in data("describe", entry["name"])["entries"] if one["kind"] == "optimiser"]
            self.assertEqual([{key: one[key] for key in entry} for one in described], [entry])

    def test_options_have_key_type_default_and_meaning(self):
        (filter_section,) = data("describe", "filter")["entries"]
        options = {option["key"]: option for option in filter_section["options"]}
        self.assertEqual(set(options["cutoff_hz"]), {"key", "type", "unit", "range", "default", "meaning"})
        self.assertEqual((options["cutoff_hz"]["type"], options["cutoff_hz"]["unit"]), ("number", "Hz"))
        (stribeck,) = data("describe", "stribeck")["entries"]
        self.assertTrue(stribeck["text"])

    def test_a_robot_has_its_frames_and_base_parameters(self):
        robot = data("describe", os.path.join(ROBOTS, "crs_a465.toml"))["robot"]
        self.assertEqual((len(robot["joints"]), robot["standard_parameters"]), (5, 50))
        self.assertEqual((robot["rigid_base_parameters"], len(robot["base_parameters"])), (29, 32))
        sums = {parameter["name"]: parameter["sum"] for parameter in robot["base_parameters"]}
        self.assertTrue(sums["xxr2"].startswith("xx2 - yy2"))

    def test_an_unknown_name_is_an_error_as_data(self):
        done = program.run("describe", "fadee", "--json", "-")
        self.assertEqual((done.code, json.loads(done.out)["error"]["code"]), (64, 64))


def commands():
    """As the program's man page lists them."""
    return re.findall(r"^\.BR torquescope\\-(\w+) \(1\)", said("man"), re.MULTILINE)


def long_options(command):
    """Of the help page."""
    return sorted(re.findall(r"^  (?:-\w, )?(--[\w-]+)", said("help", command), re.MULTILINE))


class WithShell(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_shell_")
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("lab.toml", "two words.toml", "lab.h5", "rec.csv"):
            with open(os.path.join(self.folder, name), "w", encoding="utf-8"):
                pass
        os.mkdir(os.path.join(self.folder, "lab_more"))

    def script(self, shell, name):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(said("completion", shell))
        return os.path.join(self.folder, name)

    def asked(self, *words):
        """What a program of this machine prints; the test is skipped where it is missing."""
        if not shutil.which(words[0]):
            self.skipTest(f"no {words[0]} here")
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=program.SECONDS, stdin=subprocess.DEVNULL, env=program.environment())
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout


class Bash(WithShell):
    def offers(self, *words):
        """What bash offers for the last of the words, which TAB was pressed behind; "=" is a word of its own."""
        lines = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _torquescope; '
        lines += '((${#COMPREPLY[@]})) && printf "%s\\n" "${COMPREPLY[@]}"; true'
        script = self.script("bash", "completion.bash")
        found = self.asked("bash", "-u", "-c", lines, "bash", script, "torquescope", *words).splitlines()
        os.remove(script)
        return sorted(set(found))

    def test_it_is_registered(self):
        script = self.script("bash", "completion.bash")
        self.assertEqual(self.asked("bash", "-c", 'source "$1"; complete -p torquescope', "bash", script),
                         "complete -F _torquescope torquescope\n")

    def test_commands(self):
        self.assertEqual(self.offers("s"), ["show", "simulate", "status", "submit"])
        self.assertEqual(self.offers(""), sorted([*commands(), "help", "--help", "--version"]))
        self.assertEqual(self.offers("help", "dia"), ["diagnose"])

    def test_every_option_of_every_help_page(self):
        self.assertGreater(len(commands()), 14)
        for command in commands():
            self.assertEqual(self.offers(command, "--"), sorted({*long_options(command), "--help"}), command)
        self.assertEqual(self.offers("run", "--allow"), ["--allow-full-disk", "--allow-mixed"])

    def test_values_of_options(self):
        words = ["always", "auto", "never"]
        self.assertEqual(self.offers("run", "lab.toml", "--color", ""), words)
        self.assertEqual(self.offers("run", "--color", "="), words)
        self.assertEqual(self.offers("run", "--color", "=", "n"), ["never"])
        self.assertEqual(self.offers("run", "-o", "lab"), ["lab.h5", "lab_more"])
        self.assertEqual(self.offers("simulate", "lab.toml", "--out", ""), ["lab.h5", "lab_more", "rec.csv"])
        self.assertEqual(self.offers("run", "-j", ""), [], "a number is nobody else's to know")

    def test_arguments(self):
        self.assertEqual(self.offers("run", ""), ["lab.toml", "lab_more", "two words.toml"])
        self.assertEqual(self.offers("run", "-q", "two"), ["two words.toml"])
        self.assertEqual(self.offers("show", "l"), ["lab.h5", "lab_more"])
        self.assertIn("rec.csv", self.offers("init", ""))
        self.assertEqual(self.offers("list", "eff"), ["effects"])
        self.assertEqual(self.offers("describe", "strib"), ["stribeck", "stribeck_friction"])
        self.assertEqual(self.offers("describe", "rec"), ["rec.csv", "recording", "recordings"])
        self.assertEqual(self.offers("completion", ""), ["bash", "fish", "zsh"])


class OtherShells(WithShell):
    def test_zsh_reads_its_script(self):
        self.assertEqual(self.asked("zsh", "-f", "-n", self.script("zsh", "_torquescope")), "")

    def test_zsh_knows_its_function(self):
        self.script("zsh", "_torquescope")
        lines = "fpath=($PWD $fpath); autoload -Uz compinit; compinit -D -u; print $_comps[torquescope]"
        self.assertEqual(self.asked("zsh", "-f", "-c", lines), "_torquescope\n")

    def test_zsh_finds_files_by_their_endings(self):
        with open(self.script("zsh", "_torquescope"), encoding="utf-8") as file:
            patterns = sorted(set(re.findall(r'_files -g "([^"]+)"', file.read())))
        self.assertIn("*.(csv|h5)", patterns)
        for pattern, names in (("*.(csv|h5)", "lab.h5\nrec.csv\n"), ("*.toml", "lab.toml\ntwo words.toml\n")):
            self.assertIn(pattern, patterns)
            self.assertEqual(self.asked("zsh", "-f", "-c", "print -l -- ${~1}", "zsh", pattern), names)
        # none of them is taken for qualifiers, which would be an error
        self.asked("zsh", "-f", "-c", 'setopt nullglob; for one; do : ${~one}; done', "zsh", *patterns)

    def test_fish_offers_options_and_words(self):
        script = self.script("fish", "torquescope.fish")

        def offers(line):
            asked = self.asked("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'")
            return {offer.split("\t")[0] for offer in asked.splitlines()}

        self.assertEqual(offers("torquescope dia"), {"diagnose"})
        self.assertEqual(offers("torquescope list eff"), {"effects"})
        self.assertEqual(offers("torquescope run --color "), {"always", "auto", "never"})
        for command in commands():
            self.assertEqual(offers(f"torquescope {command} --"), {*long_options(command), "--help"}, command)

    def test_an_unknown_shell_is_refused(self):
        done = program.run("completion", "csh")
        self.assertEqual(done.code, 64)
        self.assertIn("torquescope completion bash|zsh|fish", done.said)


class ManPages(WithShell):
    def setUp(self):
        super().setUp()
        self.pages = os.path.join(self.folder, "man1")
        os.mkdir(self.pages)
        said("man", "--into", self.pages)

    def files(self):
        return [os.path.join(self.pages, name) for name in sorted(os.listdir(self.pages))]

    def test_one_for_the_program_and_each_command(self):
        expected = ["torquescope.1"] + [f"torquescope-{name}.1" for name in commands()]
        self.assertEqual(sorted(os.listdir(self.pages)), sorted(expected))
        for name in commands():
            with open(os.path.join(self.pages, f"torquescope-{name}.1"), encoding="utf-8") as file:
                self.assertEqual(file.read(), said("man", name))

    def test_groff_has_nothing_to_say(self):
        for page in self.files():
            text = self.asked("groff", "-ww", "-man", "-Tascii", "-P-c", "-P-b", "-P-u", page)
            self.assertIn("EXIT STATUS", text)

    def test_man_shows_every_option(self):
        for name in commands():
            text = self.asked("man", "--warnings", "-l", os.path.join(self.pages, f"torquescope-{name}.1"))
            for option in long_options(name):
                self.assertIn(option, text, name)

    def test_mandoc_finds_no_error(self):
        self.assertEqual(self.asked("mandoc", "-Tlint", "-Werror", *self.files()), "")

    def test_exit_codes_are_those_of_the_document(self):
        with open(os.path.join(ROBOTS, "..", "README.md"), encoding="utf-8") as file:
            chapter = file.read().split("\n## Exit codes\n")[1].split("\n## ")[0]
        documented = re.findall(r"^\| (\d+) \|", chapter, re.MULTILINE)
        commanded = re.findall(r"^\\fB(\d+)\\fR$", said("man"), re.MULTILINE)
        verdicts = re.findall(r"^\\fB(\d+)\\fR$", said("man", "diagnose"), re.MULTILINE)[:-len(commanded)]
        self.assertEqual(documented, commanded + verdicts)
        self.assertIn("10", verdicts)

    def test_an_unknown_command_is_refused(self):
        done = program.run("man", "diagnos")
        self.assertEqual((done.code, "did you mean" in done.err), (64, True))
        self.assertEqual(program.run("man", "--into", os.path.join(self.folder, "nowhere")).code, 74)


if __name__ == "__main__":
    unittest.main()
