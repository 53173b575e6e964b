// A chart of errors as SVG, both axes logarithmic.

function svgElement(name, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** The numbers 1, 2 and 5 times powers of ten from low to high; powers alone where these are many. */
function ticksBetween(low, high) {
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
    for (const digit of [1, 2, 5]) {
      const tick = Number(digit + "e" + power);
      if (tick >= low * 0.9999 && tick <= high * 1.0001) ticks.push(tick);
    }
  const powers = ticks.filter((tick) => /^1e/.test(tick.toExponential()));
  return ticks.length > 9 && powers.length > 2 ? powers : ticks;
}

/** An axis over the numbers, from pixel `from` to pixel `to`, no narrower than a factor of four. */
function logAxis(numbers, from, to) {
  const middle = Math.sqrt(Math.min(...numbers) * Math.max(...numbers));
  const low = Math.min(Math.min(...numbers) / 1.1, middle / 2);
  const high = Math.max(Math.max(...numbers) * 1.1, middle * 2);
  const place = (x) => from + ((to - from) * Math.log(x / low)) / Math.log(high / low);
  return { place, ticks: ticksBetween(low, high) };
}

/** The chart of `curves`, each { name, kind, points: [{ x, y, text }] }, so many pixels wide; null without a
    point. A curve without a name is not labelled; it may have a `style`. A dot calls `choose` of its point. */
function errorChart(curves, xLabel, width) {
  const height = Math.round(clamp(0.55 * width, 240, 400)), left = 64, right = 20, top = 34, bottom = 52;
  const drawn = curves.map((curve) => ({ ...curve, points: curve.points.filter(({ x, y }) => x > 0 && y > 0) }))
    .filter((curve) => curve.points.length > 0);
  const all = drawn.flatMap((curve) => curve.points);
  if (all.length === 0) return null;
  const x = logAxis(all.map((point) => point.x), left, width - right);
  const y = logAxis(all.map((point) => point.y), height - bottom, top);
  const svg = svgElement("svg", { width, height, class: "chart", role: "img",
    "aria-label": `Error against ${xLabel}; the table has the numbers` });
  for (const tick of x.ticks)
    svg.append(svgElement("line", { class: "grid", x1: x.place(tick), x2: x.place(tick), y1: top, y2: height - bottom }),
      svgElement("text", { x: x.place(tick), y: height - bottom + 20, "text-anchor": "middle" }, shortCount(tick)));
  for (const tick of y.ticks)
    svg.append(svgElement("line", { class: "grid", x1: left, x2: width - right, y1: y.place(tick), y2: y.place(tick) }),
      svgElement("text", { x: left - 8, y: y.place(tick) + 4, "text-anchor": "end" }, percent(tick)));
  svg.append(svgElement("text", { x: (left + width - right) / 2, y: height - 10, "text-anchor": "middle" }, xLabel));
  drawn.forEach((curve, k) => svg.append(curveElement(curve, x, y, left + 8 + 170 * k, top - 14)));
  return svg;
}

function curveElement({ name, kind, points, style }, x, y, labelX, labelY) {
  const group = svgElement("g", { class: kind, ...(style ? { style } : {}) });
  const places = points.map((point) => [x.place(point.x), y.place(point.y)]);
  group.append(svgElement("polyline", { class: "curve", points: places.join(" ") }));
  const every = Math.ceil(points.length / 100); // dots of long runs would hide the curve
  places.forEach(([cx, cy], k) => {
    if (k % every !== 0 && k !== places.length - 1) return;
    const dot = svgElement("circle", { cx, cy, r: 4 }, svgElement("title", {}, points[k].text));
    if (points[k].choose) dot.addEventListener("click", points[k].choose);
    group.append(dot);
  });
  if (name) group.append(svgElement("text", { class: "label", x: labelX, y: labelY }, "● " + name));
  return group;
}
