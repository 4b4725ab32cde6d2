/** What lies under a pixel. */

import { areasOf, movingOf, obstaclesOf, outlined, pointsOf, spanCount } from "../core/mission.js";
import { frameAt, into, outOf } from "../geometry/motion.js";
import { HEADING_REACH_PX, handlesOf } from "../draw/route.js";
import { pickOtherPoint, pickOtherRobot } from "../fleet/pick_robot.js";
import { toRing } from "../geometry/rings.js";

/**
 * @typedef {{kind: "handle", handle: {id: string, role: string}}
 *   | {kind: "item", id: string}
 *   | {kind: "side", entry: any, candidate: any}
 *   | import("../fleet/pick_robot.js").PickedRobot
 *   | {kind: "path", leg: number, s: number, span: number}} Picked
 */

/**
 * @param {import("../core/store.js").Store} store
 * @param {import("../geometry/camera.js").Camera} camera
 * @param {number} px @param {number} py [CSS pixel]
 * @param {number} reach how far a finger or a mouse may be off [CSS pixel]
 * @param {number} time the instant that is drawn [s]
 * @returns {Picked|null}
 */
export function pick(store, camera, px, py, reach, time) {
  const at = camera.toWorld(px, py);
  const near = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ r) => Math.hypot(x - px, y - py) <= r;
  const handles = handlesOf(store.doc, store.selection, camera);
  const solid = handles.filter((h) => h.role !== "new-corner" && near(h.x, h.y, reach));
  const handle = solid[0] ?? handles.find((h) => near(h.x, h.y, reach));
  if (handle) return { kind: "handle", handle };
  /** @type {Picked|null} */ let found = null;
  let best = reach + 6;
  for (const point of pointsOf(store.doc)) {
    if (!point.at) continue;
    const [x, y] = camera.toScreen(point.at[0], point.at[1]);
    const away = Math.hypot(x - px, y - py);
    if (away < best || (point.id === store.selection && away === best)) { // two on one place: the one that is selected
      best = away;
      found = { kind: "item", id: point.id };
    }
    if (point.heading !== null && !found) {
      const angle = (-point.heading * Math.PI) / 180;
      if (near(x + Math.cos(angle) * HEADING_REACH_PX, y + Math.sin(angle) * HEADING_REACH_PX, reach)) {
        found = { kind: "handle", handle: { id: point.id, role: "heading" } };
      }
    }
  }
  found ??= pickOtherPoint(store, camera, px, py, reach);
  if (found) return found;
  const moving = movingOf(obstaclesOf(store.doc)).reverse();
  const keyframe = pickKeyframe(moving, camera, px, py, reach * 0.8);
  if (keyframe) return { kind: "item", id: keyframe };
  const body = pickBody(moving, camera, at, reach * 0.6, time);
  if (body) return { kind: "item", id: body };
  const { curve } = store;
  const onPath = curve && store.plan?.ok ? curve.nearest(at[0], at[1]) : null;
  const pathAway = onPath ? onPath.away * camera.scale : Infinity;
  const side = store.show.losers && store.plan?.ok ? pickSide(store.ledger, camera, px, py) : null;
  if (side && side.away < Math.min(reach, pathAway)) return { kind: "side", entry: side.entry, candidate: side.candidate };
  if (curve && onPath && pathAway < reach) {
    return { kind: "path", leg: curve.legOf(onPath.span) % Math.max(spanCount(store.doc), 1), s: onPath.s, span: onPath.span };
  }
  const robot = pickOtherRobot(store, camera, px, py, reach, time);
  if (robot) return robot;
  for (const { id, shape, item } of outlined(obstaclesOf(store.doc)).reverse()) {
    if (shape.covers(at, item)) return { kind: "item", id };
    const edge = shape.edgeNear(at, item);
    if (edge && Math.hypot(edge[0] - at[0], edge[1] - at[1]) * camera.scale < reach * 0.6) return { kind: "item", id };
  }
  for (const area of areasOf(store.doc).reverse()) { // by their edges: the map within can be moved
    if (area.ring.length && toRing(at, area.ring).away * camera.scale < reach * 0.6) return { kind: "item", id: area.id };
  }
  return null;
}

/**
 * The keyframe under a pixel, by its id.
 * @param {import("../core/mission.js").Outlined[]} moving @param {import("../geometry/camera.js").Camera} camera
 * @param {number} px @param {number} py @param {number} reach [CSS pixel]
 */
function pickKeyframe(moving, camera, px, py, reach) {
  for (const { id, shape, item } of moving) {
    const vertex = shape.vertices(item).findIndex(([vx, vy]) => {
      const [x, y] = camera.toScreen(vx, vy);
      return Math.hypot(x - px, y - py) <= reach;
    });
    if (vertex >= 0) return `${id}:${vertex}`;
  }
  return null;
}

/**
 * What is at a place at an instant, by its id.
 * @param {import("../core/mission.js").Outlined[]} moving @param {import("../geometry/camera.js").Camera} camera
 * @param {number[]} at [m] @param {number} reach [CSS pixel] @param {number} time [s]
 */
function pickBody(moving, camera, at, reach, time) {
  for (const { id, shape, item } of moving) {
    const frame = frameAt(item.motion, time);
    if (!frame) continue;
    const there = into(frame, at);
    const edge = shape.covers(there, item) ? there : shape.edgeNear(there, item);
    const [x, y] = outOf(frame, edge ?? [Infinity, Infinity]);
    if (Math.hypot(x - at[0], y - at[1]) * camera.scale < reach) return id;
  }
  return null;
}

/** @param {any[]} ledger @param {import("../geometry/camera.js").Camera} camera @param {number} px @param {number} py */
function pickSide(ledger, camera, px, py) {
  /** @type {{entry: any, candidate: any, away: number}|null} */ let best = null;
  for (const entry of ledger) {
    if (!entry.forceable) continue;
    for (const candidate of entry.candidates) {
      if (candidate.chosen) continue;
      const p = candidate.spans;
      for (let k = 0; k < p.length / 8; k += 1) {
        for (let j = 0; j <= 12; j += 1) {
          const w = j / 12, v = 1 - w, i = 8 * k;
          const mix = (/** @type {number} */ o) => v ** 3 * p[i + o] + 3 * v * v * w * p[i + 2 + o] + 3 * v * w * w * p[i + 4 + o] + w ** 3 * p[i + 6 + o];
          const [x, y] = camera.toScreen(mix(0), mix(1));
          const away = Math.hypot(x - px, y - py);
          if (!best || away < best.away) best = { entry, candidate, away };
        }
      }
    }
  }
  return best;
}
