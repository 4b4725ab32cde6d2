/** Which of many points are drawn with their numbers and named, so that they don't run together. */

const FEW = 40; // points that are all shown
const APART_PX = 30; // from the middle of one numbered point to the next
const STEPS = [100, 50, 20, 10, 5, 2, 1]; // numbers that are shown first

/**
 * @param {{id: string, at: number[]|null, dwell: number}[]} points in the order of the route
 * @param {import("../geometry/camera.js").Camera} camera
 * @param {(string|null)[]} marked ids that are shown whatever stands there
 * @returns {Set<string>} the ids of those that are shown whole; the others are dots
 */
export function thinned(points, camera, marked) {
  if (points.length <= FEW) return new Set(points.map(({ id }) => id));
  /** @type {Set<string>} */ const shown = new Set();
  const taken = new Cells(APART_PX);
  const order = points.map((point, i) => ({ point, i, rank: rankOf(point, i, points.length, marked) })).sort((a, b) => a.rank - b.rank || a.i - b.i);
  for (const { point, rank } of order) {
    if (!point.at) continue;
    const [x, y] = camera.toScreen(point.at[0], point.at[1]);
    if (x < -APART_PX || y < -APART_PX || x > camera.width + APART_PX || y > camera.height + APART_PX) continue;
    if (rank > 0 && taken.isNear(x, y)) continue;
    taken.add(x, y);
    shown.add(point.id);
  }
  return shown;
}

/** @param {{id: string, dwell: number}} point @param {number} i @param {number} count @param {(string|null)[]} marked */
function rankOf(point, i, count, marked) {
  if (i === 0 || i === count - 1 || marked.includes(point.id)) return 0;
  return point.dwell > 0 ? 1 : 2 + STEPS.findIndex((step) => i % step === 0);
}

/** Places on the screen, found by what is near them. */
class Cells {
  /** @param {number} reach [CSS pixel] */
  constructor(reach) {
    this.reach = reach;
    /** @type {Map<number, number[][]>} */ this.cells = new Map();
  }

  /** @param {number} x @param {number} y */
  key(x, y) {
    return Math.floor(x / this.reach) * 65536 + Math.floor(y / this.reach);
  }

  /** @param {number} x @param {number} y */
  add(x, y) {
    const key = this.key(x, y);
    const list = this.cells.get(key);
    if (list) list.push([x, y]);
    else this.cells.set(key, [[x, y]]);
  }

  /** @param {number} x @param {number} y */
  isNear(x, y) {
    const { reach } = this;
    for (const dx of [-reach, 0, reach]) {
      for (const dy of [-reach, 0, reach]) {
        for (const [ox, oy] of this.cells.get(this.key(x + dx, y + dy)) ?? []) if (Math.hypot(ox - x, oy - y) < reach) return true;
      }
    }
    return false;
  }
}
