/**
 * A mission document in the page's words: its points and obstacles, each with an id.
 *
 * Ids: `start`, `goal`, `via:2`, `known:0`, `unseen:1`, a polygon's corner `known:0:3`, the span
 * after the second point `span:1`, the bounds' corner `bounds:2`, a fence's corner `fence:0:1`.
 * What is not understood here is left as it is.
 */

import { part, replaced } from "./diff.js";

/** @typedef {import("./diff.js").Path} Path */
/** @typedef {{id: string, kind: string, list: string, index: number, vertex: number}} Ref */

/** @param {string|null} id @returns {Ref|null} */
export function refOf(id) {
  if (!id) return null;
  const [kind, index = "0", vertex = "-1"] = id.split(":");
  return { id, kind, list: kind, index: Number(index), vertex: Number(vertex) };
}

/** Whether an id is a point of the route. @param {string|null} id */
export const isPoint = (id) => id === "start" || id === "goal" || !!id?.startsWith("via:");
/** Whether an id is an obstacle or a corner of one. @param {string|null} id */
export const isObstacle = (id) => !!id && (id.startsWith("known:") || id.startsWith("unseen:"));
/** The obstacle that a corner belongs to; other ids as they are. @param {string} id */
export const whole = (id) => id.split(":").slice(0, 2).join(":");

/** Where in the document an id stands. @param {string} id @returns {Path} */
export function pathOf(id) {
  const ref = /** @type {Ref} */ (refOf(id));
  if (ref.kind === "start" || ref.kind === "goal") return ["route", ref.kind];
  if (ref.kind === "via") return ["route", "via", ref.index];
  if (ref.kind === "fence") return ["world", "fences", ref.index];
  if (ref.kind === "bounds") return ["world", "bounds"];
  return ["world", ref.kind, ref.index];
}

/** The id of what stands at a path; null if nothing that can be selected. @param {Path} path */
export function idAt(path) {
  const [a, b, c, d, e] = path;
  if (a === "route" && (b === "start" || b === "goal")) return b;
  if (a === "route" && b === "via" && typeof c === "number") return `via:${c}`;
  if (a === "world" && (b === "known" || b === "unseen") && typeof c === "number") {
    return d === "polygon" && typeof e === "number" ? `${b}:${c}:${e}` : `${b}:${c}`;
  }
  return null;
}

/** @param {any} point @returns {number[]|null} */
export function placeOf(point) {
  const at = Array.isArray(point) ? point : point?.at;
  return Array.isArray(at) && at.length >= 2 && at.every(Number.isFinite) ? at : null;
}

/**
 * The points of the route in the order of the file.
 * @param {any} doc
 * @returns {{id: string, at: number[]|null, name: string, given: string|null, dwell: number, heading: number|null}[]}
 */
export function pointsOf(doc) {
  const route = doc?.route ?? {};
  const via = Array.isArray(route.via) ? route.via : [];
  const rows = [["start", route.start, "start"]];
  via.forEach((/** @type {any} */ item, /** @type {number} */ i) => rows.push([`via:${i}`, item, `via ${i + 1}`]));
  if (route.goal !== undefined && route.goal !== null) rows.push(["goal", route.goal, "goal"]);
  return rows.map(([id, point, usual]) => ({
    id,
    at: placeOf(point),
    name: point?.name ?? usual,
    given: point?.name ?? null,
    dwell: Number(point?.dwell_s ?? 0),
    heading: Number.isFinite(point?.heading_deg) ? point.heading_deg : null,
  }));
}

/**
 * The obstacles of a list, with what the page can draw of them.
 * @param {any} doc
 * @returns {{id: string, list: "known"|"unseen", index: number, name: string, given: string|null,
 *   circle: {center: number[], radius: number}|null, polygon: number[][]|null, holes: number[][][],
 *   map: string|null, side: string|null}[]}
 */
