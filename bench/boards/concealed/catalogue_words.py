"""Every word a truth may use for effects, families, parameters, units and axes is one the engine uses too.

    catalogue_words.py TORQUESCOPE MAKE_CASE

The plant shares no header with the engine, so its words are strings; `make_case --words` lists them and
`torquescope describe NAME` says what the engine calls them. A word that differs would score a right answer as wrong.
"""
import dataclasses
import json
import re
import subprocess
import sys

LABELS = "family|equation|parameter|shape|signature|acts on|source"


@dataclasses.dataclass
class Described:
    families: list
    axes: list
    units: dict  # parameter -> (on a revolute joint, on a slide or None)


def parse(text):
    """The page of `describe EFFECT`; long lines of it are broken anywhere between words."""
    text = " ".join(text.split())
    fields = re.findall(rf"\b({LABELS}) (.+?)(?= (?:{LABELS}) |$)", text[text.index("(effect)"):])
    listed = lambda wanted: next(value for label, value in fields if label == wanted).split(";")[0].split(", ")
    units = {}
    for label, value in fields:
        if label in ("parameter", "shape"):
            name, unit, slide = re.match(
                r"(\w+) in (.+?)(?: \(([^()]+) on a slide\)| \(revolute joints only\))?(?:[:,]|$)", value
            ).groups()
            units[name] = (unit, slide or (None if "(revolute joints only)" in value else unit))
    return Described(listed("family"), listed("signature"), units)


def mistakes(words, catalogue):
    """words of make_case --words against {effect name: Described} -> what does not agree."""
    found = []
    for effect in words["effects"]:
        name, here = effect["name"], catalogue.get(effect["name"])
        if here is None:
            found.append(f"{name}: no effect of the catalogue")
            continue
        if effect["families"] != here.families:
            found.append(f"{name}: families {effect['families']}, the catalogue has {here.families}")
        for parameter in effect["parameters"]:
            units = here.units.get(parameter["name"])
            if units is None:
                found.append(f"{name}: no parameter {parameter['name']} among {sorted(here.units)}")
            elif parameter["unit"] != units[effect["prismatic"]]:
                found.append(f"{name}: {parameter['name']} in {parameter['unit']}, the catalogue has {units}")
    found += [
        f"no effect is called {name}, which a truth may allow" for name in words["may_name"] if name not in catalogue
    ]
    axes = {axis for described in catalogue.values() for axis in described.axes}
    return found + [f"no effect shows on the axis {axis}" for axis in words["axes"] if axis not in axes]


def teeth():
    page = (
        "stribeck  Stribeck friction [reversal]\n (effect)\n  family     reversal, velocity_law\n  equation   tau = s "
        "Fs\n"
        "  parameter  stribeck in N m (N on a slide): 0 to\n  2 x Coulomb level\n  shape      stribeck_exponent in 1: "
        "0.5 to 2\n"
        "  parameter  gravity_sin in N m (revolute joints only)\n"
        "  signature  velocity, since_velocity_reversal; odd in the velocity\n  acts on    joint\n  source     me\n"
    )
    here = parse(page)
    assert here == Described(
        ["reversal", "velocity_law"],
        ["velocity", "since_velocity_reversal"],
        {"stribeck": ("N m", "N"), "stribeck_exponent": ("1", "1"), "gravity_sin": ("N m", None)},
    ), here
    effect = {"name": "stribeck", "families": ["reversal", "velocity_law"], "prismatic": True,
              "parameters": [{"name": "stribeck", "unit": "N"}]}
    judged = lambda **changed: len(
        mistakes({"effects": [{**effect, **changed}], "may_name": [], "axes": ["velocity"]}, {"stribeck": here})
    )
    assert judged() == 0
    assert judged(name="striebeck") == judged(families=["reversal"]) == judged(prismatic=False) == 1
    assert judged(parameters=[{"name": "rise", "unit": "N"}]) == 1
    assert len(mistakes({"effects": [], "may_name": [], "axes": ["speed"]}, {"stribeck": here})) == 1
    assert len(mistakes({"effects": [], "may_name": ["late"], "axes": []}, {"stribeck": here})) == 1


def main(torquescope, make_case):
    teeth()
    run = lambda *command: subprocess.run(command, capture_output=True, text=True, check=True).stdout
    words = json.loads(run(make_case, "--words"))
    # an effect's line begins in the second column; what it breaks into stands further right
    names = re.findall(r"^  (\w+)  ", run(torquescope, "list", "effects"), re.MULTILINE)
    assert len(names) > 20 and len(words["effects"]) > 5, "too little found: have the pages changed?"
    catalogue = {name: parse(run(torquescope, "describe", name)) for name in names}
    found = mistakes(words, catalogue)
    print(
        "\n".join(found)
        or f"{len(words['effects'])} concealed effects speak the words of {len(catalogue)} effects of the engine"
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
