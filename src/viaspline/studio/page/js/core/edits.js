/** What can be done to a mission: each edit takes a document and gives another one. */

import { tidy } from "../units.js";
import { viaLike } from "./heights.js";
import { isArea, isObstacle, isPoint, part, pathOf, placeOf, pointsOf, refOf, replaced, shapedAt, spanCount, tensionsOf } from "./mission.js";

/** @typedef {any} Doc */

/** @param {Doc} doc @param {string} id @param {number[]} at */
export function moveTo(doc, id, at) {
  const ref = /** @type {import("./mission.js").Ref} */ (refOf(id));
  const path = pathOf(id);
  const item = part(doc, path);
  if (isPoint(id)) {
    const old = placeOf(item);
    const place = [...at, ...(old?.slice(2) ?? [])];
    const key = item?.gate && !item.at ? ["gate", "at"] : ["at"]; // of a gate: its middle
    return replaced(doc, Array.isArray(item) ? path : [...path, ...key], place);
  }
  if (ref.kind === "bounds") return replaced(doc, path, withCorner(item, ref.vertex, at));
  return reshaped(doc, id, (shape, one) => (ref.vertex >= 0 ? shape.withVertex(one, ref.vertex, at) : shape.movedTo(one, at)));
}

/** @param {number[]} box @param {number} corner @param {number[]} at */
function withCorner(box, corner, at) {
  const [x, y] = at;
  const [x0, y0, x1, y1] = box;
  const sides = [[x, y, x1, y1], [x0, y, x, y1], [x0, y0, x, y], [x, y0, x1, y]][corner];
  return sides[0] < sides[2] && sides[1] < sides[3] ? sides : box;
}

/**
 * Let the kind of an obstacle or an area change it.
 * @param {Doc} doc @param {string} id
 * @param {(shape: import("../shapes/shape.js").Shape, item: import("../shapes/shape.js").Item) => import("../shapes/shape.js").Item|null} change
 * @returns {Doc} the same if it can't be done
 */
export function reshaped(doc, id, change) {
  const found = shapedAt(doc, id);
  const next = found && change(found.shape, found.item);
  return found && next && next !== found.item ? found.put(next) : doc;
}

/**
 * Set a key of a point, whichever of its two forms it has; undefined takes it out.
 * @param {Doc} doc @param {string} id @param {string} key @param {unknown} value
 */
export function setOnPoint(doc, id, key, value) {
  const path = pathOf(id);
  const item = part(doc, path);
  const mapping = Array.isArray(item) ? { at: item } : item;
  const next = replaced(mapping, [key], value);
  return replaced(doc, path, Object.keys(next).length === 1 && next.at ? next.at : next);
}

/** Set any key of an item. @param {Doc} doc @param {string} id @param {string} key @param {unknown} value */
export function setKey(doc, id, key, value) {
  return isPoint(id) ? setOnPoint(doc, id, key, value) : replaced(doc, [...pathOf(id), key], value);
}

/**
 * Put a via point at a place in the route; spans that have tensions of their own keep them.
 * @param {Doc} doc @param {number} index @param {number[]} at
 */
export function addVia(doc, index, at) {
  const via = doc.route?.via ?? [];
  const place = viaLike(doc, index, at);
  const next = replaced(doc, ["route", "via"], [...via.slice(0, index), place, ...via.slice(index)]);
  return withTensions(next, (list) => [...list.slice(0, index), list[index] ?? 0, ...list.slice(index)], doc);
}

/** @param {Doc} doc @param {string} id @returns {Doc} the same if it can't be taken out */
export function remove(doc, id) {
  const ref = /** @type {import("./mission.js").Ref} */ (refOf(id));
  if (ref.kind === "via") {
    const next = replaced(doc, pathOf(id), undefined);
    return withTensions(next, (list) => list.filter((_, i) => i !== ref.index), doc);
  }
  if ((ref.kind === "goal" || ref.kind === "land") && pointsOf(doc).length > 2) {
    const next = replaced(doc, pathOf(id), undefined);
    return withTensions(next, (list) => list.slice(0, -1), doc);
  }
  if (ref.vertex >= 0) return reshaped(doc, id, (shape, item) => shape.withoutVertex(item, ref.vertex));
  if (isArea(id)) return withoutEmpty(replaced(doc, pathOf(id), undefined), pathOf(id).slice(0, -1));
  return isObstacle(id) ? replaced(doc, pathOf(id), undefined) : doc;
}

/** Take out a list that is empty. @param {Doc} doc @param {(string|number)[]} path */
const withoutEmpty = (doc, path) => (part(doc, path)?.length === 0 ? replaced(doc, path, undefined) : doc);

/**
 * Change a list of tensions along with the spans; one number for all stays one number.
 * @param {Doc} doc @param {(list: number[]) => number[]} change @param {Doc} before
 */
