/** The robot, the curve's shape, the route as a whole, and the bounds. */

import { replaced, setClosed, setTension } from "../core/edits.js";
import { pointsOf, tensionsOf } from "../core/mission.js";
import { checkbox, choice, fill, h, lazily, numberField } from "./dom.js";

export class Settings {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#settings"));
    this.isSliding = false;
    /** @type {unknown[]} */ this.shown = [0];
    app.store.on("document", lazily(() => this.render(), 120));
  }

  /** @param {(string|number)[]} path @param {unknown} value */
  set(path, value) {
    const { store } = this.app;
    store.edit(replaced(store.doc, path, value ?? undefined), { merge: path.join(".") });
  }

  render() {
    if (this.isSliding) return;
    const { doc } = this.app.store;
    const { closed, order } = doc.route ?? {};
    const shown = [doc.robot, doc.spline, doc.world?.bounds, closed, order, pointsOf(doc).length];
    if (shown.every((value, i) => value === this.shown[i])) return;
    this.shown = shown;
    const robot = doc.robot ?? {};
    const lidar = robot.sensor?.lidar;
    const field = (/** @type {string} */ label, /** @type {string} */ key, /** @type {string} */ unit, /** @type {any} */ more = {}) =>
      numberField({ label, unit, value: typeof robot[key] === "number" ? robot[key] : null, set: (value) => this.set(["robot", key], value), ...more });
    fill(
      this.panel,
      h("h3", {}, "Robot"),
      h("div", { class: "pair" },
        field("Radius", "radius_m", "m", { min: 0, placeholder: "0.5", step: 0.05 }),
        field("Clearance", "clearance_m", "m", { min: 0, placeholder: "0.5", step: 0.05 })),
      h("div", { class: "pair" },
        field("Top speed", "max_speed_mps", "m/s", { min: 0.001, placeholder: "2" }),
        field("Acceleration", "max_accel_mps2", "m/s²", { min: 0.001, placeholder: "1" })),
      h("div", { class: "pair" },
        field("Across the path", "max_lateral_accel_mps2", "m/s²", { min: 0.001, placeholder: "no limit" }),
        lidar
          ? numberField({ label: "Lidar range", unit: "m", value: lidar.range_m ?? null, min: 0.1, step: 1, set: (value) => value && this.set(["robot", "sensor", "lidar", "range_m"], value) })
          : numberField({ label: "Sensor range", unit: "m", value: robot.sensor?.range_m ?? null, min: 0.1, step: 1, placeholder: "none", set: (value) => this.set(["robot", "sensor"], value === null ? undefined : { ...robot.sensor, range_m: value }) })),
      h("h3", {}, "Curve"),
      this.tension(),
      h("div", { class: "pair" },
        choice({ label: "Knots", value: doc.spline?.knots ?? "chordal", options: [["chordal", "chordal"], ["centripetal", "centripetal"], ["uniform", "uniform"]], set: (value) => this.set(["spline", "knots"], value) }),
        choice({ label: "Tangents", value: doc.spline?.tangents ?? "cardinal", options: [["cardinal", "cardinal"], ["continuous", "continuous curvature"]], set: (value) => this.set(["spline", "tangents"], value) })),
      h("h3", {}, "Route"),
      checkbox({ label: "Closed: back to the start", value: !!doc.route?.closed, set: (value) => this.app.store.edit(setClosed(this.app.store.doc, value)) }),
      checkbox({ label: "Via points in the shortest order", value: doc.route?.order === "shortest", set: (value) => this.set(["route", "order"], value ? "shortest" : undefined) }),
      ...this.bounds(),
    );
  }

  tension() {
    const { store } = this.app;
    const list = tensionsOf(store.doc);
    const isOwn = new Set(list).size > 1;
    const output = h("output", { class: "slider-value" }, store.doc.spline?.tension === "auto" ? "auto" : isOwn ? "differs by span" : (list[0] ?? 0).toFixed(2));
    const slider = h("input", {
      type: "range", min: -1, max: 1, step: 0.05, value: String(list[0] ?? 0), "aria-label": "Tension of all spans",
      onpointerdown: () => { this.isSliding = true; },
      oninput: () => {
        output.textContent = Number(slider.value).toFixed(2);
        store.edit(setTension(store.doc, null, Number(slider.value)), { merge: "tension:all" });
      },
      onchange: () => {
        this.isSliding = false;
        this.shown = [0];
        this.render();
      },
    });
    return h("label", { class: "field" }, h("span", { class: "field-name" }, "Tension", output), slider, h("span", { class: "scale-ends" }, h("span", {}, "loose"), h("span", {}, "straight")));
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
