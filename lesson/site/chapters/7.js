lesson.chapter({
  number: 7,
  title: "Error against time",
  summary: "All methods race in one room; which has a useful picture first?",
  timed: true,
  text: `
<p>Which method is best? Ask for the error, and for the time. Here all methods solve the same room, by turns, a step at a
time, on this device. Each point of the chart is a picture: the time that the method has had, and how far the picture is
from a reference. The reference is the mean of many runs, and has an error of its own: no curve can be trusted below that
line.</p>
<p>The race is run again with other random numbers. Points become means of the runs, and each gets a <b>bar</b>: plus and
minus its standard error.</p>
<p>Methods that shoot random rays fall along the dashed line of slope −1/2: four times the time halves the error. No such
method escapes from that line; a better one only runs lower.</p>
<p>The curve that is far below is <b>stored transport</b>, the default of hemilux: it keeps its rays and solves for all
bounces (chapter 9). <b>Progressive</b> hardly falls at first and then bends down, when the light is shot.</p>
<p>The paper stops when the image is <i>useful</i>. What is useful is yours to say: set the threshold. The sentence names
the method that gets there first. Then change the room: the last one has the 1002 patches of the paper's figure 7.</p>
<p>One caution. Times differ from device to device; numbers of rays do not. The table has both. And a method that wins in
one room may lose in the next.</p>`,
  source: {
    section: "3", sentence: "The purpose of radiosity improvement techniques is to obtain as fast as possible a useful image.",
    pages: ["src/radiosity/engine/methods", "docs/measured/results-paper.md"],
    measured: "docs/measured/results-methods.md",
  },
  state: { useful: 5, room: "boxes", seconds: 1, runs: 3, seed: 1, eye: "0.12,0.1" },
  quick: { runs: 1, seconds: 0.25 },
  figure(f) {
    const chart = f.view(figures.ChartView, { label: "Error of all methods against time", title: "Error against seconds of each method", x: "seconds", ratio: 1.7, wide: true, formY: figures.percent });
    const view = f.view(figures.RoomView, { label: "The room by stored transport", title: "By stored transport", ratio: 1.5 });
    const section5 = f.view(figures.RoomView, { label: "The room by the method of section 5", title: "Section 5 at the same time", ratio: 1.5 });
    chart.range = [[0.001, 10], [0.001, 1]];
    f.slider("useful", "Useful at", 0.5, 20, 0.5, (share) => `${share} %`);
    f.slider("seconds", "Seconds each", 0.25, 3, 0.25);
    f.slider("runs", "Runs", 1, 5, 1);
    f.choice("room", "Room", { boxes: "two boxes, 256 patches", crowd: "a crowd, 185 patches", fine: "two boxes, 1024 patches", room_1002: "the paper's, 1002 patches" });
    f.slider("seed", "Seed", 1, 20, 1);
    f.button("Race again", () => { f.raced = null; f.update(); }, "g");
    const colours = { "stored-transport": "#d9720b", hemisphere: "#0b6bcb", stratified: "#4c9a2a", "progressive-monte-carlo": "#8e44ad", "monte-carlo": "#c0392b", "hemisphere-1997": "#16a0a0", progressive: "#7f6a3f", matrix: "#d3567f" };
    const scenes = { boxes: () => rooms.boxes({ n: 6 }), fine: () => rooms.boxes({ n: 12 }), crowd: () => rooms.crowd({ things: 4 }), room_1002: () => rooms.example("room_1002") };
    // The default method runs as in the program.
    const raysOf = (method) => ({ "stored-transport": 64, matrix: 8 })[method] ?? 32;
    // Two keep their rays and double them in each step.
    const maxSteps = (method) => ({ "stored-transport": 7, matrix: 4 })[method] ?? 24 * f.state.seconds;
    const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

    // The reference is the mean of runs, of as many as it takes until its error is less than 0.3 %.
    const reference = { light: [], runs: 0, error: Infinity };
    const improveReference = (room) => {
      const run = room.run("stored-transport", { rays: 512, steps: 1, seed: 1000 + reference.runs }).step(), light = run.light;
      reference.squares += run.figures.error ** 2;
      run.delete();
      ++reference.runs;
      reference.light = light.map((value, k) => value / reference.runs + (reference.light[k] ?? 0) * (1 - 1 / reference.runs));
      reference.error = Math.sqrt(reference.squares) / reference.runs;
    };

    // The points of a method: means over its runs of seconds, error and rays of each step, and the standard error of
    // the error, which a single run does not have.
    const pointsOf = ({ trials }) => trials[0].map((_, step) => {
      const points = trials.filter((trial) => trial.length > step).map((trial) => trial[step]), n = points.length;
      const [seconds, error, rays] = [0, 1, 2].map((k) => mean(points.map((point) => point[k])));
      return [seconds, error, rays, n > 1 ? Math.sqrt(mean(points.map((point) => (point[1] - error) ** 2)) / (n - 1)) : 0];
    });
    const report = () => {
      const share = f.state.useful / 100, methods = f.methods.map((method) => ({ ...method, points: pointsOf(method) }));
      const useful = ({ points }) => points.find(([, error]) => error <= share);
      const first = methods.filter(useful).sort((a, b) => useful(a)[0] - useful(b)[0])[0];
      chart.series = methods.map(({ name, points }) => ({ name, points: points.map(([x, y,, bar]) => [x, y, bar]), colour: colours[name] }));
      const [shot] = methods.find(({ name }) => name === "progressive-monte-carlo").points;
      if (shot) chart.series.push({ name: "slope −1/2", dots: false, dash: [6, 5], width: 1, colour: figures.ink("soft"), points: [shot, [10, shot[1] * Math.sqrt(shot[0] / 10)]].map(([x, y]) => [x, y]) });
      chart.after = (it, place) => {
        const across = (error, text, style) => {
          it.line([place([0.001, error]), place([10, error])], { width: 1.5, ...style });
          it.text(text, place([0.001, error])[0] + 6, place([0.001, error])[1] - 6, { colour: style.colour, halo: true });
        };
        across(share, `useful: ${f.state.useful} %`, { colour: figures.ink("good"), dash: [2, 4] });
        across(reference.error, "error of the reference", { colour: figures.ink("soft") });
      };
      const of = (column) => Object.fromEntries(methods.map(({ name, points }) => [name, points.map((point) => point[column])]));
      f.values = { seconds: of(0), errors: of(1), rays: of(2), bars: of(3), first: first?.name, reference: reference.error };
      f.say(first ? `The first picture within ${f.state.useful} % is by ${first.name}, after ${useful(first)[0].toFixed(3)} s and ${figures.format(Math.round(useful(first)[2]))} rays.` : `No method has a picture within ${f.state.useful} % yet.`);
      f.table(["Method", "Pictures", "Seconds", "Rays", "Error", `${f.state.useful} % after [s]`], methods.map((method) => {
        const { name, points } = method, last = points.at(-1), at = useful(method);
        return last ? [name, points.length, last[0].toFixed(2), figures.format(Math.round(last[2])), figures.percent(last[1]) + (last[3] ? ` ± ${figures.percent(last[3])}` : ""), at ? at[0].toFixed(3) : "–"] : [name, 0, "", "", "", ""];
      }));
    };

    f.onClose = () => f.methods?.forEach(({ solver }) => solver?.delete());
    f.change = () => {
      const { room: name, seconds, runs, seed } = f.state, key = [name, seconds, runs, seed].join();
      if (f.raced === key) return f.methods ? report() : undefined;
      f.stop();
      f.onClose();
      f.methods = null;
      f.raced = key;
      f.isBusy = true;
      if (f.built !== name) {
        f.rooms?.forEach((old) => old.delete());
        f.rooms = [];
        view.middle = view.radius = section5.middle = section5.radius = undefined;
        view.room = section5.room = f.room(scenes[name]());
        Object.assign(reference, { light: [], runs: 0, squares: 0, error: Infinity });
        f.built = name;
      }
      const [room] = f.rooms;
      const begin = () => {
        f.methods = Object.keys(colours).map((method) => ({ name: method, trials: [[]], time: 0, solver: null }));
        f.factor = figures.exposure(room, reference.light, 0.95);
        view.colour = section5.colour = () => [0, 0, 0];
      };
      const take = (method) => {
        const start = performance.now(), trial = method.trials.at(-1);
        method.solver ??= room.run(method.name, { rays: raysOf(method.name), seed: seed + 100 * (method.trials.length - 1) });
        method.solver.step();
        method.time += Math.max((performance.now() - start) / 1000, 1e-4);
        const { light, figures: { rays, densityRays }, finished } = method.solver;
        trial.push([method.time, room.error(light, reference.light), rays + densityRays]);
        const shown = { "stored-transport": view, hemisphere: section5 }[method.name];
        if (shown && method.trials.length === 1) shown.colour = figures.lit(light, f.factor);
        // Later runs take as many steps as the first.
        const isDone = method.trials.length > 1 ? trial.length === method.trials[0].length
          : method.time >= seconds || trial.length >= maxSteps(method.name);
        if (!isDone && !finished) return;
        method.solver.delete();
        Object.assign(method, { solver: null, time: 0, trials: [...method.trials, []] });
      };
      f.repeat(() => {
        if (reference.error > 0.003) {
          improveReference(room);
          view.colour = section5.colour = figures.lit(reference.light, figures.exposure(room, reference.light, 0.95));
          f.say(`First the reference: it is within ${figures.percent(reference.error)} by now (runs: ${reference.runs}).`);
          return true;
        }
        if (!f.methods) begin();
        const begun = performance.now();
        let next;
        do {
          const round = Math.min(...f.methods.map(({ trials }) => trials.length));
          next = round > runs ? null : f.methods.filter(({ trials }) => trials.length === round).sort((a, b) => a.time - b.time)[0];
          if (next) take(next);
        } while (next && performance.now() - begun < 50); // pictures take time, too
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