export function obstaclesOf(doc) {
  /** @type {any[]} */ const found = [];
  let number = 0;
  for (const list of /** @type {("known"|"unseen")[]} */ (["known", "unseen"])) {
    const items = doc?.world?.[list];
    if (!Array.isArray(items)) continue;
    items.forEach((item, index) => {
      number += 1;
      const circle = item?.circle;
      const isRound = Array.isArray(circle?.center) && Number.isFinite(circle?.radius);
      const polygon = Array.isArray(item?.polygon) && item.polygon.length > 2 ? item.polygon : null;
      const map = typeof item?.map === "string" ? item.map : null;
      found.push({
        id: `${list}:${index}`, list, index,
        name: item?.name ?? (map ? map.replace(/^.*\//, "") : `obstacle ${number}`),
        given: item?.name ?? null,
        circle: isRound ? circle : null,
        polygon,
        holes: Array.isArray(item?.holes) ? item.holes : [],
        map,
        side: item?.pass_on ?? (item?.never_pass_on === "left" ? "right" : item?.never_pass_on === "right" ? "left" : null),
      });
    });
  }
  return found;
}

/** Everything that can be selected with the keyboard, in order. @param {any} doc */
export function idsOf(doc) {
  const ids = pointsOf(doc).filter((point) => point.at).map((point) => point.id);
  for (const obstacle of obstaclesOf(doc)) {
    ids.push(obstacle.id);
    obstacle.polygon?.forEach((_, i) => ids.push(`${obstacle.id}:${i}`));
  }
  return ids;
}

/** Whether there is such a thing in the document. @param {any} doc @param {string|null} id */
export function exists(doc, id) {
  if (!id) return false;
  if (id.startsWith("span:")) return Number(id.slice(5)) < spanCount(doc);
  const item = part(doc, pathOf(id));
  const ref = /** @type {Ref} */ (refOf(id));
  if (item === undefined || item === null) return false;
  if (ref.vertex < 0 || ref.kind === "bounds") return true;
  const ring = ref.kind === "fence" ? item : item.polygon;
  return Array.isArray(ring) && ref.vertex < ring.length;
}

/** The place of a point, a corner, or the middle of an obstacle [m]. @param {any} doc @param {string} id */
export function anchorOf(doc, id) {
  const ref = /** @type {Ref} */ (refOf(id));
  const item = part(doc, pathOf(id));
  if (isPoint(id)) return placeOf(item);
  if (ref.kind === "bounds" && Array.isArray(item)) {
    return [[item[0], item[1]], [item[2], item[1]], [item[2], item[3]], [item[0], item[3]]][ref.vertex] ?? null;
  }
  if (ref.kind === "fence") return item?.[ref.vertex] ?? null;
  if (ref.vertex >= 0) return item?.polygon?.[ref.vertex] ?? null;
  if (item?.circle) return item.circle.center;
  if (Array.isArray(item?.polygon)) return middle(item.polygon);
  return null;
}

/** The middle of a ring's box. @param {number[][]} ring */
export function middle(ring) {
  const x = ring.map((p) => p[0]), y = ring.map((p) => p[1]);
  return [(Math.min(...x) + Math.max(...x)) / 2, (Math.min(...y) + Math.max(...y)) / 2];
}

/** How many spans there are between the points of the route. @param {any} doc */
export function spanCount(doc) {
  const points = pointsOf(doc).length;
  return doc?.route?.closed ? points : Math.max(points - 1, 0);
}

/** The tension of each span, from either of its names. @param {any} doc @returns {number[]} */
export function tensionsOf(doc) {
  const count = spanCount(doc);
  const { tension, slack } = doc?.spline ?? {};
  const given = slack === undefined || slack === null ? tension ?? 0 : slack;
  const list = Array.isArray(given) ? given : Array(count).fill(given);
  const isSlack = slack !== undefined && slack !== null;
  const known = (/** @type {unknown} */ value, /** @type {number} */ usual) => (typeof value === "number" ? value : usual); // auto
  return Array.from({ length: count }, (_, i) => (isSlack ? 1 - 2 * known(list[i], 0.5) : known(list[i], 0)));
}

/** Radius and clearance together [m]: what the path keeps. @param {any} doc */
export function requiredOf(doc) {
  const { radius_m = 0.5, clearance_m = 0.5 } = doc?.robot ?? {};
  return Math.max(0, Number(radius_m) + Number(clearance_m)) || 0;
}

export { part, replaced };
