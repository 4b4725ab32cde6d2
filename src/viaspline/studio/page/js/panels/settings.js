/** The robot, the curve's shape, the route as a whole, and the bounds. */

import { replaced, setClosed, setTension } from "../core/edits.js";
import { pointsOf, tensionsOf } from "../core/mission.js";
import { Advice } from "./advice.js";
import { checkbox, choice, fill, h, lazily, numberField, slider } from "./dom.js";
import { robotFields } from "./robot.js";
import { isSpatial } from "../core/heights.js";
import { spaceFields } from "../space/space_fields.js";

const MOST_PREFERRED_M = 3; // at the end of the slider

export class Settings {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#settings"));
    this.isSliding = false;
    /** What a slider does to the panel: it isn't drawn anew while it is dragged. */
    this.sliding = {
      grab: () => { this.isSliding = true; },
      drop: () => {
        this.isSliding = false;
        this.renderAgain();
      },
    };
    this.advice = new Advice(app, () => this.renderAgain());
    /** @type {unknown[]} */ this.shown = [0];
    app.store.on("plan", lazily(() => { if (app.store.plan?.ok !== this.wasOk) this.renderAgain(); }, 120));
    app.store.on("document", lazily(() => this.render(), 120));
  }

  /** @param {(string|number)[]} path @param {unknown} value */
  set(path, value) {
    const { store } = this.app;
    store.edit(replaced(store.doc, path, value ?? undefined), { merge: path.join(".") });
  }

  /** What is shown has changed otherwise than by the document. */
  renderAgain() {
    this.shown = [0];
    this.render();
  }

  render() {
    if (this.isSliding) return;
    this.wasOk = this.app.store.plan?.ok;
    const { doc } = this.app.store;
    const { closed, order, laps, corridor, optimise, depart_s: depart, hold_s: hold } = doc.route ?? {};
    const shown = [this.advice.given && doc, doc.robot, doc.spline, doc.world?.bounds, closed, order, laps, corridor, optimise, depart, hold, doc.world?.altitude, doc.route?.yaw, isSpatial(doc), this.app.preview.hasMotion, pointsOf(doc).length];
    if (shown.every((value, i) => value === this.shown[i])) return;
    this.shown = shown;
    fill(
      this.panel,
      h("h3", {}, "Robot"),
      ...robotFields(doc, this.app.drives ?? [], (path, value) => this.set(path, value), this.preferred()),
      ...spaceFields(doc, (path, value) => this.set(path, value)),
      h("h3", {}, "Curve"),
      this.tension(),
      ...(isSpatial(doc) ? [] : this.advice.rows()),
      h("div", { class: "pair" },
        choice({ label: "Knots", value: doc.spline?.knots ?? "chordal", options: [["chordal", "chordal"], ["centripetal", "centripetal"], ["uniform", "uniform"]], set: (value) => this.set(["spline", "knots"], value) }),
        choice({ label: "Tangents", value: doc.spline?.tangents ?? "", options: [["", "as needed"], ["cardinal", "cardinal"], ["continuous", "continuous curvature"]], set: (value) => this.set(["spline", "tangents"], value || undefined) })),
      h("h3", {}, "Route"),
      choice({ label: "Sides and shapes with the least", value: optimise ?? "time", options: [["time", "driven time"], ["length", "length"]], set: (value) => this.set(["route", "optimise"], value === "time" ? undefined : value) }),
      checkbox({ label: "Closed: back to the start", value: !!doc.route?.closed, set: (value) => this.app.store.edit(setClosed(this.app.store.doc, value)) }),
      checkbox({ label: "Via points in the shortest order", value: doc.route?.order === "shortest", set: (value) => this.set(["route", "order"], value ? "shortest" : undefined) }),
      closed ? numberField({ label: "Laps", value: laps ?? null, step: 1, min: 1, max: 1000, placeholder: "1", set: (value) => this.set(["route", "laps"], value === null ? undefined : Math.round(value)) }) : null,
      ...this.timing(),
      ...this.corridor(),
      ...this.bounds(),
    );
  }

  /** When it sets out, and for how long the goal stays free: of use where something moves. */
  timing() {
    const { preview, store } = this.app;
    if (!preview.hasMotion) return [];
    const one = (/** @type {string} */ label, /** @type {string} */ key) => numberField({
      label, unit: "s", value: typeof store.doc.route?.[key] === "number" ? store.doc.route[key] : null, min: 0, step: 1, placeholder: "0",
      set: (value) => this.set(["route", key], value),
    });
    return [h("div", { class: "pair" }, one("Sets out at", "depart_s"), one("Goal stays free for", "hold_s"))];
  }

  /** How far the path may lie beside the straight lines between the points. */
  corridor() {
    const { corridor } = this.app.store.doc.route ?? {};
    if (corridor?.csv || corridor?.line) {
      return [h("p", { class: "hint" }, `The corridor has a line of its own${corridor.csv ? `: ${corridor.csv}` : ""}.`)];
    }
    const one = (/** @type {string} */ label, /** @type {string} */ key, /** @type {string} */ other) =>
      numberField({
        label, unit: "m", value: typeof corridor?.[key] === "number" ? corridor[key] : null, min: 0.001, step: 0.5, placeholder: "none",
        set: (value) => this.set(["route", "corridor"], value === null ? undefined : { [other]: value, ...corridor, [key]: value }),
      });
    return [h("div", { class: "pair" }, one("Corridor to the left", "left_m", "right_m"), one("to the right", "right_m", "left_m"))];
  }

  tension() {
    const { store } = this.app;
    const list = tensionsOf(store.doc);
    const isOwn = new Set(list).size > 1;
    const { tension: stated, slack } = store.doc.spline ?? {};
    const isUnstated = (stated ?? slack ?? null) === null;
    return slider({
      label: "Tension", value: list[0] ?? 0, min: -1, max: 1, step: 0.05, ends: ["loose", "straight"],
      words: (value) => value.toFixed(2),
      shown: isUnstated ? "none stated" : stated === "auto" ? "auto" : isOwn ? "differs by span" : undefined,
      set: (value) => store.edit(setTension(store.doc, null, value), { merge: "tension:all" }),
      ...this.sliding,
    });
  }

  /** More clearance than is asked for, where it costs little time. */
  preferred() {
    const { store } = this.app;
    const value = Number(store.doc.robot?.prefer_clearance_m ?? 0) || 0;
    return slider({
      label: "Clearance liked beyond that", value, min: 0, max: Math.max(MOST_PREFERRED_M, Math.ceil(value)), step: 0.05,
      words: (more) => `${more.toFixed(2)} m`, ends: ["none", "where it costs little time"],
      set: (more) => this.set(["robot", "prefer_clearance_m"], more || undefined),
      ...this.sliding,
    });
  }

  bounds() {
    const box = this.app.store.doc.world?.bounds;
    if (!Array.isArray(box)) {
      return [h("h3", {}, "Bounds"), h("button", { type: "button", class: "button", onclick: () => this.app.boundAll() }, "Add bounds")];
    }
    const one = (/** @type {string} */ label, /** @type {number} */ i) =>
      numberField({ label, unit: "m", step: 1, value: box[i], set: (value) => value !== null && this.set(["world", "bounds", i], value) });
    return [
      h("h3", {}, "Bounds"),
      h("div", { class: "pair" }, one("x from", 0), one("x to", 2)),
      h("div", { class: "pair" }, one("y from", 1), one("y to", 3)),
      h("button", { type: "button", class: "button is-quiet", onclick: () => this.set(["world", "bounds"], undefined) }, "Remove bounds"),
    ];
  }
}
