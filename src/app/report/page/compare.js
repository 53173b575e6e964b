// The page of a comparison: two views of the scene with one camera, the light of two methods after as many steps,
// and the errors of all runs.

const measures = { true_error: "true error", estimated_error: "estimated error", true_error_detail: "true error of details",
  true_error_rest: "true error of the rest", total_error: "error of the light itself" };

function readComparison() {
  const run = readRun();
  run.radiosity = readHalves("reference", run.unit);
  run.methods.forEach((method, m) => {
    method.lights = method.steps.map((_, k) => readHalves(`light-${m}-${k}`, run.unit));
  });
  run.rows = run.rows.map((row) => Object.fromEntries(run.columns.map((column, k) => [column, row[k]])));
  run.meanLight = meanLight(run);
  return run;
}

/** What a side shows: the light of a method after a step, or the reference where there is no method. */
function lightAfter(run, method, step) {
  if (!method) return { light: run.radiosity, text: "what is taken for the truth" };
  const k = Math.max(0, method.steps.findLastIndex((number) => number <= step));
  const row = run.rows.find((r) => r.method === method.name && r.run === 0 && r.step === method.steps[k]);
  return { light: method.lights[k], text: `step ${row.step}: ${costOf(row)}; true error ${percent(row.true_error)}, ` +
    `estimated ${percent(row.estimated_error)}` };
}

const costOf = (row) => `${shortCount(row.rays)} ${row.rays === 1 ? "ray" : "rays"}, ${number(row.seconds, 3)} s`;

/** Root mean square over channels of how far off a patch's light is, relative to the mean light. */
const differenceOf = (run, light, i) =>
  Math.sqrt(mean([0, 1, 2].map((k) => (light[3 * i + k] - run.radiosity[3 * i + k]) ** 2))) / run.meanLight;

/** One of the two pictures, with its choice of a method. */
class Side {
  constructor(run, name, first) {
    this.run = run;
    this.choice = at("method-" + name);
    this.caption = at("caption-" + name);
    this.choice.append(element("option", { value: -1, text: "Reference" }),
      ...run.methods.map(({ label }, m) => element("option", { value: m, text: label })));
    this.choice.value = first;
    this.view = new SceneView(at("canvas-" + name), run);
  }
  show(step, layer, exposure) {
    const { light, text } = lightAfter(this.run, this.run.methods[Number(this.choice.value)], step);
    this.caption.textContent = text;
    this.view.exposure = layer === "light" ? exposure : 0;
    this.view.paint(layer === "light" ? (i) => triple(light, i)
      : (i) => rampColour(Math.log10(differenceOf(this.run, light, i) / 0.001) / 3));
  }
}

/** Both pictures and their controls. Returns what charts and checks need. */
function showPair(run) {
  const inScene = (point) => subtract(point, run.centre);
  const { eye, target, up, fov } = run.camera;
  const sides = [new Side(run, "left", 0), new Side(run, "right", -1)];
  const camera = new OrbitCamera({ eye: inScene(eye), target: inScene(target), up, fov }, sides[0].view.radius);
  for (const { view } of sides) view.camera = camera;
  const steps = [...new Set(run.methods.flatMap((method) => method.steps))].sort((a, b) => a - b);
  const brightness = run.exposure ?? exposureFor(run, { flat: (i) => triple(run.radiosity, i) });
  at("slider").max = steps.length - 1;
  at("slider").value = 0;

  const redraw = () => sides.forEach(({ view }) => view.redraw());
  const step = () => steps[Number(at("slider").value)];
  const describe = (patch) => describePatch(run, patch, step(), brightness);
  const show = () => {
    const stops = Number(at("exposure").value), layer = at("layer").value;
    at("step").textContent = step();
    at("stops").textContent = (stops > 0 ? "+" : "") + stops.toFixed(1);
    at("legend").hidden = layer === "light";
    at("exposure").disabled = layer !== "light";
    for (const side of sides) side.show(step(), layer, brightness * 2 ** stops);
    describe(sides[0].view.selected);
  };
  const choose = (patch) => {
    for (const { view } of sides) view.selected = patch;
    describe(patch);
    redraw();
  };
  for (const side of sides) {
    steer(side.view, choose, redraw);
    side.choice.addEventListener("change", show);
    new ResizeObserver(redraw).observe(side.view.canvas);
  }
  for (const id of ["slider", "exposure"]) at(id).addEventListener("input", show);
  at("layer").addEventListener("change", show);
  at("reset").addEventListener("click", () => { camera.reset(); redraw(); });
  at("controls").addEventListener("submit", (event) => event.preventDefault());
  at("number").max = run.patches - 1;
  at("choose").addEventListener("submit", (event) => {
    event.preventDefault();
    const patch = at("number").valueAsNumber;
    if (patch >= 0 && patch < run.patches) choose(patch);
  });
  at("ramp").style.background = rampGradient();
  show();
  /** Shows a method on the left after the kept step that is nearest below. */
  const showStep = (method, after) => {
    sides[0].choice.value = method;
    at("slider").value = Math.max(0, steps.findLastIndex((number) => number <= after));
    show();
  };
  return { run, sides, showStep };
}

