// The page: fills its elements from the data and joins controls, scene and tables.

function showScene(run) {
  const view = new SceneView(at("canvas"), run);
  const inScene = (point) => subtract(point, run.centre);
  const { eye, target, up, fov } = run.camera;
  const camera = new OrbitCamera({ eye: inScene(eye), target: inScene(target), up, fov }, view.radius);
  view.camera = camera;
  const layers = [...layersOf(run, view), factorLayer(run, view)];
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
  const isLast = () => Number(at("slider").value) === run.lights.length - 1;
  const current = () => layers[Number(at("layer").value)];
  const showLayer = () => {
    const layer = current();
    layer.follow?.();
    const smooth = layer.light && layer.smooth && at("smooth").checked && isLast();
    view.paint(smooth ? layer.smooth : layer.light ? layer.flat : layer.colourOf);
    at("exposure").disabled = !layer.light;
    at("smooth").disabled = !(layer.light && layer.smooth && isLast());
    at("legend").hidden = layer.high === undefined;
    for (const part of ["low", "high", "unit"]) at("legend-" + part).textContent = layer[part] ?? "";
    expose(layer);
  };
  const slider = at("slider");
  slider.value = slider.max = run.lights.length - 1;
  at("step-label").hidden = run.lights.length < 2;
  const showStep = () => {
    const { step, light } = run.lights[Number(slider.value)];
    at("step").textContent = step;
    run.radiosity = light;
    showLayer();
    describePatch(run, view.selected);
  };
  slider.addEventListener("input", showStep);
  showLamps(run, () => {
    run.lights.at(-1).light = run.radiosity;
    slider.value = slider.max;
    showStep();
  });
  at("ramp").style.background = rampGradient();
  at("layer").addEventListener("change", showLayer);
  at("smooth").addEventListener("change", showLayer);
  at("exposure").addEventListener("input", () => expose(current()));
  at("reset").addEventListener("click", () => { camera.reset(); view.redraw(); });
  at("controls").addEventListener("submit", (event) => event.preventDefault());
  new ResizeObserver(() => view.redraw()).observe(at("canvas"));
  showStep();
  view.layers = layers;
  view.select = (patch) => {
    view.selected = patch;
    if (current().follow) showLayer();
    view.redraw();
  };
  return view;
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
  at("patch").replaceChildren(fillTable(element("table"), null, rows), ...(run.counts ? [hemisphereDrawing(run, i, 240)] : []));
}

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

function showSteps({ steps, charts }) {
  const withTruth = steps.some((step) => known(step.true_error));
  fillTable(at("steps"), ["step", "rays", "seconds", "estimated error", ...(withTruth ? ["true error"] : [])],
    steps.map((step) => [step.step, step.rays, Number(step.seconds.toPrecision(4)), percent(step.estimated_error),
      ...(withTruth ? [percent(step.true_error)] : [])]));
  showChart(charts[0]);
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
  at("machine").textContent = run.machine;
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
    if (view) view.select(patch);
  };
  describePatch(run, null);
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

/** The data of the page. Its lights are those after steps 1, 2, 4 and so on, and the last one. */
function readSolved() {
  const run = readRun();
  run.lampSet = readLamps(run);
  run.lights = [...run.lit_steps.map((step) => ({ step, light: readHalves("light-" + step, run.unit) })),
    { step: run.statistics.steps, light: run.radiosity }];
  return run;
}

const hemiluxPage = showPage(readSolved());
