// What the program finds on the rooms of the lesson, for the figures to be compared with.
//
//   node lesson/tests/scenes.js HEMILUX SITE FOLDER     writes FOLDER/expected.js
"use strict";

const { execFileSync } = require("child_process");
const fs = require("fs"), path = require("path");
const [program, site, folder] = process.argv.slice(2);
const { rooms } = require(path.resolve(site, "rooms.js"));

const write = (name, scene) => {
  const { obj, mtl } = rooms.toObj(scene, `${name}.mtl`);
  fs.writeFileSync(path.join(folder, `${name}.obj`), obj);
  fs.writeFileSync(path.join(folder, `${name}.mtl`), mtl);
  return path.join(folder, `${name}.obj`);
};
const run = (...words) => execFileSync(program, words.map(String),
  { env: { ...process.env, HEMILUX_KERNELS: "baseline" }, stdio: ["ignore", "ignore", "inherit"] });
const rows = (file) => {
  const [header, ...lines] = fs.readFileSync(file, "utf8").trim().split("\n").map((line) => line.split(","));
  return lines.map((line) => Object.fromEntries(header.map((name, k) => [name, Number(line[k])])));
};
const solve = (scene, ...options) => {
  const [table, figures] = ["light.csv", "figures.json"].map((name) => path.join(folder, name));
  run("solve", scene, "--divide", "none", "--sides", "front", "-t", 1, "-q", "-o", table, "--stats", figures, ...options);
  const { rays_energy: rays, rays_density: densityRays, estimated_error: error } = JSON.parse(fs.readFileSync(figures, "utf8"));
  return { light: rows(table).flatMap((row) => [row.radiosity_r, row.radiosity_g, row.radiosity_b]), rays, densityRays, error };
};
const factors = (scene, ...options) => {
  const table = path.join(folder, "factors.csv");
  run("formfactors", scene, "--sides", "front", "-t", 1, "-q", "-o", table, ...options);
  return rows(table);
};

// The pages of source that chapters name are there.
const root = path.join(__dirname, "../..");
for (const file of fs.readdirSync(path.join(site, "chapters"))) {
  const text = fs.readFileSync(path.join(site, "chapters", file), "utf8");
  for (const [page] of text.matchAll(/\b(src|docs)\/[\w/-]+(\.\w+)?/g))
    if (!fs.existsSync(path.join(root, page))) throw new Error(`${file} names ${page}, which is not there`);
}

const pair = write("pair", rooms.pair({})), small = write("small", rooms.small({})), boxes = write("boxes", rooms.boxes({ n: 6 }));
const crowd = write("crowd", rooms.crowd({ things: 4 })), furnace = write("furnace", rooms.furnace());
const example = path.join(root, "examples/scenes/room_1002.obj");
const expected = {
  pair: factors(pair, "--factors", "exact"),
  small: { light: solve(small, "--method", "matrix", "--exact").light, factors: factors(small, "--factors", "exact") },
  progressive: solve(boxes, "--method", "progressive", "--plain", "--steps", 3),
  "monte-carlo": solve(boxes, "--method", "monte-carlo", "--one-shot", "--steps", 3),
  "progressive-monte-carlo": solve(boxes, "--method", "progressive-monte-carlo", "--plain", "--steps", 4),
  crowd: solve(crowd, "--method", "hemisphere", "--plain", "--steps", 2),
  threshold: solve(crowd, "--method", "hemisphere", "--plain", "--steps", 2, "--threshold", 2),
  printed: solve(crowd, "--method", "hemisphere", "--literal", "--plain", "--steps", 2),
  furnace: solve(furnace, "--method", "hemisphere", "--literal", "--plain", "--steps", 8),
  stored: solve(boxes, "--method", "stored-transport", "--steps", 2),
  // A scene of the examples: as the default method ends, and by the step that chapter 10 takes with a reader's room.
  example: solve(example, "--method", "stored-transport"),
  own: solve(example, "--method", "stored-transport", "--rays", 256, "--steps", 1),
};
fs.writeFileSync(path.join(folder, "expected.js"), `const expected = ${JSON.stringify(expected)};\n`);
