/** How far along a path something is, which was farther back a moment ago. */

const AHEAD = 0.06; // of the path: how far on from where it was something is looked for
const JUMP_M = 3; // nearer by so much, somewhere else is where it is: the time was set, not played

/** The distance of the place of a curve that is nearest; of two as near the one not far from where it was. @param {any} curve @param {number[]} place @param {number} from [m] */
export function nearestFrom(curve, [x, y, z], from) {
  const reach = Math.max(AHEAD * curve.length, 20);
  let best = Infinity, found = from;
  for (const sample of curve.solidSamples) {
    const isFar = sample.s < from - reach || sample.s > from + reach;
    const away = Math.hypot(sample.x - x, sample.y - y, sample.z - z) + 1e-3 * Math.abs(sample.s - from) + (isFar ? JUMP_M : 0);
    if (away < best) {
      best = away;
      found = sample.s;
    }
  }
  return found;
}
