/** Edits of several points, obstacles and areas at once: each takes a document and gives another one. */

import { moveTo, remove } from "../core/edits.js";
import { anchorOf, areasOf, obstaclesOf, pointsOf, refOf, whole } from "../core/mission.js";
import { tidy } from "../units.js";

/** What can be selected together with others; corners and keyframes stand for what they belong to. @param {string|null} id */
export const groupable = (id) => (id && !id.startsWith("span:") && !id.startsWith("bounds") ? whole(id) : null);

/** Everything that can be selected together. @param {any} doc @returns {string[]} */
export const allOf = (doc) => [
  ...pointsOf(doc).filter((point) => point.at).map(({ id }) => id),
  ...obstaclesOf(doc).map(({ id }) => id),
  ...areasOf(doc).map(({ id }) => id),
];

/**
 * Move all of them by the same way; what can't be moved stays.
 * @param {any} doc @param {readonly string[]} ids @param {number[]} by [m]
 */
export function movedBy(doc, ids, by) {
  let next = doc;
  for (const id of ids) {
    const at = anchorOf(doc, id);
    if (at) next = moveTo(next, id, [tidy(at[0] + by[0]), tidy(at[1] + by[1])]);
  }
  return next;
}

/**
 * Take all of them out; what a route needs stays.
 * @param {any} doc @param {readonly string[]} ids
 * @returns {{doc: any, left: string[]}} and what had to stay, under the ids that it has now
 */
export function withoutAll(doc, ids) {
  const index = (/** @type {string} */ id) => /** @type {import("../core/mission.js").Ref} */ (refOf(id)).index;
  const isEnd = (/** @type {string} */ id) => id === "goal" || id === "land";
  // From the last to the first, so that the others keep their numbers; a goal after the via points.
  const order = [...ids].sort((a, b) => Number(isEnd(a)) - Number(isEnd(b)) || index(b) - index(a));
  const left = [];
  let next = doc;
  for (const id of order) {
    const without = remove(next, id);
    if (without === next) left.push(id);
    next = without;
  }
  return { doc: next, left };
}

/** In words: "2 points, 1 obstacle". @param {readonly string[]} ids */
export function countWords(ids) {
  const kinds = { point: 0, obstacle: 0, area: 0 };
  for (const id of ids) kinds[id.startsWith("known") || id.startsWith("unseen") ? "obstacle" : id.startsWith("fence") || id.startsWith("zone") ? "area" : "point"] += 1;
  return Object.entries(kinds).filter(([, n]) => n).map(([kind, n]) => `${n} ${kind}${n === 1 ? "" : "s"}`).join(", ");
}
