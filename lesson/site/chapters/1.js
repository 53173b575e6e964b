lesson.chapter({
  number: 1,
  title: "Light between two patches",
  summary: "The form factor: in closed form, by rays, by a hemicube.",
  text: `
<p>A matt surface sends light in all directions. Seen from any side it looks equally bright, so the power that it sends
in a direction falls with the cosine of the angle to its normal: this is Lambert's law.</p>
<p>Of all the power that leaves patch <var>i</var>, a share arrives at patch <var>j</var>. This share is the <b>form
factor</b> <var>F<sub>ij</sub></var>, the only geometry that radiosity needs. It is a double integral over both patches, but
you need not integrate. Draw rays from random points of the lower square, with directions by the cosine law, and count:
<span class="formula"><var>F</var> ≈ hits / rays</span>
One ray is right on average and useless alone. The error falls with the square root of the number: for one digit more you
need a hundred times as many rays.</p>
<p>Two other ways are older. Contour integration has no error where nothing stands between the patches. The hemicube looks
through the pixels of half a cube over the centre; it is off near by, because the centre stands for the whole patch.</p>
<p>Change the size of the upper square. Both factors change, yet
<span class="formula"><var>A<sub>i</sub> F<sub>ij</sub></var> = <var>A<sub>j</sub> F<sub>ji</sub></var></span>
always holds: the way from one to the other is as wide as the way back. A large patch is easily hit, and sends little of
its light to a small one.</p>`,
  source: {
    section: "2", sentence: "A form factor … represents the ratio of energy leaving one and arriving to the other.",
    pages: ["src/geometry/polygon_sampler.h", "src/radiosity/paper/rays/shot.h", "src/radiosity/engine/factors/pairs/exchange_area.h"],
  },
  state: { distance: 1, tilt: 0, aside: 0, size: 1, rays: 200, eye: "0.55,0.12" },
  figure(f) {
    const view = f.view(figures.RoomView, { label: "Two squares, one above the other, and rays between them", ratio: 1.15, bright: true, title: "Drag to turn" });
    const chart = f.view(figures.ChartView, { label: "The estimate of F as rays arrive", log: false, ratio: 1.15, title: "F by rays, against the closed form", x: "rays" });
    view.backs = true;
    view.middle = [0, 0.6, 0];
    view.radius = 1.35;
    f.button("One ray", () => f.set({ rays: f.state.rays + 1 }), "r");
    f.button("A hundred", () => f.set({ rays: f.state.rays + 100 }), "h");
    f.button("None", () => f.set({ rays: 0 }));
    f.slider("distance", "Distance", 0.1, 2, 0.05);
    f.slider("tilt", "Tilt", -80, 80, 5, (degrees) => `${degrees}°`);
    f.slider("aside", "Aside", -1.5, 1.5, 0.1);
    f.slider("size", "Size of the upper", 0.2, 2, 0.1);
    let room;
    f.change = () => {
      const { distance, tilt, aside, size, rays } = f.state;
      room?.delete();
      f.rooms = [];
      room = f.room(rooms.pair({ distance, tilt: tilt * Math.PI / 180, aside, size }));
      view.room = room;
      const [lower, upper] = room.patches, exchange = room.exchange(0, 1);
      const closed = exchange / lower.area, shot = room.raysFrom(0, rays);
      const isHit = shot.map(({ patch }) => patch === 1), hits = isHit.filter(Boolean).length;
      const share = hits / Math.max(rays, 1), error = Math.sqrt(share * (1 - share) / Math.max(rays, 1));
      const byPixels = (edge) => room.hemicube(0, edge).reduce((sum, { factor, patch }) => sum + (patch === 1 ? factor : 0), 0);
      const back = room.raysFrom(1, rays).filter(({ patch }) => patch === 0).length / Math.max(rays, 1);
      f.values = { closed, share, hits, rays, error, hemicube: byPixels(16), exchange, back: exchange / upper.area, areas: [lower.area, upper.area] };
      view.colour = (patch) => patch.index ? figures.ink("line") : "rgba(217,114,11,.35)";
      view.chosen = [{ patch: 0, colour: figures.ink("ray") }, { patch: 1, colour: figures.ink("mark") }];
      view.rays = shot.slice(-400).map(({ from, to, patch }, k, list) => patch === 1
        ? { from, to, end: true, width: k === list.length - 1 ? 2.5 : 0.8 }
        : { from, to: figures.add(from, figures.scale(figures.unit(figures.sub(to, from)), 0.9)), colour: figures.ink("soft"), width: k === list.length - 1 ? 2.5 : 0.35 });
      let so = 0;
      const points = isHit.map((hit, k) => [k + 1, (so += hit) / (k + 1)]);
      chart.series = [{ name: "rays", points, dots: false, colour: figures.ink("ray") },
        { name: "closed form", points: [[0, closed], [Math.max(rays, 1), closed]], dots: false, dash: [6, 4] }];
      chart.range = [[0, Math.max(rays, 10)], [0, Math.max(2 * closed, 0.05)]];
      f.say(`${hits} of ${rays} rays arrive: F ≈ ${figures.format(share)} ± ${figures.format(error)}. The closed form is ${figures.format(closed)}.`);
      f.table(["", "F lower → upper", "F upper → lower"], [
        ["closed form", closed, exchange / upper.area], ["rays", share, back],
        ["hemicube, 16 pixels along an edge", byPixels(16), "–"], ["hemicube, 128", byPixels(128), "–"],
        ["area A [m²]", lower.area, upper.area], ["A F [m²], closed form", exchange, exchange]]);
    };
  },
  exercises: [
    { ask: "Two squares of side 1 at distance 1 stand face to face. What is F, to three digits?", answer: 0.1998, within: 0.004, hint: "Reset the page and read the closed form." },
    { ask: "The upper square has side 2 in place of 1, at distance 1. By what number is F from the upper to the lower multiplied, to get F from the lower to the upper?", answer: 4, within: 0.001, hint: "A F is the same both ways.", because: "The areas are 4 and 1." },
    { ask: "With 200 rays the error of F is some 0.028. How many rays bring it to 0.0028?", answer: 20000, within: 0.05, hint: "The error falls with the square root." },
  ],
});
