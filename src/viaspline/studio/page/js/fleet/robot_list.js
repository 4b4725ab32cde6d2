/** The robots of a fleet: choose one, see how it fares, add one. */

import { isFleet, membersOf, robotName } from "../core/fleet.js";
import { fill, h, icon, lazily } from "../panels/dom.js";
import { clock } from "../units.js";
import { robotColour } from "./colours.js";

export class RobotList {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.list = /** @type {HTMLElement} */ (document.querySelector("#robot-list"));
    this.count = /** @type {HTMLElement} */ (document.querySelector("#robot-count"));
    this.signature = "";
    const render = lazily(() => this.render(), 80);
    app.store.on("document file robot plan", render);
    this.list.addEventListener("keydown", (event) => this.key(event));
  }

  /** Arrows go from robot to robot. @param {KeyboardEvent} event */
  key(event) {
    const way = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    const { store } = this.app;
    const to = (store.robot ?? 0) + way;
    if (!way || event.altKey || !membersOf(store.file)[to]) return;
    store.choose(to);
    this.render();
    /** @type {HTMLElement|null} */ (this.list.children[to]?.querySelector("button"))?.focus();
    event.preventDefault();
    event.stopPropagation();
  }

  render() {
    const { store } = this.app;
    if (!isFleet(store.file)) return;
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const rows = membersOf(store.file).map((_, i) => ({ i, name: robotName(store.file, i), ...this.noteOf(robotName(store.file, i)) }));
    const signature = JSON.stringify([store.robot, dark, rows]);
    if (signature === this.signature) return; // rows say times to the second: most drags leave them
    this.signature = signature;
    fill(this.list, ...rows.map((row) => this.row(row, dark)), h("li", { class: "row" },
      h("button", { type: "button", class: "row-main is-adding", onclick: () => this.app.fleet.add() }, h("span", { class: "glyph" }, icon("plus", 16)), h("span", { class: "row-name" }, "Add a robot"))));
    this.count.textContent = String(rows.length);
  }

  /** What is said of a robot beside its name. @param {string} name @returns {{note: string, title: string, isBad: boolean}} */
  noteOf(name) {
    const { fleetPlan } = this.app.store;
    const robot = fleetPlan?.byName.get(name);
    if (!robot) return { note: "", title: "", isBad: false };
    if (robot.missing) return { note: robot.missing.outcome, title: `${robot.missing.reason}; ${robot.missing.remedy}`, isBad: true };
    const waits = fleetPlan.waitsOf(name);
    const late = robot.law.times.at(-1) - robot.law.times[0] - robot.alone;
    const title = waits.map((/** @type {any} */ wait) => `waits ${wait.seconds.toFixed(1)} s for ${wait.waits_for}`).join("\n");
    return { note: `${clock(robot.law.times.at(-1))}${late > 0.5 ? ` · +${late.toFixed(0)} s` : ""}`, title, isBad: false };
  }

  /** @param {{i: number, name: string, note: string, title: string, isBad: boolean}} row @param {boolean} dark */
  row({ i, name, note, title, isBad }, dark) {
    const { store } = this.app;
    const isChosen = store.robot === i;
    const swatch = h("span", { class: "swatch" });
    swatch.style.background = robotColour(i, dark);
    return h("li", { class: `row${isChosen ? " is-selected" : ""}` },
      h("button", { type: "button", class: "row-main", "aria-pressed": String(isChosen), "aria-label": `robot ${name}${note ? `, ${note}` : ""}`, title, onclick: () => store.choose(i) },
        swatch,
        h("span", { class: "row-name", title: name }, name),
        note ? h("span", { class: `row-note${isBad ? " is-bad" : ""}` }, note) : null));
  }
}
