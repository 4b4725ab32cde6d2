/** What can be done to how an obstacle moves: each edit takes a document and gives another one. */

import { frameAt, isLifted, outOf } from "../geometry/motion.js";
import { withKeyframe } from "../shapes/moving.js";
import { shapeOf, standingShapeOf } from "../shapes/registry.js";
import { tidy } from "../units.js";
import { part, pathOf, replaced } from "./mission.js";

/** @typedef {any} Doc */
/** @typedef {"stands"|"keyframes"|"straight"} Manner */

const FIRST_LASTS_S = 10; // what begins to move gets to its second keyframe in this time

/** How an obstacle moves; null for what can't. @param {any} item @returns {Manner|null} */
export function mannerOf(item) {
  const shape = shapeOf(item);
  if (!shape || (!shape.hasOutline && !item.motion) || shape.isPierced(item)) return null;
  return !item.motion ? "stands" : item.motion.keyframes ? "keyframes" : "straight";
}

/**
 * Let an obstacle move in another way, or stand where it is at an instant.
 * @param {Doc} doc @param {string} id @param {Manner} manner @param {number} time [s]
 */
export function setManner(doc, id, manner, time) {
  const path = pathOf(id);
  const item = part(doc, path);
  if (mannerOf(item) === manner) return doc;
  if (manner === "stands") return replaced(doc, path, stopped(item, time));
  const speed = Number(doc.robot?.max_speed_mps ?? 2) / 2;
  const moving = item.motion ? item : begun(item);
  const { motion } = moving;
  const frame = frameAt(motion, time) ?? frameAt({ ...motion, before: "stay", after: "stay" }, time);
  const { error } = motion;
  const kept = error ? { error } : {};
  if (!frame) return doc;
  const [vx, vy] = item.motion ? [frame.vx, frame.vy] : [speed, 0];
  const isInSpace = isLifted(motion), z = tidy(frame.z);
  const height = isInSpace ? [z] : [], level = isInSpace ? [0] : [], turned = isInSpace ? [0, z] : [];
  const straight = { from: [tidy(frame.x - vx * time), tidy(frame.y - vy * time), ...height], velocity_mps: [tidy(vx), tidy(vy), ...level], ...kept };
  const keyframes = [[tidy(time), tidy(frame.x), tidy(frame.y), ...turned], [tidy(time + FIRST_LASTS_S), tidy(frame.x + vx * FIRST_LASTS_S), tidy(frame.y + vy * FIRST_LASTS_S), ...turned]];
  return replaced(doc, path, { ...moving, motion: manner === "straight" ? straight : { keyframes, after: "bounce", ...kept } });
}

/** What has stood, in a frame of its own that doesn't move yet. @param {any} item */
function begun({ pass_on: _, never_pass_on: __, ...item }) {
  const shape = standingShapeOf(item);
  const at = shape?.anchor(item) ?? [0, 0];
  return { ...shape?.movedTo(item, [0, 0]), motion: { from: at.slice(0, 2), velocity_mps: [0, 0] } };
}

/** What has moved, where it is at an instant, or was at first. @param {any} item @param {number} time */
function stopped({ motion, ...item }, time) {
  const frame = frameAt(motion, time) ?? frameAt({ ...motion, before: "stay", after: "stay" }, time);
  const shape = standingShapeOf(item);
  return frame && shape ? raised(shape.mapped(item, (at) => outOf(frame, at).map(tidy)), frame.z) : item;
}

/** With all of its heights so much higher. @param {any} item @param {number} by [m] */
function raised(item, by) {
  if (!by) return item;
  const up = (/** @type {number[]} */ at) => at.map((value, i) => (i === 2 ? tidy(value + by) : value));
  const { ball, box, capsule, height_m } = item;
  return {
    ...item,
    ...(ball ? { ball: { ...ball, center: up(ball.center) } } : {}),
    ...(box ? { box: { ...box, min: up(box.min), max: up(box.max) } } : {}),
    ...(capsule ? { capsule: { ...capsule, from: up(capsule.from), to: up(capsule.to) } } : {}),
    ...(height_m ? { height_m: height_m.map((/** @type {number} */ value) => tidy(value + by)) } : {}),
  };
}

/** Set one number of a keyframe; a heading that is null is taken out. @param {Doc} doc @param {string} id @param {number} index @param {number} axis 0 to 4: t, x, y, heading, z @param {number|null} value */
export function setKeyframe(doc, id, index, axis, value) {
  const path = [...pathOf(id), "motion", "keyframes", index];
  const frame = [...part(doc, path)];
  if (value !== null) {
    if (axis === 4) frame[3] ??= 0;
    frame[axis] = value;
  } else if (axis === 3 && frame.length > 4) frame[3] = 0;
  else if (axis === 3) frame.length = 3;
  else if (axis === 4) frame.length = Math.min(frame.length, 4);
  else return doc;
  return replaced(doc, path, frame);
}

/** Say what comes after the last keyframe; what goes on and on has no before. @param {Doc} doc @param {string} id @param {string} after */
export function setAfter(doc, id, after) {
  const path = [...pathOf(id), "motion"];
  const next = replaced(doc, [...path, "after"], after);
  return after === "loop" || after === "bounce" ? replaced(next, [...path, "before"], undefined) : next;
}

/** One keyframe more, after another. @param {Doc} doc @param {string} id @param {number} after */
export const addKeyframe = (doc, id, after) => replaced(doc, pathOf(id), withKeyframe(part(doc, pathOf(id)), after));

/** Set how far off its place it may be; nothing of it is left out. @param {Doc} doc @param {string} id @param {"position_m"|"growth_mps"} key @param {number|null} value */
export function setError(doc, id, key, value) {
  const path = [...pathOf(id), "motion", "error"];
  const error = { ...part(doc, path), [key]: value || undefined };
  const left = Object.fromEntries(Object.entries(error).filter(([, one]) => one));
  return replaced(doc, path, Object.keys(left).length ? left : undefined);
}
