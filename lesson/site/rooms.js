// The rooms of the lesson, in metres, y upwards. Walls face inwards.
"use strict";

const rooms = (() => {
  const begin = (materials) => ({ vertices: [], facets: [], materials: materials.map(([name, reflectance, emission = [0, 0, 0]]) => ({ name, reflectance, emission })) });
  // A parallelogram, u x v times; its front looks along u x v.
  const sheet = (scene, corner, u, v, material, across = 1, along = 1) => {
    const first = scene.vertices.length, index = scene.materials.findIndex(({ name }) => name === material);
    for (let j = 0; j <= along; ++j)
      for (let i = 0; i <= across; ++i)
        scene.vertices.push([0, 1, 2].map((k) => corner[k] + u[k] * i / across + v[k] * j / along));
    for (let j = 0; j < along; ++j)
      for (let i = 0; i < across; ++i) {
        const at = first + j * (across + 1) + i;
        scene.facets.push({ corners: [at, at + 1, at + across + 2, at + across + 1], material: index });
      }
    return scene.facets.length - across * along;
  };
  // A box that stands on the floor, turned about the vertical, without its bottom.
  const box = (scene, [x, z], [width, height, depth], turn, material, cells = 1) => {
    const c = Math.cos(turn), s = Math.sin(turn);
    const place = (a, y, b) => [x + c * a + s * b, y, z - s * a + c * b];
    const [w, d] = [width / 2, depth / 2];
    const side = (p, q) => sheet(scene, place(...p), sub(place(...q), place(...p)), [0, height, 0], material, cells, cells);
    const sub = (a, b) => a.map((value, k) => value - b[k]);
    side([-w, 0, d], [w, 0, d]);
    side([w, 0, d], [w, 0, -d]);
    side([w, 0, -d], [-w, 0, -d]);
    side([-w, 0, -d], [-w, 0, d]);
    const top = place(-w, height, d);
    sheet(scene, top, sub(place(w, height, d), top), sub(place(-w, height, -d), top), material, cells, cells);
  };
  // Six walls inwards, each n x n, with a ceiling of cells x cells whose middle lamp x lamp shine.
  const shell = (scene, [w, h, d], n, { left = "wall", right = "wall", back = "wall", front = "wall", floor = "floor", ceiling = "wall" } = {}, lamp = 0, cells = n) => {
    sheet(scene, [0, 0, d], [w, 0, 0], [0, 0, -d], floor, n, n);
    sheet(scene, [0, 0, d], [0, 0, -d], [0, h, 0], left, n, n);
    sheet(scene, [w, 0, 0], [0, 0, d], [0, h, 0], right, n, n);
    sheet(scene, [0, 0, 0], [w, 0, 0], [0, h, 0], back, n, n);
    sheet(scene, [w, 0, d], [-w, 0, 0], [0, h, 0], front, n, n);
    const first = sheet(scene, [0, h, 0], [w, 0, 0], [0, 0, d], ceiling, cells, cells);
    const light = scene.materials.findIndex(({ name }) => name === "lamp");
    for (let i = 0; i < lamp; ++i)
      for (let j = 0; j < lamp; ++j) scene.facets[first + ((cells - lamp) / 2 + j) * cells + (cells - lamp) / 2 + i].material = light;
  };
  const grey = (x) => [x, x, x];

  // Two squares of side 1 and `size`: one on the ground, one above it, turned and moved aside.
  const pair = ({ distance = 1, tilt = 0, aside = 0, size = 1 }) => {
    const scene = begin([["lower", grey(0.6)], ["upper", grey(0.6)]]);
    sheet(scene, [-0.5, 0, 0.5], [1, 0, 0], [0, 0, -1], "lower");
    const c = Math.cos(tilt), s = Math.sin(tilt), h = size / 2;
    sheet(scene, [aside - h * c, distance - h * s, -h], [size * c, size * s, 0], [0, 0, size], "upper");
    return scene;
  };
  // A room of 14 or more patches with a lamp in the middle of its ceiling.
  const small = ({ reflectance = 0.5, lamp = 1, n = 2, block = false, colours = true }) => {
    const r = reflectance, scene = begin([["floor", grey(r)], ["wall", grey(r)],
      ["red", colours ? [r, 0.3 * r, 0.25 * r] : grey(r)], ["blue", colours ? [0.3 * r, 0.45 * r, r] : grey(r)],
      ["lamp", grey(r), [10 * lamp, 9 * lamp, 7.5 * lamp]]]);
    shell(scene, [3, 2.4, 3], n, { left: "red", right: "blue" }, 1, 3);
    if (block) box(scene, [1.8, 1.2], [0.8, 0.9, 0.8], 0.3, "wall");
    return scene;
  };
  // A room with two boxes, after that of Goral et al. at Cornell University; n x n cells a wall, n = 3, 6, 9, ...
  const boxes = ({ n = 6, reflectance = 0.6, lamp = 1, second = [2.05, 1.9, 0.75] } = {}) => {
    const r = reflectance, scene = begin([["floor", grey(r)], ["wall", grey(r)], ["red", [r, 0.12 * r, 0.1 * r]], ["green", [0.2 * r, 0.75 * r, 0.2 * r]],
      ["box", grey(1.1 * r)], ["lamp", grey(0.4), [22 * lamp, 19 * lamp, 14 * lamp]]]);
    shell(scene, [3, 2.6, 3], n, { left: "red", right: "green" }, n / 3);
    box(scene, [0.95, 0.95], [0.8, 1.5, 0.8], 0.35, "box", Math.max(1, Math.round(n / 3)));
    box(scene, second, [0.8, second[2], 0.8], -0.3, "box", Math.max(1, Math.round(n / 3)));
    return scene;
  };
  // The same walls with a table of many small things in one corner: what the paper calls complex.
  const crowd = ({ n = 4, wall = 0, things = 4, lamp = 1 } = {}) => {
    const scene = begin([["floor", grey(0.6)], ["wall", grey(0.6)], ["thing", [0.7, 0.5, 0.3]], ["screen", [0.35, 0.5, 0.6]],
      ["lamp", grey(0.4), [30 * lamp, 27 * lamp, 23 * lamp]]]);
    shell(scene, [4, 2.6, 3], n, {}, 1, 5);
    for (let i = 0; i < things; ++i)
      for (let j = 0; j < things; ++j)
        box(scene, [0.45 + 1.4 * i / Math.max(things, 1), 0.7 + 1.8 * j / Math.max(things, 1)], [0.2, 0.3 + 0.16 * ((i * 7 + j * 3) % 4), 0.2], 0.4 * (i + 2 * j), "thing");
    if (wall) box(scene, [1.75, 1.5], [0.06, 2.1, 2.6], 0, "screen", 3);
    return scene;
  };
  // A closed L in which everything emits 1 and reflects one half, or the same without its ceiling.
  const furnace = (isOpen = false) => {
    const scene = begin([["wall", grey(0.5), grey(1)]]);
    const outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    outline.forEach(([x, z], k) => {
      const [x2, z2] = outline[(k + 1) % outline.length], cells = 2 * Math.round(Math.hypot(x2 - x, z2 - z));
      sheet(scene, [x, 0, z], [x2 - x, 0, z2 - z], [0, 1, 0], "wall", cells, 2);
    });
    for (const [x, z] of [[0, 0], [1, 0], [0, 1]]) {
      sheet(scene, [x, 0, z + 1], [1, 0, 0], [0, 0, -1], "wall", 2, 2);
      if (!isOpen) sheet(scene, [x, 1, z], [1, 0, 0], [0, 0, 1], "wall", 2, 2);
    }
    return scene;
  };
  // A scene of the program's examples, as scripts/lesson.sh puts it into examples.js.
  const example = (name) => hemilux.readObj(rooms.files[name].obj, rooms.files[name].mtl);
  // Writes a scene as OBJ and MTL, for the program.
  const toObj = (scene, library) => ({
    obj: [`mtllib ${library}`, ...scene.vertices.map((v) => `v ${v.join(" ")}`),
      ...scene.facets.flatMap(({ corners, material }) => [`usemtl ${scene.materials[material].name}`, `f ${corners.map((c) => c + 1).join(" ")}`]), ""].join("\n"),
    mtl: scene.materials.flatMap(({ name, reflectance, emission }) => [`newmtl ${name}`, `Kd ${reflectance.join(" ")}`, `Ke ${emission.join(" ")}`, ""]).join("\n"),
  });
  return { begin, sheet, box, shell, grey, pair, small, boxes, crowd, furnace, example, toObj };
})();

if (typeof exports === "object") exports.rooms = rooms;
