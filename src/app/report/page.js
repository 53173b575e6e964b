// The page: fills its elements from the data and joins controls, scene and tables. Names come from files of
// others, so all text is set as text and never as HTML.

const at = (id) => document.getElementById(id);

/** An element with attributes and children; the key `text` is its text. */
function element(name, { text, ...attributes } = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...(text === undefined ? children : [text]));
  return made;
}

const known = (x) => x !== null && x !== undefined && Number.isFinite(x);
const number = (x, digits = 4) => (known(x) ? String(Number(x.toPrecision(digits))) : "unknown");
const percent = (x) => (known(x) ? number(100 * x, 3) + " %" : "unknown");
const grouped = (x) => (known(x) ? Math.round(x).toLocaleString("en").replaceAll(",", "\u202f") : "unknown");
function shortCount(x) {
  for (const [unit, letter] of [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"]])
    if (x >= unit) return number(x / unit, 3) + " " + letter;
  return number(x, 3);
}

/** A table from rows of cells; numbers stand to the right. */
function fillTable(table, heads, rows) {
  const cell = (value, index) =>
    value instanceof Node ? element("td", {}, value)
      : heads ? element("td", known(value) ? { text: value > 9999 ? grouped(value) : String(value), class: "number" } : { text: value ?? "" })
      : element(index === 0 ? "th" : "td", index === 0 ? { text: value, scope: "row" } : { text: value });
  table.replaceChildren();
  if (heads)
    table.append(element("thead", {}, element("tr", {}, ...heads.map((text) => element("th", { text, scope: "col" })))));
  table.append(element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell)))));
  return table;
}

/** Three numbers of a colour, on one line where there is room. */
const channels = (light, digits = 4) =>
  element("span", { class: "channels" }, ...light.map((x) => element("span", { text: number(x, digits) })));

/** A colour of light, its numbers after a small square. */
function lightText(light, brightness) {
  if (!light) return "unknown";
  const bytes = light.map((x) => Math.round(255 * clamp((x ?? 0) * brightness, 0, 1) ** (1 / 2.2)));
  const swatch = element("span", { class: "swatch", style: `background: rgb(${bytes})`, "aria-hidden": "true" });
  const text = channels(light);
  text.prepend(swatch);
  return text;
}

// ---- Layers: what colours the surfaces ----

// From dark to bright, of even steps in lightness.
const rampColours = [[0.13, 0.08, 0.35], [0.23, 0.26, 0.62], [0.15, 0.5, 0.64], [0.25, 0.7, 0.45], [0.72, 0.83, 0.2],
  [1, 0.93, 0.55]];
function rampColour(share) {
  const place = clamp(share, 0, 1) * (rampColours.length - 1);
  const below = Math.min(Math.floor(place), rampColours.length - 2);
  return rampColours[below].map((x, k) => x + (place - below) * (rampColours[below + 1][k] - x));
}
const unknownColour = [0.45, 0.45, 0.45];

/** A tint of a number: hues by the golden ratio differ most. */
function tint(count) {
  const hue = (count * 0.618034) % 1, light = 0.5 + 0.3 * ((count * 0.754878) % 1);
  return [0, 1 / 3, 2 / 3].map((shift) => light + 0.22 * Math.cos(2 * Math.PI * (hue - shift)));
}

/** Area-weighted mean of the light that patches reflect: what errors are relative to. */
function meanLight(run) {
  let sum = 0, area = 0;
  for (let i = 0; i < run.patches; ++i) {
    if (isFar(run, i)) continue;
    const own = emissionOf(run, i);
    sum += run.area[i] * mean(triple(run.radiosity, i).map((x, k) => x - own[k]));
    area += run.area[i];
  }
  return sum / area;
}

/** Root mean square of the channels of the standard error, relative to the mean light. */
const relativeError = (run, i) =>
  Math.sqrt(mean(triple(run.error, i).map((x) => x * x))) / run.meanLight;

