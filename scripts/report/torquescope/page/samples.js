// Samples of the traces: a script element holds them as int16 differences, deflated, base64 (traces.py).
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
