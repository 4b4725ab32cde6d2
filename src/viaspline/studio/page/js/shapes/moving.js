/**
 * What moves: any kind that has an outline, with a motion. Its own outline stands in a frame that the
 * motion carries along, so on the map its keyframes are what can be taken hold of.
 */

import { frameAt, isLifted } from "../geometry/motion.js";
import { boxOf } from "../geometry/rings.js";
import { tidy } from "../units.js";
import { NO_VERTICES } from "./shape.js";

/** @typedef {import("./shape.js").Item} Item */
/** @typedef {import("./shape.js").Place} Place */
/** @typedef {import("./shape.js").ShapeHandle} ShapeHandle */

const SHORTEST_SPLIT_PX = 44; // between two keyframes that have a handle for a new one
const MOST_HANDLES = 200; // of one thing
const ARROW_S = 1; // an arrow is as long as the way in this time

/** @param {Item} item @param {any} motion @returns {Item} */
const withMotion = (item, motion) => ({ ...item, motion });

/** How many keyframes a motion needs: what goes on and on needs a way. @param {any} motion */
export const fewestOf = ({ after }) => (after === "loop" || after === "bounce" ? 2 : 1);

/** A keyframe on the way after another, or beyond the last by the step before it. @param {Item} item @param {number} after @param {Place} [at] @returns {Item} */
export function withKeyframe({ ...item }, after, at) {
  const { motion } = item;
  const frames = motion.keyframes;
  const [a, b] = [frames[after], frames[after + 1]];
  const before = frames[after - 1];
  const time = b ? (a[0] + b[0]) / 2 : a[0] + (before ? a[0] - before[0] : 5);
  const way = frameAt({ keyframes: frames, after: "stay" }, time);
  const beyond = before ? [2 * a[1] - before[1], 2 * a[2] - before[2]] : [a[1] + 1, a[2]];
  const place = at ?? (b && way ? [way.x, way.y] : beyond);
  const isTurned = frames.some((/** @type {number[]} */ k) => k.length > 3);
  const heading = isTurned && way ? [tidy((way.heading * 180) / Math.PI)] : [];
  const height = isLifted(motion) && way ? [tidy(way.z)] : [];
  const frame = [tidy(time), tidy(place[0]), tidy(place[1]), ...heading, ...height];
  return withMotion(item, { ...motion, keyframes: [...frames.slice(0, after + 1), frame, ...frames.slice(after + 1)] });
}

/** The place that moves all of it. @param {Item} item @returns {Place} */
const anchor = ({ motion }) => (motion.keyframes ? motion.keyframes[0].slice(1, 3) : motion.from.slice(0, 2));

/** @param {Item} item @param {Place} at @returns {Item} */
function movedTo(item, at) {
  const { motion } = item;
  const from = anchor(item);
  if (!motion.keyframes) return withMotion(item, { ...motion, from: [at[0], at[1], ...motion.from.slice(2)] });
  const [dx, dy] = [at[0] - from[0], at[1] - from[1]];
  const moved = motion.keyframes.map((/** @type {number[]} */ [t, x, y, ...rest]) => [t, tidy(x + dx), tidy(y + dy), ...rest]);
  return withMotion(item, { ...motion, keyframes: moved });
}

/** @param {import("./shape.js").Shape} inner @returns {import("./shape.js").Shape} */
export const movingShape = (inner) => ({
  ...NO_VERTICES,
  key: inner.key,
  name: `moving ${inner.name}`,
  icon: inner.icon,
  hasOutline: false,
  hasSides: false,
  tool: null,
  vertexName: "keyframe",
  isSound: (item) => inner.isSound(item),
  title: (item) => `${inner.title(item)} that moves`,
  usualName: (item) => inner.usualName(item),
  trace: (pen, item) => inner.trace(pen, item),
  isPierced: (item) => inner.isPierced(item),
  svg: () => "",
  box(item) {
    const reach = inner.reach(item);
    const box = boxOf(item.motion.keyframes ? item.motion.keyframes.map((/** @type {number[]} */ k) => k.slice(1, 3)) : [item.motion.from.slice(0, 2)]);
    return box && box.map((value, i) => value + (i < 2 ? -reach : reach));
  },
  covers: (p, item) => inner.covers(p, item),
  edgeNear: (p, item) => inner.edgeNear(p, item),
  reach: (item) => inner.reach(item),
  anchor,
  movedTo,
  mapped: (item) => item,
  vertices: ({ motion }) => (motion.keyframes ?? []).map((/** @type {number[]} */ k) => k.slice(1, 3)),
  vertexAt: ([key, list, index]) => (key === "motion" && list === "keyframes" && typeof index === "number" ? index : -1),
  withVertex: (item, vertex, at) => withMotion(item, {
    ...item.motion, keyframes: item.motion.keyframes.map((/** @type {number[]} */ k, /** @type {number} */ i) => (i === vertex ? [k[0], ...at, ...k.slice(3)] : k)),
  }),
  withNewVertex: withKeyframe,
  withoutVertex(item, vertex) {
    const { keyframes } = item.motion;
    if (keyframes.length <= fewestOf(item.motion)) return null;
    return withMotion(item, { ...item.motion, keyframes: keyframes.filter((/** @type {any} */ _, /** @type {number} */ i) => i !== vertex) });
  },
  handles({ motion }, scale) {
    if (!motion.keyframes) {
      const [x, y] = motion.from, [vx, vy] = motion.velocity_mps;
      return [{ role: "velocity", at: [x + vx * ARROW_S, y + vy * ARROW_S], vertex: -1 }, { role: "from", at: [x, y], vertex: -1 }];
    }
    const places = motion.keyframes.slice(0, MOST_HANDLES).map((/** @type {number[]} */ k) => k.slice(1, 3));
    /** @type {ShapeHandle[]} */ const corners = places.map((/** @type {Place} */ at, /** @type {number} */ vertex) => ({ role: "corner", at, vertex }));
    /** @type {ShapeHandle[]} */ const middles = places.slice(1).flatMap((/** @type {Place} */ q, /** @type {number} */ vertex) => {
      const p = places[vertex];
      if (Math.hypot(p[0] - q[0], p[1] - q[1]) * scale <= SHORTEST_SPLIT_PX) return [];
      return [{ role: "new-corner", at: [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], vertex }];
    });
    return [...corners, ...middles];
  },
  dragged(item, role, at, snapped) {
    const place = snapped(at);
    if (role !== "velocity") return movedTo(item, place);
    const [x, y] = item.motion.from;
    return withMotion(item, { ...item.motion, velocity_mps: [tidy((place[0] - x) / ARROW_S), tidy((place[1] - y) / ARROW_S), ...item.motion.velocity_mps.slice(2)] });
  },
  fields: (item) => inner.fields(item),
});
