/** Discs: a centre and a radius. */

import { tidy } from "../units.js";
import { NO_VERTICES } from "./shape.js";

/** @typedef {import("./shape.js").Item} Item */
/** @typedef {import("./shape.js").Place} Place */

const SMALLEST_TYPED_M = 0.01;
const SMALLEST_DRAWN_M = 0.05;

/** @param {Place} center @param {number} radius @returns {Item} */
const disc = (center, radius) => ({ circle: { center, radius } });

/** @param {Item} item @param {number} radius @returns {Item} */
const withRadius = (item, radius) => ({ ...item, circle: { ...item.circle, radius: Math.max(radius, SMALLEST_TYPED_M) } });

/** @param {Place} center @param {Place} at @param {(at: Place) => Place} snapped */
const radiusTo = (center, at, snapped) => snapped([Math.hypot(at[0] - center[0], at[1] - center[1])])[0];

/** @type {import("./shape.js").Shape} */
export const circle = {
  ...NO_VERTICES,
  key: "circle",
  name: "circle",
  icon: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16z",
  hasOutline: true,
  hasSides: true,
  tool: {
    label: "Draw a circle", key: "C", words: "circle",
    drag: (from, to, snapped) => disc(snapped(from), Math.max(radiusTo(snapped(from), to, snapped) || 0, SMALLEST_DRAWN_M)),
    click: (at, size) => disc(at, Math.max(tidy(size), SMALLEST_DRAWN_M)),
  },
  isSound: (item) => Array.isArray(item.circle?.center) && Number.isFinite(item.circle?.radius),
  title: () => "circle",
  usualName: () => null,
  trace(pen, { circle: { center, radius } }) {
    pen.disc(center[0], center[1], radius);
  },
  isPierced: () => false,
  svg: ({ circle: { center, radius } }, look) => `<circle cx="${center[0]}" cy="${center[1]}" r="${radius}" ${look}/>`,
  box: ({ circle: { center: [x, y], radius: r } }) => [x - r, y - r, x + r, y + r],
  covers: (p, { circle: { center, radius } }) => Math.hypot(p[0] - center[0], p[1] - center[1]) <= radius,
  edgeNear(p, { circle: { center: [x, y], radius } }) {
    const away = Math.hypot(p[0] - x, p[1] - y) || 1e-9;
    return [x + ((p[0] - x) * radius) / away, y + ((p[1] - y) * radius) / away];
  },
  anchor: (item) => item.circle.center,
  movedTo: (item, at) => ({ ...item, circle: { ...item.circle, center: at } }),
  mapped: (item, move) => ({ ...item, circle: { ...item.circle, center: move(item.circle.center) } }),
  reach: ({ circle: { center, radius } }) => Math.hypot(center[0], center[1]) + radius,
  handles: ({ circle: { center: [x, y], radius } }) => [{ role: "radius", at: [x + radius, y], vertex: -1 }],
  dragged: (item, _, at, snapped) => withRadius(item, radiusTo(item.circle.center, at, snapped)),
  fields: (item) => [{
    type: "number", label: "Radius", unit: "m", min: SMALLEST_TYPED_M, value: item.circle.radius,
    put: withRadius,
  }],
};
