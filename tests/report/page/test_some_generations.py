"""Results that store some generations only ([output] history): curves stand at the right numbers, or are absent."""

import shutil
import unittest

import h5py
import numpy as np
import support
from torquescope.page import build
from torquescope.page.figures import all_cases
from torquescope.page.study import Study

SEARCHES = ("convergence", "targets_reached", "control_parameters_fade", "population_changes_fade")
HISTORIES = ("population", "fitness", "F", "CR", "PC", "FC", "best", "gap_history", "evaluations", "controller/F_path",
             "controller/CR_path")


def thinned(name, wanted):
    """The study of the paper with the generations `wanted` alone; every run of it goes to the end."""
    path = support.FOLDER / f"{name}.h5"
    shutil.copy(support.result("crs"), path)
    with h5py.File(path, "r+") as file:
        for group in file["runs"].values():
            if "population" not in group:
                continue
            for history in (history for history in HISTORIES if history in group):
                values, kept = group[history][()], dict(group[history].attrs)
                del group[history]
                group.create_dataset(history, data=values[:, wanted]).attrs.update(kept)
            group["generation"] = np.array(wanted, dtype=np.int64)
            group["last_generation"] = np.full(len(group["best"]), wanted[-1], dtype=np.int64)
    return path


def curves(study, name):
    """x and y of the thick lines of a figure, by label."""
    axes = all_cases(study)[name].figure(400).axes[0]
    return {line.get_label(): line.get_data() for line in axes.lines if line.get_linewidth() > 2}


class SomeGenerations(unittest.TestCase):
    def test_curves_stand_at_the_generations_that_are_stored(self):
        wanted = [0, 10, 30, 60, 100]
        some, whole = Study(thinned("some", wanted)), support.study("crs")
        for name in ("convergence", "control_parameters_fade", "population_changes_fade"):
            found, full = curves(some, name), curves(whole, name)
            self.assertEqual(set(found), set(full))
            for label, (x, y) in found.items():
                at = dict(zip(*full[label]))
                self.assertLessEqual(set(x), set(wanted), label)
                np.testing.assert_allclose(y, [at[generation] for generation in x], rtol=1e-12, err_msg=label)
        cases = all_cases(some)
        self.assertIn("some generations only", cases["targets_reached"].sentence)
        self.assertNotIn("some generations only", all_cases(whole)["targets_reached"].sentence)
        search = cases["targets_reached"].arguments["searches"][0]
        of_whole = all_cases(whole)["targets_reached"].arguments["searches"][0]
        np.testing.assert_array_equal(search.evaluations[0], of_whole.evaluations[0][wanted])

    def test_of_the_last_generation_alone_there_is_a_page_without_curves(self):
        path = thinned("last", [100])
        self.assertFalse(set(SEARCHES) & set(all_cases(Study(path))))
        self.assertLessEqual(set(SEARCHES), set(all_cases(support.study("crs"))))
        text = build.page(Study(path))
        self.assertIn("decision_surface_fade_F", set(all_cases(Study(path))))
        self.assertNotIn(">nan<", text)


if __name__ == "__main__":
    support.main()
