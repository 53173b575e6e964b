lesson.chapter({
  number: 4,
  title: "The hemisphere divided",
  summary: "Counts at vertices, four triangles for one, one byte each.",
  text: `
<p>Rays are dear. The paper's idea: look once before you shoot, and then send more rays where more is to be met.</p>
<p>Over the centre of each patch stands a hemisphere of four spherical triangles. A ray through each vertex counts all
surfaces on its way, also what stands behind something else. It carries no energy: <i>density rays are not energy
rays</i>. The mean of the three counts is the density of the triangle. Where it is above a threshold, the triangle is
divided into four at the midpoints of its edges, to depth 2.</p>
<p>In the picture a direction stands where it falls on the patch's plane, seen from above. So areas of the disc are shares
of the light that the patch sends. The numbers are the counts, the colour is the density. See how unequal the "equal"
triangles are: those at the rim are narrow.</p>
<p>A full tree has 84 triangles but only 41 different vertices, and a count fits in one byte. So a patch takes 41 bytes at
most, and a higher threshold takes fewer. The technique of <b>1997</b> moves the new points towards the end where more
surfaces were counted. Its directions differ for each patch and must be stored, with four hemispheres a patch: 2132
bytes. This is why the paper of 1998 asks for something smaller.</p>
<p>Choose patches on the wall, near the things and far from them.</p>`,
  source: {
    section: "4 and 5a", sentence: "If the average value of densities for a spherical triangle is higher than a threshold value, the spherical triangle is divided into four new equal spherical triangles.",
    pages: ["src/radiosity/paper/pages/section_5_hemisphere.cpp", "src/radiosity/paper/hemisphere/hemisphere.h", "src/radiosity/paper/pages/stored_subdivision.h"],
  },
  state: { patch: 18, depth: 2, threshold: 0, show: "counts", eye: "-0.35,0.3" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "A room with many small things", title: "The room: click a patch", wide: true, ratio: 2.6, eye: { zoom: 1.25 } });
    const disc = f.view(figures.DiscView, { label: "The divided hemisphere of 1998", title: "1998: midpoints" });
    const old = f.view(figures.DiscView, { label: "The divided hemisphere of 1997", title: "1997: nearer to what is there" });
    f.slider("depth", "Depth", 0, 3, 1);
    f.slider("threshold", "Threshold", 0, 8, 0.5);
    f.choice("show", "Show", { counts: "counts", none: "colours alone" });
    const room = f.room(rooms.crowd({ things: 4 })), n = room.patches.length;
    view.room = room;
    view.grid = true;
    view.colour = (patch) => patch.emission[0] ? [1, 1, 0.9] : patch.reflectance.map((x) => x * (0.45 + 0.25 * Math.abs(patch.normal[1]) + 0.1 * patch.normal[0]));
    view.onPick = (patch) => { if (patch >= 0) f.set({ patch }); };
    f.change = () => {
      const { depth, threshold, show } = f.state, patch = Math.min(f.state.patch, n - 1);
      const table = hemilux.hemisphere(depth), counts = room.counts(patch, depth);
      const leaves = hemilux.leaves(table, counts, threshold);
      const vertices = [...new Set(leaves.flatMap(({ cell }) => cell.vertex))].sort((a, b) => a - b);
      const parents = new Set(), note = (cell) => { parents.add(cell.index); };
      table.cells.forEach((cell) => { if (leaves.some((leaf) => leaf.cell === cell)) note(cell); });
      const densest = Math.max(...leaves.map(({ density }) => density), 1);
      disc.triangles = leaves.map(({ cell, density }) => ({ corners: cell.vertex.map((v) => table.vertices[v]), fill: figures.heat(density / densest) }));
      disc.labels = show === "counts" && depth < 3 ? vertices.map((v) => ({ at: figures.scale(table.vertices[v], 0.97), text: String(counts[v]) })) : [];
      const triangles = room.hemisphere1997(patch, depth, 0);
      const means = triangles.map((corners) => corners.reduce((sum, { count }) => sum + count / 3, 0));
      old.triangles = triangles.map((corners, k) => ({ corners: corners.map(({ direction }) => direction), fill: figures.heat(means[k] / densest) }));
      const directions = new Map(triangles.flat().map((corner) => [corner.direction.join(), corner]));
      old.labels = show === "counts" && depth < 3 ? [...directions.values()].map(({ direction, count }) => ({ at: figures.scale(direction, 0.97), text: String(count) })) : [];
      const axes = room.axes(patch), centre = room.patches[patch].centre;
      const world = (d) => figures.add(centre, [0, 1, 2].map((k) => 0.55 * (d[0] * axes[0][k] + d[1] * axes[1][k] + d[2] * axes[2][k])));
      view.rays = vertices.map((v) => ({ from: centre, to: world(table.vertices[v]), width: 1.2, end: true }));
      view.chosen = [patch];
      f.values = { patch, counts: [...counts], triangles: leaves.length, vertices: vertices.length, densities: leaves.map(({ cell, density }) => [cell.index, density]) };
      f.say(`Patch ${patch}: ${leaves.length} triangles are left undivided, with ${vertices.length} vertices, so its store takes ${vertices.length} bytes. In 1997 it would take ${4 * directions.size * 13} bytes.`);
      f.table(["Triangle", "Level", "Counts", "Density", "Solid angle [sr]", "Share of power"], leaves.map(({ cell, density }) =>
        [cell.index, cell.level, cell.vertex.map((v) => counts[v]).join(", "), density, cell.solidAngle, cell.projected / Math.PI]));
    };
  },
  exercises: [
    { ask: "At depth 2 with threshold 0, how many triangles of the last level has a fully divided hemisphere?", answer: 64, within: 0.001, hint: "4 octants, each divided twice." },
    { ask: "And how many different vertices?", answer: 41, within: 0.001, hint: "Read the sentence below the figure for a patch that is fully divided." },
    { ask: "How many bytes do 100 000 patches take at one byte for each vertex, in millions?", answer: 4.1, within: 0.005, because: "The paper says 6.4 million: it counts the 64 leaves." },
  ],
});
