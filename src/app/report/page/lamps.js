// The lamps of the scene apart (--layers). Light is linear: the light of all lamps is the sum of that of each, times
// how bright it is set.

const darkest = 0, brightest = 4;

/** The lamps of the page with their light, and by patch which lamp it is of; null where they are not apart. */
function readLamps(run) {
  if (!run.lamps) return null;
  const lamps = run.lamps.map((name, k) => ({ name, factor: [1, 1, 1],
    radiosity: readHalves("lamp-" + k, run.lamp_unit), light: readHalves("smooth-lamp-" + k, run.lamp_unit) }));
  return { lamps, of: readArray("lamp-of", Uint32Array), whole: { radiosity: run.radiosity, light: run.light } };
}

/** The sum of the lamps' arrays of this name. */
function sumOfLamps(lamps, name) {
  const sum = new Float32Array(lamps[0][name].length);
  for (const lamp of lamps)
    for (let i = 0; i < sum.length; ++i) sum[i] += lamp.factor[i % 3] * lamp[name][i];
  return sum;
}

/** Lights the run as the lamps are set. As they are in the scene, the light is the one that was solved for. */
function lightByLamps(run, { lamps, whole }) {
  const asSolved = lamps.every(({ factor }) => factor.every((x) => x === 1));
  for (const name of ["radiosity", "light"]) run[name] = asSolved ? whole[name] : sumOfLamps(lamps, name);
}

/** A slider and a colour for each lamp; calls changed() once the run is lit by them. */
function showLamps(run, changed) {
  const set = run.lampSet;
  if (!set) return;
  const update = () => { lightByLamps(run, set); changed(); };
  const rows = set.lamps.map((lamp) => {
    const slider = element("input", { type: "range", min: darkest, max: brightest, step: 0.05, value: 1, "aria-label": lamp.name });
    const colour = element("input", { type: "color", value: "#ffffff", "aria-label": "colour of " + lamp.name });
    const shown = element("output", { text: "1" });
    const follow = () => {
      const tint = [1, 3, 5].map((at) => parseInt(colour.value.slice(at, at + 2), 16) / 255);
      lamp.factor = tint.map((x) => slider.valueAsNumber * x ** 2.2);
      shown.textContent = number(slider.valueAsNumber, 2);
      update();
    };
    for (const input of [slider, colour]) input.addEventListener("input", follow);
    const reset = () => { slider.value = 1; colour.value = "#ffffff"; lamp.factor = [1, 1, 1]; shown.textContent = "1"; };
    return { reset, row: element("label", {}, element("span", { text: lamp.name }), slider, shown, colour) };
  });
  const all = element("button", { type: "button", text: "As solved" });
  all.addEventListener("click", () => { rows.forEach(({ reset }) => reset()); update(); });
  at("lamps").append(element("legend", { text: "Lamps" }), ...rows.map(({ row }) => row), all);
  at("lamps").hidden = false;
}
