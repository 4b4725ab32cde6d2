/** Which views of a mission in space are open: from above, in 3-D, or both beside each other. */

import { fill, h } from "../panels/dom.js";

/** @typedef {"plan"|"both"|"solid"} ViewName */

const NAMES = /** @type {[ViewName, string][]} */ ([["plan", "Plan"], ["both", "Both"], ["solid", "3-D"]]);
const LEAST_FOR_BOTH_PX = 640;

export class Views {
  /** @param {any} app @param {import("./space.js").Space} space */
  constructor(app, space) {
    this.app = app;
    this.space = space;
    /** What was asked for; null: as much as there is room for. @type {ViewName|null} */ this.chosen = null;
    this.failure = "";
    this.stage = /** @type {HTMLElement} */ (document.querySelector("#stage"));
    this.bar = /** @type {HTMLElement} */ (document.querySelector("#views"));
    this.note = /** @type {HTMLElement} */ (document.querySelector("#solid-note"));
    new ResizeObserver(() => this.show()).observe(this.stage);
  }

  /** @returns {ViewName} */
  get open() {
    if (!this.space.isOn) return "plan";
    const isWide = this.stage.clientWidth >= LEAST_FOR_BOTH_PX;
    const name = this.chosen ?? (isWide ? "both" : "plan");
    return name === "both" && !isWide ? "plan" : name;
  }

  get hasSolid() {
    return this.open !== "plan";
  }

  /** @param {ViewName} name */
  choose(name) {
    this.chosen = name;
    this.show();
  }

  show() {
    const { open, space, app } = this;
    const isWide = this.stage.clientWidth >= LEAST_FOR_BOTH_PX;
    document.body.dataset.views = open;
    this.bar.hidden = !space.isOn;
    fill(this.bar, ...NAMES.filter(([name]) => isWide || name !== "both").map(([name, label]) => h("button", {
      type: "button", class: "view-button", "aria-pressed": String(name === open), "aria-label": `${label} view`, onclick: () => this.choose(name),
    }, label)));
    const isWaiting = !this.failure && !space.solid?.drawn;
    this.note.textContent = isWaiting ? "The 3-D view is being opened …" : this.failure;
    this.note.hidden = (!this.failure && !isWaiting) || !this.hasSolid;
    space.solid?.later();
    app.scene.later();
  }

  /** There is no 3-D view. @param {string} why */
  fail(why) {
    this.failure = `The 3-D view can't be shown: ${why}. The plan and the elevation work without it.`;
    this.show();
  }
}
