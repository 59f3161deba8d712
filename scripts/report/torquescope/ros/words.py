"""What the words of a topic or a field say: which quantity, and whether it was commanded.

As the program does with names of columns (engine/data/column_word.cpp): words end where letters do, and where a capital
follows a small letter; a plural counts as its singular. A prefix or suffix is a word: "q_des", "cmd_position".
"""

import re

COMMANDED = frozenset("cmd command commanded des desired goal target tgt set setpoint sp ref reference demand demanded "
                      "soll nominal".split())
NO_SIGNAL = frozenset("error err acceleration accel acc jerk time stamp limit max min temperature temp status mode "
                      "output out gain kp ki kd".split())
QUANTITY = {word: quantity for quantity, words in {
    "position": "position pos angle q theta",
    "velocity": "velocity vel speed qd dq qdot twist",
    "effort": "effort torque tau force wrench current curr amps iq load pwm duty volt voltage"}.items()
    for word in words.split()}
DRIVE = {"current": "current", "curr": "current", "amps": "current", "iq": "current", "load": "load", "pwm": "pwm",
         "duty": "pwm", "volt": "voltage", "voltage": "voltage"}  # what a motor makes torque of, as a column is called


def words(text):
    split = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", text)
    lowered = (word.lower() for word in split)
    return [word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith("ss") else word for word in lowered]


def quantity_of(text):
    """The last word that says one, or None."""
    return next((QUANTITY[word] for word in reversed(words(text)) if word in QUANTITY), None)


def is_commanded(text):
    said = words(text)
    return not COMMANDED.isdisjoint(said) or "set point" in " ".join(said)


def is_no_signal(text):
    return not NO_SIGNAL.isdisjoint(words(text))


def drive_word(text):
    """ "current", "load", "pwm", "voltage", else "effort"."""
    return next((DRIVE[word] for word in reversed(words(text)) if word in DRIVE), "effort")
