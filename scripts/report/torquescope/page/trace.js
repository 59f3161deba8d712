// Rows of traces over one time axis. The svg carries data-layout (pixel lines of its rows, limits, names of its lines)
// and data-samples; both widths of one figure share one view: { start, stop, rows: { index: [low, high] } }.
class Trace {
  constructor(svg) {
    this.svg = svg;
    this.layout = JSON.parse(svg.dataset.layout);
    this.axis = null;
    this.brush = element(svg, "path", { fill: "var(--ink)", "fill-opacity": 0.1, d: "" });
    svg.append(this.brush);
  }
  parts(name) {
    return this.svg.querySelectorAll(`[data-part="${name}"]`);
  }
  draw(view, samples) {
    const { left, right } = this.layout;
    for (const row of this.boxes(view)) {
      for (const part of row.lines) {
        const line = this.parts(part)[0].querySelector("path");
        line.setAttribute("d", path(samples.time, samples.line(part), view, { left, right, ...row }));
      }
    }
    this.shade(view);
    this.bands(view);
    this.ticks(view);
    this.window(view, samples.time);
  }
  // the rows with the limits of this view
  boxes(view) {
    return this.layout.rows.map((row, i) => {
      const [low, high] = view.rows?.[i] ?? [row.low, row.high];
      return { ...row, low, high };
    });
  }
  bands(view) {
    const { left, right } = this.layout, drawn = this.parts("band");
    this.boxes(view).filter((row) => row.band).forEach((row, i) => {
      const y = (value) => pixel(Math.min(Math.max(height(row, value), row.top), row.bottom));
      drawn[i]?.querySelector("path").setAttribute("d",
        `M${left} ${y(row.band)}H${right}V${y(-row.band)}H${left}Z`);
    });
  }
  shade(view) {
    const { left, right, rows, regions = [] } = this.layout;
    const x = (at) => (left + ((at - view.start) / (view.stop - view.start)) * (right - left)).toFixed(1);
    const seen = regions.filter(([begin, end]) => end > view.start && begin < view.stop)
      .map(([begin, end]) => [x(Math.max(begin, view.start)), x(Math.min(end, view.stop))]);
    this.parts("regions").forEach((part, i) => part.querySelector("path").setAttribute("d",
      seen.map(([begin, end]) => `M${begin} ${rows[i].top}H${end}V${rows[i].bottom}H${begin}Z`).join("")));
  }
  ticks(view) {
    const { left, right, rows } = this.layout;
    this.parts("x-axis").forEach((drawn) => drawn.remove());
    if (this.axis) this.axis.remove();
    this.axis = element(this.svg, "g", {});
    const step = niceStep(view.stop - view.start, right - left > 600 ? 9 : 4);
    const bottom = rows[rows.length - 1].bottom;
    for (let k = Math.ceil(view.start / step - 1e-9); k * step <= view.stop + 1e-9 * step; k++) {
      const x = left + ((k * step - view.start) / (view.stop - view.start)) * (right - left);
      const d = rows.map((row) => `M${x.toFixed(1)} ${row.top}V${row.bottom}`).join("");
      this.axis.append(element(this.svg, "path", { d, stroke: "var(--grid)", fill: "none" }));
      if (x < left + 8 && left < 20) continue;
      const label = {
        x: Math.min(x, right - 4).toFixed(1), y: bottom + 16,
        "text-anchor": "middle", "font-size": "12px", fill: "var(--muted)",
      };
      this.axis.append(element(this.svg, "text", label, written(k * step, step)));
    }
    this.boxes(view).forEach((row, i) => {
      const zoomed = Boolean(view.rows?.[i]);
      this.parts("y-axis")[i].style.display = zoomed ? "none" : "";
      if (zoomed) this.heights(row);
    });
    // below the lines, above the background
    this.svg.querySelector("g").prepend(this.axis);
  }
  // grid and numbers of a row that is zoomed in height
  heights(row) {
    const { left, right } = this.layout;
    const step = niceStep(row.high - row.low, row.bottom - row.top > 100 ? 4 : 2);
    for (let k = Math.ceil(row.low / step - 1e-9); k * step <= row.high; k++) {
      const y = pixel(height(row, k * step));
      this.axis.append(element(this.svg, "path", { d: `M${left} ${y}H${right}`, stroke: "var(--grid)", fill: "none" }));
      const label = { x: left - 5, y: Number(y) + 4, "text-anchor": "end", "font-size": "12px", fill: "var(--muted)" };
      this.axis.append(element(this.svg, "text", label, written(k * step * row.times, step * row.times)));
    }
  }
  // what stands under a place: the row there, or all rows where each has one line; null outside of them
  read(at, view, samples, figure) {
    const { left, right } = this.layout, rows = this.boxes(view);
    const under = rows.filter((row) => at.y >= row.top && at.y <= row.bottom);
    if (!under.length || at.x < left || at.x > right) return null;
    const nearest = nearestIndex(samples.time, this.time(at.x, view)), time = samples.time[nearest];
    const x = left + ((time - view.start) / (view.stop - view.start)) * (right - left);
    const lines = [{ text: `${time.toFixed(3)} s` }], dots = [];
    for (const row of rows.every((one) => one.lines.length === 1) ? rows : under) {
      row.lines.forEach((part, i) => {
        if (isHidden(figure, part)) return;
        const value = samples.line(part)[nearest], colour = row.colours[i];
        lines.push({ text: `${row.labels[i]} ${quantity(value * row.times, row.unit)}`, colour });
        if (value >= row.low && value <= row.high) dots.push({ x, y: height(row, value), colour });
      });
    }
    const cross = rows.map((row) => `M${pixel(x)} ${row.top}V${row.bottom}`).join("");
    return { at: { x, y: at.y }, lines, cross, dots };
  }
  window(view, time) {
    const strip = this.layout.overview;
    if (!strip) return;
    const x = (at) => this.stripX(at, time);
    this.parts("window")[0].querySelector("path").setAttribute(
      "d", `M${x(view.start)} ${strip.top}H${x(view.stop)}V${strip.bottom}H${x(view.start)}Z`);
  }
  stripX(at, time) {
    const { left, right } = this.layout;
    return (left + ((at - time[0]) / (time[time.length - 1] - time[0])) * (right - left)).toFixed(1);
  }
  time(x, view) {
    const { left, right } = this.layout;
    const share = Math.min(Math.max((x - left) / (right - left), 0), 1);
    return view.start + share * (view.stop - view.start);
  }
  // the area that a drag has opened: of one row where the drag has a height
  mark(from, to) {
    const { left, right, rows } = this.layout;
    if (!from) return this.brush.setAttribute("d", "");
    const clip = (x) => pixel(Math.min(Math.max(x, left), right));
    const box = this.rowOf(from, to);
    const [top, bottom] = box ? box.ends : [rows[0].top, rows[rows.length - 1].bottom];
    this.brush.setAttribute("d", `M${clip(from.x)} ${pixel(top)}H${clip(to.x)}V${pixel(bottom)}H${clip(from.x)}Z`);
  }
  // { index, ends } of the row that a drag has opened in height; null for one along the time only
  rowOf(from, to) {
    if (Math.abs(to.y - from.y) < LEAST_DRAG) return null;
    const index = this.layout.rows.findIndex((row) => from.y >= row.top && from.y <= row.bottom);
    if (index < 0) return null;
    const row = this.layout.rows[index], inside = (y) => Math.min(Math.max(y, row.top), row.bottom);
    return { index, ends: [inside(from.y), inside(to.y)].sort((a, b) => a - b) };
  }
}

const LEAST_DRAG = 14;  // px: a drag of less height opens no height

// pixel of a value in a row
function height(row, value) {
  return row.bottom - ((value - row.low) / (row.high - row.low)) * (row.bottom - row.top);
}

function nearestIndex(time, at) {
  const after = Math.min(firstAtOrAfter(time, at), time.length - 1);
  return after > 0 && at - time[after - 1] < time[after] - at ? after - 1 : after;
}
