lesson.chapter({
  number: 9,
  title: "Stored transport",
  summary: "Keep the rays, use them both ways, and solve.",
  text: `
<p>Shooting throws its rays away. Each brings some power to a patch and is forgotten; the next bounce, and the next step,
trace new ones. But what did a ray find out? That patch <var>i</var> sees patch <var>j</var>. This does not depend on the
light at all.</p>
<p>So keep it. Each patch looks around once. The counts <var>c<sub>ij</sub></var> of its rays estimate form factors, and
since <var>A<sub>i</sub>F<sub>ij</sub></var> = <var>A<sub>j</sub>F<sub>ji</sub></var>, the counts of both sides estimate
one number:
<span class="formula"><var>A<sub>i</sub>F<sub>ij</sub></var> ≈ (<var>c<sub>ij</sub></var> + <var>c<sub>ji</sub></var>) / (<var>N</var>/<var>A<sub>i</sub></var> + <var>N</var>/<var>A<sub>j</sub></var>)</span>
Then solve the linear system of chapter 2: all bounces at once, without one more ray. What is traced once serves every
bounce. Rows are scaled to sum to 1, so no energy is made or lost. The engine adds shadow rays to the lamp and points that
are spread evenly.</p>
<p>The matrix is what <b>both</b> ways give from few rays; beside it are the rays of the chosen patch. The chart compares
with shooting: read off, at the same error, how many times the rays. Turn the reflectance up: the same rays
serve all the further bounces, and their error hardly grows.</p>
<p>Its weakness: all rays that are kept take memory, and each patch must have some, even in a corner that no light
reaches. Shooting sends none from there.</p>`,
  source: {
    section: "2 and 3", sentence: "Instead of keeping the whole system of equations to complete the energy exchange of the environment, a useful solution is computed.",
    pages: ["src/radiosity/engine/stored_transport/page/stored_transport.cpp", "src/radiosity/engine/methods/stored_transport.cpp"],
    measured: "docs/measured/results-methods.md",
  },
  state: { rays: 64, reflectance: 0.6, patch: 100, eye: "0.12,0.1" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "The room by stored transport, with rays of a patch", title: "The room, and what one patch keeps" });
    const matrix = f.view(figures.MatrixView, { label: "Counts of rays between all pairs", title: "Counts, both ways" });
    const chart = f.view(figures.ChartView, { label: "Error against rays: stored transport and shooting", title: "Error against rays", x: "rays", ratio: 2.6, wide: true, formY: figures.percent });
    view.ratio = 1;
    f.slider("rays", "Rays a patch", 8, 512, 8);
    f.slider("reflectance", "Reflectance", 0.1, 0.85, 0.05);
    view.onPick = (patch) => { if (patch >= 0) f.set({ patch }); };
    let built = "", room, reference, curves, hits;
    f.change = () => {
      const { rays, reflectance } = f.state;
      if (built !== String(reflectance)) {
        f.rooms?.forEach((old) => old.delete());
        f.rooms = [];
        room = f.room(rooms.boxes({ n: 6, reflectance }));
        view.room = room;
        const exact = room.run("stored-transport", { rays: 1024, seed: 99 });
        reference = exact.step().light;
        exact.delete();
        const curve = (method, list) => list.map(([n, steps]) => {
          const run = room.run(method, { rays: n });
          for (let step = 0; step < steps; ++step) run.step();
          const point = [run.figures.rays, room.error(run.light, reference)];
          run.delete();
          return point;
        });
        curves = { stored: curve("stored-transport", [[8, 1], [16, 1], [32, 1], [64, 1], [128, 1], [256, 1]]), shooting: curve("progressive-monte-carlo", [[8, 1], [16, 2], [32, 4], [64, 8], [64, 16]]) };
        hits = null;
        built = String(reflectance);
      }
      const n = room.patches.length, patch = Math.min(f.state.patch, n - 1);
      if (hits?.rays !== rays) {
        hits = { rays, from: room.patches.map(({ index }) => room.raysFrom(index, rays)) };
        hits.counts = new Float64Array(n * n);
        hits.from.forEach((list, i) => list.forEach(({ patch: j }) => { if (j >= 0) ++hits.counts[i * n + j]; }));
      }
      const run = room.run("stored-transport", { rays });
      const light = run.step().light, error = room.error(light, reference), { rays: traced } = run.figures;
      run.delete();
      matrix.values = hits.counts.map((_, k) => {
        const i = Math.floor(k / n), j = k % n, [a, b] = [room.patches[i].area, room.patches[j].area];
        return (hits.counts[i * n + j] + hits.counts[j * n + i]) / (rays / a + rays / b) / a;
      });
      matrix.rows = [patch];
      view.colour = figures.lit(light, figures.exposure(room, reference, 0.95));
      view.chosen = [patch];
      view.rays = hits.from[patch].slice(0, 200).map(({ from, to }) => ({ from, to, end: true, width: 0.7, colour: "rgba(255,200,110,.8)" }));
      // Rays that shooting needs for the same error, along its slope.
      const [lastRays, lastError] = curves.shooting.at(-1), needs = lastRays * (lastError / error) ** 2;
      chart.series = [{ name: "stored transport", points: curves.stored, colour: figures.ink("ray") }, { name: "Monte Carlo progressive", points: curves.shooting },
        { name: "now", points: [[traced, error]], colour: figures.ink("good") }];
      f.values = { error, traced, ratio: needs / traced, light: [...light], curves };
      f.say(`${figures.format(traced)} rays give an error of ${figures.percent(error)}. Shooting would need about ${figures.format(Math.round(needs / traced))} times as many.`);
      f.table(["Method", "Rays", "Error"], [...curves.stored.map(([x, y]) => ["stored transport", figures.format(x), figures.percent(y)]), ...curves.shooting.map(([x, y]) => ["Monte Carlo progressive", figures.format(x), figures.percent(y)])]);
    };
  },
  exercises: [
    { ask: "Patches of area 1 and 4 with 100 rays each: the small one hits the large one 20 times, the large one the small one 4 times. What is A F by both (two digits)?", answer: 0.192, within: 0.01, hint: "24 / (100/1 + 100/4)." },
    { ask: "Shooting has 30 times the rays of stored transport at 1 % error. At 0.5 %, if both have slope −1/2?", answer: 30, within: 0.001, because: "Both need four times as many." },
    { ask: "What does a ray of stored transport keep?", choices: ["the power that it brings", "which patch it hit", "its colour"], answer: "which patch it hit" },
  ],
});
