/** The kinds of obstacles that the page knows, in the order of their tools. */

import { capsule } from "./capsule.js";
import { circle } from "./circle.js";
import { map } from "./map.js";
import { polygon } from "./polygon.js";

/** @typedef {import("./shape.js").Shape} Shape */

/** @type {readonly Shape[]} */
export const SHAPES = [
  circle,
  capsule,
  polygon,
  map,
];

/** The kind of an obstacle; null if it is none that can be drawn. @param {any} item */
export const shapeOf = (item) => (item ? SHAPES.find((shape) => shape.isSound(item)) ?? null : null);

/** The vertex that a path within an obstacle leads to, or -1. @param {(string|number)[]} path */
export const vertexAt = (path) => Math.max(-1, ...SHAPES.map((shape) => shape.vertexAt(path)));

/** Kinds that are drawn by hand. */
export const DRAWN = SHAPES.flatMap((shape) => (shape.tool ? [{ shape, tool: shape.tool }] : []));
