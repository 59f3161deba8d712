"""A matplotlib figure as inline SVG: the page's colours by CSS variable, the page's font, short numbers, no stray ids.

matplotlib names what carries a gid by id; here 'part:x' becomes data-part="x" (page.js finds it), ids that nothing
refers to go, and the rest are made unique to the figure by svg.hashsalt, so that equal input gives equal bytes.
"""

import html
import io
import re

import matplotlib

from . import style

_COLOURS = {light.lower(): f"var(--{name})" for name, light in style.LIGHT.items()}
_NUMBER = re.compile(r"-?\d+\.\d{2,}")
_PATH = re.compile(r'\bd="([^"]*)"')


def inline(figure, name, title, description, css_class, attributes=None):
    """The <svg> element; `attributes` become data-* attributes. What carries a gid "part:x" is found by page.js."""
    buffer = io.StringIO()
    with matplotlib.rc_context({**style.LOOK, "svg.hashsalt": f"{name} {css_class}"}):
        figure.savefig(buffer, format="svg", metadata={key: None for key in ("Date", "Creator", "Format", "Type")})
    text = buffer.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r"<!--.*?-->|<style.*?</style>", "", text, flags=re.S)
    text = text.replace("xlink:href", "href")
    text = _PATH.sub(lambda match: f'd="{_short_path(match[1])}"', text)
    text = re.sub(r'id="part:([^"]+)"', r'data-part="\1"', text)
    referred = set(re.findall(r'#([\w-]+)[")]', text))
    text = re.sub(r' id="([^"]+)"', lambda match: match[0] if match[1] in referred else "", text)
    text = re.sub(r"#[0-9a-f]{6}\b", lambda match: _COLOURS.get(match[0], match[0]), text)
    text = re.sub(r"font: ((?:\d+|bold|italic) )?([\d.]+)px [^;\"]*", _font, text)
    text = re.sub(r"\n\s*", "\n", text)
    body = text[text.index(">") + 1:]
    width, height = (round(72 * inches) for inches in figure.get_size_inches())
    data = "".join(f' data-{key}="{html.escape(value)}"' for key, value in (attributes or {}).items())
    return (
        f'<svg class="{css_class}" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img"{data}>'
        f"<title>{html.escape(title)}</title><desc>{html.escape(description)}</desc>{body}"
    )


def _font(match):
    weight = "font-weight:600;" if (match[1] or "").strip() in ("bold", "600", "700") else ""
    return f"{weight}font-size:{match[2]}px"


def _short_path(path):
    # half a tenth of a pixel cannot be seen, and the numbers are most of the page
    path = _NUMBER.sub(lambda match: f"{float(match[0]):.1f}".rstrip("0").rstrip("."), path)
    return re.sub(r"\s*([MLCQZz])\s*", r"\1", path.replace("\n", " ")).strip()
