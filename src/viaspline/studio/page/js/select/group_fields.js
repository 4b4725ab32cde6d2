/** What the fields show while several things are selected: how many, and what is done with all of them. */

import { h, icon, numberField } from "../panels/dom.js";
import { countWords, movedBy } from "./group_edits.js";

/** @param {any} app @returns {Node[]} */
export function groupFields(app) {
  const { store, selecting, clipboard, say } = app;
  const { chosen } = store;
  const move = (/** @type {number} */ axis) => (/** @type {number|null} */ value) => {
    if (!value) return;
    store.edit(movedBy(store.doc, store.chosen, axis ? [0, value] : [value, 0]));
    say(`${countWords(store.chosen)} moved`);
  };
  return [
    h("header", { class: "inspector-title" }, h("h3", {}, `${chosen.length} selected`), h("span", { class: "row-note" }, countWords(chosen))),
    h("div", { class: "pair" },
      numberField({ label: "Move by x", value: null, unit: "m", placeholder: "0", set: move(0) }),
      numberField({ label: "Move by y", value: null, unit: "m", placeholder: "0", set: move(1) })),
    h("div", { class: "group-buttons" },
      h("button", { type: "button", class: "button", onclick: () => clipboard.duplicate() }, icon("plus", 15), "Duplicate"),
      h("button", { type: "button", class: "button", onclick: () => store.select(store.selection) }, "Only the last"),
      h("button", { type: "button", class: "button is-danger", onclick: () => selecting.erase() }, icon("trash", 15), "Delete all")),
  ];
}
