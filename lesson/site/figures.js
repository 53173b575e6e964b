// What figures are made of: a room seen in perspective, a hemisphere seen from above, charts, matrices. Each
// view is a canvas with a text for those who do not see it.
"use strict";

const figures = (() => {
  const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const length = (a) => Math.sqrt(dot(a, a));
  const unit = (a) => scale(a, 1 / length(a));
  const lerp = (a, b, t) => add(scale(a, 1 - t), scale(b, t));
  const vectors = { add, sub, scale, dot, cross, length, unit, lerp };

  // Linear light as a colour of the screen (IEC 61966-2-1).
  const screen = (x) => {
    const clamped = Math.min(Math.max(x, 0), 1);
    return Math.round(255 * (clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * clamped ** (1 / 2.4) - 0.055));
  };
  const rgb = (colour) => `rgb(${screen(colour[0])},${screen(colour[1])},${screen(colour[2])})`;
  // A scale of colours from dark to bright for numbers from 0 to 1.
  const stops = [[0.05, 0.04, 0.09], [0.24, 0.06, 0.33], [0.62, 0.13, 0.28], [0.93, 0.42, 0.1], [1, 0.86, 0.45]];
  const heat = (t) => {
    const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
    const [r, g, b] = lerp(stops[k], stops[k + 1], at - k).map((x) => Math.round(255 * x));
    return `rgb(${r},${g},${b})`;
  };

  const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

  class View {
    constructor(parent, { label, ratio = 4 / 3, kind = "" }) {
      this.canvas = document.createElement("canvas");
      this.canvas.className = kind;
      this.canvas.setAttribute("role", "img");
      this.label = label;
      this.ratio = ratio;
      parent.append(this.canvas);
      this.observer = new ResizeObserver(() => this.draw());
      this.observer.observe(this.canvas);
    }
    set label(text) { this.canvas.setAttribute("aria-label", text); }
    close() { this.observer.disconnect(); }
    // Begins a picture; sizes are in pixels of the page.
    begin() {
      const width = Math.max(this.canvas.clientWidth, 1), height = Math.round(width / this.ratio);
      const dense = Math.min(window.devicePixelRatio || 1, 2);
      if (this.canvas.width !== Math.round(width * dense) || this.canvas.height !== Math.round(height * dense)) {
        this.canvas.width = Math.round(width * dense);
        this.canvas.height = Math.round(height * dense);
        this.canvas.style.aspectRatio = String(this.ratio);
      }
      this.width = width;
      this.height = height;
      const pen = this.pen = this.canvas.getContext("2d");
      pen.setTransform(dense, 0, 0, dense, 0, 0);
      pen.clearRect(0, 0, width, height);
      pen.font = `${Math.max(11, Math.min(14, width / 34))}px ${ink("sans")}`;
      pen.lineJoin = pen.lineCap = "round";
      return pen;
    }
    draw() { }
    text(text, x, y, { colour = ink("ink"), align = "left", base = "alphabetic", halo = false, size = 0 } = {}) {
      const { pen } = this;
      pen.textAlign = align;
      pen.textBaseline = base;
      const font = pen.font;
      if (size) pen.font = `${size}px ${ink("sans")}`;
      if (halo) {
        pen.strokeStyle = ink("paper");
        pen.lineWidth = 3;
        pen.strokeText(text, x, y);
      }
      pen.fillStyle = colour;
      pen.fillText(text, x, y);
      pen.font = font;
    }
    line(points, { colour = ink("ink"), width = 1, dash = [], closed = false, fill = "" } = {}) {
      const { pen } = this;
      pen.beginPath();
      points.forEach(([x, y], k) => k ? pen.lineTo(x, y) : pen.moveTo(x, y));
      if (closed) pen.closePath();
      if (fill) { pen.fillStyle = fill; pen.fill(); }
      if (!width) return;
      pen.setLineDash(dash);
      pen.strokeStyle = colour;
      pen.lineWidth = width;
      pen.stroke();
      pen.setLineDash([]);
    }
    dot(x, y, radius, colour) {
      this.pen.beginPath();
      this.pen.arc(x, y, radius, 0, 2 * Math.PI);
      this.pen.fillStyle = colour;
      this.pen.fill();
    }
  }

  // A room in perspective, turned by drags and arrow keys; a click or Enter chooses a patch. One looks into a
  // closed room through the backs of its walls.
  class RoomView extends View {
    constructor(parent, options) {
      super(parent, { ratio: 1.25, kind: options.bright ? "room" : "room lit", ...options });
      this.eye = { yaw: 0.5, pitch: 0.32, zoom: 1, ...options.eye };
      this.colour = (patch) => patch.reflectance;
      this.grid = false;
      this.chosen = [];
      this.rays = [];
      this.arrows = [];
      this.onPick = null;
      this.onTurn = () => { };
      this.canvas.tabIndex = 0;
      this.listen();
    }
    get room() { return this.shown; }
    set room(room) {
      this.shown = room;
      const corners = room.patches.flatMap((patch) => patch.corners);
      const low = [0, 1, 2].map((k) => Math.min(...corners.map((c) => c[k])));
      const high = [0, 1, 2].map((k) => Math.max(...corners.map((c) => c[k])));
      this.middle ??= scale(add(low, high), 0.5);
      this.radius ??= length(sub(high, low)) / 2;
      this.box = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => [0, 1, 2].map((k) => (corner >> k & 1 ? high : low)[k]));
    }
    turn(yaw, pitch) {
      this.eye.yaw += yaw;
      this.eye.pitch = Math.min(Math.max(this.eye.pitch + pitch, -1.5), 1.5);
      this.onTurn(this.eye);
      this.draw();
    }
    listen() {
      const { canvas } = this;
      let from = null, moved = false;
      canvas.addEventListener("pointerdown", (event) => { from = [event.clientX, event.clientY]; moved = false; });
      canvas.addEventListener("pointermove", (event) => {
        if (!from || !event.buttons) return;
        const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
        if (!moved && Math.hypot(dx, dy) < 5) return;
        moved = true;
        from = [event.clientX, event.clientY];
        this.turn(-dx / 150, dy / 150);
      });
      canvas.addEventListener("pointerup", (event) => {
        if (from && !moved) {
          const box = canvas.getBoundingClientRect();
          const patch = this.patchAt(event.clientX - box.left, event.clientY - box.top);
          if (patch >= 0 && this.onPick) this.onPick(patch);
        }
        from = null;
      });
      canvas.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: [0.15, 0], ArrowRight: [-0.15, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
        if (step) this.turn(...step);
        else if (event.key === "Enter" && this.onPick) this.onPick(this.patchAt(this.width / 2, this.height / 2));
        else if ((event.key === "," || event.key === ".") && this.onPick)
          this.onPick(((this.chosen[0] ?? -1) + (event.key === "." ? 1 : this.room.patches.length - 1)) % this.room.patches.length);
        else return;
        event.preventDefault();
      });
    }
    aim() {
      const { yaw, pitch, zoom } = this.eye;
      const back = [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
      this.right = unit(cross([0, 1, 0], back));
      this.up = cross(back, this.right);
      this.back = back;
      this.place = add(this.middle, scale(back, 3.1 * this.radius / zoom));
      // Nothing of the room is cut off, however it is turned.
      this.factor = this.box.reduce((factor, corner) => {
        const to = sub(corner, this.place), depth = -dot(to, back);
        const [x, y] = [this.right, this.up].map((axis) => Math.abs(dot(to, axis)));
        return depth > 0 ? Math.min(factor, 0.49 * depth * Math.min(this.width / x, this.height / y)) : factor;
      }, 1.95 * Math.min(this.height, this.width));
    }
    // A place of the world on the canvas, and its distance.
    project(point) {
      const to = sub(point, this.place), depth = -dot(to, this.back);
      const factor = this.factor / Math.max(depth, 1e-3 * this.radius);
      return [this.width / 2 + factor * dot(to, this.right), this.height / 2 - factor * dot(to, this.up), depth];
    }
    order() {
      const faces = (patch) => dot(patch.normal, sub(this.place, patch.centre)) > 0;
      const facing = this.backs ? [...this.room.patches] : this.room.patches.filter(faces);
      const far = new Map(facing.map((patch) => [patch, length(sub(patch.centre, this.place))]));
      return facing.sort((a, b) => far.get(b) - far.get(a));
    }
    patchAt(x, y) {
      const inside = (corners) => corners.reduce((odd, [ax, ay], k) => {
        const [bx, by] = corners[(k + 1) % corners.length];
        return (ay > y) !== (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) ? !odd : odd;
      }, false);
      return this.order().reverse().find((patch) => inside(patch.corners.map((c) => this.project(c))))?.index ?? -1;
    }
    draw() {
      if (!this.shown) return;
      this.begin();
      this.aim();
      for (const patch of this.order()) {
        const colour = this.colour(patch), fill = typeof colour === "string" ? colour : rgb(colour);
        const edge = this.grid ? "rgba(0,0,0,.45)" : fill;
        this.line(patch.corners.map((c) => this.project(c)), { closed: true, fill, colour: edge, width: this.grid ? 0.6 : 0.8 });
      }
      for (const { patch, colour = ink("mark") } of this.chosen.map((mark) => typeof mark === "number" ? { patch: mark } : mark))
        if (this.room.patches[patch])
          this.line(this.room.patches[patch].corners.map((c) => this.project(c)), { closed: true, width: 2.5, colour });
      for (const ray of this.rays) {
        const { from, to, colour = ink("ray"), share = 1, begin = 0, width = 1 } = ray;
        this.line([this.project(lerp(from, to, begin)), this.project(lerp(from, to, share))], { colour, width });
        if (ray.end && share === 1) this.dot(...this.project(to).slice(0, 2), 1.8, colour);
      }
      for (const { from, to, text = "", colour = ink("mark") } of this.arrows) {
        const [a, b] = [this.project(from), this.project(to)];
        this.line([a, b], { colour, width: 2 });
        this.dot(b[0], b[1], 3, colour);
        if (text) this.text(text, b[0] + 6, b[1] - 6, { colour, halo: true });
      }
      this.after?.(this);
    }
  }

  // A hemisphere from above: a direction (x, y, z) stands at (x, y), so that areas of the picture are shares of
  // a diffuse patch's power.
  class DiscView extends View {
    constructor(parent, options) {
      super(parent, { ratio: 1, kind: "disc", ...options });
      this.triangles = [];
      this.labels = [];
      this.canvas.tabIndex = 0;
      this.canvas.addEventListener("click", (event) => {
        const box = this.canvas.getBoundingClientRect();
        const [x, y] = [(event.clientX - box.left - this.width / 2) / this.size, (this.height / 2 - event.clientY + box.top) / this.size];
        const z = Math.sqrt(Math.max(0, 1 - x * x - y * y));
        const inside = ({ corners: [a, b, c] }) => [[a, b], [b, c], [c, a]].every(([p, q]) => dot(cross(p, q), [x, y, z]) >= -1e-9);
        const found = this.triangles.findIndex(inside);
        if (found >= 0) this.onPick?.(found);
      });
    }
    get size() { return Math.min(this.width, this.height) / 2 - 14; }
    place([x, y]) { return [this.width / 2 + this.size * x, this.height / 2 - this.size * y]; }
    arc(a, b) { return Array.from({ length: 9 }, (_, k) => this.place(unit(lerp(a, b, k / 8)))); }
    // Draws triangles [{ corners: [three directions], fill, chosen }], dots and labels [{ at, text }].
    draw() {
      this.begin();
      const outline = ([a, b, c]) => [...this.arc(a, b), ...this.arc(b, c), ...this.arc(c, a)];
      for (const { corners, fill = "transparent" } of this.triangles)
        this.line(outline(corners), { closed: true, fill, colour: ink("line"), width: 0.8 });
      for (const { corners } of this.triangles.filter(({ chosen }) => chosen))
        this.line(outline(corners), { closed: true, colour: ink("mark"), width: 3 });
      for (const { at, colour = ink("ray") } of this.dots ?? []) this.dot(...this.place(at), 2, colour);
      for (const { at, text, colour } of this.labels)
        this.text(text, ...this.place(at), { align: "center", base: "middle", halo: true, colour, size: Math.max(10, this.size / 17) });
      this.after?.(this);
    }
  }

  // A chart with linear or logarithmic axes: series [{ name, points: [[x, y, half]], colour, dash, dots }]. `half`, where
  // there is one, is half of the length of an error bar.
  class ChartView extends View {
    constructor(parent, options) {
      super(parent, { ratio: 1.5, kind: "chart", ...options });
      Object.assign(this, { x: "", log: true, series: [], lines: [], range: null, form: format, ...options });
    }
    draw() {
      this.begin();
      const [left, right, top, bottom] = [58, 30, 18, 42];
      const all = this.series.flatMap(({ points }) => points).filter(([x, y]) => !this.log || (x > 0 && y > 0));
      const span = (k) => {
        const values = all.map((point) => point[k]);
        const [low, high] = values.length ? [Math.min(...values), Math.max(...values)] : [1, 10];
        return this.log ? [10 ** Math.floor(Math.log10(low) + 1e-9), 10 ** Math.ceil(Math.log10(high * 1.0001))] : [Math.min(0, low), high || 1];
      };
      const [xs, ys] = this.range ?? [span(0), span(1)];
      const map = (value, [low, high]) => this.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
      const place = ([x, y]) => [left + map(x, xs) * (this.width - left - right), this.height - bottom - map(y, ys) * (this.height - top - bottom)];
      // Powers of ten, or round numbers.
      const ticks = ([low, high]) => {
        const list = [], rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
        const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= rough);
        if (this.log) for (let tick = 10 ** Math.ceil(Math.log10(low) - 1e-9); tick <= high * 1.001; tick *= 10) list.push(tick);
        else for (let k = Math.ceil(low / step - 1e-9); k * step <= high * 1.001; ++k) list.push(Number((k * step).toPrecision(6)));
        return list;
      };
      for (const tick of ticks(xs)) {
        this.line([place([tick, ys[0]]), place([tick, ys[1]])], { colour: ink("line"), width: 0.5 });
        this.text(this.form(tick), place([tick, ys[0]])[0], this.height - bottom + 16, { align: "center", colour: ink("soft") });
      }
      for (const tick of ticks(ys)) {
        this.line([place([xs[0], tick]), place([xs[1], tick])], { colour: ink("line"), width: 0.5 });
        this.text((this.formY ?? this.form)(tick), left - 8, place([xs[0], tick])[1], { align: "right", base: "middle", colour: ink("soft") });
      }
      this.text(this.x, this.width - right, this.height - 6, { align: "right", colour: ink("soft") });
      this.pen.save();
      this.pen.beginPath();
      this.pen.rect(left, top, this.width - left - right, this.height - top - bottom);
      this.pen.clip();
      for (const { points, colour = ink("mark"), dash = [], width = 2, dots = true } of this.series) {
        const shown = points.filter(([x, y]) => !this.log || (x > 0 && y > 0)).map(place);
        if (shown.length > 1) this.line(shown, { colour, width, dash });
        if (dots) shown.forEach(([x, y]) => this.dot(x, y, 2.6, colour));
        for (const [x, y, half] of points.filter((point) => point[2] > 0)) {
          const [from, to] = [-half, half].map((off) => place([x, this.log ? Math.max(y + off, ys[0] / 10) : y + off]));
          this.line([from, to], { colour, width: 1.5 });
          for (const [at, end] of [from, to]) this.line([[at - 3, end], [at + 3, end]], { colour, width: 1.5 });
        }
      }
      this.pen.restore();
      const named = this.series.filter(({ name, points }) => name && points.length);
      named.forEach(({ name, colour = ink("mark") }, k) => {
        const y = top + 12 + 17 * k;
        this.line([[this.width - right - 18, y], [this.width - right - 4, y]], { colour, width: 3 });
        this.text(name, this.width - right - 24, y, { align: "right", base: "middle", halo: true });
      });
      this.after?.(this, place);
    }
  }

  // A matrix of numbers from 0 to 1 as squares.
  class MatrixView extends View {
    constructor(parent, options) {
      super(parent, { ratio: 1, kind: "matrix", ...options });
      this.values = [];
      this.rows = [];
      this.canvas.addEventListener("click", (event) => {
        const box = this.canvas.getBoundingClientRect();
        this.onPick?.(Math.min(this.rows_ - 1, Math.max(0, Math.floor((event.clientY - box.top - 4) / (this.height - 8) * this.rows_))));
      });
    }
    get rows_() { return Math.round(Math.sqrt(this.values.length)); }
    draw() {
      const pen = this.begin(), n = this.rows_, edge = (this.width - 8) / Math.max(n, 1);
      const largest = this.values.reduce((most, value) => Math.max(most, value), 1e-9);
      for (let k = 0; k < n * n; ++k) {
        pen.fillStyle = heat(Math.sqrt(this.values[k] / largest));
        pen.fillRect(4 + (k % n) * edge, 4 + Math.floor(k / n) * edge, edge + 0.5, edge + 0.5);
      }
      for (const row of this.rows)
        this.line([[3, 3 + row * edge], [5 + n * edge, 3 + row * edge], [5 + n * edge, 5 + (row + 1) * edge], [3, 5 + (row + 1) * edge]],
          { closed: true, colour: ink("mark"), width: 2 });
    }
  }

  // A number with about four digits, as the program prints it.
  const format = (value) => {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    const size = Math.abs(value);
    if (Number.isInteger(value) && size < 1e6) return value.toLocaleString("en").replace(/,/g, " ");
    if (size >= 1e6) return `${(value / 1e6).toPrecision(3)} M`;
    if (size !== 0 && size < 1e-3) return value.toExponential(1).replace("-", "-");
    return value.toPrecision(size >= 1000 ? 5 : 4).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  };
  const percent = (share) => Number.isFinite(share) ? `${format(Number((100 * share).toPrecision(3)))} %` : "–";

  // Brings light to the brightness of the screen: the patch at this quantile of area is shown at full white.
  const exposure = (room, light, quantile = 0.97) => {
    const values = room.patches.filter((patch) => patch.emission[0] + patch.emission[1] + patch.emission[2] === 0)
      .map((patch) => Math.max(light[3 * patch.index], light[3 * patch.index + 1], light[3 * patch.index + 2])).sort((a, b) => a - b);
    return 0.9 / Math.max(values[Math.floor(quantile * (values.length - 1))] ?? 0, 1e-12);
  };
  const lit = (light, factor) => (patch) => [0, 1, 2].map((k) => light[3 * patch.index + k] * factor);

  // A relative difference as a colour: blue where light is missing, red where there is too much.
  const difference = (share) => {
    const t = Math.min(1, Math.abs(share)), full = share < 0 ? [0.13, 0.4, 0.78] : [0.82, 0.2, 0.12];
    const [r, g, b] = lerp([0.95, 0.94, 0.92], full, t).map((x) => Math.round(255 * x));
    return `rgb(${r},${g},${b})`;
  };

  return { ...vectors, vectors, difference, View, RoomView, DiscView, ChartView, MatrixView, format, percent, rgb, heat, ink, exposure, lit };
})();
