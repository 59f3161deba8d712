// What a zoom of a still figure moves, its scale, and keys, buttons and the pointer on it.

// [node, write(node, move)] of everything drawn in the axes but their scales; move takes a point of the first picture
function drawnIn(axes) {
  const { left, top, right, bottom } = axes.home, svg = axes.svg, found = [];
  const clip = element(svg, "clipPath", { id: `${svg.dataset.chart}-${axes.index}` });
  clip.append(element(svg, "rect", { x: left, y: top, width: right - left, height: bottom - top }));
  axes.group.prepend(clip);
  for (const child of [...axes.group.children]) {
    if (child === clip || /axis/.test(child.dataset.part ?? "")) continue;
    const texts = child.querySelectorAll("text");
    if (!texts.length && !child.hasAttribute("clip-path")) child.setAttribute("clip-path", `url(#${clip.id})`);
    texts.forEach((text) => found.push([child, movedText(text, axes)]));
    child.querySelectorAll("path").forEach((path) => {
      if (!path.closest("defs")) found.push([path, movedPath(path.getAttribute("d"))]);
    });
    child.querySelectorAll("use").forEach((use) => found.push([use, movedUse(use)]));
  }
  return found;
}

// matplotlib writes M, L, C, Q with absolute pairs, and z
function movedPath(d) {
  const tokens = d.match(/[A-Za-z]|-?[\d.]+(?:e-?\d+)?/g) ?? [];
  return (node, move) => {
    const written = [];
    for (let i = 0; i < tokens.length; i++) {
      if (/[A-Za-z]/.test(tokens[i])) written.push(tokens[i]);
      else written.push(move(Number(tokens[i]), Number(tokens[++i])).map(pixel).join(" "));
    }
    node.setAttribute("d", written.join(" "));
  };
}

function movedUse(use) {
  const x = Number(use.getAttribute("x")), y = Number(use.getAttribute("y"));
  return (node, move) => {
    const [at, on] = move(x, y);
    node.setAttribute("x", pixel(at));
    node.setAttribute("y", pixel(on));
  };
}

// words inside the axes go with their place; those that leave it, and those beside the axes, wait for the first view
function movedText(text, axes) {
  const x = Number(text.getAttribute("x")), y = Number(text.getAttribute("y"));
  return (node, move) => {
    const [at, on] = move(x, y), isHome = axes.view === axes.home;
    node.style.display = isHome || axes.holds({ x: at, y: on }) ? "" : "none";
    node.setAttribute("transform", `translate(${pixel(at - x)} ${pixel(on - y)})`);
  };
}

// grid and numbers of a zoomed view
function scaleOf(axes) {
  const { left, top, right, bottom } = axes.home, scale = element(axes.svg, "g", {});
  const look = { "font-size": "12px", fill: "var(--muted)" };
  const line = (d) => scale.append(element(axes.svg, "path", { d, stroke: "var(--grid)", fill: "none" }));
  const isNumbered = axes.ticksOf("x").some((tick) => tick.querySelector("text"));
  const [x0, y0] = axes.values(left, bottom), [x1, y1] = axes.values(right, top);
  for (const [value, words] of ticksBetween(axes.x, x0, x1, right - left > 600 ? 9 : 4)) {
    const [x] = axes.pixels(value, axes.y.from);
    line(`M${pixel(x)} ${top}V${bottom}`);
    const at = { x: pixel(Math.min(x, right - 4)), y: bottom + 16, "text-anchor": "middle", ...look };
    if (isNumbered) scale.append(element(axes.svg, "text", at, words));
  }
  if (axes.zoom !== "xy") return scale;
  for (const [value, words] of ticksBetween(axes.y, y0, y1, 4)) {
    const [, y] = axes.pixels(axes.x.from, value);
    line(`M${left} ${pixel(y)}H${right}`);
    const at = { x: left - 5, y: Number(pixel(y)) + 4, "text-anchor": "end", ...look };
    scale.append(element(axes.svg, "text", at, words));
  }
  return scale;
}

// [[value, words]]: round numbers, on a logarithmic axis powers of ten while there are two of them
function ticksBetween(axis, a, b, most) {
  const [low, high] = a < b ? [a, b] : [b, a], found = [];
  if (axis.log) {
    const step = Math.max(1, Math.ceil(Math.log10(high / low) / most));
    for (let power = Math.ceil(Math.log10(low)); power <= Math.log10(high); power += step)
      found.push([10 ** power, powerOfTen(power)]);
    if (found.length > 1) return found;
    found.length = 0;
  }
  const step = niceStep(high - low, most);
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9) && found.length < 20; k++)
    found.push([k * step, axis.log ? number(k * step) : shortTick(k * step, step)]);
  return found;
}

const shortTick = (value, step) => (step < 1e-3 || step >= 1e5 ? number(value) : written(value, step));

