// Keys, buttons and the pointer on a figure of traces.
function makeZoomable(figure) {
  const area = figure.querySelector(".trace");
  const told = figure.querySelector("output");
  const traces = [...area.querySelectorAll("svg[data-layout]")].map((svg) => new Trace(svg));
  const home = { start: traces[0].layout.start, stop: traces[0].layout.stop, rows: {} };
  const reading = new Reading(area);
  let view = home, samples = null, loading = null;

  const load = () => (loading ??= unpack(traces[0].svg.dataset.samples).then((loaded) => (samples = loaded)));

  const shown = (trace) => trace.svg.getBoundingClientRect().width > 0;
  async function show(start, stop, rows = view.rows) {
    await load();
    reading.hide();
    const first = samples.time[0], last = samples.time[samples.time.length - 1];
    const least = (20 * (last - first)) / samples.time.length;
    const length = Math.min(Math.max(stop - start, least), last - first);
    start = Math.min(Math.max((start + stop) / 2 - length / 2, first), last - length);
    view = { start, stop: start + length, rows };
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
    back: () => show(home.start, home.stop, {}),
    whole: () => load().then(() => show(samples.time[0], samples.time[samples.time.length - 1], {})),
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

  // drag: zoom, in height too; in the strip: move; with shift: measure; without a button: read
  let drag = null;
  area.addEventListener("pointerdown", (event) => {
    const trace = traces.find((one) => one.svg.contains(event.target));
    if (!trace || event.button !== 0) return;
    load();
    const at = placeIn(trace.svg, event), strip = trace.layout.overview;
    drag = { trace, at, how: strip && at.y >= strip.top ? "strip" : event.shiftKey ? "measure" : "zoom" };
    area.setPointerCapture(event.pointerId);
    if (drag.how === "strip") centreOn(at.x);
  });
  area.addEventListener("pointermove", (event) => {
    if (!drag) return read(event);
    const at = placeIn(drag.trace.svg, event);
    if (drag.how === "strip") return centreOn(at.x);
    drag.trace.mark(drag.at, drag.how === "measure" ? { x: at.x, y: drag.at.y } : at);
    if (drag.how === "measure") told.textContent = measured(drag, at);
  });
  area.addEventListener("pointerleave", () => reading.hide());
  const end = (event) => {
    if (!drag) return;
    const { trace, at: from, how } = drag, to = placeIn(trace.svg, event);
    drag = null;
    if (how !== "measure") trace.mark(null);
    if (how !== "zoom" || event.type !== "pointerup") return;
    const row = trace.rowOf(from, to), isWide = Math.abs(to.x - from.x) > 6;
    if (!row && !isWide) return read(event);
    const [start, stop] = isWide ? [trace.time(from.x, view), trace.time(to.x, view)].sort((a, b) => a - b)
      : [view.start, view.stop];
    show(start, stop, row ? { ...view.rows, [row.index]: limits(trace, row) } : view.rows);
  };
  area.addEventListener("pointerup", end);
  area.addEventListener("pointercancel", end);

  async function read(event) {
    const trace = traces.find((one) => one.svg.contains(event.target));
    if (!trace) return reading.hide();
    await load();
    const found = drag ? null : trace.read(placeIn(trace.svg, event), view, samples, figure);
    if (found) reading.show(trace.svg, found.at, found.lines, found.cross, found.dots);
    else reading.hide();
  }
  const valueAt = (box, y) => box.low + ((box.bottom - y) / (box.bottom - box.top)) * (box.high - box.low);
  // [low, high] that a drag has opened of a row
  function limits(trace, { index, ends: [top, bottom] }) {
    const box = trace.boxes(view)[index];
    return [valueAt(box, bottom), valueAt(box, top)];
  }
  function centreOn(x) {
    if (!samples) return load().then(() => centreOn(x));
    const whole = { start: samples.time[0], stop: samples.time[samples.time.length - 1] };
    const centre = drag ? drag.trace.time(x, whole) : traces[0].time(x, whole), half = (view.stop - view.start) / 2;
    return show(centre - half, centre + half);
  }
  function measured({ trace, at }, to) {
    const boxes = trace.boxes(view);
    const box = boxes.find((one) => at.y >= one.top - 12 && at.y <= one.bottom + 12) ?? boxes[0];
    const seconds = trace.time(to.x, view) - trace.time(at.x, view);
    const rise = (valueAt(box, to.y) - valueAt(box, at.y)) * box.times;
    const text = `Δt ${seconds.toPrecision(3)} s, Δ${box.symbol} ${rise.toPrecision(3)} ${box.unit}`;
    return text.replace(/-/g, "\u2212");
  }
  figure.zoomTo = show;
}
