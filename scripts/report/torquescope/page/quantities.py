"""Numbers and units as a person reads them: SI, a space before the unit, minus U+2212, powers of ten written out."""

import math

MINUS = "\u2212"
LONGEST = 1e7
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_COUNT_WORDS = "no one two three four five six seven eight nine ten eleven twelve".split()


def number(value, digits=3):
    """Three significant digits unless told; 8.1 × 10⁻¹² outside 0.0001 ... 99 999; an en dash when absent."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    if 1e-4 <= abs(value) < 99999.5:
        decimals = max(digits - 1 - math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}")))), 0)
        return _minus(f"{value:.{decimals}f}")
    mantissa, exponent = f"{value:.{max(digits - 2, 0)}e}".split("e")
    return f"{_minus(mantissa)} × {power_of_ten(int(exponent))}"


def fixed(value, decimals):
    """The same number of decimals for a whole column; a zero has no sign, and what is too long a power of ten."""
    if value is None or not math.isfinite(value):
        return "–"
    if abs(value) >= LONGEST:
        return number(value)
    text = f"{value:.{decimals}f}"
    return _minus(text.lstrip("-") if float(text) == 0 else text)


def decimals_for(error, value=0.0):
    """Decimals that show an uncertainty with two digits; four significant digits of the value when there is none."""
    if error is not None and math.isfinite(error) and error > 0:
        return min(max(1 - math.floor(math.log10(error)), 0), 12)
    if value and math.isfinite(value):
        return min(max(3 - math.floor(math.log10(abs(value))), 0), 12)
    return 0


def power_of_ten(exponent):
    return "10" + str(exponent).translate(_SUPERSCRIPT)


def tick(value, _position=None):
    """For axes: as short as the value allows."""
    if abs(value) < 1e-14:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        return _minus(f"{value:.6g}")
    mantissa, exponent = f"{value:.3e}".split("e")
    mantissa = f"{float(mantissa):g}"
    return power_of_ten(int(exponent)) if mantissa == "1" else f"{_minus(mantissa)}×{power_of_ten(int(exponent))}"


def log_tick(value, _position=None):
    return power_of_ten(round(math.log10(value))) if value > 0 else ""


def percent(fraction, digits=2):
    if fraction is None or not math.isfinite(fraction):
        return "–"
    return f"{number(100 * fraction, digits)} %"


def unit(text):
    """'kg m2' or 'kg m^2' as stored becomes 'kg m²'; '1' (no unit) becomes ''."""
    if text == "1":
        return ""
    text, pretty = text.replace("^", ""), []
    for index, letter in enumerate(text):
        before = text[index - 1] if index else " "
        pretty.append(letter.translate(_SUPERSCRIPT) if letter in "-0123456789" and (before.isalpha() or before in ")-")
                      else letter)
    return "".join(pretty)


def with_unit(text, unit_text):
    """'0.354' and 'N m' to '0.354 N m'."""
    return f"{text} {unit(unit_text)}".strip()


def square(unit_text):
    """The unit of a mean square: 'N m' gives '(N m)²', 'N' gives 'N²'."""
    if unit_text in ("", "1"):
        return ""
    return f"({unit(unit_text)})²" if " " in unit_text or "/" in unit_text else f"{unit(unit_text)}²"


def count(n, noun, plural=None):
    """'1 run', '30 runs', '60 000 samples'."""
    return f"{whole(n)} {noun if n == 1 else plural or noun + 's'}"


def shortened(text, letters=80):
    """A name as a page has room for it: a job or a file may be called anything."""
    return text if len(text) <= letters else text[:letters - 1] + "…"


def whole(n):
    """Thousands apart by a narrow no-break space from 10 000 on."""
    return f"{int(n):,}".replace(",", "\u202f") if abs(n) >= 10000 else str(int(n))


def count_word(n):
    """Small counts as words, for sentences."""
    return _COUNT_WORDS[n] if 0 <= n < len(_COUNT_WORDS) else whole(n)


def listed(words):
    """'a', 'a and b', 'a, b and c'."""
    words = list(words)
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}" if words else ""


def seconds(value):
    """'0.4 s', '12 s', '3 min 20 s', '2 h 5 min'."""
    if value is None or not math.isfinite(value):
        return "–"
    if value < 100:
        return f"{value:.2g} s" if value < 10 else f"{value:.0f} s"
    minutes, rest = divmod(round(value), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    return f"{minutes // 60} h {minutes % 60} min"


def _minus(text):
    return text.replace("-", MINUS)
