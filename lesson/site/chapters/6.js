lesson.chapter({
  number: 6,
  title: "What is wrong in the print",
  summary: "Five rules as switches; light in the wrong place, and a balance that does not notice.",
  text: `
<p>A <b>furnace</b> finds errors. In a closed room where everything emits 1 and reflects one half, <var>B</var> = 1 +
½<var>B</var>, so <var>B</var> = 2 everywhere, whatever the shape. The room shows how far each patch is off: blue is too
dark, red too bright.</p>
<p>Switch on one rule of the print at a time.</p>
<p><b>Areas on the sphere</b> (D1). Power by solid angle and directions by the cosine break Lambert's law once triangles
are divided: too much light leaves along the surface. Corners get it. Set the depth to 0: octants are equal both ways, and
the fault is gone.</p>
<p><b>Rays from the centre</b> (D2) find the form factors of a point. Some 2 % stay here, however many rays: set 512.</p>
<p><b>Rounded numbers</b> (D4) lose the power of every triangle that is due less than half a ray. Fewer rays lose
more.</p>
<p><b>Density 0 gets no ray</b> (D5). In a closed room nothing counts 0. Take the ceiling away: the power towards the sky
is then not shot at all.</p>
<p>Now read the sentence. The <i>balance</i> compares what is emitted with what is absorbed and what escapes. It does not
notice D1 and D2: all power arrives, in the wrong place. The <i>estimated</i> error is the spread of the steps: more rays make it
small, and the true error stays. Only a scene whose answer is known finds the fault.</p>`,
  source: {
    section: "5b", sentence: "The amount of energy distributed by each ray shot to a given spherical triangle is … proportional to the area of the spherical triangle and inversely proportional to the number of rays shot in the triangle.",
    pages: ["src/radiosity/paper/pages/section_5_hemisphere.cpp", "docs/paper/decisions.md"],
  },
  state: { sphere: true, centre: false, rounded: false, zero: false, room: "furnace", depth: 2, rays: 64, eye: "0.75,0.55" },
  needs: { zero: { room: "open" } }, // in a closed room this switch changes nothing
  figure(f) {
    const view = f.view(figures.RoomView, { label: "A room, coloured by how far each patch is off", title: "Too dark is blue, too bright is red", bright: true });
    const chart = f.view(figures.ChartView, { label: "Error after each step: true and estimated", title: "Error after each step", x: "steps", ratio: 1.25, formY: figures.percent });
    f.toggle("sphere", "D1 areas on the sphere");
    f.toggle("centre", "D2 rays from the centre");
    f.toggle("rounded", "D4 rounded numbers, for each patch");
    f.toggle("zero", "D5 density 0 gets no ray");
    f.slider("depth", "Depth (D6)", 0, 3, 1);
    f.slider("rays", "Rays a patch", 4, 512, 4);
    f.choice("room", "Room", { furnace: "furnace: B = 2", open: "furnace without its ceiling" });
    const steps = 8;
    view.grid = true;
    f.change = () => {
      const { sphere, centre, rounded, zero, depth, rays } = f.state, isOpen = f.state.room === "open";
      f.rooms?.forEach((old) => old.delete());
      f.rooms = [];
      const room = f.room(rooms.furnace(isOpen)), table = hemilux.hemisphere(depth);
      let reference = new Float64Array(3 * room.patches.length).fill(2);
      if (isOpen) {
        const solver = room.run("stored-transport", { rays: 1024 });
        reference = solver.step().light;
        solver.delete();
      }
      const leaves = room.patches.map(({ index }) => hemilux.leaves(table, room.counts(index, depth), 0));
      const run = room.runOwn((patch) => hemilux.shares(leaves[patch], { sphere, zero }), { depth, fromCentre: centre, rounded, rays });
      const points = { true: [], estimated: [] };
      for (let step = 1; step <= steps; ++step) {
        run.step();
        points.true.push([step, room.error(run.light, reference)]);
        if (step > 1) points.estimated.push([step, run.figures.error]);
      }
      const light = run.light, { emitted, absorbed, escaped, error: estimated, rays: traced } = run.figures;
      run.delete();
      const off = points.true.at(-1)[1], missing = (emitted - absorbed - escaped) / emitted;
      const share = (patch) => light[3 * patch.index] / reference[3 * patch.index] - 1;
      view.room = room;
      view.colour = (patch) => figures.difference(share(patch) / 0.4);
      chart.series = [{ name: "true", points: points.true, colour: figures.ink("ray") }, { name: "estimated", points: points.estimated, dash: [5, 4] }];
      chart.range = [[1, 10], [0.005, 1]];
      f.values = { light: [...light], off, estimated, missing, traced };
      f.say(`True error ${figures.percent(off)}, estimated ${figures.percent(estimated)}. The balance of energy misses ${figures.percent(Math.abs(missing) < 1e-9 ? 0 : missing)}. ${figures.format(traced)} rays.`);
      f.table(["Patch", "B [W/m²]", "should be", "off"], room.patches.map((patch) => [patch.index, light[3 * patch.index], reference[3 * patch.index], figures.percent(share(patch))]));
    };
  },
  exercises: [
    { ask: "In the furnace everything emits 1 and reflects 0.8 instead. What is B?", answer: 5, within: 0.001 },
    { ask: "D1 alone, furnace: what does the balance of energy miss?", choices: ["about 15 %", "next to nothing", "half of the light"], answer: "next to nothing", hint: "Read the sentence: it is chance alone." },
    { ask: "Which rule alone makes power vanish in the furnace?", choices: ["D1", "D2", "D4"], answer: "D4", hint: "Set 4 rays a patch." },
  ],
});