/** A layer of numbers in false colour. */
function scalarLayer(name, unit, run, valueOf) {
  const values = Array.from({ length: run.patches }, (_, i) => valueOf(i));
  const sure = values.map((_, i) => i).filter((i) => known(values[i]) && !isFar(run, i));
  const high = quantileByArea(sure.map((i) => values[i]), sure.map((i) => run.area[i]), 0.99) || 1;
  return { name, low: "0", high: number(high, 2), unit,
    colourOf: (i) => (known(values[i]) ? rampColour(values[i] / high) : unknownColour) };
}

/** A layer of tints, shaded a little so that edges show. */
function tintLayer(name, run, view, numberOf) {
  const from = normalised([0.4, 0.8, 0.5]);
  return { name, colourOf: (i) => scale(tint(numberOf(i)), 0.78 + 0.22 * dot(view.normal(i), from)) };
}

function layersOf(run, view) {
  const seen = (i, light) => irradianceFrom(run, i, light).map((x) => x ?? 0);
  const layers = [
    { name: "Radiosity", light: true, of: "radiosity", flat: (i) => triple(run.radiosity, i),
      smooth: (i, vertex) => triple(run.light, vertex) },
    { name: "Irradiance", light: true, of: "irradiance", flat: (i) => seen(i, triple(run.radiosity, i)),
      // Corners are shared by patches whose textures differ.
      smooth: run.reflectance ? null : (i, vertex) => seen(i, triple(run.light, vertex)) },
  ];
  if (run.error)
    layers.push(scalarLayer("Estimated error", "standard error, % of the mean light", run,
      (i) => 100 * relativeError(run, i)));
  if (run.hits)
    layers.push(scalarLayer("Rays that hit", "energy rays per m²", run, (i) => run.hits[i] / run.area[i]));
  layers.push(tintLayer("Patches", run, view, (i) => i + 1));
  layers.push(tintLayer("Materials", run, view, (i) => run.material[i] + 1));
  layers.push(tintLayer("Groups", run, view, (i) => run.group[i] + 1));
  return layers;
}

/** As pictures are exposed: nine tenths of the surface shown are at most 0.8 of white. */
function exposureFor(run, layer) {
  const lit = [];
  const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b; // ITU-R BT.709
  for (let i = 0; i < run.patches; ++i)
    if (!isFar(run, i) && mean(emissionOf(run, i)) === 0) lit.push([luminance(layer.flat(i)), run.area[i]]);
  const high = quantileByArea(lit.map(([y]) => y), lit.map(([, area]) => area), 0.9);
  return high > 0 ? 0.8 / high : 1;
}

// ---- The scene and its controls ----

function showScene(run) {
  const view = new SceneView(at("canvas"), run);
  const inScene = (point) => subtract(point, run.centre);
  const { eye, target, up, fov } = run.camera;
  const camera = new OrbitCamera({ eye: inScene(eye), target: inScene(target), up, fov }, view.radius);
  view.camera = camera;
  const layers = layersOf(run, view);
  layers.forEach(({ name }, k) => at("layer").append(element("option", { value: k, text: name })));
  const factors = new Map(layers.filter(({ light }) => light).map((layer) =>
    [layer, layer.of === "radiosity" && run.exposure ? run.exposure : exposureFor(run, layer)]));
  run.brightness = factors.get(layers[0]);

  const expose = (layer) => {
    const stops = Number(at("exposure").value);
    at("stops").textContent = (stops > 0 ? "+" : "") + stops.toFixed(1);
    view.exposure = layer.light ? factors.get(layer) * 2 ** stops : 0;
    view.redraw();
  };
  const current = () => layers[Number(at("layer").value)];
  const showLayer = () => {
    const layer = current();
    const smooth = layer.light && layer.smooth && at("smooth").checked;
    view.paint(smooth ? layer.smooth : layer.light ? layer.flat : layer.colourOf);
    at("exposure").disabled = !layer.light;
    at("smooth").disabled = !(layer.light && layer.smooth);
    at("legend").hidden = layer.high === undefined;
    for (const part of ["low", "high", "unit"]) at("legend-" + part).textContent = layer[part] ?? "";
    expose(layer);
  };
  at("ramp").style.background = "linear-gradient(to right, " +
    rampColours.map((c) => `rgb(${c.map((x) => Math.round(255 * x))})`) + ")";
  at("layer").addEventListener("change", showLayer);
  at("smooth").addEventListener("change", showLayer);
  at("exposure").addEventListener("input", () => expose(current()));
  at("reset").addEventListener("click", () => { camera.reset(); view.redraw(); });
  at("controls").addEventListener("submit", (event) => event.preventDefault());
  new ResizeObserver(() => view.redraw()).observe(at("canvas"));
  showLayer();
  return view;
}

