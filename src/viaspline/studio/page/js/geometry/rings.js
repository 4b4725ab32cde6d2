/** Distances to rings, whether they go round a place, the boxes round them. */

/** @param {number[]} p @param {number[]} a @param {number[]} b @returns {{at: number[], away: number}} */
export function toSegment(p, a, b) {
  const dx = b[0] - a[0], dy = b[1] - a[1];
  const size = dx * dx + dy * dy;
  const t = size > 0 ? Math.min(1, Math.max(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / size)) : 0;
  const at = [a[0] + t * dx, a[1] + t * dy];
  return { at, away: Math.hypot(at[0] - p[0], at[1] - p[1]) };
}

/** The nearest place on a closed ring, and after which corner it lies. @param {number[]} p @param {number[][]} ring */
export function toRing(p, ring) {
  let best = { at: ring[0], away: Infinity, edge: 0 };
  ring.forEach((a, i) => {
    const found = toSegment(p, a, ring[(i + 1) % ring.length]);
    if (found.away < best.away) best = { ...found, edge: i };
  });
  return best;
}

/** @param {number[]} p @param {number[][]} ring */
export function inside(p, ring) {
  let is = false;
  for (let i = 0, j = ring.length - 1; i < ring.length; j = i, i += 1) {
    const [xi, yi] = ring[i], [xj, yj] = ring[j];
    if (yi > p[1] !== yj > p[1] && p[0] < ((xj - xi) * (p[1] - yi)) / (yj - yi) + xi) is = !is;
  }
  return is;
}

/** The box round many points; null if there are none. @param {number[][]} points @returns {number[]|null} */
export function boxOf(points) {
  if (!points.length) return null;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  }
  return box;
}

/** The middle of a ring's box. @param {number[][]} ring */
export function middle(ring) {
  const x = ring.map((p) => p[0]), y = ring.map((p) => p[1]);
  return [(Math.min(...x) + Math.max(...x)) / 2, (Math.min(...y) + Math.max(...y)) / 2];
}
