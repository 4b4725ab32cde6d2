/** Boxes in space: seen from above a rectangle, turned by its yaw about its middle. */

import { middle } from "../geometry/rings.js";
import { tidy } from "../units.js";
import { polygon } from "./polygon.js";
import { NO_VERTICES } from "./shape.js";

/** @typedef {import("./shape.js").Item} Item */
/** @typedef {import("./shape.js").Place} Place */

/** Its corners from above. @param {Item} item @returns {Place[]} */
function cornersOf({ box: { min, max, yaw_deg: yaw = 0 } }) {
  const [x, y] = middle([min, max]);
  const c = Math.cos((yaw * Math.PI) / 180), s = Math.sin((yaw * Math.PI) / 180);
  const half = [(max[0] - min[0]) / 2, (max[1] - min[1]) / 2];
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => [x + c * a * half[0] - s * b * half[1], y + s * a * half[0] + c * b * half[1]]);
}

/** As a polygon, to be drawn. @param {Item} item @returns {Item} */
const seen = (item) => ({ polygon: cornersOf(item) });
/** @param {Item} item @param {any} change @returns {Item} */
const withBox = (item, change) => ({ ...item, box: { ...item.box, ...change } });
/** @param {string} end @returns {(item: Item, z: number) => Item} */
const withHeight = (end) => (item, z) => withBox(item, { [end]: [...item.box[end].slice(0, 2), z] });

/** @type {import("./shape.js").Shape} */
export const box = {
  ...NO_VERTICES,
  key: "box",
  name: "box",
  icon: "M12 3l8 4.500v9L12 21l-8-4.500v-9zM4 7.500l8 4.500 8-4.500M12 12v9",
  hasOutline: true,
  hasSides: true,
  tool: null,
  isSound: ({ box: b }) => [b?.min, b?.max].every((end) => Array.isArray(end) && end.length === 3 && end.every(Number.isFinite)),
  title: () => "box",
  usualName: () => null,
  trace: (pen, item) => polygon.trace(pen, seen(item)),
  isPierced: () => false,
  svg: (item, look) => polygon.svg(seen(item), look),
  box: (item) => polygon.box(seen(item)),
  covers: (p, item) => polygon.covers(p, seen(item)),
  edgeNear: (p, item) => polygon.edgeNear(p, seen(item)),
  anchor: (item) => middle([item.box.min, item.box.max]),
  movedTo(item, at) {
    const from = middle([item.box.min, item.box.max]);
    const moved = (/** @type {number[]} */ p) => [tidy(p[0] + at[0] - from[0]), tidy(p[1] + at[1] - from[1]), p[2]];
    return withBox(item, { min: moved(item.box.min), max: moved(item.box.max) });
  },
  handles: () => [],
  dragged: (item) => item,
  fields: (item) => [
    { type: "number", label: "Floor", unit: "m", min: -10000, value: item.box.min[2], put: withHeight("min") },
    { type: "number", label: "Roof", unit: "m", min: -10000, value: item.box.max[2], put: withHeight("max") },
  ],
};