/** Mouse, touch and keys move the camera; `choose(patch)` is called for a click. */
function steer(view, choose) {
  const { canvas, camera } = view;
  const pointers = new Map();
  let travelled = 0, spread = 0;
  const pickAt = (clientX, clientY) => {
    const box = canvas.getBoundingClientRect();
    const x = (2 * (clientX - box.left)) / box.width - 1, y = 1 - (2 * (clientY - box.top)) / box.height;
    choose(view.pick(camera.ray(x, y, view.aspect)));
  };
  const spreadOf = ([a, b]) => Math.hypot(a.x - b.x, a.y - b.y);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture?.(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    travelled = pointers.size > 1 ? Infinity : 0; // a pinch is no click
    if (pointers.size === 2) spread = spreadOf([...pointers.values()]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y, height = canvas.clientHeight;
    Object.assign(last, { x: event.clientX, y: event.clientY });
    travelled += Math.hypot(dx, dy);
    if (pointers.size === 2) {
      camera.move(-dx / (2 * height), dy / (2 * height));
      const now = spreadOf([...pointers.values()]);
      if (now > 0 && spread > 0) camera.zoom(spread / now);
      spread = now;
    } else if (event.shiftKey || (event.buttons & 6)) camera.move(-dx / height, dy / height);
    else camera.turn((-4 * dx) / height, (4 * dy) / height);
    view.redraw();
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && event.button === 0 && travelled < 5) pickAt(event.clientX, event.clientY);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(0.0015 * event.deltaY * (event.deltaMode === 1 ? 16 : 1)));
    view.redraw();
  }, { passive: false });
  const actions = {
    ArrowLeft: (moving) => (moving ? camera.move(-0.05, 0) : camera.turn(-0.1, 0)),
    ArrowRight: (moving) => (moving ? camera.move(0.05, 0) : camera.turn(0.1, 0)),
    ArrowUp: (moving) => (moving ? camera.move(0, 0.05) : camera.turn(0, 0.1)),
    ArrowDown: (moving) => (moving ? camera.move(0, -0.05) : camera.turn(0, -0.1)),
    "+": () => camera.zoom(1 / 1.15), "=": () => camera.zoom(1 / 1.15), "-": () => camera.zoom(1.15),
    Home: () => camera.reset(), Enter: () => choose(view.pick(camera.ray(0, 0, view.aspect))),
    Escape: () => choose(null),
  };
  canvas.addEventListener("keydown", (event) => {
    if (!actions[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    actions[event.key](event.shiftKey);
    view.redraw();
  });
}

/** The numbers of a patch, or how to choose one. */
function describePatch(run, i) {
  if (i === null) return at("patch").replaceChildren(element("p", { class: "hint", text: "Click a surface, or enter a number." }));
  at("number").value = i;
  const light = triple(run.radiosity, i), material = run.materials[run.material[i]];
  const rows = [
    ["Patch", String(i)], ["Face", String(run.face[i])], ["Material", material.name],
    ["Group", run.groups[run.group[i]] ?? ""], ["Area [m²]", number(run.area[i])],
    ["Radiosity [W/m²]", lightText(light, run.brightness)],
    ...(run.error ? [["Standard error [W/m²]", channels(triple(run.error, i), 3)],
      ["of the mean light", percent(relativeError(run, i))]] : []),
    ["Irradiance [W/m²]", lightText(irradianceFrom(run, i, light), run.brightness / 2)],
    ["Reflectance", lightText(reflectanceOf(run, i), 1)],
    ["Emission [W/m²]", channels(emissionOf(run, i))],
  ];
  if (run.hits) rows.push(["Rays that hit", grouped(run.hits[i])]);
  at("patch").replaceChildren(fillTable(element("table"), null, rows));
}

// ---- Texts, tables and the chart ----

function showFigures({ statistics }) {
  const { estimated_error: error, estimated_error_uncertainty: uncertainty } = statistics;
  const errorText = known(error) && known(uncertainty)
    ? `${number(100 * error, 3)} ± ${number(100 * uncertainty, 2)} %` : percent(error);
  const figures = [
    ["patches", grouped(statistics.patches)], ["method", statistics.method],
    ["steps", grouped(statistics.steps)], ["energy rays", shortCount(statistics.rays_energy)],
    ["estimated error", errorText],
    ["light within patches differs by", percent(statistics.error_division)], ["in all", number(statistics.seconds_total, 3) + " s"],
  ];
  for (const [name, value] of figures)
    at("figures").append(element("div", {}, element("dt", { text: name }), element("dd", { text: value })));
}

function showSteps({ steps }) {
  const withTruth = steps.some((step) => known(step.true_error));
  fillTable(at("steps"), ["step", "rays", "seconds", "estimated error", ...(withTruth ? ["true error"] : [])],
    steps.map((step) => [step.step, step.rays, Number(step.seconds.toPrecision(4)), percent(step.estimated_error),
      ...(withTruth ? [percent(step.true_error)] : [])]));
  const draw = () => {
    const axis = document.querySelector("#axis input:checked").value;
    const curve = (name, kind, key) => ({ name, kind, points: steps.filter((step) => known(step[key])).map((step) => ({
      x: step[axis], y: step[key],
      text: `step ${step.step}: ${percent(step[key])} after ${shortCount(step.rays)} rays, ${number(step.seconds, 3)} s` })) });
    const width = Math.max(300, at("chart").clientWidth);
    const chart = errorChart([curve("estimated error", "estimated", "estimated_error"),
      ...(withTruth ? [curve("true error", "true", "true_error")] : [])], axis, width);
    at("chart").replaceChildren(chart ?? element("p", { class: "hint", text: "No step has a known error." }));
  };
  at("axis").addEventListener("change", draw);
  addEventListener("resize", draw);
  draw();
}

/** Statistics as rows of name and value; objects within become names with a dot. */
function flatRows(object, prefix = "") {
  return Object.entries(object).flatMap(([key, value]) =>
    key === "left_out" ? []
      : value !== null && typeof value === "object" && !Array.isArray(value) ? flatRows(value, prefix + key + ".")
      : [[prefix + key, value === null ? "unknown" : Array.isArray(value) ? value.join("  ") : String(value)]]);
}

function showTexts(run) {
  const name = run.scene.split("/").pop();
  document.title = name + " – hemilux report";
  at("title").textContent = name;
  at("version").textContent = `version ${run.version}, seed ${run.statistics.seed}, threads: ${run.statistics.threads}`;
  at("command").textContent = run.command;
  at("warnings-section").hidden = run.warnings.length === 0;
  at("warnings").append(...run.warnings.map((text) => element("li", { text })));
  const leftOut = run.statistics.left_out;
  at("left-out").append(leftOut.length === 0
    ? element("p", { class: "hint", text: "Nothing: this scene needs all that the method does." })
    : fillTable(element("table"), ["what", "why", "saved"], leftOut.map(({ what, why, saved }) => [what, why, saved])));
  fillTable(at("statistics"), null, flatRows(run.statistics));
  fillTable(at("materials"), ["name", "reflectance", "emission [W/m²]"], run.materials.map((material) =>
    [material.name, lightText(material.reflectance, 1), channels(material.emission)]));
}

/** Fills the page; returns the view of the scene, null where the browser cannot show it. */
function showPage(run) {
  run.meanLight = meanLight(run);
  run.brightness = 1;
  showTexts(run);
  showFigures(run);
  showSteps(run);
  let view = null;
  const choose = (patch) => {
    describePatch(run, patch);
    if (view) { view.selected = patch; view.redraw(); }
  };
  at("number").max = run.patches - 1;
  at("choose").addEventListener("submit", (event) => {
    event.preventDefault();
    const patch = at("number").valueAsNumber;
    if (patch >= 0 && patch < run.patches) choose(patch);
  });
  try {
    view = showScene(run);
    steer(view, choose);
  } catch (error) {
    at("fault").textContent = error.message;
    at("fault").hidden = false;
  }
  return view;
}

const hemiluxPage = showPage(readRun());
