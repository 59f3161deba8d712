"""Identification of real arms by FIGAROH beside ours: its regressor, its base parameters, its weighted least squares.

    figaroh_peer.py PROGRAM FOLDER [ROBOT ...]

As identify_peer.py, which reads and filters; both see the same samples. FIGAROH weighs joints once, after least
squares. Its own filters are left out: they take no mask joint by joint. Needs PyPI's figaroh (1.0.2 was tried).
"""
import argparse
import importlib.metadata
import pathlib
import tomllib
import types

import numpy as np
import pinocchio
from figaroh.identification.base_identification import BaseIdentification
from figaroh.identification.parameter import add_standard_additional_parameters, get_standard_parameters
from figaroh.tools.qrdecomposition import QRDecomposer
from figaroh.tools.regressor import build_regressor_basic, build_regressor_reduced, get_index_eliminate

from identify_peer import JOBS, errors, ours, parts_of


def settings(model, job):
    return {"has_friction": True, "has_joint_offset": True, "has_actuator_inertia": job["model"]["drive_inertia"],
            "is_joint_torques": True, "act_idxv": list(range(model.nv)),
            "fv": [0] * model.nv, "fs": [0] * model.nv, "Ia": [0] * model.nv, "off": [0] * model.nv}


def figaroh_columns(model, q, dq, ddq, job):
    robot = types.SimpleNamespace(model=model, data=model.createData())
    stacked = build_regressor_basic(robot, q, dq, ddq, settings(model, job))
    return np.split(stacked, model.nv)


class Weighing(BaseIdentification):
    """Its solver without its files: what it asks of a robot's own class is not needed here."""

    def load_trajectory_data(self, data_source=None):
        raise NotImplementedError


def least_squares(model, job, train):
    """Base columns and their values, plain and weighed by the variance that plain ones leave at every joint."""
    columns, torque = (np.concatenate(piece) for piece in zip(*train))
    names = get_standard_parameters(model) | add_standard_additional_parameters(model, settings(model, job))
    dropped, left = get_index_eliminate(columns, names, tol_e=1e-6)
    decomposer = QRDecomposer(relative_tolerance=1e-8)
    base, *_, plain = decomposer.double_decomposition(torque, build_regressor_reduced(columns, dropped), left)
    chosen = np.delete(np.arange(columns.shape[1]), dropped)[decomposer.get_base_indices()]
    own = np.concatenate([np.full(len(tau), np.mean((tau - phi[:, chosen] @ plain) ** 2)) for phi, tau in train])
    weighed, _ = object.__new__(Weighing)._solve_weighted_least_squares(base, torque, own)
    return chosen, {"ols": plain, "wls": weighed}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("folder", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("robots", nargs="*", default=["panda", "ur10e"])
    wanted = parser.parse_args()
    print(f"FIGAROH {importlib.metadata.version('figaroh')}, Pinocchio {pinocchio.__version__}; relative errors in %, "
          "joint by joint, then the arm")
    for robot in wanted.robots:
        text = (JOBS / f"{robot}.toml").read_text(encoding="utf-8")
        job = tomllib.loads(text)
        model, make = parts_of(job, wanted.folder)
        train, validation, _ = make(figaroh_columns)
        chosen, found = least_squares(model, job, train)
        mine = ours(wanted.program, text, job, wanted.folder)
        print(f"{robot}: {len(chosen)} base parameters with frictions")
        for name, values in found.items():
            theirs = [errors([(phi[:, chosen], tau) for phi, tau in rows], values) for rows in (train, validation)]
            for who, results in (("ours", mine[name][1:]), ("FIGAROH", theirs)):
                for rows, percent in zip(("train", "unseen"), results):
                    numbers = " | ".join(f"{100 * value:.3g}" for value in percent)
                    print(f"| {robot}, {name}, {rows} | {who} | {numbers} |")


if __name__ == "__main__":
    main()
