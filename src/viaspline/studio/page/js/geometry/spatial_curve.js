/** The planned curve in space: seen from above as any other, with its heights, climb and headings. */

import { Curve } from "./curve.js";

/** @typedef {import("./curve.js").Sample & {z: number, climb: number, yaw: number}} SpatialSample */

export class SpatialCurve extends Curve {
  /** @param {any} plan the server's answer */
  constructor(plan) {
    super(plan);
    /** Bézier control polygons as x, y, z, x, … @type {number[]} */ this.solid = plan.space.spans;
    /** @type {{distances: number[], headings: number[]}} */ this.yaw = plan.space.yaw;
    this.isSpatial = true;
  }

  /** The first derivative of one coordinate of a span. @param {number} k @param {number} axis @param {number} w */
  slope(k, axis, w) {
    const p = this.solid, i = 12 * k + axis, v = 1 - w;
    return 3 * (v * v * (p[i + 3] - p[i]) + 2 * v * w * (p[i + 6] - p[i + 3]) + w * w * (p[i + 9] - p[i + 6]));
  }

  /** @param {number} k @param {number} w */
  speedIn(k, w) {
    const x = this.slope(k, 0, w), y = this.slope(k, 1, w), z = this.slope(k, 2, w);
    return Math.sqrt(x * x + y * y + z * z);
  }

  /** @param {number} k @param {number} w @param {number} s @returns {any} */
  sample(k, w, s) {
    const p = this.solid, i = 12 * k, v = 1 - w;
    const b0 = v * v * v, b1 = 3 * v * v * w, b2 = 3 * v * w * w, b3 = w * w * w;
    const bend = (/** @type {number} */ j) => 6 * (v * (p[j + 6] - 2 * p[j + 3] + p[j]) + w * (p[j + 9] - 2 * p[j + 6] + p[j + 3]));
    const place = (/** @type {number} */ j) => b0 * p[j] + b1 * p[j + 3] + b2 * p[j + 6] + b3 * p[j + 9];
    const dx = this.slope(k, 0, w), dy = this.slope(k, 1, w), dz = this.slope(k, 2, w);
    const ex = bend(i), ey = bend(i + 1), ez = bend(i + 2);
    const size = Math.sqrt(dx * dx + dy * dy + dz * dz) || 1e-9;
    const cx = dy * ez - dz * ey, cy = dz * ex - dx * ez, cz = dx * ey - dy * ex;
    const speed = this.speedAt(s), yaw = this.yawAt(s);
    const isUpright = dx * dx + dy * dy < 1e-18 * size * size;
    return {
      x: place(i), y: place(i + 1), z: place(i + 2), s, heading: isUpright ? yaw : Math.atan2(dy, dx),
      curvature: size > 1e-6 ? Math.sqrt(cx * cx + cy * cy + cz * cz) / size ** 3 : 0, speed, climb: (speed * dz) / size, yaw,
    };
  }

  /** @param {number} s @returns {any} */
  at(s) {
    const list = /** @type {SpatialSample[]} */ (this.shape);
    const level = super.at(s);
    let low = 0, high = list.length - 2;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (list[middle].s <= s) low = middle;
      else high = middle - 1;
    }
    const a = list[low], b = list[low + 1];
    const t = b.s > a.s ? Math.min(Math.max((s - a.s) / (b.s - a.s), 0), 1) : 0;
    return { ...level, z: a.z + t * (b.z - a.z), climb: a.climb + t * (b.climb - a.climb), yaw: this.yawAt(s) };
  }

  /** Where the body looks at a distance [rad]. @param {number} s */
  yawAt(s) {
    const { distances: d, headings } = this.yaw;
    let low = 0, high = d.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (d[middle] <= s) low = middle;
      else high = middle - 1;
    }
    const next = Math.min(low + 1, d.length - 1);
    const t = d[next] > d[low] ? Math.min(Math.max((s - d[low]) / (d[next] - d[low]), 0), 1) : 0;
    return headings[low] + t * (headings[next] - headings[low]);
  }

  /** The samples with their heights. @returns {SpatialSample[]} */
  get solidSamples() {
    return /** @type {SpatialSample[]} */ (this.shape);
  }
}
