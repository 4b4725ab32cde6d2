/** Heights in a mission document: whether it says any, that of each point of the route, how it is changed. */

import { number, tidy } from "../units.js";
import { part, replaced } from "./diff.js";
import { isPoint, pathOf, placeOf } from "./mission.js";

/** @typedef {import("./diff.js").Path} Path */

const ROBOT_KEYS = ["half_height_m", "max_climb_mps", "max_descent_mps", "max_vertical_accel_mps2"];
const SOLID_KEYS = ["height_m", "ball", "box", "voxels"];
const has = (/** @type {any} */ data, /** @type {string[]} */ keys) => keys.some((key) => data?.[key] !== undefined && data[key] !== null);
const listed = (/** @type {any} */ value) => (Array.isArray(value) ? value : []);

/** Whether a document holds a mission in space, sound or not. @param {any} doc */
export function isSpatial(doc) {
  const { world, robot, route } = doc ?? {};
  const points = [route?.start, route?.goal, ...listed(route?.via)];
  return has(world, ["altitude", "ground"]) || has(robot, ROBOT_KEYS) || has(route, ["takeoff", "land", "yaw"])
    || points.some((point) => has(point, ["agl_m", "look_at", "gate"]))
    || [...listed(world?.known), ...listed(world?.unseen)].some(isSolid);
}

/** @param {any} item */
function isSolid(item) {
  const { from, to } = item?.capsule ?? {};
  return has(item, SOLID_KEYS) || [from, to].some((end) => Array.isArray(end) && end.length === 3)
    || [item?.pass_on, item?.never_pass_on].some((side) => side === "over" || side === "under");
}

/**
 * What says how high a point is.
 * @typedef {object} Height
 * @property {"agl"|"z"|"takeoff"} kind above the ground under it, absolute, or where take-off ends
 * @property {number} value [m]
 * @property {Path} path where that stands in the document
 */

/** The height of a point of the route; null if nothing can change it. @param {any} doc @param {string|null} id @returns {Height|null} */
export function heightOf(doc, id) {
  if (!isPoint(id) || id === "land") return null;
  const path = pathOf(/** @type {string} */ (id));
  const point = part(doc, path);
  const lift = doc?.route?.takeoff?.to_agl_m;
  if (id === "start" && Number.isFinite(lift)) return { kind: "takeoff", value: lift, path: ["route", "takeoff", "to_agl_m"] };
  if (Number.isFinite(point?.agl_m)) return { kind: "agl", value: point.agl_m, path: [...path, "agl_m"] };
  const at = placeOf(point);
  if (at?.length !== 3) return null;
  const there = Array.isArray(point) ? path : point.gate && !point.at ? [...path, "gate", "at"] : [...path, "at"];
  return { kind: "z", value: at[2], path: [...there, 2] };
}

/** How high a point is, for a list; null where heights mean nothing. @param {any} doc @param {string} id */
export function heightWords(doc, id) {
  const height = heightOf(doc, id);
  if (!height) return null;
  const value = number(height.value, 1);
  return height.kind === "z" ? { short: `${value} m`, whole: `height ${value} m` } : { short: `${value} m AGL`, whole: `${value} m above the ground` };
}

/** The document with another height of a point, counted as it is there. @param {any} doc @param {string} id @param {number} value [m] */
export function withHeight(doc, id, value) {
  const height = heightOf(doc, id);
  if (!height) return doc;
  const least = height.kind === "takeoff" ? 0.1 : -Infinity;
  return replaced(doc, height.path, tidy(Math.max(value, least)));
}

/** A via point at a place in the plane, as high as one beside it in the route. @param {any} doc @param {number} index @param {number[]} at */
export function viaLike(doc, index, at) {
  const via = listed(doc?.route?.via);
  const beside = [via[index - 1], via[index], ...via];
  const like = beside.find((point) => Number.isFinite(point?.agl_m) || placeOf(point)?.length === 3);
  const lift = doc?.route?.takeoff?.to_agl_m;
  if (Number.isFinite(like?.agl_m)) return { at, agl_m: like.agl_m };
  const z = placeOf(like)?.[2] ?? placeOf(doc?.route?.start)?.[2];
  if (z !== undefined) return [...at, z];
  return isSpatial(doc) ? { at, agl_m: Number.isFinite(lift) ? lift : 10 } : at;
}
