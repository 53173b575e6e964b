// Runs at the end of a page of --report, put there by check_report.sh: does by itself what a user would,
// and writes a line for each thing that holds or does not.
"use strict";
{
  const lines = [];
  const check = (what, holds) => lines.push((holds ? "holds: " : "FAILS: ") + what);
  const view = hemiluxPage, { canvas, gl, run } = view;
  const rows = () => [...document.querySelectorAll("#patch tr")].map((row) => [...row.cells].map((cell) => cell.textContent));
  const pixels = () => {
    view.draw();
    const bytes = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return bytes;
  };
  const colours = (bytes) => new Set(new Uint32Array(bytes.buffer)).size;
  const brightness = (bytes) => bytes.reduce((sum, byte) => sum + byte, 0);
  const differ = (a, b) => a.some((byte, k) => byte !== b[k]);
  const key = (name, shiftKey = false) =>
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: name, shiftKey, bubbles: true, cancelable: true }));
  const pointer = (type, x, y, pointerId = 1) => canvas.dispatchEvent(new PointerEvent(type,
    { clientX: x, clientY: y, pointerId, button: 0, buttons: type === "pointerup" ? 0 : 1, bubbles: true }));

  canvas.setPointerCapture = () => {}; // refuses pointers of scripts
  const first = pixels();
  check("the canvas shows many colours", colours(first) > 50);
  check("the page says how a patch is chosen", document.getElementById("patch").textContent.includes("Click a surface"));

  if (run.triangles && run.scene.endsWith("office_3576.obj")) { // a closed room
    const background = gl.getParameter(gl.COLOR_CLEAR_VALUE);
    gl.clearColor(1, 0, 1, 1);
    check("no pixel is left between patches that were divided differently", !differ(first, pixels()));
    gl.clearColor(...background);
  }

  const box = canvas.getBoundingClientRect();
  const middle = [box.left + box.width / 2, box.top + box.height / 2];
  pointer("pointerdown", ...middle);
  pointer("pointerup", ...middle);
  const chosen = view.selected;
  check("a click selects a patch", chosen !== null && rows()[0][1] === String(chosen));
  check("its numbers are those of the data", chosen !== null &&
    rows().some(([name, value]) => name === "Material" && value === run.materials[run.material[chosen]].name) &&
    rows().some(([name, value]) => name === "Radiosity [W/m²]" && value.includes(number(run.radiosity[3 * chosen]))));
  const hemisphere = document.querySelector(".hemisphere");
  check("it has a divided hemisphere where there are densities", run.counts
    ? hemisphere && hemisphere.querySelectorAll("polygon").length >= 4 &&
      hemisphere.querySelectorAll("circle").length === [...countsOf(run, chosen)].filter((count) => count < 255).length
    : !hemisphere);
  check("the patch is marked", differ(first, pixels()));
  key("Escape");
  check("Escape lets it go", view.selected === null && !differ(first, pixels()));
  key("Enter");
  check("Enter takes the patch in the middle", view.selected === chosen);
  key("Escape");

  pointer("pointerdown", ...middle);
  pointer("pointermove", middle[0] + 60, middle[1]);
  pointer("pointerup", middle[0] + 60, middle[1]);
  check("a drag turns and selects nothing", view.selected === null && differ(first, pixels()));
  key("Home");
  check("Home gives the first view back", !differ(first, pixels()));
  for (const [name, shift] of [["ArrowLeft"], ["ArrowUp"], ["ArrowRight", true], ["+"]]) {
    key(name, shift);
    check((shift ? "Shift and " : "") + name + " changes the view", differ(first, pixels()));
    key("Home");
  }
  pointer("pointerdown", middle[0] - 40, middle[1], 1);
  pointer("pointerdown", middle[0] + 40, middle[1], 2);
  pointer("pointermove", middle[0] + 90, middle[1], 2);
  pointer("pointerup", middle[0] - 40, middle[1], 1);
  pointer("pointerup", middle[0] + 90, middle[1], 2);
  check("a pinch goes nearer and selects nothing", view.selected === null && differ(first, pixels()));
  key("Home");

  const slider = document.getElementById("exposure");
  slider.value = 2;
  slider.dispatchEvent(new Event("input"));
  check("the slider brightens", brightness(pixels()) > brightness(first));
  slider.value = 0;
  slider.dispatchEvent(new Event("input"));

  check("there are sliders of lamps where these are apart", document.getElementById("lamps").hidden === !run.lamps);
  if (run.lamps) {
    const [power, colour] = document.querySelectorAll("#lamps input"), solved = run.radiosity;
    const set = (input, value) => { input.value = value; input.dispatchEvent(new Event("input")); };
    const lit = pixels(), { lamps } = run.lampSet;
    check("the light of lamps adds up to that of all", solved.every((x, i) =>
      Math.abs(lamps.reduce((sum, lamp) => sum + lamp.radiosity[i], 0) - x) <= 2e-3 * x + 1e-6));
    set(power, 0);
    check("a lamp of power 0 leaves the light of the others", run.radiosity.every((x, i) =>
      Math.abs(x - lamps[1].radiosity[i]) <= 1e-4 * x) && brightness(pixels()) < brightness(lit));
    set(power, 2);
    check("one of power 2 brightens", brightness(pixels()) > brightness(lit));
    set(colour, "#ff0000");
    check("a red lamp has no green light", lamps[0].factor[0] === 2 && lamps[0].factor[1] === 0);
    document.querySelector("#lamps button").click();
    check("'As solved' gives the light that was solved for", run.radiosity === solved && !differ(lit, pixels()));
  }

  const steps = document.getElementById("slider");
  check("steps before the last are kept", run.lit_steps.every((step, k) => step === 2 ** k) && (run.steps.length < 2 || run.lit_steps.length > 0));
  check("there is a slider of steps where there are some", document.getElementById("step-label").hidden === (run.lit_steps.length === 0));
  if (run.lit_steps.length > 0) {
    document.getElementById("number").value = chosen;
    document.getElementById("choose").requestSubmit();
    const last = rows(), light = run.radiosity;
    steps.value = 0;
    steps.dispatchEvent(new Event("input"));
    check("the slider of steps shows the light after the first", document.getElementById("step").textContent === "1" &&
      differ(first, pixels()) && rows().some(([, value], k) => value !== last[k][1]) && run.radiosity !== light);
    check("in all it is about as much as at the end", Math.abs(meanLight(run) / run.meanLight - 1) < 0.3);
    steps.value = steps.max;
    steps.dispatchEvent(new Event("input"));
    check("the last step comes back", run.radiosity === light && rows().every(([, value], k) => value === last[k][1]));
    key("Escape");
  }

  const select = document.getElementById("layer");
  for (const option of [...select.options].slice(1)) {
    select.value = option.value;
    select.dispatchEvent(new Event("change"));
    const after = pixels();
    check("layer " + option.text + " is drawn", colours(after) > 3 && differ(first, after));
  }
  {
    const layer = view.layers.find(({ follow }) => follow), sum = (F) => F.reduce((all, x) => all + x, 0);
    select.value = view.layers.indexOf(layer);
    select.dispatchEvent(new Event("change"));
    const fromLamp = pixels();
    document.getElementById("number").value = chosen;
    document.getElementById("choose").requestSubmit();
    const F = layer.factors, target = F.indexOf(Math.max(...F));
    check("form factors follow the chosen patch", differ(fromLamp, pixels()) && document.getElementById("legend-unit").textContent.includes(`patch ${chosen}`));
    check(`none is negative or to the patch itself, and they sum to 1 at most (${number(sum(F))})`, F[chosen] === 0 && F.every((x) => x >= 0) && sum(F) < 1.002);
    if (/office_3576|room_1002/.test(run.scene)) check("in a closed room they sum to 1", Math.abs(sum(F) - 1) < 0.01);
    view.select(target);
    check(`A F from two centres is about the same (${number(F[target] * run.area[chosen])}, ${number(layer.factors[chosen] * run.area[target])})`,
      Math.abs(F[target] * run.area[chosen] / (layer.factors[chosen] * run.area[target]) - 1) < 0.25);
    for (const [from, to, expected] of window.expectedFactors ?? []) {
      view.select(from);
      const found = layer.factors[to]; // pixels make some per cent
      check(`F from ${from} to ${to} is the program's (${number(found)}, ${number(expected)})`, Math.abs(found - expected) < 0.08 * expected);
    }
    key("Escape");
  }
  select.value = 0;
  select.dispatchEvent(new Event("change"));
  check("the first layer comes back", !differ(first, pixels()));

  const dots = document.querySelectorAll("#chart circle").length;
  const errors = run.steps.filter((step) => step.estimated_error > 0).length +
    run.steps.filter((step) => step.true_error > 0).length;
  check("both panels of the chart have a dot for each error", dots === 2 * errors || (errors > 100 && dots > 100));
  check("a dot has the numbers of its step", errors === 0 || [...document.querySelectorAll("#chart title")].some((title) =>
    title.textContent.includes(`step ${run.steps.at(-1).step}: `)));
  check("the table has a row for each step", document.querySelectorAll("#steps tbody tr").length === run.steps.length);
  document.getElementById("number").value = run.patches - 1;
  document.getElementById("choose").requestSubmit();
  check("a number chooses a patch", view.selected === run.patches - 1);
  key("Escape");
  check("nothing is loaded from elsewhere", performance.getEntriesByType("resource").length === 0);
  check("no name has become HTML", document.querySelectorAll("main img, main b, main i").length === 0 &&
    window.hostile === undefined);
  check("nothing is wider than the window",
    document.documentElement.scrollWidth <= document.documentElement.clientWidth);
  document.body.replaceChildren(element("pre", { id: "check", text: "\n" + lines.join("\n") + "\nall checks ran\n" }));
}
