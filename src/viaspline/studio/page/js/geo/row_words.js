/** What rows of the lists say besides names: heights of points, and where nameless obstacles stand in the file. */

import { heightWords } from "../core/heights.js";
import { anchorOf } from "../core/mission.js";
import { h } from "../panels/dom.js";

/** @param {HTMLElement} row @param {string} words */
function saysToo(row, words) {
  const main = /** @type {HTMLElement} */ (row.querySelector(".row-main"));
  main.setAttribute("aria-label", `${main.getAttribute("aria-label")}, ${words}`);
}

/** The row of a point with its height, and its latitude and longitude under the cursor. @param {HTMLElement} row @param {any} app @param {{id: string, name: string}} point */
export function withHeight(row, app, { id, name }) {
  const height = heightWords(app.store.doc, id);
  if (height) {
    row.querySelector(".row-name")?.after(h("span", { class: "row-note", title: height.whole }, height.short));
    saysToo(row, height.whole);
  }
  row.addEventListener("pointerenter", () => {
    row.title = [name, app.earth.degrees(anchorOf(app.store.doc, id))].filter(Boolean).join(", ");
  });
  return row;
}

/** The row of an obstacle that has no name, called by its key as in messages and files; plans call it by its number. @param {HTMLElement} row @param {import("../core/mission.js").Obstacle} one */
export function withKey(row, one) {
  const name = /** @type {HTMLElement} */ (row.querySelector(".row-name"));
  name.title = one.name;
  if (!one.key) return row;
  name.classList.add("is-key");
  name.textContent = one.key;
  if (!row.querySelector(".row-note")) name.after(h("span", { class: "row-note" }, one.name));
  saysToo(row, one.key);
  return row;
}
