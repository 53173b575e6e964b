lesson.chapter({
  number: 2,
  title: "The balance",
  summary: "B = E + ρ F B: a room, its matrix, its bounces.",
  text: `
<p>Cut a room into patches. The light that leaves a patch, its <b>radiosity</b> <var>B<sub>i</sub></var> in W/m², is what
it emits and what it reflects of the light that arrives from all others:
<span class="formula"><var>B<sub>i</sub></var> = <var>E<sub>i</sub></var> + <var>ρ<sub>i</sub></var> Σ<sub>j</sub> <var>F<sub>ij</sub></var> <var>B<sub>j</sub></var></span>
One equation for each patch: a linear system. The picture beside the room is its matrix <var>F</var>. A row is what one
patch sees; in a closed room it sums to 1, as all light arrives somewhere. A patch does not see itself, nor others in its
own plane: these squares are dark.</p>
<p>How is it solved? Let the light fly. After 0 bounces only the lamp shines. One bounce lights what the lamp sees. Each
further bounce multiplies by <var>ρF</var> once more, so it brings at most <var>ρ</var> times as much as the one before. The
sum is a geometric series, and its limit solves the system.</p>
<p>Click a patch, or its row. With <i>Form factors</i> the room shows how much of the patch's light goes where. Look at
the ceiling: its first light comes with the second bounce, and before that it is black. All of its light was on another surface
before.</p>
<p>The lamp only scales: twice the lamp, twice the light everywhere. The reflectance does more. At 0.5 six bounces
are enough for one per cent; at 0.9 you need many more.</p>`,
  source: {
    section: "2", sentence: "The relationship between the radiosity of a given patch and the remainder is given by the following formula.",
    pages: ["src/radiosity/paper/pages/section_2_matrix.cpp"],
  },
  state: { bounces: 1, reflectance: 0.5, lamp: 1, room: "29", show: "light", patch: 12, eye: "0.22,0.12" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "A room of patches", title: "The room: click a patch", ratio: 1 });
    const matrix = f.view(figures.MatrixView, { label: "The matrix of form factors", title: "F: row i, what patch i sees" });
    view.grid = true;
    view.onPick = matrix.onPick = (patch) => { if (patch >= 0) f.set({ patch }); };
    f.slider("bounces", "Bounces", 0, 13, 1, (k) => k === 13 ? "all" : k);
    f.slider("reflectance", "Reflectance", 0, 0.95, 0.05);
    f.slider("lamp", "Lamp", 0, 2, 0.1);
    f.choice("room", "Room", { 14: "14 patches", 29: "29 patches", 34: "34, with a block" });
    f.choice("show", "Show", { light: "light", factors: "form factors from the patch" });
    f.button("Next bounce", () => f.set({ bounces: (f.state.bounces + 1) % 14, show: "light" }), "j");
    let built = "", room, F;
    f.change = () => {
      const { bounces, reflectance, lamp, show } = f.state;
      const key = [reflectance, lamp, f.state.room].join();
      if (key !== built) {
        const shape = f.state.room;
        f.rooms?.forEach((old) => old.delete());
        f.rooms = [];
        room = f.room(rooms.small({ reflectance, lamp, n: shape === "14" ? 1 : 2, block: shape === "34" }));
        if (!built.endsWith(shape)) F = room.factors();
        built = key;
        view.room = room;
      }
      const n = room.patches.length, chosen = Math.min(f.state.patch, n - 1);
      const emission = room.patches.flatMap((patch) => patch.emission);
      // One more bounce: E + rho F B.
      const bounce = (B) => Float64Array.from(B, (_, at) => {
        const i = Math.floor(at / 3), c = at % 3;
        let arriving = 0;
        for (let j = 0; j < n; ++j) arriving += F[i * n + j] * B[3 * j + c];
        return emission[at] + room.patches[i].reflectance[c] * arriving;
      });
      let B = Float64Array.from(emission), light = B;
      for (let k = 1; k <= 600; ++k) {
        B = bounce(B);
        if (k === bounces) light = B;
      }
      if (bounces === 13) light = B;
      if (bounces === 0) light = Float64Array.from(emission);
      const missing = room.error(light, B), factors = [...F.slice(chosen * n, chosen * n + n)];
      f.values = { light: [...light], all: [...B], factors, missing, chosen, patches: n };
      const largest = Math.max(...factors, 1e-9), factor = lamp > 0 ? figures.exposure(room, B, 1) : 1;
      view.colour = show === "light" ? figures.lit(light, factor) : (patch) => figures.heat(Math.sqrt(factors[patch.index] / largest));
      view.chosen = [chosen];
      matrix.values = F;
      matrix.rows = [chosen];
      const sum = factors.reduce((a, b) => a + b, 0);
      f.say(show === "light" ? `After ${bounces === 13 ? "all bounces" : bounces === 1 ? "1 bounce" : `${bounces} bounces`} ${figures.percent(missing)} of the reflected light is missing. Patch ${chosen} has the radiosity ${figures.format(light[3 * chosen])} W/m² in red.`
        : `Of the light of patch ${chosen}, the largest share, ${figures.percent(largest)}, goes to patch ${factors.indexOf(largest)}. All shares sum to ${figures.format(sum)}.`);
      f.table(["Patch", "A [m²]", "ρ red", "E red", "B red [W/m²]", `F from ${chosen}`],
        room.patches.map(({ index, area, reflectance: rho, emission: E }) => [index, area, rho[0], E[0], light[3 * index], factors[index]]));
    };
  },
  exercises: [
    { ask: "In the room of 29 patches with reflectance 0.5: how many bounces until less than 1 % of the reflected light is missing?", answer: 6, within: 0.01, hint: "Move the slider and read the sentence." },
    { ask: "A closed room in which every patch emits 1 and reflects 0.75. What is B everywhere?", answer: 4, within: 0.001, hint: "Let B be the same everywhere: the sum of a row is 1.", because: "B = 1 + 0.75 B." },
    { ask: "Twice as many patches: how many times as many form factors?", answer: 4, within: 0.001 },
  ],
});
