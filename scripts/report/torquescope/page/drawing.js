// What every figure of the page draws with: elements, ticks, numbers, and the box of words at the pointer.
function firstAtOrAfter(time, at) {
  let low = 0, high = time.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle] < at) low = middle + 1; else high = middle;
  }
  return low;
}

function niceStep(span, most) {
  const rough = span / most, power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 2.5, 5, 10].find((factor) => factor * power >= rough) * power;
}

function written(value, step) {
  const power = Math.floor(Math.log10(step * 1.0001));
  const half = Math.abs(step / 10 ** power - 2.5) < 0.1 ? 1 : 0;  // 0.25 needs one more decimal than 0.2
  return value.toFixed(Math.max(0, half - power)).replace("-", "\u2212");
}

function element(svg, name, attributes, text) {
  const made = document.createElementNS(svg.namespaceURI, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

function powerOfTen(power) {
  return "10" + String(power).replace(/[-0-9]/g, (letter) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(letter)]);
}

// a value as a person reads it: four digits, minus U+2212, powers of ten written out
function number(value) {
  if (value === null || !Number.isFinite(value)) return "\u2013";
  const size = Math.abs(value);
  if (value !== 0 && (size < 1e-3 || size >= 1e5)) {
    const [mantissa, exponent] = value.toExponential(2).split("e");
    return `${mantissa} × ${powerOfTen(Number(exponent))}`.replace("-", "\u2212");
  }
  return String(Number(value.toPrecision(4))).replace("-", "\u2212");
}

const quantity = (value, unit) => `${number(value)} ${unit}`.trim();

const pixel = (value) => value.toFixed(1);

// a part of a figure that its legend has hidden is not read either
const isHidden = (figure, part) => figure.hiddenParts?.has(part) ?? false;

// the pointer inside a drawing, in the drawing's own pixels
function placeIn(svg, event) {
  const box = svg.getBoundingClientRect();
  const scale = svg.viewBox.baseVal.width / box.width;
  return { x: (event.clientX - box.left) * scale, y: (event.clientY - box.top) * scale };
}

// Words beside the pointer, and a cross with dots where they were read. Texts come from files: textContent only.
class Reading {
  constructor(area) {
    this.area = area;
    this.box = document.createElement("div");
    this.box.className = "reading";
    this.box.setAttribute("role", "status");
    this.box.hidden = true;
    area.append(this.box);
  }
  // lines: [{ text, colour }]; at, dots in pixels of the drawing; cross: path
  show(svg, at, lines, cross, dots) {
    this.hide();
    this.box.replaceChildren(...lines.map(({ text, colour }) => {
      const line = document.createElement("div");
      line.textContent = text;
      if (colour) line.style.setProperty("--mark", `var(--${colour})`);
      line.classList.toggle("marked", Boolean(colour));
      return line;
    }));
    this.box.hidden = false;
    this.marks = element(svg, "g", { class: "cross", "pointer-events": "none" });
    this.marks.append(element(svg, "path", { d: cross, stroke: "var(--muted)", fill: "none" }));
    for (const { x, y, colour } of dots) {
      const look = { fill: `var(--${colour})`, stroke: "var(--background)", "stroke-width": 1.2 };
      this.marks.append(element(svg, "circle", { cx: pixel(x), cy: pixel(y), r: 4, ...look }));
    }
    svg.append(this.marks);
    this.place(svg, at);
  }
  place(svg, at) {
    const drawing = svg.getBoundingClientRect(), area = this.area.getBoundingClientRect();
    const scale = drawing.width / svg.viewBox.baseVal.width, width = this.box.offsetWidth;
    const x = drawing.left - area.left + at.x * scale, y = drawing.top - area.top + at.y * scale;
    const right = x + 14 + width <= area.width;
    this.box.style.left = `${Math.max(right ? x + 14 : x - 14 - width, 0)}px`;
    this.box.style.top = `${Math.max(y - this.box.offsetHeight - 10, 0)}px`;
  }
  hide() {
    this.box.hidden = true;
    this.marks?.remove();
  }
}
