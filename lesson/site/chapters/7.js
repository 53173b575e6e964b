lesson.chapter({
  number: 7,
  title: "Error against time",
  summary: "All methods race in one room; which has a useful picture first?",
  timed: true,
  text: `
<p>Which method is best? Ask for the error, and for the time. Here all methods solve the same room, by turns, a step at a
time, on this device. Each point of the chart is a picture: the time that the method has had, and how far the picture is
from a reference of many more rays. Both axes are logarithmic.</p>
<p>Methods that shoot random rays fall along the dashed line of slope −1/2: four times the time halves the error. No such
method escapes from that line; a better one only runs lower. The line of the <i>hemisphere</i> begins later than that of
<i>Monte Carlo progressive</i>, as its counts take time before the first step.</p>
<p>The curve that is far below is <b>stored transport</b>: it keeps its rays and solves for all bounces (chapter 9).
<b>Progressive</b> hardly falls at first and then bends down, when the light is shot.</p>
<p>The paper stops when the image is <i>useful</i>. What is useful is yours to say: set the threshold. The sentence names
the method that gets there first. Then change the room: finer patches, a crowd of things.</p>
<p>One caution. Times differ from run to run and from device to device; numbers of rays do not. The table has both. And a
method that wins in one room may lose in the next.</p>`,
  source: {
    section: "3", sentence: "The purpose of radiosity improvement techniques is to obtain as fast as possible a useful image.",
    pages: ["src/radiosity/engine/methods", "docs/measured/results-paper.md"],
  },
  state: { useful: 5, room: "boxes", seconds: 1, seed: 1, eye: "0.12,0.1" },
  figure(f) {
    const chart = f.view(figures.ChartView, { label: "Error of all methods against time", title: "Error against seconds of each method", x: "seconds", ratio: 1.7, wide: true, formY: figures.percent });
    const view = f.view(figures.RoomView, { label: "The room by stored transport", title: "By stored transport", ratio: 1.5 });
    const mean = f.view(figures.RoomView, { label: "The room by the method of section 5", title: "Section 5 at the same time", ratio: 1.5 });
    f.slider("useful", "Useful at", 0.5, 20, 0.5, (share) => `${share} %`);
    f.slider("seconds", "Seconds each", 0.25, 3, 0.25);
    f.choice("room", "Room", { boxes: "two boxes, 256 patches", fine: "two boxes, 1024 patches", crowd: "a crowd, 185 patches" });
    f.slider("seed", "Seed", 1, 20, 1);
    f.button("Race again", () => { f.raced = null; f.update(); }, "g");
    const colours = { "stored-transport": "#d9720b", hemisphere: "#0b6bcb", stratified: "#4c9a2a", "progressive-monte-carlo": "#8e44ad", "monte-carlo": "#c0392b", "hemisphere-1997": "#16a0a0", progressive: "#7f6a3f", matrix: "#d3567f" };
    // Two keep their rays and double them in each step.
    const maxSteps = (method) => ({ "stored-transport": 7, matrix: 4 })[method] ?? 24 * f.state.seconds;
    f.change = () => {
      const { useful, seconds, seed } = f.state, key = [f.state.room, seconds, seed].join();
      const first = (runs) => runs.map((run) => ({ run, at: run.points.find(([, error]) => error <= useful / 100) })).filter(({ at }) => at).sort((a, b) => a.at[0] - b.at[0])[0];
      const report = () => {
        const runs = f.runs, winner = first(runs);
        chart.series = runs.map(({ method, points }) => ({ name: method, points: points.map(([x, y]) => [x, y]), colour: colours[method] }));
        const shooter = runs.find(({ method }) => method === "progressive-monte-carlo").points;
        if (shooter.length > 1) chart.series.push({ name: "", dots: false, dash: [6, 5], width: 1, colour: figures.ink("soft"), points: [shooter[0], [10, shooter[0][1] * Math.sqrt(shooter[0][0] / 10)]] });
        chart.range = [[0.001, 10], [0.002, 1]];
        chart.after = (it, place) => it.line([place([0.001, useful / 100]), place([10, useful / 100])], { colour: figures.ink("good"), width: 1.5, dash: [2, 4] });
        f.values = { errors: Object.fromEntries(runs.map(({ method, points }) => [method, points.map(([, error]) => error)])), rays: Object.fromEntries(runs.map(({ method, points }) => [method, points.map(([,, rays]) => rays)])), first: winner?.run.method };
        f.say(winner ? `The first picture within ${useful} % is by ${winner.run.method}, after ${winner.at[0].toFixed(3)} s and ${figures.format(winner.at[2])} rays.` : `No method has a picture within ${useful} % yet.`);
        f.table(["Method", "Pictures", "Seconds", "Rays", "Error", `${useful} % after [s]`], runs.map(({ method, points }) => {
          const last = points.at(-1), at = points.find(([, error]) => error <= useful / 100);
          return last ? [method, points.length, last[0].toFixed(2), figures.format(last[2]), figures.percent(last[1]), at ? at[0].toFixed(3) : "–"] : [method, 0, "", "", "", ""];
        }));
      };
      if (f.raced === key) return report();
      f.stop();
      f.runs?.forEach(({ solver }) => solver?.delete());
      f.rooms?.forEach((old) => old.delete());
      f.rooms = [];
      const scene = f.state.room === "crowd" ? rooms.crowd({ things: 4 }) : rooms.boxes({ n: f.state.room === "fine" ? 12 : 6 });
      const room = f.room(scene), exact = room.run("stored-transport", { rays: 1024, seed: 99 }), reference = exact.step().light;
      exact.delete();
      view.room = mean.room = room;
      const factor = figures.exposure(room, reference, 0.95);
      view.colour = mean.colour = () => [0, 0, 0];
      f.raced = key;
      f.runs = Object.keys(colours).map((method) => ({ method, points: [], time: 0, solver: null, steps: 0 }));
      f.isBusy = true;
      const take = (run) => {
        const begin = performance.now();
        run.solver ??= room.run(run.method, { rays: { "stored-transport": 16, matrix: 8 }[run.method] ?? 32, seed });
        run.solver.step();
        run.time += Math.max((performance.now() - begin) / 1000, 1e-4);
        ++run.steps;
        const light = run.solver.light;
        run.points.push([run.time, room.error(light, reference), run.solver.figures.rays + run.solver.figures.densityRays]);
        if (run.method === "stored-transport") view.colour = figures.lit(light, factor);
        if (run.method === "hemisphere") mean.colour = figures.lit(light, factor);
      };
      f.repeat(() => {
        const next = f.runs.filter((run) => run.time < seconds && run.steps < maxSteps(run.method) && !run.solver?.finished).sort((a, b) => a.time - b.time)[0];
        if (next) take(next);
        f.isBusy = Boolean(next);
        report();
        return next;
      });
    };
  },
  exercises: [
    { ask: "A shooting method has an error of 8 % after 1 s. After how many seconds has it 2 %?", answer: 16, within: 0.01, hint: "The slope is −1/2." },
    { ask: "Which method is first at 5 % in the room with two boxes?", choices: ["hemisphere", "monte-carlo", "stored-transport"], answer: "stored-transport", hint: "Set the threshold and read the sentence." },
    { ask: "One method runs at half the error of another, both with slope −1/2. How many times sooner is it at a given error?", answer: 4, within: 0.001 },
  ],
});
