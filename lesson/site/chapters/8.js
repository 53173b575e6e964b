lesson.chapter({
  number: 8,
  title: "What counts cannot know",
  summary: "A wall in front of the crowd, and what better guides do about it.",
  text: `
<p>A density ray counts everything on its way. It does not know what is visible. Put a screen before a crowd: all counts
towards it are high, and the rays that they attract end on the bare screen. The paper fears this itself in its
conclusion. Yet the things gain here even so: the bars tell how much.</p>
<p>Each bar is a guide, and all shoot the same number of rays from the same room: so the same cost in rays, not quite in
time. The upper bar is the error of all surfaces, the lower one that of the small things alone.</p>
<p><b>None</b> is <i>stratified</i>: the same triangles, rays in proportion to power. It is what a guide has to beat.</p>
<p><b>Counts</b> are those of section 5. With the screen away they send more rays to the things; these get better and the
rest gets worse, as the rays must come from somewhere.</p>
<p><b>Pyramid</b> is the successor of 2000: triangles of many levels. <b>Visible</b> guides by what is seen first, and
<b>learned</b> by what earlier rays have found: what is hidden attracts none of theirs.</p>
<p>Now look at the size of it all. Between the best and the worst bar there is far less than between shooting and stored
transport (chapter 7). So the idea is sound and its gain is small. Ask why: a guide moves rays between directions, but the
noise of shooting comes from all bounces.</p>`,
  source: {
    section: "7", sentence: "This technique could possibly fail in some situations where a wall is in front of a large number of surfaces.",
    pages: ["src/radiosity/research/guides", "src/radiosity/engine/methods/stratified.cpp"],
    measured: "docs/measured/results-methods.md",
  },
  state: { wall: true, things: 4, steps: 4, runs: 3, eye: "-0.35,0.3" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "A crowd of things, perhaps behind a screen", title: "The room", ratio: 1.25 });
    const bars = f.view(figures.View, { label: "Errors of guides", title: "Error: all above, the things below", ratio: 1.25, kind: "chart" });
    f.toggle("wall", "A screen before the crowd");
    f.slider("things", "Things in a row", 2, 5, 1);
    f.slider("steps", "Steps", 2, 8, 1);
    f.slider("runs", "Runs in the mean", 1, 6, 1);
    const guides = { none: ["stratified", ""], counts: ["hemisphere", ""], pyramid: ["hemisphere", "--guide pyramid"], visible: ["hemisphere", "--guide visible"], learned: ["hemisphere", "--guide learned"] };
    let built = "", room, thing, reference;
    f.change = () => {
      const { wall, things, steps, runs } = f.state;
      if (built !== [wall, things].join()) {
        f.rooms?.forEach((old) => old.delete());
        f.rooms = [];
        room = f.room(rooms.crowd({ things, wall: wall ? 1 : 0 }));
        thing = room.scene.materials.findIndex(({ name }) => name === "thing");
        const exact = room.run("stored-transport", { rays: 1024, seed: 99 });
        reference = exact.step().light;
        exact.delete();
        built = [wall, things].join();
      }
      view.room = room;
      view.colour = figures.lit(reference, figures.exposure(room, reference, 0.97));
      const errorOf = (light, chosen) => {
        let off = 0, whole = 0;
        for (const patch of room.patches.filter(chosen)) for (let c = 0; c < 3; ++c) {
          const at = 3 * patch.index + c;
          off += patch.area * (light[at] - reference[at]) ** 2;
          whole += patch.area * (reference[at] - patch.emission[c]) ** 2;
        }
        return off / whole;
      };
      const results = Object.entries(guides).map(([name, [method, own]]) => {
        let all = 0, detail = 0, rays = 0, light;
        for (let seed = 1; seed <= runs; ++seed) {
          const run = room.run(method, { rays: 32, own, seed });
          for (let step = 0; step < steps; ++step) run.step();
          light = run.light;
          all += errorOf(light, () => true) / runs;
          detail += errorOf(light, ({ material }) => material === thing) / runs;
          rays += run.figures.rays / runs;
          run.delete();
        }
        return { name, all: Math.sqrt(all), detail: Math.sqrt(detail), rays };
      });
      const most = Math.max(...results.flatMap(({ all, detail }) => [all, detail]));
      bars.draw = () => {
        bars.begin();
        const row = (bars.height - 20) / results.length, left = 74, wide = bars.width - left - 66;
        results.forEach(({ name, all, detail }, k) => {
          const y = 10 + k * row;
          bars.text(name, left - 8, y + row / 2, { align: "right", base: "middle" });
          [[all, figures.ink("ray"), 0.14], [detail, figures.ink("mark"), 0.52]].forEach(([value, colour, at]) => {
            bars.pen.fillStyle = colour;
            bars.pen.fillRect(left, y + at * row, wide * value / most, row * 0.32);
            bars.text(figures.percent(value), left + wide * value / most + 6, y + (at + 0.16) * row, { base: "middle", colour: figures.ink("soft") });
          });
        });
      };
      f.values = { results };
      const by = (key) => [...results].sort((a, b) => a[key] - b[key])[0].name;
      f.say(`With about ${figures.format(Math.round(results[0].rays / 1000))} thousand rays each, ${by("all")} has the smallest error of all surfaces, ${by("detail")} that of the things.`);
      f.table(["Guide", "Error, all", "Error, things", "Rays"], results.map(({ name, all, detail, rays }) => [name, figures.percent(all), figures.percent(detail), figures.format(Math.round(rays))]));
    };
  },
  exercises: [
    { ask: "Which guide sends most of its rays to a screen because of what stands behind it?", choices: ["counts", "visible", "none"], answer: "counts" },
    { ask: "Why may the rest of the room get worse when the things get better?", choices: ["rays are moved, not added", "the things reflect more", "the counts are wrong"], answer: "rays are moved, not added" },
    { ask: "A triangle gets twice the rays that its power would give it. By what is the noise of its light divided (two digits)?", answer: 1.41, within: 0.01, hint: "The square root." },
  ],
});
