// Compares the module of the lesson with the program: the radiosity and the standard errors of all methods on
// three scenes have the same bits.
//
//   node lesson/tests/same_bits.js HEMILUX [SITE]     HEMILUX: the program; SITE: build/lesson/site
"use strict";

const { execFileSync } = require("child_process");
const fs = require("fs"), os = require("os"), path = require("path");
const root = path.join(__dirname, "../..");
const [program, site = path.join(root, "build/lesson/site")] = process.argv.slice(2);
const { hemilux } = require(path.resolve(site, "engine.js"));

const scenes = ["cube_96", "furnace_lshape", "open_scene"];
const pages = ["matrix", "progressive", "monte-carlo", "progressive-monte-carlo", "hemisphere-1997", "hemisphere"];
const runs = [
  ...pages.map((method) => ({ method, page: true })),
  ...pages.map((method) => ({ method, page: false })),
  { method: "hemisphere", page: true, literal: true },
  { method: "hemisphere", page: false, own: "--guide pyramid" },
  { method: "hemisphere", page: false, own: "--guide visible" },
  { method: "hemisphere", page: false, own: "--guide learned" },
  { method: "stratified", page: false },
  { method: "stored-transport", page: true },
  { method: "stored-transport", page: false },
];
const steps = 2, rays = 16;

const ofProgram = (scene, { method, page, literal, own }, folder) => {
  const table = path.join(folder, "table.csv");
  execFileSync(program, ["solve", path.join(root, `examples/scenes/${scene}.obj`), "--method", method, "--divide", "none",
    "--sides", "front", "--steps", steps, "--rays", rays, "-t", 1, "-q", "-o", table,
    ...(page ? ["--plain"] : []), ...(literal ? ["--literal"] : []), ...(own ? own.split(" ") : [])],
    { env: { ...process.env, HEMILUX_KERNELS: "baseline" }, stdio: ["ignore", "ignore", "inherit"] });
  const [header, ...lines] = fs.readFileSync(table, "utf8").trim().split("\n").map((line) => line.split(","));
  const columns = (name) => ["r", "g", "b"].map((channel) => header.indexOf(`${name}_${channel}`));
  const values = (name) => lines.flatMap((line) => columns(name).map((column) => readNumber(line[column])));
  return { light: values("radiosity"), errors: values("stderr") };
};

const readNumber = (word) => ({ inf: Infinity, nan: NaN, "": NaN })[word] ?? Number(word);
const bitsOf = (values) => new BigUint64Array(Float64Array.from(values).buffer);
// The share of values with other bits, and the largest difference relative to the largest value.
const compare = (a, b) => {
  if (a.length !== b.length) return { different: 1, largest: Infinity };
  const [x, y] = [bitsOf(a), bitsOf(b)];
  const scale = b.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 1e-300);
  const isSame = (k) => x[k] === y[k] || (Number.isNaN(a[k]) && Number.isNaN(b[k]));
  const different = b.filter((_, k) => !isSame(k)).length / b.length;
  const largest = b.reduce((most, value, k) => isSame(k) ? most : Math.max(most, Math.abs(value - a[k]) / scale), 0);
  return { different, largest: Number.isNaN(largest) ? Infinity : largest };
};

(async () => {
  await hemilux.ready(require(path.resolve(site, "hemilux.js")));
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "hemilux-"));
  let all = true;
  for (const scene of scenes) {
    const read = (extension) => fs.readFileSync(path.join(root, `examples/scenes/${scene}.${extension}`), "utf8");
    const room = new hemilux.Room(hemilux.readObj(read("obj"), read("mtl")));
    for (const run of runs) {
      const expected = ofProgram(scene, run, folder);
      const solver = room.run(run.method, { ...run, steps, rays });
      for (let step = 0; step < steps && !solver.finished; ++step) solver.step();
      const light = compare(solver.light, expected.light), errors = compare(solver.errors, expected.errors);
      solver.delete();
      const holds = light.different + errors.different === 0;
      all = all && holds;
      const name = `${scene}: ${run.method}${run.page ? ", page" : ""}${run.literal ? ", as printed" : ""}${run.own ? " " + run.own : ""}`;
      const shares = `${(100 * light.different).toFixed(0)} % of the light by up to ${light.largest.toExponential(1)}, ` +
        `${(100 * errors.different).toFixed(0)} % of the errors by up to ${errors.largest.toExponential(1)}`;
      console.log(holds ? `same bits  ${name}` : `DIFFERS    ${name}: ${shares}`);
    }
    room.delete();
  }
  fs.rmSync(folder, { recursive: true });
  console.log(all ? "the module agrees with the program" : "the module DIFFERS from the program");
  process.exit(all ? 0 : 1);
})();
