// Zooming of the trace rows, and the switch between light and dark. Without this script the page shows its first
// pictures.
//
// A trace svg carries data-layout (pixel lines of its rows, limits, names of its lines) and data-samples (the script
// element with the samples: int16 differences, deflated, base64). Both widths of one figure share one view.
"use strict";
(() => {
  const root = document.documentElement;
  document.getElementById("theme").addEventListener("click", () => {
    const dark = root.dataset.theme
      ? root.dataset.theme === "dark"
      : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
  });

  // ---- samples
  const ABSENT = -32768;  // what traces.py writes for "not measured": the line has a gap there

  async function inflate(text, Kind) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    const values = new Kind(await new Response(stream).arrayBuffer());
    for (let i = 1; i < values.length; i++) values[i] += values[i - 1];
    return values;
  }

  async function unpack(name) {
    const packed = JSON.parse(document.getElementById("samples-" + name).textContent);
    const ticks = await inflate(packed.t.data, Int32Array);
    const time = Float64Array.from(ticks, (tick) => packed.t.origin + tick * packed.t.scale);
    const series = {};
    for (const [part, { scale, data }] of Object.entries(packed.series)) {
      const counts = await inflate(data, Int16Array);
      series[part] = Float32Array.from(counts, (value) => (value === ABSENT ? NaN : value * scale));
    }
    // "measured-e0" is what e0 leaves of the measured
    const line = (part) => {
      if (series[part]) return series[part];
      const [whole, less] = part.split("-");
      return (series[part] = series[whole].map((value, i) => value - series[less][i]));
    };
    return { time, line };
  }

  // ---- drawing
  function firstAtOrAfter(time, at) {
    let low = 0, high = time.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (time[middle] < at) low = middle + 1; else high = middle;
    }
    return low;
  }

  // M4: first, lowest, highest, last of each pixel column draw the same picture as all samples; a gap where values are
  // NaN
  function path(time, values, view, box) {
    const begin = Math.max(firstAtOrAfter(time, view.start) - 1, 0);
    const end = Math.min(firstAtOrAfter(time, view.stop) + 1, time.length);
    const perSecond = (box.right - box.left) / (view.stop - view.start);
    const perUnit = (box.bottom - box.top) / (box.high - box.low);
    const x = (i) => (box.left + (time[i] - view.start) * perSecond).toFixed(1);
    const y = (i) => (box.bottom - (values[i] - box.low) * perUnit).toFixed(1);
    const points = [];
    let last = -1, pen = "M";
    const put = (i) => {
      if (i === last) return;
      points.push(pen + x((last = i)) + " " + y(i));
      pen = "L";
    };
    let column = NaN, first = begin, low = begin, high = begin, open = false;
    const keep = (end) => { put(first); put(Math.min(low, high)); put(Math.max(low, high)); put(end); open = false; };
    for (let i = begin; i < end; i++) {
      if (Number.isNaN(values[i])) {
        if (open) keep(i - 1);
        pen = "M";
        continue;
      }
      const here = Math.floor((time[i] - view.start) * perSecond);
      if (!open || here !== column) {
        if (open) keep(i - 1);
        column = here;
        first = low = high = i;
        open = true;
      } else if (values[i] < values[low]) low = i;
      else if (values[i] > values[high]) high = i;
    }
    if (open) keep(end - 1);
    return points.join("");
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
      const { left, right, rows } = this.layout;
      for (const row of rows) {
        for (const part of row.lines) {
          const line = this.parts(part)[0].querySelector("path");
          line.setAttribute("d", path(samples.time, samples.line(part), view, { left, right, ...row }));
        }
      }
      this.shade(view);
      this.ticks(view);
      this.window(view, samples.time);
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
      // below the lines, above the background
      this.svg.querySelector("g").prepend(this.axis);
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
    // pixel of the event inside the drawing
    place(event) {
      const box = this.svg.getBoundingClientRect();
      const scale = this.svg.viewBox.baseVal.width / box.width;
      return { x: (event.clientX - box.left) * scale, y: (event.clientY - box.top) * scale };
    }
    time(x, view) {
      const { left, right } = this.layout;
      const share = Math.min(Math.max((x - left) / (right - left), 0), 1);
      return view.start + share * (view.stop - view.start);
    }
    mark(from, to) {
      const { left, right, rows } = this.layout;
      const clip = (x) => Math.min(Math.max(x, left), right).toFixed(1);
      const bottom = rows[rows.length - 1].bottom;
      const path = from === null ? "" : `M${clip(from)} ${rows[0].top}H${clip(to)}V${bottom}H${clip(from)}Z`;
      this.brush.setAttribute("d", path);
    }
  }

  function makeZoomable(figure) {
    const area = figure.querySelector(".trace");
    const told = figure.querySelector("output");
    const traces = [...area.querySelectorAll("svg[data-layout]")].map((svg) => new Trace(svg));
    const home = { start: traces[0].layout.start, stop: traces[0].layout.stop };
    let view = { ...home }, samples = null, loading = null;

    const load = () => (loading ??= unpack(traces[0].svg.dataset.samples).then((loaded) => (samples = loaded)));

    const shown = (trace) => trace.svg.getBoundingClientRect().width > 0;
    async function show(start, stop) {
      await load();
      const first = samples.time[0], last = samples.time[samples.time.length - 1];
      const least = (20 * (last - first)) / samples.time.length;
      const length = Math.min(Math.max(stop - start, least), last - first);
      start = Math.min(Math.max((start + stop) / 2 - length / 2, first), last - length);
      view = { start, stop: start + length };
      redraw(shown);
    }
    // the width that is not shown waits until it is
    function redraw(now) {
      if (!samples) return;
      for (const trace of traces) if (trace.view !== view && now(trace)) trace.draw((trace.view = view), samples);
    }
    addEventListener("resize", () => redraw(shown));
    addEventListener("beforeprint", () => redraw(() => true));
    const zoom = (factor) => {
      const centre = (view.start + view.stop) / 2, half = ((view.stop - view.start) / 2) * factor;
      return show(centre - half, centre + half);
    };
    const move = (share) => {
      const step = share * (view.stop - view.start);
      return show(view.start + step, view.stop + step);
    };
    const actions = {
      in: () => zoom(0.5), out: () => zoom(2), left: () => move(-0.25), right: () => move(0.25),
      back: () => show(home.start, home.stop),
      whole: () => load().then(() => show(samples.time[0], samples.time[samples.time.length - 1])),
    };

    const keys = { "+": "in", "=": "in", "-": "out", "−": "out", ArrowLeft: "left", ArrowRight: "right", 0: "back" };
    area.addEventListener("keydown", (event) => {
      const action = keys[event.key];
      if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      actions[action]();
    });
    figure.querySelectorAll("button[data-do]").forEach((button) =>
      button.addEventListener("click", () => actions[button.dataset.do]()));
    area.addEventListener("dblclick", () => actions.back());

    // drag: zoom; in the strip: move; with shift: measure
    let drag = null;
    const row = (trace, y) =>
      trace.layout.rows.find((one) => y >= one.top - 12 && y <= one.bottom + 12) ?? trace.layout.rows[0];
    area.addEventListener("pointerdown", (event) => {
      const trace = traces.find((one) => one.svg.contains(event.target));
      if (!trace || event.button !== 0) return;
      load();
      const at = trace.place(event), strip = trace.layout.overview;
      drag = { trace, at, how: strip && at.y >= strip.top ? "strip" : event.shiftKey ? "measure" : "zoom" };
      area.setPointerCapture(event.pointerId);
      if (drag.how === "strip") centreOn(at.x);
    });
    area.addEventListener("pointermove", (event) => {
      if (!drag) return;
      const at = drag.trace.place(event);
      if (drag.how === "strip") return centreOn(at.x);
      drag.trace.mark(drag.at.x, at.x);
      if (drag.how === "measure") told.textContent = measured(drag, at);
    });
    const end = (event) => {
      if (!drag) return;
      const { trace, at: from, how } = drag, to = trace.place(event);
      drag = null;
      if (how !== "measure") trace.mark(null);
      if (how === "zoom" && event.type === "pointerup" && Math.abs(to.x - from.x) > 6) {
        const [start, stop] = [trace.time(from.x, view), trace.time(to.x, view)].sort((a, b) => a - b);
        show(start, stop);
      }
    };
    area.addEventListener("pointerup", end);
    area.addEventListener("pointercancel", end);

    function centreOn(x) {
      if (!samples) return load().then(() => centreOn(x));
      const whole = { start: samples.time[0], stop: samples.time[samples.time.length - 1] };
      const centre = drag ? drag.trace.time(x, whole) : traces[0].time(x, whole), half = (view.stop - view.start) / 2;
      return show(centre - half, centre + half);
    }
    function measured({ trace, at }, to) {
      const box = row(trace, at.y);
      const value = (y) => box.low + ((box.bottom - y) / (box.bottom - box.top)) * (box.high - box.low);
      const seconds = trace.time(to.x, view) - trace.time(at.x, view);
      const rise = value(to.y) - value(at.y);
      const text = `Δt ${seconds.toPrecision(3)} s, Δ${box.symbol} ${rise.toPrecision(3)} ${box.unit}`;
      return text.replace(/-/g, "\u2212");
    }
    figure.zoomTo = show;
  }

  const copy = document.getElementById("copy-verdict");
  if (copy) {
    copy.addEventListener("click", async () => {
      const text = document.getElementById("verdict-json").textContent;
      const told = copy.nextElementSibling;
      try {
        await navigator.clipboard.writeText(text);
        told.textContent = "copied";
      } catch {
        // no clipboard for this page: show the text, to be copied by hand
        told.textContent = "";
        copy.parentElement.nextElementSibling.open = true;
      }
    });
  }

  document.querySelectorAll("figure").forEach((figure) => {
    if (figure.querySelector(".trace") && "DecompressionStream" in window) makeZoomable(figure);
  });
})();
