// Still figures: values under the pointer and zooming by a drag. The svg names a script element with its axes
// (readings.py): pixel box, limits, and the numbers of what is drawn there.
class Axes {
  constructor(svg, told) {
    Object.assign(this, told);
    this.svg = svg;
    const [left, top, right, bottom] = told.box;
    this.home = { left, top, right, bottom };
    this.view = this.home;  // which part of the first picture is shown, in its pixels
    this.group = svg.querySelector(`[data-part="axes-${told.index}"]`);
  }
  holds({ x, y }) {
    const { left, top, right, bottom } = this.home;
    return x >= left - 2 && x <= right + 2 && y >= top - 2 && y <= bottom + 2;
  }
  // from the first picture to this view, and back
  toView(x, y) {
    const { left, top, right, bottom } = this.home, view = this.view;
    return [left + ((x - view.left) / (view.right - view.left)) * (right - left),
      top + ((y - view.top) / (view.bottom - view.top)) * (bottom - top)];
  }
  fromView(x, y) {
    const { left, top, right, bottom } = this.home, view = this.view;
    return [view.left + ((x - left) / (right - left)) * (view.right - view.left),
      view.top + ((y - top) / (bottom - top)) * (view.bottom - view.top)];
  }
  // from a value to a pixel of the first picture, and back
  static place(axis, value, first, last) {
    const of = axis.log ? Math.log10 : (number) => number;
    return first + ((of(value) - of(axis.from)) / (of(axis.to) - of(axis.from))) * (last - first);
  }
  static value(axis, place, first, last) {
    const share = (place - first) / (last - first);
    return axis.log ? axis.from * (axis.to / axis.from) ** share : axis.from + share * (axis.to - axis.from);
  }
  pixels(x, y) {
    const { left, top, right, bottom } = this.home;
    return this.toView(Axes.place(this.x, x, left, right), Axes.place(this.y, y, bottom, top));
  }
  values(px, py) {
    const { left, top, right, bottom } = this.home, [x, y] = this.fromView(px, py);
    return [Axes.value(this.x, x, left, right), Axes.value(this.y, y, bottom, top)];
  }

  // ---- reading
  read(at, figure) {
    const [x, y] = this.values(at.x, at.y);
    return this.readNote(at, x, y) ?? this.readGrid(at, x, y) ?? this.readSeries(at, x, figure);
  }
  readNote(at, x, y) {
    const inside = this.notes.find(({ cell }) => cell && within(cell[0], x, cell[1]) && within(cell[2], y, cell[3]));
    if (inside) return { at, lines: [{ text: inside.words }], cross: "", dots: [] };
    let best = null, least = 18;
    for (const note of this.notes.filter((one) => one.at)) {
      const [px, py] = this.pixels(...note.at), distance = Math.hypot(px - at.x, py - at.y);
      if (distance < least) [best, least] = [{ note, px, py }, distance];
    }
    if (!best) return null;
    const { px, py } = best;
    const ring = `M${pixel(px - 8)} ${pixel(py)}a8 8 0 1 0 16 0a8 8 0 1 0 -16 0`;
    return { at: { x: px, y: py }, lines: [{ text: best.note.words }], cross: ring, dots: [] };
  }
  readGrid(at, x, y) {
    for (const grid of this.grids) {
      const value = grid.values[cellOf(grid.x, x)]?.[cellOf(grid.y, y)];
      if (value === undefined) continue;
      const lines = [{ text: said(this.x, x) }, ...(this.y.word ? [{ text: said(this.y, y) }] : []),
        { text: value === null ? "nothing here" : `${grid.word} ${number(value)}` }];
      return { at, lines, cross: "", dots: [] };
    }
    return null;
  }
  readSeries(at, x, figure) {
    const { top, bottom } = this.home, lines = [], dots = [];
    let where = x;
    for (const one of this.series) {
      if (isHidden(figure, one.part)) continue;
      const found = nearestValue(one, x);
      if (!found) continue;
      if (!lines.length) where = found.x;
      const name = this.series.length > 1 || !this.y.word ? one.label : this.y.word;
      lines.push({ text: `${name} ${quantity(found.y, this.y.unit)}`, colour: one.colour });
      const [px, py] = this.pixels(found.x, found.y);
      if (this.holds({ x: px, y: py }) && !one.edges) dots.push({ x: px, y: py, colour: one.colour });
    }
    if (!this.x.word && !lines.length) return null;
    const [px] = this.pixels(where, this.y.from);
    return { at: { x: px, y: at.y }, lines: [{ text: said(this.x, where) }, ...lines],
      cross: `M${pixel(px)} ${top}V${bottom}`, dots };
  }

  // ---- zooming: every point of the first picture is moved, so lines keep their width
  zoomTo(view) {
    this.drawn ??= drawnIn(this);
    this.view = view;
    const move = (x, y) => this.toView(x, y);
    for (const [node, write] of this.drawn) write(node, move);
    const isHome = view === this.home;
    for (const tick of this.ticksOf("x").concat(this.zoom === "xy" ? this.ticksOf("y") : []))
      tick.style.display = isHome ? "" : "none";
    this.scale?.remove();
    if (!isHome) this.group.prepend((this.scale = scaleOf(this)));
  }
  // numbers and grid of one axis, without its words
  ticksOf(which) {
    const drawn = this.svg.querySelector(`[data-part="${which}-axis-${this.index}"]`);
    return [...(drawn?.children ?? [])].filter((one) => one.querySelector(":scope > g"));
  }
}

const within = (a, value, b) => value >= Math.min(a, b) && value <= Math.max(a, b);

const said = (axis, value) => `${axis.word} ${quantity(value, axis.unit)}`.trim();

// index of the cell between two edges; -1 outside
function cellOf(edges, value) {
  for (let i = 0; i + 1 < edges.length; i++) if (within(edges[i], value, edges[i + 1])) return i;
  return -1;
}

// { x, y } of a series at x: of its nearest point, of the step that holds it; null where nothing is near
function nearestValue({ x: places, y: values, edges }, x) {
  if (edges) {
    const cell = cellOf(edges, x);
    return cell < 0 ? null : { x, y: values[cell] };
  }
  let best = -1;
  places.forEach((place, i) => {
    if (place === null || values[i] === null) return;
    if (best < 0 || Math.abs(place - x) < Math.abs(places[best] - x)) best = i;
  });
  return best < 0 ? null : { x: places[best], y: values[best] };
}
