// The patches by WebGL, as triangles with a colour at each corner, and which patch a ray meets.

const vertexShader = `
  attribute vec3 position;
  attribute vec3 colour;
  uniform mat4 camera;
  varying vec3 light;
  void main() { light = colour; gl_Position = camera * vec4(position, 1.0); }`;

// Light is multiplied by the exposure, and goes through the curve of pictures with --tone neutral
// (io/pictures/tone.h), which keeps hues. Then it becomes sRGB (IEC 61966-2-1). Tints are sRGB already.
const fragmentShader = `
  precision highp float;
  varying vec3 light;
  uniform float exposure; // 0: tints
  uniform float alpha;
  vec3 srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
  }
  void main() {
    vec3 c = max(light * exposure, 0.0);
    float peak = max(c.r, max(c.g, c.b));
    if (peak > 0.8) {
      float compressed = 1.0 - 0.04 / (peak - 0.6);
      c = mix(vec3(compressed), c * compressed / peak, 1.0 / (0.15 * (peak - compressed) + 1.0));
    }
    gl_FragColor = vec4(exposure > 0.0 ? srgb(c) : light, alpha);
  }`;

function makeProgram(gl, fragmentText = fragmentShader) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentText]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "position");
  gl.bindAttribLocation(program, 1, "colour");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error("WebGL: " + gl.getProgramInfoLog(program));
  return program;
}

/** The patches as triangles: of each triangle's corner the vertex, and where those of each patch begin. */
function trianglesOf(run) {
  const vertex = [], first = [0], listed = run.triangles || [];
  for (let i = 0, k = 0; i < run.patches; ++i) {
    const [a, b, c, d] = run.corners.subarray(4 * i, 4 * i + 4);
    if (listed[k] === i)
      for (; listed[k] === i; k += 4) vertex.push(listed[k + 1], listed[k + 2], listed[k + 3]);
    else if (c !== d) vertex.push(a, b, c, a, c, d);
    else vertex.push(a, b, c);
    first.push(vertex.length);
  }
  return { vertex, first };
}

class SceneView {
  constructor(canvas, run) {
    this.canvas = canvas;
    this.run = run;
    const { vertex, first } = trianglesOf(run);
    this.vertex = vertex; // of each corner of a triangle
    this.first = first;   // corners of patch i: first[i] to first[i + 1]
    this.position = new Float32Array(3 * vertex.length);
    vertex.forEach((v, k) => this.position.set(run.position.subarray(3 * v, 3 * v + 3), 3 * k));
    this.measure();
    this.colour = new Float32Array(this.position.length);
    this.exposure = 1; // 0: the colours are tints
    this.selected = null;
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.start());
    this.start();
  }

  /** The size of all but suns and skies, and of everything. */
  measure() {
    const radius = { near: 0, all: 0 };
    for (let i = 0; i < this.run.patches; ++i)
      for (let k = this.first[i]; k < this.first[i + 1]; ++k) {
        const r = length(triple(this.position, k));
        radius.all = Math.max(radius.all, r);
        if (!isFar(this.run, i)) radius.near = Math.max(radius.near, r);
      }
    this.radius = radius.near || radius.all || 1;
    this.reach = Math.max(radius.all, this.radius);
  }

  start() {
    const gl = this.canvas.getContext("webgl", { antialias: true });
    if (!gl) throw new Error("This browser has no WebGL, so the scene is not shown. All numbers are.");
    this.gl = gl;
    this.program = makeProgram(gl);
    const uniform = (name) => gl.getUniformLocation(this.program, name);
    this.uniform = { camera: uniform("camera"), exposure: uniform("exposure"), alpha: uniform("alpha") };
    this.buffers = [this.position, this.colour].map((numbers, index) => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, 3, gl.FLOAT, false, 0, 0);
      return buffer;
    });
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.CULL_FACE);
    gl.clearColor(0.063, 0.071, 0.086, 1);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.redraw();
  }

  /** `colourOf(patch, vertex)`: three numbers, light or a tint. */
  paint(colourOf) {
    for (let i = 0; i < this.run.patches; ++i)
      for (let k = this.first[i]; k < this.first[i + 1]; ++k)
        this.colour.set(colourOf(i, this.vertex[k]), 3 * k);
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[1]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, this.colour, this.gl.STATIC_DRAW);
    this.redraw();
  }

  get aspect() { return this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight); }

  /** Draws before the next frame. */
  redraw() {
    if (!this.pending) this.pending = requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.pending = 0;
    const { gl, canvas } = this;
    if (!this.camera || gl.isContextLost()) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    gl.uniformMatrix4fv(this.uniform.camera, false, this.camera.matrix(this.aspect, this.reach));
    gl.uniform1f(this.uniform.exposure, this.exposure);
    gl.uniform1f(this.uniform.alpha, 1);
    gl.drawArrays(gl.TRIANGLES, 0, this.vertex.length);
    if (this.selected !== null) this.drawSelected();
  }

  /** A tint over the patch, fainter where something hides it. */
  drawSelected() {
    const { gl } = this;
    const from = this.first[this.selected], count = this.first[this.selected + 1] - from;
    gl.enable(gl.BLEND);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.disable(gl.CULL_FACE);
    gl.polygonOffset(-2, -2);
    gl.uniform1f(this.uniform.exposure, 0);
    gl.disableVertexAttribArray(1);
    gl.vertexAttrib3f(1, 1, 0.45, 0.05);
    for (const [depth, alpha] of [[gl.ALWAYS, 0.3], [gl.LEQUAL, 0.6]]) {
      gl.depthFunc(depth);
      gl.uniform1f(this.uniform.alpha, alpha);
      gl.drawArrays(gl.TRIANGLES, from, count);
    }
    gl.enableVertexAttribArray(1);
    gl.enable(gl.CULL_FACE);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.disable(gl.BLEND);
  }

  /** The nearest patch whose front the ray meets (Moeller and Trumbore 1997); null where there is none. */
  pick({ origin, direction }) {
    let nearest = Infinity, found = null;
    for (let i = 0; i < this.run.patches; ++i)
      for (let k = this.first[i]; k < this.first[i + 1]; k += 3) {
        const a = triple(this.position, k);
        const ab = subtract(triple(this.position, k + 1), a), ac = subtract(triple(this.position, k + 2), a);
        const p = cross(direction, ac), determinant = dot(ab, p);
        if (!(determinant > 0)) continue; // its back, or edge on
        const s = subtract(origin, a), u = dot(s, p) / determinant;
        if (!(u >= 0 && u <= 1)) continue;
        const q = cross(s, ab), v = dot(direction, q) / determinant;
        if (!(v >= 0 && u + v <= 1)) continue;
        const t = dot(ac, q) / determinant;
        if (t > 0 && t < nearest) { nearest = t; found = i; }
      }
    return found;
  }

  /** The unit normal of a patch, from its first triangle. */
  normal(i) {
    const [a, b, c] = [0, 1, 2].map((k) => triple(this.position, this.first[i] + k));
    const n = cross(subtract(b, a), subtract(c, a));
    return length(n) > 0 ? normalised(n) : [0, 0, 1];
  }
}
