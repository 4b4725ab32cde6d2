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

  /** The place and the first two derivatives of a span, each x, y, z. @param {number} k @param {number} w */
  solidAt(k, w) {
    const p = this.solid, v = 1 - w;
    /** @type {number[][]} */ const found = [[], [], []];
    for (let axis = 0; axis < 3; axis += 1) {
      const [a, b, c, d] = [0, 3, 6, 9].map((j) => p[12 * k + j + axis]);
      found[0].push(v * v * v * a + 3 * v * v * w * b + 3 * v * w * w * c + w * w * w * d);
      found[1].push(3 * (v * v * (b - a) + 2 * v * w * (c - b) + w * w * (d - c)));
      found[2].push(6 * (v * (c - 2 * b + a) + w * (d - 2 * c + b)));
    }
    return found;
  }

  /** @param {number} k @param {number} w */
  speedIn(k, w) {
    return Math.hypot(...this.solidAt(k, w)[1]);
  }

  /** @param {number} k @param {number} w @param {number} s @returns {any} */
  sample(k, w, s) {
    const level = super.sample(k, w, s);
    const [[, , z], d, dd] = this.solidAt(k, w);
    const size = Math.hypot(...d) || 1e-9;
    const across = Math.hypot(d[1] * dd[2] - d[2] * dd[1], d[2] * dd[0] - d[0] * dd[2], d[0] * dd[1] - d[1] * dd[0]);
    const upright = Math.hypot(d[0], d[1]) < 1e-9 * size;
    const yaw = this.yawAt(s);
    return { ...level, z, heading: upright ? yaw : level.heading, curvature: size > 1e-6 ? across / size ** 3 : 0, climb: (level.speed * d[2]) / size, yaw };
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
