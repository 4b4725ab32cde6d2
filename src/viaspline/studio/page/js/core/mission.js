/**
 * A mission document in the page's words: its points and obstacles, each with an id.
 *
 * Ids: `start`, `goal`, `land`, `via:2`, `known:0`, `unseen:1`, an obstacle's vertex `known:0:3`, the span
 * after the second point `span:1`, the bounds' corner `bounds:2`, a fence `fence:0`, a speed zone
 * `zone:1`, their corners `fence:0:1` and `zone:1:2`.
 * What is not understood here is left as it is.
 */

import { polygon } from "../shapes/polygon.js";
import { shapeOf, vertexAt } from "../shapes/registry.js";
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
export const isPoint = (id) => id === "start" || id === "goal" || id === "land" || !!id?.startsWith("via:");
/** Whether an id is an obstacle or a vertex of one. @param {string|null} id */
export const isObstacle = (id) => !!id && (id.startsWith("known:") || id.startsWith("unseen:"));
/** Whether an id is a fence, a speed zone, or a corner of one. @param {string|null} id */
export const isArea = (id) => !!id && (id.startsWith("fence:") || id.startsWith("zone:"));
/** The obstacle or area that a vertex belongs to; other ids as they are. @param {string} id */
export const whole = (id) => id.split(":").slice(0, 2).join(":");

/** Where in the document an id stands. @param {string} id @returns {Path} */
export function pathOf(id) {
  const ref = /** @type {Ref} */ (refOf(id));
  if (ref.kind === "start" || ref.kind === "goal" || ref.kind === "land") return ["route", ref.kind];
  if (ref.kind === "via") return ["route", "via", ref.index];
  if (ref.kind === "fence") return ["world", "fences", ref.index];
  if (ref.kind === "zone") return ["world", "speed_zones", ref.index];
  if (ref.kind === "bounds") return ["world", "bounds"];
  return ["world", ref.kind, ref.index];
}

/**
 * What has a shape at an id: an obstacle, a speed zone or a fence, or a vertex of one.
 * @typedef {object} Shaped
 * @property {import("../shapes/shape.js").Shape} shape
 * @property {import("../shapes/shape.js").Item} item as its kind takes it
 * @property {(item: import("../shapes/shape.js").Item) => any} put the document with another item in its place
 */

/** @param {any} doc @param {string|null} id @returns {Shaped|null} null also if it can't be drawn */
export function shapedAt(doc, id) {
  if (!isObstacle(id) && !isArea(id)) return null;
  const path = pathOf(/** @type {string} */ (id));
  const item = part(doc, path);
  if (isObstacle(id)) {
    const shape = shapeOf(item);
    return shape && { shape, item, put: (next) => replaced(doc, path, next) };
  }
  const isRing = Array.isArray(item); // a fence is nothing but its corners
  const area = isRing ? { polygon: item } : item ?? {};
  return polygon.isSound(area) ? { shape: polygon, item: area, put: (next) => replaced(doc, path, isRing ? next.polygon : next) } : null;
}

/** The id of what stands at a path; null if nothing that can be selected. @param {Path} path */
export function idAt(path) {
  const [a, b, c, d] = path;
  const withVertex = (/** @type {string} */ owner, /** @type {number} */ vertex) => (vertex < 0 ? owner : `${owner}:${vertex}`);
  if (a === "route" && (b === "start" || b === "goal" || b === "land")) return b;
  if (a === "route" && b === "via" && typeof c === "number") return `via:${c}`;
  if (a === "world" && (b === "known" || b === "unseen") && typeof c === "number") {
    return withVertex(`${b}:${c}`, vertexAt(path.slice(3)));
  }
  if (a === "world" && b === "speed_zones" && typeof c === "number") {
    return withVertex(`zone:${c}`, polygon.vertexAt(path.slice(3)));
  }
  if (a === "world" && b === "fences" && typeof c === "number") {
    return withVertex(`fence:${c}`, typeof d === "number" ? d : -1);
  }
  return null;
}

