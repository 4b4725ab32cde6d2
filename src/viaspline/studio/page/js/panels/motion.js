/** How an obstacle moves, in fields: its keyframes or its velocity, what comes after, how far it may be off. */

import { addKeyframe, mannerOf, setAfter, setError, setKeyframe, setManner } from "../core/motion_edits.js";
import { part, pathOf, replaced } from "../core/mission.js";
import { isLifted } from "../geometry/motion.js";
import { erase } from "../input/keyboard.js";
import { fewestOf } from "../shapes/moving.js";
import { choice, h, icon, iconButton, numberField } from "./dom.js";

const MOST_ROWS = 12; // of keyframes, about the one that is selected
/** @type {[string, string][]} */
const AFTER = [["loop", "begins again"], ["bounce", "goes back"], ["stay", "stays there"], ["vanish", "is gone"]];
const COLUMNS = [["t", "s"], ["x", "m"], ["y", "m"], ["heading", "°"]]; // of a keyframe
const LIFTED = [...COLUMNS, ["z", "m"]]; // of one in space

/** @param {any} app @param {string} owner the obstacle's id @param {number} selected a keyframe, or -1 */
export function motionFields(app, owner, selected) {
  const { store } = app;
  const item = part(store.doc, pathOf(owner));
  const manner = mannerOf(item);
  if (!manner) return [];
  const moves = choice({
    label: "How it moves", value: manner, options: [["stands", "stands still"], ["keyframes", "from keyframe to keyframe"], ["straight", "straight on"]],
    set: (value) => store.edit(setManner(store.doc, owner, /** @type {any} */ (value), app.scene.time), { select: owner }),
  });
  if (manner === "stands") return [moves];
  return [
    h("h3", {}, "Motion"),
    moves,
    ...(manner === "straight" ? [velocity(app, owner, item.motion)] : keyframes(app, owner, item.motion, selected)),
    h("div", { class: "pair" },
      error(app, owner, item.motion, "May be off by", "position_m", "m"),
      error(app, owner, item.motion, "more each second", "growth_mps", "m/s")),
  ];
}

/** @param {any} app @param {string} owner @param {any} motion */
function velocity({ store }, owner, motion) {
  const one = (/** @type {string} */ label, /** @type {number} */ axis) => numberField({
    label, unit: "m/s", value: motion.velocity_mps[axis],
    set: (value) => value !== null && store.edit(replaced(store.doc, [...pathOf(owner), "motion", "velocity_mps", axis], value), { merge: `velocity:${owner}` }),
  });
  return h("div", { class: "pair" }, one("Velocity in x", 0), one("in y", 1), isLifted(motion) ? one("in z", 2) : null);
}

/** @param {any} app @param {string} owner @param {any} motion @param {string} label @param {"position_m"|"growth_mps"} key @param {string} unit */
function error({ store }, owner, motion, label, key, unit) {
  return numberField({
    label, unit, value: motion.error?.[key] ?? null, min: 0, step: 0.05, placeholder: "0",
    set: (value) => store.edit(setError(store.doc, owner, key, value), { merge: `${key}:${owner}` }),
  });
}

/** @param {any} app @param {string} owner @param {any} motion @param {number} selected */
function keyframes(app, owner, motion, selected) {
  const { store } = app;
  const all = motion.keyframes;
  const first = Math.max(0, Math.min(selected - (MOST_ROWS >> 1), all.length - MOST_ROWS));
  const shown = all.slice(first, first + MOST_ROWS);
  const after = selected >= 0 ? selected : all.length - 1;
  const columns = isLifted(motion) ? LIFTED : COLUMNS;
  return [
    h("div", { class: `keyframes${isLifted(motion) ? " is-lifted" : ""}`, role: "table", "aria-label": "Keyframes" },
      h("div", { class: "keyframe is-head", role: "row" }, ...columns.map(([name, unit], axis) => h("span", { role: "columnheader" }, axis === 3 ? `${name} ${unit}` : `${name} [${unit}]`)), h("span", {})),
      ...shown.map((/** @type {number[]} */ frame, /** @type {number} */ i) => row(app, owner, { frame, index: first + i, columns, isSelected: first + i === selected, isSpare: all.length > fewestOf(motion) }))),
    all.length > shown.length ? h("p", { class: "hint" }, `${first + 1} to ${first + shown.length} of ${all.length}; select another on the map`) : null,
    h("button", {
      type: "button", class: "button",
      onclick: () => store.edit(addKeyframe(store.doc, owner, after), { select: `${owner}:${after + 1}` }),
    }, icon("plus", 14), after < all.length - 1 ? `Keyframe after ${after + 1}` : "Keyframe at the end"),
    choice({
      label: "Then it", value: motion.after ?? "", options: [...(motion.after ? [] : [/** @type {[string, string]} */ (["", "–"])]), ...AFTER.filter(([key]) => all.length >= fewestOf({ after: key }))],
      set: (value) => value && store.edit(setAfter(store.doc, owner, value)),
    }),
  ];
}

/**
 * @param {any} app @param {string} owner
 * @param {{frame: number[], index: number, columns: string[][], isSelected: boolean, isSpare: boolean}} keyframe whether it can be taken out is ``isSpare``
 */
function row(app, owner, { frame, index, columns, isSelected, isSpare }) {
  const { store } = app;
  const id = `${owner}:${index}`;
  const cell = (/** @type {string[]} */ [name, unit], /** @type {number} */ axis) => {
    const value = frame[axis];
    const input = h("input", {
      type: "number", step: "any", value: value === undefined ? "" : String(Number(value.toFixed(4))), placeholder: axis >= 3 ? "–" : undefined,
      "aria-label": `keyframe ${index + 1}, ${name} in ${unit}`,
      onchange: () => {
        const next = input.value === "" ? null : Number(input.value);
        store.edit(setKeyframe(store.doc, owner, index, axis, next), { merge: `keyframe:${id}:${axis}`, select: id });
      },
    });
    return input;
  };
  return h("div", { class: `keyframe${isSelected ? " is-selected" : ""}`, role: "row" }, ...columns.map(cell),
    isSpare ? iconButton("trash", `Delete keyframe ${index + 1}`, () => {
      store.select(id);
      erase(app);
      store.select(owner);
    }, { class: "icon-button small" }) : h("span", {}));
}
