/** Balls in space: seen from above a disc. */

import { circle } from "./circle.js";

/** @typedef {import("./shape.js").Item} Item */

const SMALLEST_M = 0.01;

/** As a circle, to be drawn. @param {Item} item @returns {Item} */
const seen = (item) => ({ circle: { center: item.ball.center.slice(0, 2), radius: item.ball.radius } });
/** @param {Item} item @param {any} change @returns {Item} */
const withBall = (item, change) => ({ ...item, ball: { ...item.ball, ...change } });

/** @type {import("./shape.js").Shape} */
export const ball = {
  ...circle,
  key: "ball",
  name: "ball",
  icon: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16zM4 12c4 4 12 4 16 0",
  tool: null,
  isSound: ({ ball: b }) => Array.isArray(b?.center) && b.center.length === 3 && Number.isFinite(b?.radius),
  title: () => "ball",
  trace: (pen, item) => circle.trace(pen, seen(item)),
  svg: (item, look) => circle.svg(seen(item), look),
  box: (item) => circle.box(seen(item)),
  covers: (p, item) => circle.covers(p, seen(item)),
  edgeNear: (p, item) => circle.edgeNear(p, seen(item)),
  anchor: (item) => item.ball.center.slice(0, 2),
  movedTo: (item, at) => withBall(item, { center: [at[0], at[1], item.ball.center[2]] }),
  mapped: (item, move) => withBall(item, { center: [...move(item.ball.center.slice(0, 2)), item.ball.center[2]] }),
  reach: (item) => circle.reach(seen(item)),
  handles: (item, scale) => circle.handles(seen(item), scale),
  dragged: (item, role, at, snapped) => {
    const next = circle.dragged(seen(item), role, at, snapped);
    return withBall(item, { radius: next.circle.radius });
  },
  fields: (item) => [
    { type: "number", label: "Height of the middle", unit: "m", min: -10000, value: item.ball.center[2], put: (now, z) => withBall(now, { center: [...now.ball.center.slice(0, 2), z] }) },
    { type: "number", label: "Radius", unit: "m", min: SMALLEST_M, value: item.ball.radius, put: (now, radius) => withBall(now, { radius: Math.max(radius, SMALLEST_M) }) },
  ],
};
