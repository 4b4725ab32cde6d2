/** The robot that is chosen, in fields: its name, its kind, who goes first, when it sets out, what it does at its goal. */

import { countOfKind, isFleet, kindOf, kindsOf, membersOf, robotName, setOnRobot } from "../core/fleet.js";
import { replaced } from "../core/diff.js";
import { choice, fill, h, icon, isTypedInto, lazily, numberField, textField } from "../panels/dom.js";

export class RobotFields {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#robot-fields"));
    /** @type {unknown[]} */ this.shown = [];
    const render = lazily(() => this.render(), 100);
    this.panel.addEventListener("change", ({ target }) => {
      if (target instanceof HTMLInputElement) target.defaultValue = target.value;
    });
    app.store.on("document robot file", render);
  }

  /** @param {string} key @param {unknown} value */
  set(key, value) {
    const { store } = this.app;
    store.editFile(setOnRobot(store.file, store.robot, key, value ?? undefined), { merge: `robot:${store.robot}:${key}` });
  }

  render() {
    const { store } = this.app;
    if (!isFleet(store.file) || isTypedInto(this.panel)) return;
    const member = membersOf(store.file)[store.robot] ?? {};
    const { name, priority, depart_s: depart, rest, mission } = member;
    const kind = kindOf(store.file, store.robot);
    const shown = [store.robot, name, priority, depart, rest, mission, kind, kindsOf(store.file).join(), store.file.separation_m, membersOf(store.file).length, member.route?.depart_s];
    if (shown.length === this.shown.length && shown.every((value, i) => value === this.shown[i])) return;
    this.shown = shown;
    fill(this.panel,
      textField({ label: "Name", value: name ?? "", placeholder: robotName(store.file, store.robot), set: (value) => (value ? this.set("name", value) : false) }),
      ...this.kind(kind, mission),
      h("div", { class: "pair" },
        numberField({ label: "Priority", value: priority ?? null, step: 1, placeholder: "0", set: (value) => this.set("priority", value) }),
        numberField({ label: "Sets out at", unit: "s", value: depart ?? member.route?.depart_s ?? null, step: 1, min: 0, placeholder: "0", set: (value) => this.departs(value) })),
      h("div", { class: "pair" },
        choice({ label: "At its goal", value: rest ?? "stay", options: [["stay", "it stays"], ["leave", "it leaves"]], set: (value) => this.set("rest", value === "stay" ? undefined : value) }),
        numberField({ label: "Apart, all robots", unit: "m", value: store.file.separation_m ?? null, min: 0, step: 0.1, placeholder: "0.5", set: (value) => store.editFile(replaced(store.file, ["separation_m"], value ?? undefined), { merge: "separation" }) })),
      h("button", { type: "button", class: "button is-danger", onclick: () => this.app.fleet.remove() }, icon("trash", 15), "Take this robot out"));
  }

  /** What it is, among the kinds that there are. @param {string|null} kind @param {string|undefined} mission */
  kind(kind, mission) {
    const { store } = this.app;
    if (kind === null) {
      return [h("p", { class: "hint" }, `Its robot and its route stand in ${mission}: here they are only shown.`),
        h("button", { type: "button", class: "button", onclick: () => this.app.fleet.openMission(mission) }, icon("file", 15), `Open ${mission}`)];
    }
    const kinds = kindsOf(store.file);
    const count = countOfKind(store.file, kind);
    return [
      kinds.length > 1 ? choice({ label: "Kind", value: kind, options: kinds.map((one) => /** @type {[string, string]} */ ([one, one])), set: (value) => this.set("robot", value) }) : null,
      count > 1 ? h("p", { class: "hint" }, `What is said of the robot below goes for all ${count} of the kind ${kind}.`) : null,
    ];
  }

  /** Where its departure stands: on the route, if it does already. @param {number|null} value [s] */
  departs(value) {
    const { store } = this.app;
    const route = membersOf(store.file)[store.robot]?.route;
    if (route?.depart_s === undefined) this.set("depart_s", value);
    else store.edit(replaced(store.doc, ["route", "depart_s"], value ?? undefined), { merge: "depart" });
  }
}
