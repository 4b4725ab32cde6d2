/** The menu of what lies under the pointer, by the right button, a long press, or the keyboard's menu key. */

import { anchorOf, whole } from "../core/mission.js";
import { pick } from "../input/pick.js";
import { fill, h, icon } from "../panels/dom.js";
import { entriesOf } from "./entries.js";

/** @typedef {{label: string, icon?: string, key?: string, act: () => void, isChecked?: boolean}|null} MenuEntry null: a line between */

const REACH_PX = 10, TOUCH_REACH_PX = 18;

export class ContextMenu {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.menu = h("div", { class: "menu", id: "context-menu", role: "menu", hidden: true });
    /** @type {HTMLElement} */ (document.querySelector("#shown")).after(this.menu);
    /** What gets the focus when it is closed. @type {() => HTMLElement|null} */ this.back = () => app.scene.canvas;
    this.menu.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.key(event));
    this.menu.addEventListener("contextmenu", (/** @type {Event} */ event) => event.preventDefault());
    addEventListener("pointerdown", (event) => {
      if (!this.menu.contains(/** @type {Node} */ (event.target))) this.close(false);
    }, { capture: true });
    addEventListener("blur", () => this.close(false));
    addEventListener("resize", () => this.close(false));
    app.store.on("document view", () => this.close(this.menu.contains(document.activeElement)));
    const left = /** @type {HTMLElement} */ (document.querySelector("#left"));
    left.addEventListener("contextmenu", (event) => this.onRow(event));
  }

  get isOpen() {
    return !this.menu.hidden;
  }

  /** At a place on the map. @param {number} px @param {number} py [CSS pixel of the map] @param {boolean} isTouch */
  at(px, py, isTouch = false) {
    const { app } = this;
    const found = pick(app.store, app.camera, px, py, isTouch ? TOUCH_REACH_PX : REACH_PX, app.scene.time);
    const box = app.scene.canvas.getBoundingClientRect();
    this.take(found);
    this.open(`Menu of ${this.words(found)}`, entriesOf(app, found, app.camera.toWorld(px, py)), box.left + px, box.top + py, () => app.scene.canvas);
  }

  /** By the keyboard: of what is selected, of a row of the lists, or of the map. */
  byKey() {
    const { app } = this;
    const { store, camera, scene } = app;
    const row = /** @type {HTMLElement|null} */ (document.activeElement?.closest?.("#left [data-id]") ?? null);
    if (row) {
      const box = row.getBoundingClientRect();
      this.ofRow(row, box.left + 30, box.bottom - 4);
      return;
    }
    const at = scene.cross ?? (store.selection && !store.selection.startsWith("span:") ? anchorOf(store.doc, store.selection) : null);
    const [px, py] = at ? camera.toScreen(at[0], at[1]) : [camera.width / 2, camera.height / 2];
    const found = scene.cross || !store.selection ? null : { kind: "item", id: store.selection };
    const box = scene.canvas.getBoundingClientRect();
    this.open(`Menu of ${this.words(found)}`, entriesOf(app, found, camera.toWorld(px, py)), box.left + Math.min(Math.max(px, 0), camera.width), box.top + Math.min(Math.max(py, 0), camera.height), () => scene.canvas);
  }

  /** @param {MouseEvent} event */
  onRow(event) {
    const row = /** @type {HTMLElement|null} */ (/** @type {HTMLElement} */ (event.target).closest("[data-id]"));
    if (!row) return;
    event.preventDefault();
    this.ofRow(row, event.clientX, event.clientY);
  }

  /** @param {HTMLElement} row @param {number} x @param {number} y */
  ofRow(row, x, y) {
    const id = /** @type {string} */ (row.dataset.id);
    const found = { kind: "item", id };
    this.take(found);
    this.open(`Menu of ${this.words(found)}`, entriesOf(this.app, found, null), x, y, () => document.querySelector(`#left [data-id="${id}"] button`)); // rows are made anew
  }

  /** What the menu is about is selected, unless it belongs to what is selected already. @param {any} found */
  take(found) {
    const { store } = this.app;
    if (found?.kind === "item" && !store.chosen.some((/** @type {string} */ id) => whole(id) === whole(found.id))) store.select(found.id);
    if (found?.kind === "handle" && found.handle.role === "corner") store.select(found.handle.id);
    if (found?.kind === "path") store.select(`span:${found.leg}`);
  }

  /** @param {any} found */
  words(found) {
    if (this.app.store.chosen.length > 1 && found?.kind === "item") return "all that is selected";
    if (found?.kind === "item") return found.id.startsWith("span:") ? "the span" : this.app.describe(found.id);
    return found?.kind === "path" ? "the path" : found?.kind === "handle" ? this.app.describe(found.handle.id) : "the map";
  }

  /** @param {string} label @param {MenuEntry[]} entries @param {number} x @param {number} y [CSS pixel of the page] @param {() => HTMLElement|null} back */
  open(label, entries, x, y, back) {
    const { menu } = this;
    document.querySelectorAll(".menu").forEach((other) => { /** @type {HTMLElement} */ (other).hidden = true; });
    this.back = back;
    menu.setAttribute("aria-label", label);
    fill(menu, ...entries.map((entry) => (entry ? this.item(entry) : h("div", { class: "menu-line", role: "separator" }))));
    menu.hidden = false;
    menu.style.left = `${Math.max(8, Math.min(x, innerWidth - menu.offsetWidth - 8))}px`;
    menu.style.top = `${Math.max(8, Math.min(y, innerHeight - menu.offsetHeight - 8))}px`;
    /** @type {HTMLElement|null} */ (menu.querySelector("button"))?.focus();
  }

  /** @param {{label: string, icon?: string, key?: string, act: () => void, isChecked?: boolean}} entry */
  item({ label, icon: name, key, act, isChecked }) {
    const isChoice = isChecked !== undefined;
    return h("button", {
      type: "button", class: "menu-item", tabindex: "-1", role: isChoice ? "menuitemcheckbox" : "menuitem", "aria-checked": isChoice ? String(isChecked) : undefined, "aria-label": label,
      onclick: () => {
        this.close(true);
        act();
      },
    }, h("span", { class: "tick" }, isChecked ? icon("check", 14) : name ? icon(name, 15) : ""), h("span", {}, label), key ? h("kbd", {}, key) : null);
  }

  /** @param {boolean} isFocused whether the focus goes back to where it came from */
  close(isFocused) {
    if (!this.isOpen) return;
    this.menu.hidden = true;
    if (isFocused) (this.back() ?? this.app.scene.canvas).focus({ preventScroll: true });
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const items = [.../** @type {NodeListOf<HTMLElement>} */ (this.menu.querySelectorAll("button"))];
    const i = items.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const count = items.length;
    const to = /** @type {Record<string, number>} */ ({ ArrowDown: (i + 1) % count, ArrowUp: (i + count - 1) % count, Home: 0, End: count - 1 })[event.key];
    if (to !== undefined) items[to].focus();
    else if (event.key === "Escape" || event.key === "Tab") this.close(true);
    else if (event.key.length === 1 && event.key !== " ") { // its first letter, as in every menu
      const letter = event.key.toLowerCase();
      [...items.slice(i + 1), ...items.slice(0, i + 1)].find((one) => one.getAttribute("aria-label")?.toLowerCase().startsWith(letter))?.focus();
    } else {
      event.stopPropagation();
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
}
