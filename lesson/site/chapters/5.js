lesson.chapter({
  number: 5,
  title: "From counts to rays",
  summary: "N_tr, Φ_tr and Φ_ray of a patch, in numbers that add up.",
  text: `
<p>A patch has power Φ<sub>patch</sub> to shoot and gets <var>N</var><sub>hemi</sub> rays for it. Each triangle of its
hemisphere asks two questions.</p>
<p><b>How much power goes through it?</b> The share of its area, whatever the counts say:
<span class="formula">Φ<sub>tr</sub> = Φ<sub>patch</sub> <var>A</var><sub>tr</sub> / <var>A</var><sub>hemi</sub></span></p>
<p><b>How many rays carry it?</b> More, where more surfaces are:
<span class="formula"><var>N</var><sub>tr</sub> = <var>N</var><sub>hemi</sub> (<var>A</var><sub>tr</sub> / <var>A</var><sub>hemi</sub>) (<var>D</var><sub>tr</sub> / <var>D</var><sub>average</sub>)</span></p>
<p>Then a ray carries Φ<sub>ray</sub> = Φ<sub>tr</sub> / <var>N</var><sub>tr</sub>: many weak rays into the crowd, few
strong ones to the bare wall. The power is not changed by the counts. Only its grain is: fine where there is much to
light. This is importance sampling, and right on average whatever is counted.</p>
<p>All must add up. The shares of area sum to 1. The numbers of rays sum to <var>N</var><sub>hemi</sub> if
<var>D</var><sub>average</sub> is weighted by area too. A number such as 0.3 rays is rounded up in three patches or steps of
ten, and the ray that is shot then carries the power of those that are not. The print rounds it to 0, and the power is
lost.</p>
<p>The dots are rays. Choose a triangle and follow its row in the table. Then choose the rules <i>as printed</i>: areas on
the sphere in place of their projection. Watch the power at the rim, and go on to the next chapter.</p>`,
  source: {
    section: "5b", sentence: "A number of rays proportional to the average value of its density are shot in each spherical triangle of the hemisphere.",
    pages: ["src/radiosity/paper/pages/section_5_hemisphere.cpp"],
  },
  state: { patch: 18, triangle: 0, rays: 64, rules: "corrected", threshold: 0, eye: "-0.35,0.3" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "The room and rays of a patch", title: "The room: click a patch", ratio: 1 });
    const disc = f.view(figures.DiscView, { label: "Rays in the triangles of the patch", title: "Rays in each triangle: click one" });
    f.slider("rays", "N_hemi", 16, 512, 16);
    f.slider("threshold", "Threshold", 0, 8, 0.5);
    f.choice("rules", "Rules", { corrected: "corrected", printed: "as printed" });
    const room = f.room(rooms.crowd({ things: 4 })), n = room.patches.length, depth = 2, table = hemilux.hemisphere(depth);
    view.room = room;
    view.colour = (patch) => patch.emission[0] ? [1, 1, 0.9] : patch.reflectance.map((x) => x * (0.45 + 0.25 * Math.abs(patch.normal[1]) + 0.1 * patch.normal[0]));
    view.onPick = (patch) => { if (patch >= 0) f.set({ patch, triangle: 0 }); };
    disc.onPick = (triangle) => f.set({ triangle });
    f.change = () => {
      const { rays, rules, threshold } = f.state, patch = Math.min(f.state.patch, n - 1), printed = rules === "printed";
      const leaves = hemilux.leaves(table, room.counts(patch, depth), threshold);
      const shares = hemilux.shares(leaves, { sphere: printed, zero: printed }), { average } = shares;
      const rows = shares.map(({ cell, area, density, rays: share, power }) =>
        ({ cell: table.cells[cell], A: area, D: density, exact: rays * share, N: printed ? Math.round(rays * share) : rays * share, power }));
      // Whole numbers of rays: grid points on the line of all triangles, or rounded.
      let line = 0.5;
      const whole = rows.map(({ exact }) => { const before = Math.floor(line); line += exact; return Math.floor(line) - before; });
      const counts = printed ? rows.map(({ N }) => N) : whole;
      const chosen = Math.min(f.state.triangle, rows.length - 1), row = rows[chosen];
      const weight = rows.map(({ power, exact, N }) => printed ? (N ? power / N : 0) : power / exact);
      const strongest = Math.max(...weight);
      disc.triangles = rows.map(({ cell }, k) => ({ corners: cell.vertex.map((v) => table.vertices[v]), fill: figures.heat(0.15 + 0.75 * weight[k] / strongest), chosen: k === chosen }));
      disc.dots = rows.flatMap(({ cell }, k) => table.raysIn(cell.index, counts[k]).map((at) => ({ at, colour: "#fff" })));
      const axes = room.axes(patch), centre = room.patches[patch].centre;
      const world = (d) => figures.add(centre, [0, 1, 2].map((k) => d[0] * axes[0][k] + d[1] * axes[1][k] + d[2] * axes[2][k]));
      view.rays = rows.flatMap(({ cell }, k) => table.raysIn(cell.index, counts[k]).map((d) => ({ from: centre, to: world(d), width: k === chosen ? 2 : 0.6, colour: k === chosen ? figures.ink("mark") : figures.ink("ray") })));
      view.chosen = [patch];
      const total = counts.reduce((a, b) => a + b, 0), lost = printed ? rows.reduce((sum, { power, N }) => sum + (N ? 0 : power), 0) : 0;
      f.values = { patch, average, rows: rows.map(({ cell, A, D, exact, N, power }) => ({ cell: cell.index, A, D, exact, N, power })), total, lost, rules };
      f.say(`D_average is ${figures.format(average)}. Triangle ${row.cell.index} gets N_tr = ${figures.format(row.N)} rays and ${figures.percent(row.power)} of the power; ${row.N ? `each ray carries ${figures.percent(weight[chosen])}` : "no ray carries it"}. All triangles: ${total} rays${printed ? `, and ${figures.percent(lost)} of the power is lost` : ""}.`);
      f.table(["Triangle", "A_tr/A_hemi", "D_tr", "N_tr", "Φ_tr/Φ_patch", "Φ_ray/Φ_patch"], [
        ...rows.map(({ cell, A, D, N, power }, k) => [cell.index, A, D, N, power, weight[k]]),
        ["sum", rows.reduce((s, { A }) => s + A, 0), "", rows.reduce((s, { N }) => s + N, 0), rows.reduce((s, { power }) => s + power, 0), ""]]);
    };
  },
  exercises: [
    { ask: "A hemisphere is its four octants with densities 1, 1, 1 and 5, and N_hemi = 64. How many rays does the fourth get?", answer: 40, within: 0.001, hint: "D_average is 2." },
    { ask: "Which share of Φ_patch does one ray of the fourth octant carry, as 1/x? Give x.", answer: 160, within: 0.001, because: "A quarter of the power, on 40 rays." },
    { ask: "With densities 0, 1, 1 and 2, which share of the power is lost by the printed rule, in per cent?", answer: 25, within: 0.001, hint: "N_tr of the first octant is 0." },
  ],
});
