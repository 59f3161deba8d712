"""python -m torquescope convert BAG TABLE: what the program does not read itself.

Exit codes are those of the program (jobs/README.md), and 69 when rosbags, or pyarrow, is not installed.
"""

import argparse
import sys

from .errors import Error
from .ros import convert

CODES = ((FileNotFoundError, 66), (FileExistsError, 73), (ImportError, 69), (OSError, 74))


def _parser():
    parser = argparse.ArgumentParser(prog="python -m torquescope")
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("convert", help="a bag of ROS 1 or ROS 2, an MCAP file, or a data set of LeRobot, "
                                             "to a recording")
    one.add_argument("bag", help="run.mcap, run.bag, run.db3, the folder of a bag of ROS 2 or of a LeRobot data set")
    one.add_argument("out", help="rec.h5 or rec.csv")
    one.add_argument("--topic", action="append", default=[], metavar="NAME",
                     help="read this topic; may be repeated (default: every topic of plain numbers)")
    one.add_argument("--receive-time", action="store_true",
                     help="the recorder's stamps for all topics, not those of headers")
    one.add_argument("--reference", default="", metavar="TOPIC[/FIELD]",
                     help="the commanded positions (default: what is called so, and the positions follow)")
    one.add_argument("--effort", default="", metavar="TOPIC[/FIELD]",
                     help="efforts or motor currents of the joints, where the joint states have none")
    one.add_argument("--episode", type=int, default=0, metavar="N", help="of a LeRobot data set, counted from 0")
    return parser


def main(arguments=None):
    parser = _parser()
    try:
        given = parser.parse_args(arguments)
    except SystemExit as end:
        return 64 if end.code else 0
    try:
        print(convert(given.bag, given.out, given.topic, given.receive_time, given.reference, given.effort,
                      given.episode))
    except (Error, OSError, ImportError) as error:
        print(error, file=sys.stderr)
        return getattr(error, "exit_code", None) or next(code for kind, code in CODES if isinstance(error, kind))
    return 0


if __name__ == "__main__":
    sys.exit(main())
