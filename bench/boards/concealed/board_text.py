"""The board as text for a terminal and as a Markdown table."""
import protocol

SHORT = {protocol.OPEN: "?", protocol.NONE: "-"}

FORMS = {"percent": lambda value: f"{100 * value:.1f} %", "number": lambda value: f"{value:.3f}",
         "count": lambda value: f"{value:g}", "seconds": lambda value: f"{value:.1f} s"}


def number(row, value):
    return "-" if value is None else FORMS[row["form"]](value)


def measured(row):
    if row["value"] is None:
        return "-"
    return number(row, row["value"]) + (
        f"  ({row['hits']} of {row['n']})" if row["hits"] is not None else f"  (n = {row['n']})"
    )


def bounds(row):
    if row["low"] is None and row["high"] is None:
        return "-"
    return f"{number(row, row['low'])} to {number(row, row['high'])}"


def verdict(row, level):
    """Level and whether it holds; the bound the protocol states for it is in the Markdown table and on the page."""
    return (
        f"{row[level].split(' (')[0]:18} {SHORT.get(row[level + '_holds'], row[level + '_holds']):4}"
        if row[level]
        else ""
    )


def head_lines(suite):
    several = lambda hashes: ", ".join(h[:12] for h in hashes) or "unknown"
    mixed = "   MIXED: these cases were not all diagnosed by one program" if len(suite["programs_sha256"]) > 1 else ""
    return [
        f"{suite['cases']} cases, suite seed {', '.join(map(str, suite['suite_seeds'])) or '-'}; "
        f"sealed truths {suite['truths_sha256']}",
        f"program {several(suite['programs_sha256'])}, plant {several(suite['plants_sha256'])}{mixed}",
        *left_out_lines(suite),
    ]


def left_out_lines(suite):
    """What half a step changes in them, as share of the noise floor: with chaos there is no truth to be judged by."""
    error = lambda one: "lost" if one["step_error"] is None else f"{one['step_error']:.2g} of the noise"
    cases = ", ".join(f"{one['case']} ({error(one)})" for one in suite["left_out"])
    of_all = f"{len(suite['left_out'])} of {suite['cases'] + len(suite['left_out'])}"
    return [f"cases left out, plant not exact ({of_all}): {cases}"] if cases else []


def case_line(j, width):
    said = ", ".join(name for name, *_ in j.names) or "-"
    levels = ", ".join(f"{f.name} {f.level}" for f in j.found) or ", ".join(j.concealed) or "-"
    right = "right" if j.right else "WRONG"
    return f"{j.drawn or j.case:{width}} {protocol.size(j):7.2f}  {j.verdict:12} {right:6} {levels:44} {said}"


def table_lines(rows):
    lines = [f"{'':58} {'measured':21} {'95 % sure above, below':23} {'pass':18} {'':4} stretch"]
    for row in rows:
        lines.append(
            f"{row['words']:58} {measured(row):21} {bounds(row):23} {verdict(row, 'pass')} "
            f"{verdict(row, 'stretch')}".rstrip()
        )
    return lines + ["? too few cases to say; - not measured"]


def tier_lines(tiers):
    lines = [f"{'tier':36} {'cases':>6} {'right':>6} {'with a false name':>18} {'no answer':>10}"]
    for t in tiers:
        right, false, silent = (t[key]["hits"] for key in ("right", "false_name", "no_answer"))
        lines.append(f"{t['tier']} {t['words']:33} {t['right']['n']:6} {right:6} {false:18} {silent:10}")
    return lines


def power_lines(power):
    share = lambda band: f"{band['hits']:3} of {band['n']:<3}"
    lines = [f"{'tier':5} {'SNR_eff':>7}  {'exact':10} {'class':10} {'family':10} {'3 guesses':10} {'false name':10}"]
    return lines + [
        f"{row['tier']:5} {row['size']:7g}  {share(row['exact']):10} {share(row['class']):10} "
        f"{share(row['family']):10} "
        f"{share(row['guess']):10} {share(row['false_name']):10}".rstrip()
        for row in power
    ]


def rival_lines(methods):
    """The measured column of every method side by side."""
    width = max(16, *(len(name) + 2 for name in methods))
    tables = [method["table"] for method in methods.values()]
    lines = [f"{'':58} " + "".join(f"{name:{width}}" for name in methods).rstrip()]
    for rows in zip(*tables):
        lines.append(
            f"{rows[0]['words']:58} " + "".join(f"{number(row, row['value']):{width}}" for row in rows).rstrip()
        )
    return lines


def text(board, judgements=()):
    """judgements: cases of ours to print a line for."""
    ours, lines = next(iter(board["methods"].values())), []
    if judgements:
        width = max(10, *(len(j.drawn or j.case) for j in judgements))
        lines += [f"{'case':{width}} {'SNR_eff':>7}  {'verdict':12} {'':6} {'concealed':44} said"]
        lines += [case_line(j, width) for j in judgements] + [""]
    lines += [*head_lines(board["suite"]), "", *table_lines(ours["table"]), "", *tier_lines(ours["tiers"])]
    if ours["power"]:
        lines += [
            "",
            "everything found and nothing invented, by the size each effect was made with",
            *power_lines(ours["power"]),
        ]
    if len(board["methods"]) > 1:
        lines += ["", "the same cases, every method", *rival_lines(board["methods"])]
    return "\n".join(lines)


def markdown(board):
    methods = board["methods"]
    ours, *rivals = methods
    lines = [
        f"{board['suite']['cases']} cases, suite seed {', '.join(map(str, board['suite']['suite_seeds'])) or '-'}, "
        f"sealed truths `{board['suite']['truths_sha256'][:16]}`.",
        *left_out_lines(board["suite"]),
        "",
        "| | measured | 95 % sure above, below | pass level | holds | stretch level | holds |"
        + "".join(f" {rival} |" for rival in rivals),
        "|---|---|---|---|---|---|---|" + "---|" * len(rivals),
    ]
    for index, row in enumerate(methods[ours]["table"]):
        others = [methods[rival]["table"][index] for rival in rivals]
        cells = [
            row["words"],
            measured(row),
            bounds(row),
            row["pass"],
            row["pass_holds"],
            row["stretch"],
            row["stretch_holds"],
            *(number(other, other["value"]) for other in others),
        ]
        lines.append("| " + " | ".join(cell.replace("  ", " ") for cell in cells) + " |")
    return "\n".join(lines)
