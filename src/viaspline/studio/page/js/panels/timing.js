/** What is proven of what moves, what the robot waits for, and which paths were timed. */

import { waitWords } from "../preview.js";
import { down, metres, seconds } from "../units.js";
import { h } from "./dom.js";
import { meaning } from "./meaning.js";

const MOST_CANDIDATES = 4;

/** @param {string} text */
const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** @param {any} app @param {any} plan */
export function timingRows(app, plan) {
  const { timing } = plan;
  if (!timing) return [];
  return [
    h("h3", {}, "Among what moves"),
    proof(app, plan, timing.certificate),
    h("ul", { class: "moments" },
      ...timing.waits.slice(0, 8).map((/** @type {any} */ wait) => moment(app, wait.at_s, wait.obstacle, `${waitWords(wait)}, ${seconds(wait.lost_s)} later`)),
      ...tried(timing.candidates).map((words) => h("li", {}, words))),
  ];
}

/** @param {any} app @param {any} plan @param {any} certificate */
function proof(app, plan, certificate) {
  if (!certificate.obstacle) return h("p", { class: "hint" }, meaning("what-moves", "Proven"), ": nothing that moves comes near, until the goal need not stay free.");
  const { obstacle, tightest_at_s: time, clearance_m: clearance, required_clearance_m: required } = certificate;
  return h("div", { class: "proof is-small" },
    h("span", { class: "proof-figure" }, down(clearance)),
    h("span", { class: "proof-words" }, h("span", {}, meaning("what-moves", "proven"), ` clear of what moves, at every instant (${metres(required)} asked)`),
      h("button", { type: "button", class: "link", onclick: () => look(app, time, plan.timing.items[obstacle]) }, `tightest at ${seconds(time)}, to ${obstacle}`)));
}

/** A line that leads to an instant. @param {any} app @param {number} time @param {string} obstacle @param {string} words */
function moment(app, time, obstacle, words) {
  const id = app.store.goodPlan?.timing?.items[obstacle];
  return h("li", {}, h("button", { type: "button", class: "link", onclick: () => look(app, time, id) }, seconds(time)), ` ${words}`);
}

/** @param {any} app @param {number} time @param {string|undefined} id */
function look({ timeline, store }, time, id) {
  timeline.played.pause();
  timeline.played.seek(time);
  if (id) store.select(id);
}

/** The path that is taken and the best of the others, in words. @param {any[]} candidates @returns {string[]} */
function tried(candidates) {
  const taken = candidates.find(({ chosen }) => chosen);
  if (!taken || candidates.length < 2) return [];
  const others = candidates.filter((one) => !one.chosen && one.arrival_s !== null).sort((a, b) => a.arrival_s - b.arrival_s);
  const unlike = others.filter((one, i) => others.findIndex((other) => waysOf(other) === waysOf(one)) === i && waysOf(one) !== waysOf(taken));
  const lost = candidates.filter((one) => !one.chosen && one.arrival_s === null).length;
  const compared = unlike.slice(0, MOST_CANDIDATES).map((one) => `${sentence(waysOf(one))} instead: ${seconds(one.arrival_s - taken.arrival_s)} later`);
  return [
    `Goes ${waysOf(taken)}: arrives at ${seconds(taken.arrival_s)}`,
    ...compared,
    ...(lost ? [`${lost} more path${lost === 1 ? "" : "s"} without a law in time`] : []),
  ];
}

/** @param {any} candidate */
function waysOf({ passes }) {
  if (!passes.length) return "by the path among what stands";
  const words = passes.map((/** @type {any} */ one) => `${one.side} of ${one.obstacle}`);
  return [...new Set(words)].join(", ");
}