function makeReadable(figure, area) {
  const reading = new Reading(area), back = figure.querySelector("button[data-do=back]");
  const charts = [...area.querySelectorAll("svg[data-chart]")].map((svg) => ({
    svg, axes: JSON.parse(document.getElementById(svg.dataset.chart).textContent).map((told) => new Axes(svg, told)),
    brush: svg.appendChild(element(svg, "path", { fill: "var(--ink)", "fill-opacity": 0.1, d: "" })),
  }));
  let at = null, drag = null;  // at: { chart, x, y } where the figure is read

  const chartOf = (event) => charts.find(({ svg }) => svg.contains(event.target));
  const axesAt = (chart, place) => chart.axes.find((one) => one.holds(place));
  function read(chart, place) {
    at = { chart, ...place };
    const found = axesAt(chart, place)?.read(place, figure);
    if (found) reading.show(chart.svg, found.at, found.lines, found.cross, found.dots);
    else reading.hide();
  }
  // axes over the same stretch zoom along it together
  function zoom(axes, view) {
    reading.hide();
    axes.zoomTo(view);
    for (const other of charts.flatMap((chart) => chart.axes)) {
      if (other === axes || other.svg !== axes.svg || !sameStretch(other.x, axes.x)) continue;
      const { left, right } = view, { top, bottom } = other.view;
      const isHome = left === other.home.left && right === other.home.right && top === other.home.top
        && bottom === other.home.bottom;
      other.zoomTo(isHome ? other.home : { left, right, top, bottom });
    }
    back.hidden = charts.every((chart) => chart.axes.every((one) => one.view === one.home));
  }
  const home = () => {
    for (const axes of charts.flatMap((chart) => chart.axes)) if (axes.view !== axes.home) zoom(axes, axes.home);
  };
  function zoomAbout(factor) {
    const place = at ?? middleOf(charts.find(({ svg }) => svg.getBoundingClientRect().width));
    const axes = axesAt(place.chart, place);
    if (axes?.zoom) zoom(axes, scaled(axes, place, factor));
  }

  // a drag opens what it spans; in one direction only where it is flat, or where the other one does not zoom
  function opened(axes, from, to) {
    const { left, top, right, bottom } = axes.home, clip = (low, value, high) => Math.min(Math.max(value, low), high);
    const [x0, x1] = [from.x, to.x].map((x) => clip(left, x, right)).sort((a, b) => a - b);
    const [y0, y1] = [from.y, to.y].map((y) => clip(top, y, bottom)).sort((a, b) => a - b);
    const wide = x1 - x0 > LEAST_DRAG, high = axes.zoom === "xy" && y1 - y0 > LEAST_DRAG;
    if (!wide && !high) return null;
    return { left: wide ? x0 : left, right: wide ? x1 : right, top: high ? y0 : top, bottom: high ? y1 : bottom };
  }
  area.addEventListener("pointerdown", (event) => {
    const chart = chartOf(event);
    if (!chart || event.button !== 0) return;
    const from = placeIn(chart.svg, event), axes = axesAt(chart, from);
    if (axes?.zoom) drag = { chart, axes, from };
    if (drag) area.setPointerCapture(event.pointerId);
  });
  area.addEventListener("pointermove", (event) => {
    if (!drag) {
      const chart = chartOf(event);
      return chart ? read(chart, placeIn(chart.svg, event)) : reading.hide();
    }
    const box = opened(drag.axes, drag.from, placeIn(drag.chart.svg, event));
    drag.chart.brush.setAttribute("d", box ? `M${box.left} ${box.top}H${box.right}V${box.bottom}H${box.left}Z` : "");
  });
  area.addEventListener("pointerleave", () => reading.hide());
  const end = (event) => {
    if (!drag) return;
    const { chart, axes, from } = drag, to = placeIn(chart.svg, event), box = opened(axes, from, to);
    drag = null;
    chart.brush.setAttribute("d", "");
    if (event.type !== "pointerup") return;
    if (!box) return read(chart, to);  // a tap
    zoom(axes, inFirstPicture(axes, box));
  };
  area.addEventListener("pointerup", end);
  area.addEventListener("pointercancel", end);
  area.addEventListener("dblclick", home);
  back.addEventListener("click", home);

  const steps = { ArrowLeft: [-8, 0], ArrowRight: [8, 0], ArrowUp: [0, -8], ArrowDown: [0, 8] };
  const others = { "+": () => zoomAbout(0.5), "=": () => zoomAbout(0.5), "-": () => zoomAbout(2), 0: home,
    Escape: () => reading.hide() };
  area.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in steps || event.key in others)) return;
    event.preventDefault();
    if (event.key in others) return others[event.key]();
    const from = at ?? middleOf(charts.find(({ svg }) => svg.getBoundingClientRect().width));
    const [dx, dy] = steps[event.key];
    read(from.chart, { x: from.x + dx, y: from.y + dy });
  });
}

const sameStretch = (a, b) => a.word === b.word && a.from === b.from && a.to === b.to;

const inFirstPicture = (axes, box) => {
  const [left, top] = axes.fromView(box.left, box.top), [right, bottom] = axes.fromView(box.right, box.bottom);
  return { left, top, right, bottom };
};

function middleOf(chart) {
  const { left, top, right, bottom } = chart.axes[0].home;
  return { chart, x: (left + right) / 2, y: (top + bottom) / 2 };
}

// the view about a place, `factor` times as wide; never wider than the first one
function scaled(axes, place, factor) {
  const { home, view } = axes, [x, y] = axes.fromView(place.x, place.y);
  const along = (low, high, middle, first, last) => {
    const length = (high - low) * factor;
    if (length >= last - first) return [first, last];
    const start = Math.min(Math.max(middle - length / 2, first), last - length);
    return [start, start + length];
  };
  const [left, right] = along(view.left, view.right, x, home.left, home.right);
  const [top, bottom] = axes.zoom === "xy" ? along(view.top, view.bottom, y, home.top, home.bottom)
    : [view.top, view.bottom];
  const isHome = left === home.left && right === home.right && top === home.top && bottom === home.bottom;
  return isHome ? home : { left, top, right, bottom };
}
