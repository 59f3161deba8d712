"""Results side by side: verdicts, errors and estimates as columns, and where intervals lie apart."""

import contextlib
import io
import re
import shutil

import h5py
import numpy as np
import support
import unittest
from vary_diagnosis import HOSTILE_WORDS, replace

from torquescope.page import compare, compared


def beside(kind, folder, change=lambda file: None):
    """A changed copy of a result under its own name in a folder of its own."""
    path = support.FOLDER / folder / f"{kind}.h5"
    path.parent.mkdir(exist_ok=True)
    shutil.copy(support.result(kind), path)
    with h5py.File(path, "r+") as file:
        change(file)
    return path


def moved(file):
    """Viscous friction ten intervals away."""
    run = file["runs/ols"]
    values, ends = run["parameters"][()], run["ci95"][()]
    shift = 10 * (ends[:, 1, 1] - ends[:, 1, 0])
    values[:, 1] += shift
    ends[:, 1] += shift[:, None]
    replace(run, "parameters", values)
    replace(run, "ci95", ends)


class Compare(unittest.TestCase):
    def cells(self, text, caption):
        table = text[text.index(f"<caption>{caption}</caption>"):]
        rows = re.findall(r"<tr>(.*?)</tr>", table[:table.index("</table>")], re.S)
        return [[re.sub(r"<[^>]+>", "", cell).strip() for cell in re.findall(r"<t[hd][^>]*>.*?</t[hd]>", row, re.S)]
                for row in rows]

    def test_estimates_are_columns_and_intervals_that_lie_apart_are_told(self):
        paths = [support.result("crs"), beside("crs", "moved", moved)]
        text = compare.page(paths)
        head, *rows = self.cells(text, "Estimates with 95 % intervals")
        self.assertEqual(len(head), 5)
        found = {row[0]: row for row in rows}
        self.assertEqual({name: row[-1] for name, row in found.items()},
                         {name: "no" if name == "viscous" else "yes" for name in found})
        self.assertRegex(found["inertia"][2], r"^[\d.]+ ± [\d.]+$")
        self.assertEqual(found["inertia"][2], found["inertia"][3])
        self.assertIn("One of four parameters differs by more than the 95 % intervals say.", text)

    def test_results_of_different_joints_are_said_to_be_so(self):
        def slide(file):
            file["model"].attrs["joint"] = np.bytes_("prismatic")
        text = compare.page([support.result("crs"), beside("crs", "slide", slide)])
        self.assertIn("These are results of different joints: a revolute joint; a prismatic joint.", text)
        self.assertNotIn("different joints", compare.page([support.result("crs"), beside("crs", "moved", moved)]))

    def test_files_of_one_name_have_labels_that_tell_them_apart(self):
        paths = [support.result("crs"), beside("crs", "monday"), beside("crs", "tuesday")]
        labels = [side.label for side in compared.sides(paths)]
        self.assertEqual(len(set(labels)), 3)
        self.assertTrue(all("crs" in label for label in labels))
        self.assertEqual(len({side.label for side in compared.sides([paths[0], paths[0]])}), 2)

    def test_a_unit_that_differs_is_another_row(self):
        def slides(file):
            replace(file["model"], "units", [b"kg", *file["model/units"][()][1:]])
        rows = compared.parameter_rows(compared.sides([support.result("crs"), beside("crs", "slide", slides)]))
        self.assertEqual([row.unit for row in rows if row.name == "inertia"], ["kg m2", "kg"])
        self.assertIsNone(rows[0].differs)

    @support.needs_diagnoses
    def test_verdicts_and_what_is_named_are_columns(self):
        text = compare.page([support.result("named"), support.result("none"), support.result("crs")])
        facts = {row[0]: row[1:] for row in self.cells(text, "Verdicts and errors")}
        self.assertEqual(facts["verdict"][:2], ["● Missing physics named", "○ Nothing missing"])
        self.assertTrue(facts["verdict"][2].startswith("identified"))
        named = support.study("named").diagnosis.joints[0]
        self.assertIn(f"{100 * named.augmented_validation_relerr:.1f}"[:2], facts["error, validation"][0])
        effects = {row[0]: row[1:] for row in self.cells(text, "Effects that one of them names")}
        self.assertRegex(effects["Stribeck friction"][0], "^◍ named or friction that builds up")
        self.assertTrue(effects["Stribeck friction"][1].startswith("○"))
        self.assertEqual(effects["Stribeck friction"][2], "–")

    @support.needs_diagnoses
    def test_hostile_words_stay_words(self):
        def hostile(file):
            file["job"].attrs["name"] = np.bytes_(HOSTILE_WORDS)
            for path in ("candidates/reasons",):
                values = file["diagnosis/joint_1"][path][()]
                file["diagnosis/joint_1"][path][...] = [HOSTILE_WORDS.encode()[:values.dtype.itemsize]] * len(values)
        path = beside("none", "hostile", hostile)
        text = compare.page([path, support.result("named")])
        self.assertNotIn("<script>alert", text)
        self.assertIn("&lt;script&gt;", text)

    def test_one_result_is_refused_and_a_broken_one_told(self):
        broken = support.FOLDER / "broken.h5"
        broken.write_bytes(b"no result")
        out = support.FOLDER / "compared.html"
        told = io.StringIO()
        with contextlib.redirect_stderr(told), contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(compare.main([str(support.result("crs")), "--out", str(out)]), 64)
            self.assertEqual(compare.main([str(support.result("crs")), str(broken), "--out", str(out)]), 65)
            self.assertFalse(out.exists())
            self.assertEqual(compare.main([str(support.result("crs")), str(support.result("arm")), f"--out={out}"]), 0)
        self.assertIn("two results or more", told.getvalue())
        self.assertEqual(re.findall(r"https?:|@import|url\((?!#)|\ssrc=", out.read_text(encoding="utf-8")), [])


if __name__ == "__main__":
    support.main()
