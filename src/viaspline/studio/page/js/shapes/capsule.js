/** Capsules: pipes, hedges, cables on the ground. A line and a radius. */

import { middle, toSegment } from "../geometry/rings.js";
import { tidy } from "../units.js";
import { NO_VERTICES } from "./shape.js";

/** @typedef {import("./shape.js").Item} Item */
/** @typedef {import("./shape.js").Place} Place */

const SMALLEST_M = 0.01;
const USUAL_SHARE = 0.1; // of the length: the radius of one that is drawn
const ARC_PARTS = 16; // of the half circle at either end
const ENDS = ["from", "to"];

/** @param {Place} from @param {Place} to @returns {Item} */
const capsuleOf = (from, to) => {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  return { capsule: { from, to, radius: Math.max(tidy(USUAL_SHARE * length), SMALLEST_M) } };
};

/** @param {Item} item @param {number} radius @returns {Item} */
const withRadius = (item, radius) => ({ ...item, capsule: { ...item.capsule, radius: Math.max(tidy(radius), SMALLEST_M) } });

/** The outline as a ring. @param {Item} item @returns {Place[]} */
function outline({ capsule: { from, to, radius } }) {
  const along = Math.atan2(to[1] - from[1], to[0] - from[0]);
  /** @type {Place[]} */ const ring = [];
  for (const [[x, y], first] of /** @type {[Place, number][]} */ ([[to, along - Math.PI / 2], [from, along + Math.PI / 2]])) {
    for (let k = 0; k <= ARC_PARTS; k += 1) {
      const angle = first + (k * Math.PI) / ARC_PARTS;
      ring.push([x + radius * Math.cos(angle), y + radius * Math.sin(angle)]);
    }
  }
  return ring;
}

/** How far a place is from the line, and the line's nearest. @param {Place} p @param {Item} item */
const toLine = (p, { capsule: { from, to } }) => toSegment(p, from, to);

/** A place with the height that an end has, if it has one. @param {Place} at @param {Place} end @returns {Place} */
const asHigh = (at, end) => [...at.slice(0, 2), ...end.slice(2)];

/** The height of an end, if it has one. @param {Item} item @param {string} end @returns {import("./shape.js").ShapeField[]} */
const heightField = (item, end) => (item.capsule[end].length < 3 ? [] : [{
  type: "number", label: end === "from" ? "Height at its first end" : "Height at its last end", unit: "m", min: -10000, value: item.capsule[end][2],
  put: (now, z) => ({ ...now, capsule: { ...now.capsule, [end]: [...now.capsule[end].slice(0, 2), z] } }),
}]);

/** @type {import("./shape.js").Shape} */
export const capsule = {
  ...NO_VERTICES,
  key: "capsule",
  name: "capsule",
  icon: "M4 15a4 4 0 0 0 6 5L20 10a4 4 0 0 0-6-5z",
  hasOutline: true,
  hasSides: true,
  tool: {
    label: "Draw a capsule", key: "I", words: "capsule",
    drag: (from, to, snapped) => {
      const [a, b] = [snapped(from), snapped(to)];
      return a[0] === b[0] && a[1] === b[1] ? capsuleOf(a, [tidy(a[0] + 1), a[1]]) : capsuleOf(a, b);
    },
    click: (at, size) => capsuleOf([tidy(at[0] - size), at[1]], [tidy(at[0] + size), at[1]]),
  },
  vertexName: "end",
  isSound: ({ capsule: c }) => Array.isArray(c?.from) && Array.isArray(c?.to) && Number.isFinite(c?.radius),
  title: () => "capsule",
  usualName: () => null,
  trace: (pen, item) => pen.ring(outline(item)),
  isPierced: () => false,
  svg: (item, look) => `<path d="M${outline(item).map((p) => p.join(" ")).join("L")}Z" ${look}/>`,
  box({ capsule: { from, to, radius } }) {
    const low = [0, 1].map((k) => Math.min(from[k], to[k]) - radius);
    return [...low, ...[0, 1].map((k) => Math.max(from[k], to[k]) + radius)];
  },
  covers: (p, item) => toLine(p, item).away <= item.capsule.radius,
  edgeNear(p, item) {
    const { at, away } = toLine(p, item);
    const reach = item.capsule.radius / (away || 1e-9);
    return [at[0] + (p[0] - at[0]) * reach, at[1] + (p[1] - at[1]) * reach];
  },
  anchor: ({ capsule: { from, to } }) => middle([from, to]),
  movedTo(item, at) {
    const from = middle([item.capsule.from, item.capsule.to]);
    const move = (/** @type {Place} */ p) => asHigh([tidy(p[0] + at[0] - from[0]), tidy(p[1] + at[1] - from[1])], p);
    return { ...item, capsule: { ...item.capsule, from: move(item.capsule.from), to: move(item.capsule.to) } };
  },
  mapped: (item, move) => ({ ...item, capsule: { ...item.capsule, from: asHigh(move(item.capsule.from), item.capsule.from), to: asHigh(move(item.capsule.to), item.capsule.to) } }),
  reach: ({ capsule: { from, to, radius } }) => Math.max(Math.hypot(from[0], from[1]), Math.hypot(to[0], to[1])) + radius,
  vertices: ({ capsule: { from, to } }) => [from, to],
  vertexAt: ([key, end]) => (key === "capsule" ? ENDS.indexOf(String(end)) : -1),
  withVertex: (item, vertex, at) => ({ ...item, capsule: { ...item.capsule, [ENDS[vertex]]: asHigh(at, item.capsule[ENDS[vertex]]) } }),
  handles({ capsule: { from, to, radius } }) {
    const [x, y] = middle([from, to]);
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1e-9;
    const across = [-(to[1] - from[1]) / length, (to[0] - from[0]) / length];
    return [
      ...[from, to].map((at, vertex) => ({ role: "corner", at, vertex })),
      { role: "radius", at: [x + radius * across[0], y + radius * across[1]], vertex: -1 },
    ];
  },
  dragged: (item, _, at, snapped) => withRadius(item, snapped([toLine(at, item).away])[0]),
  fields: (item) => [...heightField(item, "from"), ...heightField(item, "to"), {
    type: "number", label: "Radius", unit: "m", min: SMALLEST_M, value: item.capsule.radius,
    put: withRadius,
  }],
};
