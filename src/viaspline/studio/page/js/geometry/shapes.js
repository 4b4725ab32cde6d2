/** Distances to the shapes of obstacles, for picking and for the mark of the tightest place. */

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

/** The nearest place on an obstacle's edge [m]; null for maps. @param {number[]} p @param {any} obstacle */
export function edgeNear(p, obstacle) {
  if (obstacle.circle) {
    const { center: [x, y], radius } = obstacle.circle;
    const away = Math.hypot(p[0] - x, p[1] - y) || 1e-9;
    return [x + ((p[0] - x) * radius) / away, y + ((p[1] - y) * radius) / away];
  }
  if (obstacle.polygon) {
    const rings = [obstacle.polygon, ...obstacle.holes];
    return rings.map((ring) => toRing(p, ring)).reduce((a, b) => (b.away < a.away ? b : a)).at;
  }
  return null;
}

/** @param {number[]} p @param {any} obstacle */
export function covers(p, obstacle) {
  if (obstacle.circle) {
    const { center, radius } = obstacle.circle;
    return Math.hypot(p[0] - center[0], p[1] - center[1]) <= radius;
  }
  return !!obstacle.polygon && inside(p, obstacle.polygon) && !obstacle.holes.some((/** @type {number[][]} */ hole) => inside(p, hole));
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
