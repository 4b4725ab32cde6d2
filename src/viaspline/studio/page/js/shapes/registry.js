/** The kinds of obstacles that the page knows, in the order of their tools. */

import { ball } from "./ball.js";
import { box } from "./box.js";
import { capsule } from "./capsule.js";
import { circle } from "./circle.js";
import { map } from "./map.js";
import { movingShape } from "./moving.js";
import { polygon } from "./polygon.js";
import { tracks } from "./tracks.js";
import { voxels } from "./voxels.js";
import { isMotion } from "../geometry/motion.js";

/** @typedef {import("./shape.js").Shape} Shape */

/** @type {readonly Shape[]} */
export const SHAPES = [
  circle,
  capsule,
  polygon,
  ball,
  box,
  voxels,
  map,
  tracks,
];

const MOVING = new Map(SHAPES.filter((shape) => shape.hasOutline).map((shape) => [shape, movingShape(shape)]));

/** The kind of an obstacle; null if it is none that can be drawn. @param {any} item */
export function shapeOf(item) {
  const shape = standingShapeOf(item);
  if (!shape || !item.motion) return shape;
  return isMotion(item.motion) ? MOVING.get(shape) ?? null : null;
}

/** The kind of an obstacle as it is if nothing moves it. @param {any} item */
export const standingShapeOf = (item) => (item ? SHAPES.find((shape) => shape.isSound(item)) ?? null : null);

/** The vertex that a path within an obstacle leads to, or -1. @param {(string|number)[]} path */
export const vertexAt = (path) => Math.max(-1, ...[...SHAPES, ...MOVING.values()].map((shape) => shape.vertexAt(path)));

/** Kinds that are drawn by hand. */
export const DRAWN = SHAPES.flatMap((shape) => (shape.tool ? [{ shape, tool: shape.tool }] : []));
