// Form factors from a patch by a hemicube (Cohen and Greenberg 1985): the scene is drawn from the patch's centre onto
// the sides of a cube, in colours that number the patches, and each pixel has a known share of the patch's power.

// The colour at a corner is the number of its patch; backs hide, and receive nothing.
const numberShader = `
  precision highp float;
  varying vec3 light;
  void main() { gl_FragColor = vec4(gl_FrontFacing ? light : vec3(0.0), 1.0); }`;

class Hemicube {
  /** `view`: the SceneView whose patches are drawn; `edge`: pixels along an edge of the cube, an even number. */
  constructor(view, edge = 256) {
    this.view = view;
    this.edge = edge;
    const canvas = element("canvas", { width: edge, height: edge });
    const gl = canvas.getContext("webgl", { antialias: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("This browser has no WebGL for form factors.");
    this.gl = gl;
    const program = makeProgram(gl, numberShader);
    this.camera = gl.getUniformLocation(program, "camera");
    gl.useProgram(program);
    this.fill(0, view.position, 3, gl.FLOAT, false);
    this.fill(1, this.numbers(), 4, gl.UNSIGNED_BYTE, true);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(0, 0, 0, 1);
  }

  fill(index, numbers, size, type, normalised) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, size, type, normalised, 0, 0);
  }

  /** The number of its patch, from 1 on, as the colour of each corner. */
  numbers() {
    const { first, vertex, run } = this.view, bytes = new Uint8Array(4 * vertex.length);
    for (let i = 0; i < run.patches; ++i)
      for (let k = first[i]; k < first[i + 1]; ++k) bytes.set([(i + 1) & 255, ((i + 1) >> 8) & 255, (i + 1) >> 16], 4 * k);
    return bytes;
  }

  /** The form factors F from patch i to each patch [-], as seen from its centre. */
  factors(i) {
    const { view: { run, vertex, radius, reach }, gl, edge } = this;
    const { centre, normal, tangent } = this.place(i), across = cross(normal, tangent);
    const F = new Float32Array(run.patches), pixels = new Uint8Array(4 * edge * edge), step = 2 / edge;
    const near = 5e-4 * radius, far = 3 * reach;
    for (const [ahead, right] of [[normal, tangent], [tangent, across], [across, tangent], [scale(tangent, -1), across],
      [scale(across, -1), tangent]]) {
      const up = cross(right, ahead), offset = (axis) => -dot(axis, centre);
      const depth = (far + near) / (far - near);
      gl.uniformMatrix4fv(this.camera, false, [0, 1, 2].flatMap((k) => [right[k], up[k], depth * ahead[k], ahead[k]])
        .concat(offset(right), offset(up), depth * offset(ahead) - (2 * far * near) / (far - near), offset(ahead)));
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.drawArrays(gl.TRIANGLES, 0, vertex.length);
      gl.readPixels(0, 0, edge, edge, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      const [cosRight, cosUp, cosAhead] = [right, up, ahead].map((axis) => dot(axis, normal));
      for (let at = 0, y = 0; y < edge; ++y)
        for (let x = 0; x < edge; ++x, at += 4) {
          const seen = pixels[at] + 256 * pixels[at + 1] + 65536 * pixels[at + 2];
          if (!seen || seen === i + 1) continue;
          const u = (x + 0.5) * step - 1, v = (y + 0.5) * step - 1;
          const cosine = u * cosRight + v * cosUp + cosAhead;
          if (cosine > 0) F[seen - 1] += (cosine * step * step) / (Math.PI * (1 + u * u + v * v) ** 2);
        }
    }
    return F;
  }

  /** The centre of area of a patch, its normal and a direction in it. The centre is lifted a little: some drivers lose
   *  triangles that have corners in the plane of the eye. */
  place(i) {
    const { view } = this;
    let area = 0, sum = [0, 0, 0];
    for (let k = view.first[i]; k < view.first[i + 1]; k += 3) {
      const [a, b, c] = [0, 1, 2].map((j) => triple(view.position, k + j));
      const weight = length(cross(subtract(b, a), subtract(c, a)));
      area += weight;
      sum = add(sum, scale(add(a, add(b, c)), weight / 3));
    }
    const normal = view.normal(i), side = Math.abs(normal[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
    return { centre: add(scale(sum, 1 / (area || 1)), scale(normal, 1e-5 * view.radius)), normal, tangent: normalised(cross(side, normal)) };
  }
}

/** The patch from which form factors are shown while none is chosen: the brightest emitter. */
function brightestPatch(run) {
  let brightest = 0;
  for (let i = 0; i < run.patches; ++i)
    if (!isFar(run, i) && mean(emissionOf(run, i)) > mean(emissionOf(run, brightest))) brightest = i;
  return brightest;
}

/** A layer of the form factors from the patch that is chosen; `follow()` recomputes it where another was. */
function factorLayer(run, view) {
  const layer = { name: "Form factors", colourOf: () => unknownColour };
  let hemicube = null, from = null;
  layer.follow = () => {
    const patch = view.selected ?? brightestPatch(run);
    if (patch === from) return;
    from = patch;
    hemicube ??= new Hemicube(view);
    layer.factors = hemicube.factors(from);
    Object.assign(layer, scalarLayer("Form factors", `F from the centre of patch ${from}`, run, (i) => layer.factors[i]));
  };
  return layer;
}
