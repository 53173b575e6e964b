// A camera that turns around a point, and the little algebra that it needs. Vectors are arrays of three
// numbers, matrices of sixteen, column after column.

const add = (a, b) => a.map((x, k) => x + b[k]);
const subtract = (a, b) => a.map((x, k) => x - b[k]);
const scale = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(...a);
const normalised = (a) => scale(a, 1 / length(a));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

class OrbitCamera {
  /** `radius`: of the scene, around the origin. */
  constructor({ eye, target, up, fov }, radius) {
    this.first = { eye, target, up, fov };
    this.radius = radius;
    this.reset();
  }

  reset() {
    const { eye, target, up, fov } = this.first;
    const forward = normalised(subtract(target, eye));
    this.fov = (fov * Math.PI) / 180;
    this.up = normalised(up);
    const side = Math.abs(this.up[0]) < 0.9 ? [1, 0, 0] : [0, 0, 1];
    this.east = normalised(cross(this.up, side));
    this.north = cross(this.up, this.east);
    // The pivot lies on the view's axis, as far as the middle of the scene.
    this.distance = clamp(-dot(eye, forward), 0.3 * this.radius, 10 * this.radius);
    this.pivot = add(eye, scale(forward, this.distance));
    const back = scale(forward, -1);
    this.pitch = Math.asin(clamp(dot(back, this.up), -1, 1));
    this.yaw = Math.atan2(dot(back, this.north), dot(back, this.east));
    this.turn(0, 0);
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = clamp(this.pitch + pitch, -1.55, 1.55);
  }
  zoom(factor) {
    this.distance = clamp(this.distance * factor, 0.02 * this.radius, 12 * this.radius);
  }
  /** Moves the pivot to the right and up, in shares of the picture's height. */
  move(x, y) {
    const { right, top } = this.axes();
    const size = 2 * this.distance * Math.tan(this.fov / 2);
    this.pivot = add(this.pivot, add(scale(right, x * size), scale(top, y * size)));
  }

  axes() {
    const across = add(scale(this.east, Math.cos(this.yaw)), scale(this.north, Math.sin(this.yaw)));
    const back = add(scale(across, Math.cos(this.pitch)), scale(this.up, Math.sin(this.pitch)));
    const right = normalised(cross(this.up, back));
    return { right, top: cross(back, right), back, eye: add(this.pivot, scale(back, this.distance)) };
  }

  /** Half of the picture's height at distance 1; a narrow picture shows as much in width as one of 4 : 3. */
  halfHeight(aspect) { return Math.tan(this.fov / 2) * Math.max(1, 4 / 3 / aspect); }

  /** The matrix from the scene to the cube of clip space. */
  matrix(aspect, reach) {
    const { right, top, back, eye } = this.axes();
    const near = Math.max(0.002 * this.radius, 0.3 * (length(eye) - 1.2 * this.radius));
    const far = length(eye) + reach;
    const h = this.halfHeight(aspect), w = h * aspect;
    const rows = [scale(right, 1 / w), scale(top, 1 / h),
      scale(back, (near + far) / (near - far)), scale(back, -1)];
    const last = rows.map((row) => -dot(row, eye));
    last[2] += (2 * near * far) / (near - far);
    const columns = [0, 1, 2].flatMap((k) => rows.map((row) => row[k]));
    return [...columns, ...last];
  }

  /** The ray through a place of the picture: x from -1 to 1, y from -1 (bottom) to 1. */
  ray(x, y, aspect) {
    const { right, top, back, eye } = this.axes();
    const h = this.halfHeight(aspect);
    const along = add(add(scale(right, x * h * aspect), scale(top, y * h)), scale(back, -1));
    return { origin: eye, direction: normalised(along) };
  }
}
