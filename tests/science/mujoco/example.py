"""A user's own simulator (MuJoCo) beside a recording of a joint that has more friction than the simulator knows.

    example.py inverse   TORQUESCOPE MAKE_CASE SIMULATE CONCEALED OUT the column holds what the model says, the job
                         reads it
    example.py diagnosis TORQUESCOPE MAKE_CASE SIMULATE CONCEALED OUT    real - simulated gives the concealed effect its
                                                                         name

SIMULATE is the program made of simulated_torque.cpp, "" where MuJoCo is not installed: exit code 77, skipped. CONCEALED
is bench/boards/concealed, whose scorer judges. The sealed case is an elbow; elbow.xml is its model with numbers 5 %
off.
"""

import pathlib
import subprocess
import sys
import xml.etree.ElementTree

import numpy as np

CASE = "alder"
HERE = pathlib.Path(__file__).resolve().parent
SKIPPED = 77


def run(*command, cwd=None):
    done = subprocess.run(command, cwd=cwd, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\nexit code {done.returncode}\n{done.stdout}")
    return done.stdout


def make_job(make_case, simulate, out):
    """A folder with the recordings, the simulator's column in them, and a job that names it."""
    run(make_case, CASE, out / "sealed")
    folder = out / "open"
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("train.csv", "validate.csv"):
        run(simulate, HERE / "elbow.xml", out / "sealed" / CASE / name, folder / name)
    job = (out / "sealed" / CASE / "job.toml").read_text()
    with_column = job.replace("\n[filter]", 'simulated_torque = "tau_sim_Nm"\n\n[filter]')
    assert with_column != job, "the job of the case has no [filter] any more"
    (folder / "job.toml").write_text(with_column)
    return folder


def parameters_in(path):
    """Inertia, damping, friction of the column, by least squares where the joint surely moves one way."""
    rows = np.genfromtxt(path, delimiter=",", names=True)
    around = np.arange(-8, 9)
    fit = np.linalg.pinv(np.vander(around, 4, increasing=True))
    rate_hz = 1e3
    v = np.convolve(rows["q_rad"], fit[1][::-1], "same") * rate_hz
    a = np.convolve(rows["q_rad"], 2 * fit[2][::-1], "same") * rate_hz**2
    inside = np.zeros(len(v), bool)
    inside[20:-20] = np.abs(v[20:-20]) > 0.05 * np.abs(v).max()
    columns = np.column_stack([a, v, np.sign(v)])[inside]
    return np.linalg.lstsq(columns, rows["tau_sim_Nm"][inside], rcond=None)[0]


def parameters_of_model():
    model = xml.etree.ElementTree.parse(HERE / "elbow.xml")
    joint, inertial = model.find(".//joint"), model.find(".//inertial")
    about_axis = float(inertial.get("diaginertia").split()[2])
    return np.array([about_axis + float(joint.get("armature")), float(joint.get("damping")),
                     float(joint.get("frictionloss"))])


def inverse(torquescope, folder):
    ratio = parameters_in(folder / "train.csv") / parameters_of_model()
    # the clock's jitter is the only thing the two ways to differentiate may disagree on
    assert np.all(np.abs(ratio - 1) < 2e-3), f"the column is not the model's torque: {ratio}"
    readable = (folder / "job.toml").read_text().split("[diagnose]")[0] + '[[estimator]]\nname = "ols"\n'
    (folder / "readable.toml").write_text(readable)
    run(torquescope, "check", "readable.toml", cwd=folder)
    (folder / "misspelt.toml").write_text(readable.replace("tau_sim_Nm", "tau_sim"))
    refused = subprocess.run([torquescope, "check", "misspelt.toml"], cwd=folder, capture_output=True, text=True)
    assert refused.returncode == 78 and "tau_sim" in refused.stderr + refused.stdout, refused
    print(f"the simulator's column holds its parameters (ratio {ratio}), and the job reads it")


def diagnosis(torquescope, folder, concealed, out):
    verdicts = out / "verdicts"
    verdicts.mkdir(exist_ok=True)
    verdict = verdicts / f"{CASE}.json"
    verdict.unlink(missing_ok=True)
    print(run(torquescope, "diagnose", "job.toml", "--json", verdict, "--out", out / "diagnosis.h5", cwd=folder))
    print(run(sys.executable, "-B", pathlib.Path(concealed) / "score.py", out, "--all-right"))


def main(what, torquescope, make_case, simulate, concealed, out):
    if not simulate:
        print("skipped: MuJoCo is not installed (scripts/install-deps --full, or libmujoco-dev)")
        return SKIPPED
    out = pathlib.Path(out).resolve()
    (out / "diagnosis.h5").unlink(missing_ok=True)
    folder = make_job(make_case, simulate, out)
    if what == "inverse":
        inverse(torquescope, folder)
    else:
        diagnosis(torquescope, folder, concealed, out)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
