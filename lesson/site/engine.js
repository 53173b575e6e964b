// The methods of the paper as objects of JavaScript: rooms, runs and hemispheres of the module hemilux.js.
// It is the same library as that of the program; tests/same_bits.js compares every bit of both.
"use strict";

const hemilux = (() => {
  let module;

  const number = (values) => {
    const at = module._malloc(8 * Math.max(values.length, 1));
    new Float64Array(module.HEAPU8.buffer).set(values, at / 8);
    return at;
  };
  const text = (string) => {
    const bytes = new TextEncoder().encode(string + "\0");
    const at = module._malloc(bytes.length);
    new Uint8Array(module.HEAPU8.buffer).set(bytes, at);
    return at;
  };

  // Calls a function of the module with numbers, arrays of numbers and texts. Returns its answer, an array
  // of numbers. Throws an Error with what was wrong.
  const call = (name, ...values) => {
    const taken = [];
    const keep = (at) => (taken.push(at), at);
    const plain = values.map((value) => typeof value === "string" ? keep(text(value))
      : typeof value === "object" ? keep(number(value)) : Number(value));
    const succeeded = module["_" + name](...plain);
    taken.forEach((at) => module._free(at));
    if (!succeeded) throw new Error(module.UTF8ToString(module._failure_text()));
    const begin = module._answer_begin() / 8;
    return new Float64Array(module.HEAPU8.buffer).slice(begin, begin + module._answer_size());
  };

  const patchNumbers = 28;
  const vector = (values, at) => [values[at], values[at + 1], values[at + 2]];

  // A scene with its patches. `scene`: { vertices: [[x, y, z]], facets: [{ corners: [3 or 4 indices],
  // material }], materials: [{ name, reflectance: [r, g, b], emission: [r, g, b] }] }, lengths in metres.
  class Room {
    constructor(scene, maxEdge = 0) {
      this.scene = scene;
      const facets = scene.facets.flatMap(({ corners, material }) =>
        [...corners, ...(corners.length === 3 ? [corners[2]] : []), material]);
      const materials = scene.materials.flatMap((m) => [...m.reflectance, ...m.emission]);
      [this.handle] = call("room_new", scene.vertices.flat(), scene.vertices.length, facets,
        scene.facets.length, materials, scene.materials.length, maxEdge);
      const values = call("room_patches", this.handle);
      this.patches = [];
      for (let at = 0; at < values.length; at += patchNumbers) {
        const corners = [0, 1, 2, 3].slice(0, values[at]).map((k) => vector(values, at + 1 + 3 * k));
        this.patches.push({ index: this.patches.length, corners, centre: vector(values, at + 13),
          normal: vector(values, at + 16), area: values[at + 19], facet: values[at + 20],
          material: values[at + 21], reflectance: vector(values, at + 22), emission: vector(values, at + 25) });
      }
    }
    delete() { module._room_delete(this.handle); }
    // The patch at which an eye looks, or -1.
    look(eye, direction) { return call("room_look", this.handle, ...eye, ...direction)[0]; }
    note(rays) { call("room_note", this.handle, rays); }
    noted() { return rays(call("room_noted", this.handle)); }
    error(radiosity, reference) { return call("room_error", this.handle, radiosity, reference)[0]; }
    exchange(i, j) { return call("factor_closed", this.handle, i, j)[0]; }
    raysFrom(patch, count, seed = 1) { return rays(call("factor_rays", this.handle, patch, count, seed)); }
    // The pixels of a hemicube: [{ direction, factor, patch }].
    hemicube(patch, edge) {
      const values = call("factor_hemicube", this.handle, patch, edge), pixels = [];
      for (let at = 0; at < values.length; at += 5)
        pixels.push({ direction: vector(values, at), factor: values[at + 3], patch: values[at + 4] });
      return pixels;
    }
    // The matrix of form factors, row by row.
    factors(raysEach = 4096, seed = 1) { return call("room_factors", this.handle, raysEach, seed); }
    axes(patch) {
      const values = call("room_axes", this.handle, patch);
      return [0, 3, 6].map((at) => vector(values, at));
    }
    counts(patch, depth) { return call("room_counts", this.handle, patch, depth); }
    // The triangles of 1997: [[{ direction, count } of three corners]].
    hemisphere1997(patch, stored, estimated) {
      const values = call("room_hemisphere_1997", this.handle, patch, stored, estimated), triangles = [];
      for (let at = 0; at < values.length; at += 12)
        triangles.push([0, 4, 8].map((k) => ({ direction: vector(values, at + k), count: values[at + k + 3] })));
      return triangles;
    }
    gather(radiosity, points, raysEach, seed = 1) {
      return call("room_gather", this.handle, radiosity, points.flat(), points.length, raysEach, seed);
    }
    run(method, options = {}) {
      const { page = false, rays = 64, depth = 2, threshold = 0, literal = false, seed = 1, steps = 0, own = "" } = options;
      return new Run(this, call("run_new", this.handle, method, page, rays, depth, threshold, literal, seed, steps, own)[0]);
    }
    // A run by a strategy of the reader: share(patch, triangles) returns [{ cell, rays, power }].
    runOwn(share, options = {}) {
      const { depth = 2, fromCentre = false, rounded = false, rays = 64, seed = 1 } = options;
      const numbers = this.patches.flatMap((patch) => {
        const triangles = share(patch.index);
        return [triangles.length, ...triangles.flatMap(({ cell, rays: n, power }) => [cell, n, power])];
      });
      return new Run(this, call("run_own", this.handle, numbers, numbers.length, depth, fromCentre, rounded, rays, seed)[0]);
    }
  }

  const rays = (values) => {
    const list = [];
    for (let at = 0; at < values.length; at += 7)
      list.push({ from: vector(values, at), to: vector(values, at + 3), patch: values[at + 6] });
    return list;
  };

  class Run {
    constructor(room, handle) { this.room = room; this.handle = handle; this.finished = false; }
    delete() { module._run_delete(this.handle); }
    step() { this.finished = call("run_step", this.handle)[0] === 1; return this; }
    get light() { return call("run_light", this.handle); }
    get errors() { return call("run_errors", this.handle); }
    get figures() {
      const [steps, rays, densityRays, bytes, error, emitted, absorbed, escaped, unshot] = call("run_figures", this.handle);
      return { steps, rays, densityRays, bytes, error, emitted, absorbed, escaped, unshot };
    }
  }

  // The subdivision that all patches share.
  const hemisphere = (depth) => {
    const directions = call("hemisphere_vertices", depth), numbers = call("hemisphere_cells", depth);
    const vertices = [], cells = [];
    for (let at = 0; at < directions.length; at += 3) vertices.push(vector(directions, at));
    for (let at = 0; at < numbers.length; at += 7)
      cells.push({ index: cells.length, vertex: vector(numbers, at), level: numbers[at + 3], child: numbers[at + 4],
        solidAngle: numbers[at + 5], projected: numbers[at + 6] });
    // Directions of rays in a triangle.
    const raysIn = (cell, count, seed = 1) => {
      const values = call("hemisphere_rays", depth, cell, count, seed), list = [];
      for (let at = 0; at < values.length; at += 3) list.push(vector(values, at));
      return list;
    };
    return { depth, vertices, cells, raysIn };
  };

  // The triangles of a patch that are not divided, with their mean counts: procedure Preprocessing.
  const leaves = ({ depth, cells }, counts, threshold) => {
    const list = [];
    const divide = (cell) => {
      const density = (counts[cell.vertex[0]] + counts[cell.vertex[1]] + counts[cell.vertex[2]]) / 3;
      if (density > threshold && cell.level < depth)
        for (let child = 0; child < 4; ++child) divide(cells[cell.child + child]);
      else list.push({ cell, density: Math.fround(density) }); // a float, as on the page
    };
    for (let root = 0; root < 4; ++root) divide(cells[root]);
    return list;
  };

  // The shares of the triangles of a patch: of its rays, A_tr / A_hemi D_tr / D_average, and of its power,
  // A_tr / A_hemi. Rules: `sphere`, areas on the sphere in place of their projections (D1); `zero`, a density of 0
  // gets no rays (D5). Without it a density is one surface at least, and a quarter of the average.
  const shares = (leaves, { sphere = false, zero = false } = {}) => {
    const area = (cell) => sphere ? cell.solidAngle / (2 * Math.PI) : cell.projected / Math.PI;
    const averageOf = (densities) => leaves.reduce((sum, { cell }, k) => sum + area(cell) * densities[k], 0);
    const counted = leaves.map(({ density }) => density), mean = averageOf(counted);
    const densities = zero ? counted : counted.map((density) => Math.fround(Math.max(density, 1, mean / 4)));
    const average = averageOf(densities);
    const list = leaves.map(({ cell }, k) => ({ cell: cell.index, area: area(cell), density: densities[k],
      rays: average > 0 ? area(cell) * densities[k] / average : 0, power: area(cell) }));
    return Object.assign(list, { average });
  };

  // Reads a Wavefront OBJ with its MTL: v, f (any convex polygon), usemtl; Kd, Ke. Throws an Error with the line that is
  // wrong and what is expected there.
  const readObj = (obj, mtl = "") => {
    const materials = [], byName = new Map();
    const add = (name) => {
      if (!byName.has(name)) {
        byName.set(name, materials.length);
        materials.push({ name, reflectance: [0.5, 0.5, 0.5], emission: [0, 0, 0] });
      }
      return byName.get(name);
    };
    const check = (holds, at, expected) => { if (!holds) throw new Error(`${at}: ${expected}`); };
    const eachLine = (kind, text, take) => text.split("\n").forEach((line, k) =>
      take(line.replace(/#.*/, "").trim().split(/\s+/), `line ${k + 1} of the ${kind}`));
    const triple = (words, at, name, low, high) => {
      const numbers = words.slice(0, 3).map(Number);
      check(numbers.length === 3 && numbers.every((x) => Number.isFinite(x) && x >= low && x <= high), at, `${name} has three numbers` +
        (high < Infinity ? ` from ${low} to ${high}` : low === 0 ? ", none of them negative" : ""));
      return numbers;
    };
    let material = -1;
    eachLine("MTL", mtl, ([word, ...rest], at) => {
      if (word === "newmtl") material = add(rest.join(" "));
      if (word !== "Kd" && word !== "Ke") return;
      check(material >= 0, at, `newmtl stands before ${word}`);
      if (word === "Kd") materials[material].reflectance = triple(rest, at, "Kd", 0, 1);
      else materials[material].emission = triple(rest, at, "Ke", 0, Infinity);
    });
    const vertices = [], facets = [];
    material = -1;
    eachLine("OBJ", obj, ([word, ...rest], at) => {
      if (word === "v") vertices.push(triple(rest, at, "a vertex", -Infinity, Infinity));
      if (word === "usemtl") material = add(rest.join(" "));
      if (word !== "f") return;
      const corners = rest.map((entry) => {
        const index = parseInt(entry, 10), corner = index < 0 ? vertices.length + index : index - 1;
        check(corner >= 0 && corner < vertices.length, at, `there is no vertex ${entry}`);
        return corner;
      });
      check(corners.length >= 3, at, "a face has three corners at least");
      if (material < 0) material = add("default");
      if (corners.length <= 4) facets.push({ corners, material });
      else for (let k = 1; k + 1 < corners.length; ++k) facets.push({ corners: [corners[0], corners[k], corners[k + 1]], material });
    });
    return { vertices, facets, materials };
  };

  const ready = (load) => load().then((loaded) => { module = loaded; });
  return { ready, Room, hemisphere, leaves, shares, readObj };
})();

if (typeof exports === "object") exports.hemilux = hemilux;