function withTensions(doc, change, before) {
  for (const key of ["tension", "slack"]) {
    const list = before.spline?.[key];
    if (Array.isArray(list)) return replaced(doc, ["spline", key], change(list).slice(0, spanCount(doc)));
  }
  return doc;
}

/** @param {Doc} doc @param {number} from @param {number} to place in the list of via points */
export function moveVia(doc, from, to) {
  const via = [...(doc.route?.via ?? [])];
  if (to < 0 || to >= via.length || from === to) return doc;
  const [item] = via.splice(from, 1);
  via.splice(to, 0, item);
  return replaced(doc, ["route", "via"], via);
}

/** @param {Doc} doc @param {"known"|"unseen"} list @param {any} obstacle */
export function addObstacle(doc, list, obstacle) {
  const items = doc.world?.[list] ?? [];
  return replaced(doc, ["world", list], [...items, obstacle]);
}

/** Add a fence or a speed zone. @param {Doc} doc @param {"fence"|"zone"} kind @param {number[][]} ring @returns {[Doc, string]} */
export function addArea(doc, kind, ring) {
  const key = kind === "fence" ? "fences" : "speed_zones";
  const items = doc.world?.[key] ?? [];
  const slow = tidy(Number(doc.robot?.max_speed_mps ?? 2) / 2);
  const item = kind === "fence" ? ring : { polygon: ring, max_speed_mps: slow };
  return [replaced(doc, ["world", key], [...items, item]), `${kind}:${items.length}`];
}

/** Move an obstacle to the other list. @param {Doc} doc @param {string} id @returns {[Doc, string]} */
export function toggleUnseen(doc, id) {
  const ref = /** @type {import("./mission.js").Ref} */ (refOf(id));
  const path = ["world", ref.kind, ref.index];
  const item = part(doc, path);
  const other = ref.kind === "known" ? "unseen" : "known";
  let next = addObstacle(replaced(doc, path, undefined), other, item);
  if (other === "unseen" && !next.robot?.sensor) {
    next = replaced(next, ["robot", "sensor"], { range_m: 20 }); // else the mission isn't sound
  }
  return [next, `${other}:${next.world[other].length - 1}`];
}

/** Insert a vertex after another. @param {Doc} doc @param {string} id @param {number} after @param {number[]} at */
export const addVertex = (doc, id, after, at) => reshaped(doc, id, (shape, item) => shape.withNewVertex(item, after, at));

/** Set the tension of one span, or of all. @param {Doc} doc @param {number|null} span @param {number} tension */
export function setTension(doc, span, tension) {
  const isSlack = doc.spline?.slack !== undefined && doc.spline?.slack !== null;
  const value = Math.round(Math.min(1, tension) * 100) / 100;
  const own = isSlack ? tidy((1 - value) / 2) : value;
  const key = isSlack ? "slack" : "tension";
  if (span === null) return replaced(doc, ["spline", key], own);
  const list = tensionsOf(doc).map((t) => (isSlack ? tidy((1 - t) / 2) : t));
  list[span] = own;
  return replaced(doc, ["spline", key], list);
}

/** Set the tension of all spans or of each; null states none. @param {Doc} doc @param {number|number[]|null} tension */
export function withSpline(doc, tension) {
  const { tension: _, slack: __, ...spline } = doc.spline ?? {};
  const next = tension === null ? spline : { ...spline, tension };
  return replaced(doc, ["spline"], Object.keys(next).length ? next : undefined);
}

/** Force a side of some obstacles, or free them (null). @param {Doc} doc @param {number[]} items @param {string|null} side */
export function forceSide(doc, items, side) {
  let next = doc;
  for (const i of items) {
    if (!part(next, ["world", "known", i])) continue;
    next = replaced(next, ["world", "known", i, "never_pass_on"], undefined);
    next = replaced(next, ["world", "known", i, "pass_on"], side ?? undefined);
  }
  return next;
}

/** Close the route or open it. @param {Doc} doc @param {boolean} closed */
export function setClosed(doc, closed) {
  let next = doc;
  const goal = doc.route?.goal;
  if (closed && goal !== undefined && goal !== null) {
    // The goal becomes a via point: a closed route ends at its start.
    const { heading_deg: _, ...rest } = Array.isArray(goal) ? { at: goal } : goal;
    const plain = Object.keys(rest).length === 1 ? rest.at : rest;
    next = replaced(next, ["route", "via"], [...(next.route.via ?? []), plain]);
    next = replaced(next, ["route", "goal"], undefined);
  }
  next = replaced(next, ["route", "closed"], closed ? true : undefined);
  return withTensions(next, (list) => Array.from({ length: spanCount(next) }, (_, i) => list[i] ?? list.at(-1) ?? 0), doc);
}

export { replaced };
