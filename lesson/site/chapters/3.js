lesson.chapter({
  number: 3,
  title: "Shooting",
  summary: "One patch at a time, by form factors or by rays; then steps.",
  text: `
<p>The matrix wants all form factors before it shows anything. Shooting turns this round: let the patch with the most
unshot power send it to all others, show the picture, and take the next. Early pictures are dark, but light is where it
belongs.</p>
<p><b>Progressive radiosity</b> computes a column of form factors for each shot. The lamp shoots first, then what it has
lit.</p>
<p><b>Monte Carlo radiosity</b> leaves form factors out. A shot is a bundle of rays with equal power, from random points,
by the cosine law. A patch receives what its rays bring: their number stands for the factor. This is simpler, and noisy.
A picture comes when a patch has shot all of its energy.</p>
<p><b>Monte Carlo progressive radiosity</b> adds a loop. A step is a whole solution with few rays, all bounces included.
Then comes another, with other rays. The result is the mean of the steps, so the first picture is early, complete and
coarse, and the noise falls as one over the square root of the steps.</p>
<p>Shoot. The rays of the last shot fly; the chart has the error of each picture against the full matrix. For the first two
methods it falls as light is shot. For the third it starts low: each step has all the light there is.</p>`,
  source: {
    section: "3.1 to 3.3", sentence: "At each step, the energy of a reduced number of additional rays is shot from each patch of the scene.",
    pages: ["src/radiosity/paper/pages/section_3_1_progressive.cpp", "src/radiosity/paper/pages/section_3_2_monte_carlo.cpp", "src/radiosity/paper/pages/section_3_3_progressive_monte_carlo.cpp"],
  },
  state: { method: "progressive-monte-carlo", steps: 4, reflectance: 0.6, rays: 64, eye: "0.12,0.1" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "A room with two boxes, lit by shooting", title: "The picture after the last shot" });
    const chart = f.view(figures.ChartView, { label: "Error of each picture", title: "Error against rays", x: "rays", ratio: 1.25, formY: (y) => figures.percent(y) });
    f.choice("method", "Method", { progressive: "3.1 progressive", "monte-carlo": "3.2 Monte Carlo", "progressive-monte-carlo": "3.3 Monte Carlo progressive" });
    f.button("Shoot", () => f.set({ steps: f.state.steps + 1 }), "s");
    f.button("Again from 0", () => f.set({ steps: 0 }), "0");
    f.slider("steps", "Shots or steps", 0, 60, 1);
    f.slider("reflectance", "Reflectance", 0.1, 0.85, 0.05);
    f.slider("rays", "Rays a patch", 4, 128, 4);
    const motions = { progressive: 0.5, "monte-carlo": 0.5, "progressive-monte-carlo": 0.9 };
    let room, run, reference, built = "", series = [];
    f.change = () => {
      const { method, steps, reflectance, rays } = f.state, key = [reflectance].join();
      if (key !== built) {
        f.rooms?.forEach((old) => old.delete());
        f.rooms = [];
        room = f.room(rooms.boxes({ n: 6, reflectance }));
        view.room = room;
        const solver = room.run("stored-transport", { rays: 512 });
        reference = solver.step().light;
        solver.delete();
        built = key;
        run = null;
      }
      const kind = [method, rays, reflectance].join();
      if (!run || run.kind !== kind || run.done > steps) {
        run?.delete();
        run = room.run(method, method === "monte-carlo" ? { rays, own: "--one-shot" } : { page: true, rays });
        Object.assign(run, { kind, done: 0 });
        series = [];
      }
      const emission = Float64Array.from(room.patches.flatMap((patch) => patch.emission));
      let rest = [];
      while (run.done < steps && !run.finished) {
        room.note(run.done + 1 === steps ? 20000 : 0);
        run.step();
        ++run.done;
        const { rays: traced } = run.figures;
        series.push([traced, room.error(run.light, reference)]);
        rest = room.noted();
      }
      room.note(0);
      const light = run.done ? run.light : emission, { rays: traced, unshot, emitted } = run.figures;
      const error = room.error(light, reference);
      f.values = { light: [...light], error, rays: traced, steps: run.done, unshot: unshot / emitted, emitted };
      view.colour = figures.lit(light, figures.exposure(room, reference, 0.95));
      const every = Math.max(1, Math.floor(rest.length / 260));
      const flying = rest.filter((_, k) => k % every === 0).map(({ from, to }) => ({ from, to, width: 0.7, colour: "rgba(255,190,90,.75)" }));
      chart.series = [{ name: "error", points: series, colour: figures.ink("ray") }];
      if (series.length > 1 && method === "progressive-monte-carlo")
        chart.series.push({ name: "slope −1/2", dots: false, dash: [5, 5], points: series.map(([x]) => [x, series[0][1] * Math.sqrt(series[0][0] / x)]) });
      f.say(run.done === 0 ? "Nothing is shot yet: only the lamp shines." :
        `After ${run.done} ${method === "progressive-monte-carlo" ? (run.done === 1 ? "step" : "steps") : (run.done === 1 ? "shot" : "shots")} and ${figures.format(traced)} rays the error is ${figures.percent(error)}` +
        (method === "progressive-monte-carlo" ? "." : `; light still to be shot is ${figures.percent(unshot / emitted)} of what the lamp emits.`));
      f.table(["Rays", "Error"], series.map(([x, y]) => [figures.format(x), figures.percent(y)]));
      view.rays = [];
      if (flying.length) f.animate(motions[method], (t) => {
        view.rays = t < 1 ? flying.map((ray) => ({ ...ray, begin: Math.max(0, t * 1.4 - 0.4), share: Math.min(1, t * 1.4) })) : [];
      });
    };
  },
  exercises: [
    { ask: "Method 3.1: which patches shoot in the first four shots?", choices: ["the four of the lamp", "the floor", "the largest"], answer: "the four of the lamp", hint: "Look at the rays." },
    { ask: "Method 3.3: after 4 steps the error is e. About which multiple of e is left after 16 steps?", answer: 0.5, within: 0.1, hint: "One over the square root." },
    { ask: "Why has 3.3 a complete picture after one step?", choices: ["its rays are better", "a step shoots all bounces", "it uses form factors"], answer: "a step shoots all bounces" },
  ],
});
