"""The recording by scipy's least_squares over loops in Python, one line of JSON each.

    python_peer.py RECORDING
"""
import sys

import numpy as np

import joint
import python_loops
import recording
from first_guess import first_guess
from peer_fit import Trace, by_least_squares, rate, report

MANY, TICKS = 1024, 6000  # trials side by side, to see what numpy can do at most


def main(path):
    data = recording.read(path)
    ticks, start = len(data.reference), data.position[0]

    def floats(trials):
        both = [python_loops.one_trial(one, data.reference, start) for one in trials]
        return tuple(np.stack(signal) for signal in zip(*both))

    def arrays(trials):
        return python_loops.side_by_side(trials, data.reference, start)

    guessed = [signal[0] for signal in floats([first_guess(data)])]
    trace = Trace(data)
    guess = first_guess(data)
    trace.saw(*guessed)
    report("where the peers start: least squares", None, trace, guess)

    trace = Trace(data)
    found = by_least_squares(floats, trace, first_guess(data), together=False)
    report("scipy, one trial at a time, floats", rate(lambda: floats([found]), 1, ticks), trace, found)

    trace = Trace(data)
    found = by_least_squares(arrays, trace, first_guess(data), together=True)
    columns = np.tile(found, (len(joint.NAMES) + 1, 1))
    report("scipy, numpy, 9 trials side by side", rate(lambda: arrays(columns), len(columns), ticks), trace, found)

    short = data.reference[:TICKS]
    crowd = np.tile(found, (MANY, 1))
    report(f"numpy, {MANY} trials side by side",
           rate(lambda: python_loops.side_by_side(crowd, short, start), MANY, len(short)))


main(sys.argv[1])
