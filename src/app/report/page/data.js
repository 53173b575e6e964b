// The data of the page: JSON, and arrays of numbers in base64 (report_page.h lists them).

/** The bytes of an array of the page; null where it has none. */
function readBytes(name) {
  const element = document.getElementById(name);
  if (!element || element.type !== "application/base64") return null;
  const text = atob(element.textContent);
  const bytes = new DataView(new ArrayBuffer(text.length));
  for (let i = 0; i < text.length; ++i) bytes.setUint8(i, text.charCodeAt(i));
  element.remove(); // its text is no longer needed
  return bytes;
}

/** Words of four bytes; null where there are none. Type: Float32Array or Uint32Array. */
function readArray(name, Type) {
  const bytes = readBytes(name);
  if (!bytes) return null;
  const numbers = new Type(bytes.byteLength / 4); // the file is little-endian, the machine may not be
  for (let i = 0; i < numbers.length; ++i)
    numbers[i] = Type === Float32Array ? bytes.getFloat32(4 * i, true) : bytes.getUint32(4 * i, true);
  return numbers;
}

/** Halves (IEEE 754 binary16), each times the unit. */
function readHalves(name, unit) {
  const bytes = readBytes(name);
  return Float32Array.from({ length: bytes.byteLength / 2 }, (_, i) => {
    const half = bytes.getUint16(2 * i, true), exponent = (half >> 10) & 31, fraction = half & 1023;
    const size = exponent ? (1 + fraction / 1024) * 2 ** (exponent - 15) : fraction * 2 ** -24;
    return (half & 0x8000 ? -size : size) * unit;
  });
}

/** The JSON of the page with its arrays by patch or vertex. */
function readRun() {
  const run = JSON.parse(document.getElementById("run").textContent);
  for (const name of ["position", "light", "area", "radiosity", "error", "hits", "reflectance", "emission"])
    run[name] = readArray(name, Float32Array);
  for (const name of ["corners", "triangles", "face", "material", "group"]) run[name] = readArray(name, Uint32Array);
  run.patches = run.area.length;
  readDensities(run);
  return run;
}

/** The hemisphere of patches and what was counted, where there are densities. */
function readDensities(run) {
  const counts = readBytes("counts");
  run.counts = counts && new Uint8Array(counts.buffer);
  for (const name of ["vertices", "shares"]) run[name] = readArray(name, Float32Array);
  run.cells = readArray("cells", Uint32Array);
}

/** Three numbers of a patch from an array with three a patch. */
const triple = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];

const reflectanceOf = (run, i) =>
  run.reflectance ? triple(run.reflectance, i) : run.materials[run.material[i]].reflectance;
function emissionOf(run, i) {
  const solved = run.emission ? triple(run.emission, i) : run.materials[run.material[i]].emission;
  const lamp = run.lampSet?.lamps[run.lampSet.of[i]];
  return lamp ? solved.map((x, k) => x * lamp.factor[k]) : solved;
}
const isFar = (run, i) => run.materials[run.material[i]].far;

/** E = (B - emission) / rho by channel; null where a surface that reflects nothing hides it. */
function irradianceFrom(run, i, light) {
  const rho = reflectanceOf(run, i), own = emissionOf(run, i);
  return light.map((value, k) => (rho[k] > 0 ? Math.max(0, (value - own[k]) / rho[k]) : null));
}

const mean = (numbers) => numbers.reduce((sum, x) => sum + x, 0) / numbers.length;

/** The least number that is not exceeded on the given share of the area. */
function quantileByArea(values, areas, share) {
  const order = values.map((_, k) => k).sort((a, b) => values[a] - values[b]);
  let left = share * areas.reduce((sum, a) => sum + a, 0);
  for (const k of order) if ((left -= areas[k]) <= 0) return values[k];
  return values.length ? values[order[order.length - 1]] : 0;
}
