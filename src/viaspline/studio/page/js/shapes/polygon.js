/** Polygons with holes; speed zones and fences are shaped the same way. */

import { boxOf, inside, middle, toRing } from "../geometry/rings.js";
import { tidy } from "../units.js";

/** @typedef {import("./shape.js").Item} Item */
/** @typedef {import("./shape.js").Place} Place */
/** @typedef {import("./shape.js").ShapeHandle} ShapeHandle */

const FEWEST_CORNERS = 3;
const SHORTEST_SPLIT_PX = 44; // of an edge that has a handle for a new corner

/** @param {Item} item @returns {Place[][]} the outer ring first */
const ringsOf = (item) => [item.polygon, ...(Array.isArray(item.holes) ? item.holes : [])];

/** @param {Item} item @param {(at: Place) => Place} move @returns {Item} */
function mapped(item, move) {
  /** @type {Item} */ const moved = { ...item, polygon: item.polygon.map(move) };
  if (Array.isArray(item.holes)) moved.holes = item.holes.map((/** @type {Place[]} */ ring) => ring.map(move));
  return moved;
}

/** @type {import("./shape.js").Shape} */
export const polygon = {
  key: "polygon",
  name: "polygon",
  icon: "M5 9l7-5 8 6-3 10H8z",
  hasOutline: true,
  hasSides: true,
  tool: { label: "Draw a polygon", key: "P", words: "polygon", close: (corners) => ({ polygon: corners }) },
  vertexName: "corner",
  isSound: (item) => Array.isArray(item.polygon) && item.polygon.length >= FEWEST_CORNERS,
  title: (item) => `polygon of ${item.polygon.length} corners`,
  usualName: () => null,
  trace(pen, item) {
    for (const ring of ringsOf(item)) pen.ring(ring);
  },
  isPierced: (item) => ringsOf(item).length > 1,
  svg(item, look) {
    const rings = ringsOf(item).map((ring) => `M${ring.map((p) => p.slice(0, 2).join(" ")).join("L")}Z`);
    return `<path d="${rings.join("")}" fill-rule="evenodd" ${look}/>`;
  },
  box: (item) => boxOf(item.polygon),
  covers(p, item) {
    const [outer, ...holes] = ringsOf(item);
    return inside(p, outer) && !holes.some((hole) => inside(p, hole));
  },
  edgeNear: (p, item) => ringsOf(item).map((ring) => toRing(p, ring)).reduce((a, b) => (b.away < a.away ? b : a)).at,
  anchor: (item) => middle(item.polygon),
  movedTo(item, at) {
    const from = middle(item.polygon);
    const [dx, dy] = [at[0] - from[0], at[1] - from[1]];
    return mapped(item, ([x, y]) => [tidy(x + dx), tidy(y + dy)]);
  },
  mapped,
  reach: (item) => Math.max(...item.polygon.map((/** @type {Place} */ [x, y]) => Math.hypot(x, y))),
  vertices: (item) => item.polygon,
  vertexAt: ([key, index]) => (key === "polygon" && typeof index === "number" ? index : -1),
  withVertex: (item, vertex, at) => ({ ...item, polygon: item.polygon.map((/** @type {Place} */ p, /** @type {number} */ i) => (i === vertex ? at : p)) }),
  withNewVertex: (item, after, at) => ({ ...item, polygon: [...item.polygon.slice(0, after + 1), at, ...item.polygon.slice(after + 1)] }),
  withoutVertex(item, vertex) {
    if (item.polygon.length <= FEWEST_CORNERS) return null;
    return { ...item, polygon: item.polygon.filter((/** @type {Place} */ _, /** @type {number} */ i) => i !== vertex) };
  },
  handles({ polygon: ring }, scale) {
    /** @type {ShapeHandle[]} */ const corners = ring.map((/** @type {Place} */ at, /** @type {number} */ vertex) => ({ role: "corner", at, vertex }));
    /** @type {ShapeHandle[]} */ const middles = ring.flatMap((/** @type {Place} */ p, /** @type {number} */ vertex) => {
      const q = ring[(vertex + 1) % ring.length];
      if (Math.hypot(p[0] - q[0], p[1] - q[1]) * scale <= SHORTEST_SPLIT_PX) return [];
      return [{ role: "new-corner", at: [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], vertex }];
    });
    return [...corners, ...middles];
  },
  dragged: (item) => item,
  fields: () => [],
};
