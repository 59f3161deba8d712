"""What else belongs to the joints of a bag: the commanded position, wherever it is, and the effort.

Reference  what a topic or a field calls commanded ("desired.positions", "/joint_commands"), and the position follows
           (follow.py). Numbers without names go to the joints that follow them; joints at rest by the message's order
Effort     that of another topic only where it is asked for: no number tells a motor current from a temperature
Told       what was taken, what looked like it and was not, and that nothing was found
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..errors import DataError
from .follow import Following, following
from .joints import changes, fields_of, homes_of, in_order, pieces_of
from .words import drive_word, is_commanded, is_no_signal, quantity_of

CLEARLY = 4.0  # times less than another joint: then a number of a list is this joint's


@dataclass
class Roles:
    moved: dict[str, str] = field(default_factory=dict)  # path of a column: its new name, beside the joint's position
    lines: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class _Offer:
    """A command for a joint; rank: which to prefer."""

    rank: int
    piece: object
    following: Following


def roles_of(columns, step_s, reference="", effort=""):
    """Roles of {path: Column}, rows step_s apart. reference, effort: a topic, or topic/field, that was asked for."""
    homes = homes_of(columns)
    roles = Roles()
    if not homes:
        if reference or effort:
            raise DataError("error: no topic has positions of joints by name, to which a reference or an effort could "
                            "go\n  help: name the columns in the job: [recording] columns")
        roles.lines.append("joints    none has a name here; name the columns in the job: [recording] columns")
        return roles
    groups = fields_of(pieces_of(columns, homes))
    _references(groups, homes, step_s, reference, roles)
    _efforts(columns, groups, homes, effort, roles)
    return roles


def _is_asked(group, asked):
    topic, of = group[0].column.topic.name, group[0].field
    return asked.strip("/") in (topic.strip("/"), f"{topic}/{of}".strip("/"))


def _asked(groups, asked, option):
    found = [group for group in groups if _is_asked(group, asked)]
    if not found:
        known = dict.fromkeys(group[0].column.topic.name for group in groups)
        raise DataError(f"error: {option} {asked}: no numbers of such a topic\n  those that have: {', '.join(known)}")
    if len(found) > 1:  # of a message with several fields the one that says it
        told = [group for group in found if (quantity_of(group[0].field) or "effort") ==
                ("position" if option == "--reference" else "effort")]
        found = told if len(told) == 1 else found
    if len(found) > 1:
        fields = ", ".join(f"{asked}/{group[0].field}" for group in found)
        raise DataError(f"error: {option} {asked} has several fields\n  help: {option} with one of {fields}")
    return found[0]


# the commanded position

def _is_command(group):
    topic, of = group[0].column.topic, group[0].field
    says_so = topic.is_command or is_commanded(of)
    return says_so and not is_no_signal(of) and (quantity_of(of) or quantity_of(topic.name) or "position") == "position"


def _references(groups, homes, step_s, asked, roles):
    offers, declined, seen = {}, [], set()
    chosen = [_asked(groups, asked, "--reference")] if asked else [group for group in groups if _is_command(group)]
    for group in chosen:
        seen.add(id(group))
        pairs = _assigned(group, homes, step_s, bool(asked))
        for home in homes:
            if home.joint not in pairs:
                continue
            piece, told = pairs[home.joint]
            if asked or told.is_good or (np.isnan(told.share) and not told.is_copy):
                offers.setdefault(home.joint, []).append(_Offer(_rank(piece), piece, told))
            else:
                declined.append((group, home.joint, told))
        if not pairs:
            roles.lines.append(f"not taken {group[0].source}, {_counted(group)}: no joint follows one of them")
    without = []
    for home in homes:
        if home.joint not in offers:
            without.append(home.joint)
            continue
        best = min(offers[home.joint], key=lambda offer: (offer.rank, np.nan_to_num(offer.following.share)))
        roles.moved[best.piece.path] = f"{home.prefix}/reference_position"
        roles.lines.append(f"reference of {home.joint}: {best.piece.column.name} of {best.piece.source}"
                           f"{_how(best.following)}")
    for group, joint, told in declined:
        if joint in without:
            roles.lines.append(f"not taken {group[0].field} of {group[0].source} for {joint}: {_why_not(told)}")
    if without:
        roles.lines.append(f"reference none of {_listed(without)}: no message looks like the commanded position; "
                           "record it, small effects are not found without; --reference TOPIC names it")
        _offer_references(groups, homes, step_s, seen, without, roles)


def _rank(piece):
    if not piece.column.topic.is_command:
        return 0  # of the controller itself, as it used it
    return 2 if piece.index is not None else 1


def _assigned(group, homes, step_s, is_asked):
    """{joint: (Piece, Following)}."""
    by_joint = {home.joint: home for home in homes}
    ordered = in_order(group, homes)
    ordered = {joint: piece for joint, piece in ordered.items() if joint in by_joint}
    pairs = {joint: (piece, _following(piece, by_joint[joint], step_s)) for joint, piece in ordered.items()}
    is_named = all(piece.joint and (piece.index is None or len(group) == 1) for piece in group)
    if is_named or (is_asked and pairs):
        return pairs
    shares = np.array([[_following(piece, home, step_s).share for home in homes] for piece in group])
    if pairs and _order_holds(shares):
        return pairs
    found = {}
    for k, row in enumerate(shares):
        moving = np.flatnonzero(np.isfinite(row))
        if not moving.size:
            continue
        best = moving[np.argmin(row[moving])]
        others = [*np.delete(row, best), *np.delete(shares[:, best], k)]
        if all(not value < CLEARLY * row[best] for value in others):  # NaN: a joint at rest
            found[homes[best].joint] = group[k], _following(group[k], homes[best], step_s)
    return {joint: pair for joint, pair in found.items() if pair[1].is_good}


def _order_holds(shares):
    """Whether no joint that moves follows another number much better than that in its place."""
    own = np.diag(shares)
    moving = np.isfinite(own)
    least = np.nanmin(np.where(moving, shares, np.nan)[:, moving], axis=0) if moving.any() else np.empty(0)
    return moving.any() and bool(np.all(own[moving] <= CLEARLY * least))


def _following(piece, home, step_s):
    return following(piece.column.values, home.position.values, step_s, piece.column.is_own)


def _how(told):
    if np.isnan(told.share):
        return ", by name or by order: the joint is at rest"
    return f"; the position follows it ({100 * told.share:.2g} % of its variance is left" + \
        (f", {1e3 * told.lag_s:.0f} ms later)" if told.lag_s > 0 else ")")


def _why_not(told):
    if told.is_copy:
        return "it is the measured position once more"
    return f"the position does not follow it ({100 * min(told.share, 9.99):.0f} % of its variance is left)"


def _offer_references(groups, homes, step_s, seen, without, roles):
    """What nothing calls a command, and joints follow all the same."""
    own = {home.path for home in homes}
    for group in groups:
        if id(group) in seen or any(piece.path in own for piece in group) or \
                (quantity_of(group[0].field) or "position") != "position" or is_no_signal(group[0].field):
            continue
        pairs = _assigned(group, homes, step_s, False)
        good = [joint for joint, (_, told) in pairs.items() if told.is_good and joint in without]
        if good:
            roles.lines.append(f"reference may be {group[0].source}, {_counted(group)}; --reference "
                               f"{group[0].column.topic.name} takes it")


# the effort

def _efforts(columns, groups, homes, asked, roles):
    own = {home.joint: [path for path in columns if path.startswith(home.prefix + "/")
                        and _is_effort(path[len(home.prefix):])] for home in homes}
    if asked:
        return _take_effort(_asked(groups, asked, "--effort"), homes, roles)
    without = [home.joint for home in homes if not any(changes(columns[path].values) for path in own[home.joint])]
    if not without:
        return
    is_zero = any(own[joint] for joint in without)
    roles.lines.append(f"effort    none of {_listed(without)}" + (": it never changes" if is_zero else ""))
    for group in groups:
        pieces = in_order(group, homes)
        if any(joint in without for joint in pieces) and _may_be_effort(group, homes, roles):
            roles.lines.append(f"effort    may be {group[0].source}, {_counted(group)}; --effort "
                               f"{_shortest(group, groups)} takes it")


def _is_effort(of):
    return quantity_of(of) == "effort" and not is_commanded(of) and not is_no_signal(of)


def _take_effort(group, homes, roles):
    pieces = in_order(group, homes)
    taken = [home for home in homes if home.joint in pieces]
    if not taken:
        raise DataError(f"error: {group[0].source} has {_counted(group)} and no names, and there are {len(homes)} "
                        f"joints: {_listed([home.joint for home in homes])}\n"
                        "  help: name the columns in the job: [recording] columns")
    word = drive_word(f"{group[0].column.topic.name} {group[0].field}")
    for home in taken:
        piece = pieces[home.joint]
        if piece.path != f"{home.prefix}/{word}":
            roles.moved[piece.path] = f"{home.prefix}/{word}"
        by = "in the message's order" if piece.index is not None else "by name"
        roles.lines.append(f"effort    {home.prefix}/{word}: {piece.column.name} of {piece.source}, {by}")


def _may_be_effort(group, homes, roles):
    topic, of = group[0].column.topic, group[0].field
    if any(piece.path in roles.moved for piece in group) or any(piece.path == home.path for piece in group
                                                                for home in homes):
        return False
    said = quantity_of(of) or quantity_of(topic.name)
    plain = said is None and not topic.is_command and group[0].index is not None
    return (said == "effort" or plain) and any(changes(piece.column.values) for piece in group)


def _shortest(group, groups):
    topic = group[0].column.topic.name
    alone = sum(other[0].column.topic.name == topic for other in groups) == 1
    return topic if alone else f"{topic}/{group[0].field}"


def _counted(group):
    messages, numbers = group[0].column.topic.messages, len(group)
    return f"{messages} messages of {numbers} number{'' if numbers == 1 else 's'}"


def _listed(joints):
    return ", ".join(joints)
