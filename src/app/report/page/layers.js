// Layers: what colours the surfaces. One with `light` has linear light, the others tints.

// The colours go from dark to bright, in even steps of lightness.
const rampColours = [[0.13, 0.08, 0.35], [0.23, 0.26, 0.62], [0.15, 0.5, 0.64], [0.25, 0.7, 0.45], [0.72, 0.83, 0.2],
  [1, 0.93, 0.55]];
function rampColour(share) {
  const place = clamp(share, 0, 1) * (rampColours.length - 1);
  const below = Math.min(Math.floor(place), rampColours.length - 2);
  return rampColours[below].map((x, k) => x + (place - below) * (rampColours[below + 1][k] - x));
}
const rampGradient = () =>
  `linear-gradient(to right, ${rampColours.map((c) => `rgb(${c.map((x) => Math.round(255 * x))})`)})`;
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
  if (run.counts)
    layers.push(scalarLayer("Density", "surfaces met by a density ray, mean", run, (i) => meanDensity(run, i)));
  layers.push(tintLayer("Patches", run, view, (i) => i + 1));
  layers.push(tintLayer("Materials", run, view, (i) => run.material[i] + 1));
  layers.push(tintLayer("Groups", run, view, (i) => run.group[i] + 1));
  return layers;
}

/** The exposure that pictures have: nine tenths of the surface shown are at most 0.8 of white. */
function exposureFor(run, layer) {
  const lit = [];
  const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b; // ITU-R BT.709
  for (let i = 0; i < run.patches; ++i)
    if (!isFar(run, i) && mean(emissionOf(run, i)) === 0) lit.push([luminance(layer.flat(i)), run.area[i]]);
  const high = quantileByArea(lit.map(([y]) => y), lit.map(([, area]) => area), 0.9);
  return high > 0 ? 0.8 / high : 1;
}
