"""What shells and programs read of the command line: names and options as data.

Use: TORQUESCOPE=build/dev/bin/torquescope /usr/bin/python3 tests/jobs/shell_cli.py
"""

import json
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402

ROBOTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "robots")


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


if __name__ == "__main__":
    unittest.main()
