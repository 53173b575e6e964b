lesson.chapter({
  number: 10,
  title: "The answer is not the solution",
  summary: "Patches are constant, light is not: division, gathering, your own room.",
  text: `
<p>A solver gives one number for each patch. Light does not stop at the edges of patches: a shadow runs across them, and
near a corner it changes within one. Even the exact solution on patches is wrong between them.</p>
<p>The chart follows the light along the dotted line on the floor. The stairs are the patches. The fine line is the
reference: a solution on 1024 patches, gathered with many rays.</p>
<p><b>Division</b> makes the stairs smaller. Patches half as wide halve the error, and there are four times as many.</p>
<p><b>Gathering</b> asks again, at each point: rays by the cosine law take the mean of what the patches reflect, and
shadow rays ask whether the lamp is seen. Now the patches are seen from afar, and their errors cancel. From the same coarse solution comes a far better answer.
What is left is noise, which more rays remove, and a small error of the patches, which they do not.</p>
<p>So the patches are not the answer; they are what the answer is computed <i>from</i>. hemilux goes one step on. It
takes the patches for a guess and estimates by further rays only what they are off: in statistics, a control variate. The
same rays say how large the error is, and this is what the program reports.</p>
<p>Now make the room yours. Move the box, dim the lamp, paint the walls, or open an OBJ file of your own with its
materials.</p>`,
  source: {
    section: "2", sentence: "This environment is composed of polygons which are split into patches.",
    pages: ["src/radiosity/light/cached_light/page/how_wrong.cpp", "src/radiosity/light/division/adaptive_division.h"],
  },
  state: { cells: 6, rays: 256, x: 2.05, z: 1.9, height: 0.75, lamp: 1, reflectance: 0.6, show: "both", eye: "0.12,0.14" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "A room with two boxes and a line on its floor", title: "The room on patches", ratio: 1.25 });
    const chart = f.view(figures.ChartView, { label: "Light along the line on the floor", title: "Light along the line [W/m²]", x: "metres from the left wall", log: false, ratio: 1.25 });
    f.choice("cells", "Cells of a wall", { 3: "3 x 3", 6: "6 x 6", 9: "9 x 9", 12: "12 x 12" });
    f.slider("rays", "Rays of a gather", 16, 1024, 16);
    f.choice("show", "Show", { both: "patches and gathers", patches: "patches", gathered: "gathers" });
    f.slider("x", "Box, x", 1.9, 2.3, 0.05);
    f.slider("z", "Box, z", 1.5, 2, 0.05);
    f.slider("height", "Box, height", 0.2, 2, 0.05);
    f.slider("lamp", "Lamp", 0.1, 2, 0.1);
    f.slider("reflectance", "Walls", 0.1, 0.85, 0.05);
    // The reader's own room, or what is wrong with its file.
    const maxFaces = 10000;
    const ownScene = ({ obj, mtl }) => {
      if (obj === undefined) throw new Error("an OBJ file is expected, with its MTL file beside it");
      const { facets, materials, ...rest } = hemilux.readObj(obj, mtl);
      if (!facets.length) throw new Error("the OBJ has no face (f)");
      if (facets.length > maxFaces) throw new Error(`it has ${facets.length} faces, and this page takes ${maxFaces} at most`);
      if (!facets.some(({ material }) => materials[material].emission.some((x) => x > 0)))
        throw new Error(mtl === undefined ? "nothing emits light: choose the MTL file too" : "nothing emits light: a material of the MTL needs Ke");
      return { facets, materials, ...rest };
    };
    f.files("Your own OBJ, with its MTL: drop both, or", ".obj,.mtl", (texts) => {
      try {
        f.own = ownScene(texts);
        f.update();
      } catch (error) {
        f.own = null;
        f.update();
        f.say(`This file cannot be shown: ${error.message}.`);
      }
    });
    f.button("Back to the room with two boxes", () => { f.own = null; f.update(); });
    const titles = { view: view.title.textContent, chart: chart.title.textContent };
    // Patches from dark to bright over the area that they add.
    const byBrightness = (room, light) => {
      const mean = (patch) => (light[3 * patch.index] + light[3 * patch.index + 1] + light[3 * patch.index + 2]) / 3;
      let area = 0;
      return [...room.patches].sort((p, q) => mean(p) - mean(q)).map((patch) => [area += patch.area, mean(patch)]);
    };
    const showOwn = () => {
      const room = f.room(f.own);
      if (!room.patches.some(({ area }) => area > 0)) throw new Error("its faces have no area");
      const run = room.run("stored-transport", { rays: 256, steps: 1 }).step();
      const { light, figures: { rays: traced, error } } = run;
      run.delete();
      view.middle = view.radius = undefined;
      view.room = room;
      view.colour = figures.lit(light, figures.exposure(room, light, 0.95));
      view.after = null;
      view.title.textContent = "Your room";
      chart.title.textContent = "Light of your patches [W/m²], from dark to bright";
      chart.x = "area of patches [m²]";
      chart.series = [{ name: "patches", points: byBrightness(room, light), dots: false }];
      f.values = { light: [...light], count: room.patches.length, rays: traced, error };
      f.say(`Your room has ${room.patches.length} patches. ${figures.format(traced)} rays found its light, within ${figures.percent(error)} by their own estimate.`);
      f.table(["Material", "Patches", "Area [m²]", "Mean light [W/m²]"], f.own.materials.map(({ name }, k) => {
        const of = room.patches.filter(({ material }) => material === k), area = of.reduce((sum, patch) => sum + patch.area, 0);
        const power = of.reduce((sum, { index, area: own }) => sum + own * (light[3 * index] + light[3 * index + 1] + light[3 * index + 2]) / 3, 0);
        return [name, of.length, area, area > 0 ? power / area : 0];
      }));
    };
    const points = Array.from({ length: 60 }, (_, k) => [0.025 + k * 0.05, 2.62]);
    const solve = (room, rays) => {
      const run = room.run("stored-transport", { rays, steps: 1 });
      const light = run.step().light;
      run.delete();
      return light;
    };
    // The floor is the first sheet of the room.
    const patchAt = ([x, z], n) => Math.min(n - 1, Math.floor((3 - z) / 3 * n)) * n + Math.min(n - 1, Math.floor(x / 3 * n));
    const gather = (room, light, n, rays, seed) => {
      const seen = room.gather(light, points.map((point) => [point[0], 0, point[1], 0, 1, 0, patchAt(point, n)]), rays, seed);
      return points.map((_, k) => f.state.reflectance * seen[3 * k]);
    };
    let built = "", reference;
    f.change = () => {
      const { cells, rays, x, z, height, lamp, reflectance, show } = f.state, n = Number(cells);
      f.rooms?.forEach((old) => old.delete());
      f.rooms = [];
      if (f.own) return showOwn();
      if (view.title.textContent !== titles.view) view.middle = view.radius = undefined;
      view.title.textContent = titles.view;
      chart.title.textContent = titles.chart;
      chart.x = "metres from the left wall";
      const make = (k) => rooms.boxes({ n: k, reflectance, lamp, second: [x, z, height] });
      const key = [x, z, height, lamp, reflectance].join();
      if (key !== built) {
        const fine = f.room(make(12));
        reference = gather(fine, solve(fine, 128), 12, 1024, 7);
        built = key;
      }
      const room = f.room(make(n)), light = solve(room, 256);
      const patches = points.map((point) => light[3 * patchAt(point, n)]), gathered = gather(room, light, n, rays, 1);
      const off = (values) => Math.sqrt(values.reduce((sum, value, k) => sum + (value - reference[k]) ** 2, 0) / reference.reduce((sum, value) => sum + value ** 2, 0));
      view.room = room;
      view.colour = figures.lit(light, figures.exposure(room, light, 0.95));
      view.after = (it) => it.line([points[0], points.at(-1)].map(([px, pz]) => it.project([px, 0.01, pz])), { colour: "#fff", width: 2, dash: [3, 4] });
      const along = (values) => values.map((value, k) => [points[k][0], value]);
      chart.series = [{ name: "reference", points: along(reference), dots: false, colour: figures.ink("soft"), width: 1.5 }];
      if (show !== "gathered") chart.series.push({ name: "patches", points: along(patches), dots: false });
      if (show !== "patches") chart.series.push({ name: "gathered", points: along(gathered), dots: false, colour: figures.ink("ray"), width: 1.5 });
      f.values = { patches: off(patches), gathered: off(gathered), count: room.patches.length };
      f.say(`On ${room.patches.length} patches the light along the line is off by ${figures.percent(off(patches))}. Gathered from the same patches it is off by ${figures.percent(off(gathered))}.`);
      f.table(["x [m]", "Reference", "Patches", "Gathered"], points.map(([px], k) => [px.toFixed(3), reference[k], patches[k], gathered[k]]).filter((_, k) => k % 2 === 0));
    };
  },
  exercises: [
    { ask: "The error of patches falls as their width. How many times as many patches make it a third?", answer: 9, within: 0.001, hint: "A wall has two directions." },
    { ask: "Which error do more rays of a gather not remove?", choices: ["the noise", "what the patches are off seen from afar", "the stairs on the floor"], answer: "what the patches are off seen from afar" },
    { ask: "A gather by 256 rays has the noise s. By 4096 rays, as a share of s?", answer: 0.25, within: 0.01 },
  ],
});