/** A patch's light by each method after the step, and how far off it is. */
function describePatch(run, i, step, brightness) {
  if (i === null) return at("patch").replaceChildren(element("p", { class: "hint", text: "Click a surface, or enter a number." }));
  at("number").value = i;
  const rows = [null, ...run.methods].map((method) => {
    const { light } = lightAfter(run, method, step);
    return [method ? method.label : "Reference", lightText(triple(light, i), brightness),
      method ? percent(differenceOf(run, light, i)) : ""];
  });
  at("patch").replaceChildren(
    element("p", { class: "hint", text: `${run.materials[run.material[i]].name}, ${number(run.area[i])} m²` }),
    fillTable(element("table"), ["method", "W/m²", "off, of the mean light"], rows));
}

/** The charts of errors with their choices; `showStep` may be null. */
function showErrors(run, showStep) {
  const shown = Object.keys(measures).filter((key) => run.rows.some((row) => known(row[key])));
  run.charts.forEach(({ name }, k) => at("measure").append(element("label", {},
    element("input", { type: "radio", name: "measure", value: k, ...(k === 0 ? { checked: "" } : {}) }), " " + name)));
  run.methods.forEach(({ label }, m) => at("curves").append(element("label", {},
    element("input", { type: "checkbox", value: m, checked: "" }), element("span", { text: label }))));
  const hide = () => {
    for (const { value, checked } of document.querySelectorAll("#curves input"))
      for (const part of at("chart").querySelectorAll(".curve" + value)) part.style.display = checked ? "" : "none";
  };
  const draw = () => {
    showChart(run.charts[document.querySelector("#measure input:checked")?.value], showStep);
    hide();
  };
  at("measure").addEventListener("change", draw);
  at("curves").addEventListener("change", hide);
  draw();
  fillTable(at("steps"), ["method", "run", "step", "rays", "seconds", ...shown.map((key) => measures[key])],
    run.rows.map((row) => [row.method, row.run, row.step, row.rays, Number(row.seconds.toPrecision(4)),
      ...shown.map((key) => percent(row[key]))]));
}

function showComparison(run) {
  const name = run.scene.split("/").pop();
  document.title = name + " – hemilux comparison";
  at("title").textContent = name;
  at("version").textContent = "version " + run.version;
  at("command").textContent = run.command;
  at("machine").textContent = run.machine;
  at("warnings-section").hidden = run.warnings.length === 0;
  at("warnings").append(...run.warnings.map((text) => element("li", { text })));
  fillTable(at("summary"), run.summary[0], run.summary.slice(1));
  fillTable(at("facts"), null, run.facts);
  let pair = null;
  try {
    pair = showPair(run);
  } catch (error) {
    at("fault").textContent = error.message;
    at("fault").hidden = false;
  }
  showErrors(run, pair?.showStep);
  return pair;
}

const hemiluxPage = showComparison(readComparison());
