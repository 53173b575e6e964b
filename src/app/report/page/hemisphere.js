// The divided hemisphere of a patch, seen from above its pole: areas are the parts of a diffuse patch's power
// (Nusselt's analog).

/** The counts of a patch at the vertices; 255: not counted. */
const countsOf = (run, i) => run.counts.subarray(i * run.vertices.length / 3, (i + 1) * run.vertices.length / 3);

/** The triangles that are not divided: { cell, corners, density }. */
function leavesOf(run, i) {
  const counts = countsOf(run, i), leaves = [];
  const visit = (cell) => {
    const [a, b, c, child] = run.cells.subarray(4 * cell, 4 * cell + 4);
    const density = (counts[a] + counts[b] + counts[c]) / 3;
    if (child && density > run.threshold) for (let k = 0; k < 4; ++k) visit(child + k);
    else leaves.push({ cell, corners: [a, b, c], density });
  };
  for (let root = 0; root < 4; ++root) visit(root);
  return leaves;
}

/** The mean density of a patch, weighted by Lambert's law [surfaces per ray]. */
const meanDensity = (run, i) =>
  leavesOf(run, i).reduce((sum, { cell, density }) => sum + run.shares[cell] * density, 0);

/** A drawing of so many pixels: triangles by density, and a dot with its count at each vertex. */
function hemisphereDrawing(run, i, size) {
  const place = ([x, y]) => [size / 2 + (size / 2 - 6) * x, size / 2 - (size / 2 - 6) * y];
  const direction = (vertex) => triple(run.vertices, vertex);
  const leaves = leavesOf(run, i), most = Math.max(1, ...leaves.map(({ density }) => density));
  const svg = svgElement("svg", { width: size, height: size, class: "hemisphere", role: "img",
    "aria-label": `The divided hemisphere: ${leaves.length} triangles, up to ${number(most, 3)} surfaces a ray` });
  for (const { cell, corners, density } of leaves) {
    const edge = (from, to) => [0, 1, 2, 3, 4, 5].map((k) => // along a great circle
      normalised(add(scale(direction(from), 1 - k / 6), scale(direction(to), k / 6))));
    const [a, b, c] = corners, outline = [...edge(a, b), ...edge(b, c), ...edge(c, a)].map(place);
    const colour = rampColour(density / most).map((x) => Math.round(255 * x));
    svg.append(svgElement("polygon", { points: outline.join(" "), fill: `rgb(${colour})` },
      svgElement("title", {}, `${number(density, 3)} surfaces a ray, ${percent(run.shares[cell])} of the power`)));
  }
  countsOf(run, i).forEach((count, vertex) => {
    if (count === 255) return;
    const [cx, cy] = place(direction(vertex));
    svg.append(svgElement("circle", { cx, cy, r: 3 }, svgElement("title", {}, `${count} surfaces`)));
  });
  return element("figure", {}, svg, element("figcaption", { class: "hint",
    text: `Surfaces met along its density rays, up to ${number(most, 3)} in a triangle` }));
}