/** @param {any} point @returns {number[]|null} */
export function placeOf(point) {
  const at = Array.isArray(point) ? point : point?.at ?? point?.gate?.at;
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
  else if (route.land !== undefined && route.land !== null) rows.push(["land", route.land, "landing"]);
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
 * An obstacle with its kind; null if it is none that can be drawn.
 * @typedef {object} Obstacle
 * @property {string} id
 * @property {"known"|"unseen"} list
 * @property {number} index
 * @property {string} name
 * @property {string|null} [key] where it stands in the file, if nothing else names it
 * @property {string|null} given the name that the document gives it
 * @property {import("../shapes/shape.js").Shape|null} shape
 * @property {import("../shapes/shape.js").Item} item
 * @property {string|null} side the only one on which it may be passed
 * @property {boolean} [isRecorded] whether its motion stands in another file
 */

/** @typedef {Obstacle & {shape: import("../shapes/shape.js").Shape}} Outlined */

/** The obstacles of both lists. @param {any} doc @returns {Obstacle[]} */
export function obstaclesOf(doc) {
  /** @type {any[]} */ const found = [];
  let number = 0;
  for (const list of /** @type {("known"|"unseen")[]} */ (["known", "unseen"])) {
    const items = doc?.world?.[list];
    if (!Array.isArray(items)) continue;
    items.forEach((item, index) => {
      number += 1;
      const shape = shapeOf(item);
      const isNamed = !!(item?.name ?? shape?.usualName(item));
      found.push({
        key: isNamed ? null : `world.${list}[${index}]`,
        id: `${list}:${index}`, list, index,
        name: item?.name ?? shape?.usualName(item) ?? `obstacle ${number}`,
        given: item?.name ?? null,
        shape,
        item,
        side: item?.pass_on ?? (item?.never_pass_on === "left" ? "right" : item?.never_pass_on === "right" ? "left" : null),
      });
    });
  }
  return found;
}

/** Those that have an outline on the map; that of what moves stands in a frame of its own. @param {Obstacle[]} obstacles */
export const outlined = (obstacles) => /** @type {Outlined[]} */ (obstacles.filter((one) => one.shape?.hasOutline));

/** Those that move. @param {Obstacle[]} obstacles */
export const movingOf = (obstacles) => /** @type {Outlined[]} */ (obstacles.filter((one) => one.shape && one.item.motion));

/** What the server has read from recorded tracks, as obstacles. @param {any[]} tracks of its answer @returns {Outlined[]} */
export const tracksOf = (tracks) => tracks.map(({ list, item, as }) => ({
  id: `${list}:${item}`, list, index: item, name: as.name ?? "", given: as.name ?? null, isRecorded: true, shape: /** @type {import("../shapes/shape.js").Shape} */ (shapeOf(as)), item: as, side: null,
}));

/**
 * Fences and speed zones.
 * @param {any} doc
 * @returns {{id: string, kind: "fence"|"zone", name: string, given: string|null, ring: number[][], speed: number|null}[]}
 */
export function areasOf(doc) {
  const list = (/** @type {any} */ value) => (Array.isArray(value) ? value : []);
  const sound = (/** @type {any} */ ring) => (Array.isArray(ring) && ring.length > 2 ? ring : []);
  return [
    ...list(doc?.world?.fences).map((ring, i) => ({
      id: `fence:${i}`, kind: /** @type {const} */ ("fence"), name: `fence ${i + 1}`, given: null, ring: sound(ring), speed: null,
    })),
    ...list(doc?.world?.speed_zones).map((zone, i) => ({
      id: `zone:${i}`, kind: /** @type {const} */ ("zone"), name: zone?.name ?? `zone ${i + 1}`, given: zone?.name ?? null,
      ring: sound(zone?.polygon), speed: Number.isFinite(zone?.max_speed_mps) ? zone.max_speed_mps : null,
    })),
  ];
}

/** Everything that can be selected with the keyboard, in order. @param {any} doc */
export function idsOf(doc) {
  const ids = pointsOf(doc).filter((point) => point.at).map((point) => point.id);
  for (const obstacle of obstaclesOf(doc)) {
    ids.push(obstacle.id);
    obstacle.shape?.vertices(obstacle.item).forEach((_, i) => ids.push(`${obstacle.id}:${i}`));
  }
  for (const area of areasOf(doc)) {
    ids.push(area.id);
    area.ring.forEach((_, i) => ids.push(`${area.id}:${i}`));
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
  const found = shapedAt(doc, id);
  return !!found && ref.vertex < found.shape.vertices(found.item).length;
}

/** The place of a point or a vertex, or what moves an obstacle or an area [m]; null if nothing does. @param {any} doc @param {string} id */
export function anchorOf(doc, id) {
  const ref = /** @type {Ref} */ (refOf(id));
  const item = part(doc, pathOf(id));
  if (isPoint(id)) return placeOf(item);
  if (ref.kind === "bounds" && Array.isArray(item)) {
    return [[item[0], item[1]], [item[2], item[1]], [item[2], item[3]], [item[0], item[3]]][ref.vertex] ?? null;
  }
  const found = shapedAt(doc, id);
  if (!found) return null;
  return ref.vertex >= 0 ? found.shape.vertices(found.item)[ref.vertex] ?? null : found.shape.anchor(found.item);
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

/** Radius and clearance together [m]: what the path keeps; for a polygon, what it keeps anyway. @param {any} doc */
export function requiredOf(doc) {
  return Math.max(0, innerRadius(bodyOf(doc)) + Number(doc?.robot?.clearance_m ?? 0.5)) || 0;
}

/**
 * The robot's body: a disc, or corners about its reference point, x forward and y left [m].
 * @param {any} doc @returns {{footprint: number[][]|null, radius: number}}
 */
export function bodyOf(doc) {
  const { footprint, radius_m = 0.5 } = doc?.robot ?? {};
  const isPolygon = Array.isArray(footprint) && footprint.length > 2 && footprint.every((p) => Array.isArray(p) && p.every(Number.isFinite));
  return { footprint: isPolygon ? footprint : null, radius: Math.max(0, Number(radius_m)) || 0 };
}

/** How far the body keeps from obstacles at least, seen from its reference point [m]. @param {{footprint: number[][]|null, radius: number}} body */
export function innerRadius({ footprint, radius }) {
  if (!footprint) return radius;
  return Math.min(...footprint.map(([ax, ay], i) => {
    const [bx, by] = footprint[(i + 1) % footprint.length];
    const dx = bx - ax, dy = by - ay;
    const size = dx * dx + dy * dy;
    const t = size > 0 ? Math.min(1, Math.max(0, -(ax * dx + ay * dy) / size)) : 0;
    return Math.hypot(ax + t * dx, ay + t * dy);
  }));
}

export { part, replaced };
