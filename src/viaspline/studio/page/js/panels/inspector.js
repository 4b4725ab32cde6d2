/** What is selected, in fields: name, place, dwell, heading, size, side, tension. */

import { forceSide, moveTo, reshaped, setKey, setOnPoint, setTension } from "../core/edits.js";
import { anchorOf, areasOf, isArea, isPoint, obstaclesOf, pointsOf, refOf, tensionsOf, whole } from "../core/mission.js";
import { heightOf, isSpatial, withHeight } from "../core/heights.js";
import { erase } from "../input/keyboard.js";
import { metres } from "../units.js";
import { groupFields } from "../select/group_fields.js";
import { motionFields } from "./motion.js";
import { checkbox, choice, fill, h, icon, isTypedInto, lazily, numberField, slider, textField } from "./dom.js";

export class Inspector {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#inspector"));
    this.isSliding = false;
    this.isOwed = false; // what has changed while somebody was typing
    const render = lazily(() => this.render(), 100);
    this.panel.addEventListener("change", ({ target }) => {
      if (target instanceof HTMLInputElement) target.defaultValue = target.value;
    });
    this.panel.addEventListener("focusout", () => { if (this.isOwed) render(); });
    app.store.on("document selection origin", render);
    app.store.on("plan", () => { if (app.store.selection?.startsWith("span:")) render(); });
  }

  /** Put the keyboard's focus into the first field. */
  focus() {
    this.app.openSheet("edit");
    this.render();
    /** @type {HTMLElement|null} */ (this.panel.querySelector("input, select"))?.focus();
    /** @type {HTMLInputElement|null} */ (this.panel.querySelector("input[type=text]"))?.select();
  }

  render() {
    this.isOwed = isTypedInto(this.panel);
    if (this.isSliding || this.isOwed) return;
    const { store } = this.app;
    const id = store.selection;
    if (!id) fill(this.panel, h("p", { class: "hint" }, "Nothing is selected. Click a point, an obstacle or a span of the path; or press Tab on the map."));
    else if (this.app.selecting.isGroup) fill(this.panel, ...groupFields(this.app));
    else if (id.startsWith("span:")) fill(this.panel, ...this.span(Number(id.slice(5))));
    else if (isPoint(id)) fill(this.panel, ...this.point(id));
    else if (isArea(id)) fill(this.panel, ...this.area(id));
    else fill(this.panel, ...this.obstacle(id));
  }

  /** @param {string} id @param {number[]} at @param {string} [what] */
  placeFields(id, at, what = "") {
    const { store } = this.app;
    const put = (/** @type {number} */ axis) => (/** @type {number|null} */ value) => {
      if (value === null) return;
      const now = [.../** @type {number[]} */ (anchorOf(store.doc, id))].slice(0, 2);
      now[axis] = value;
      store.edit(moveTo(store.doc, id, now), { merge: `place:${id}` });
    };
    return h("div", {},
      h("div", { class: "pair" },
        numberField({ label: `${what}x`, value: at[0], unit: "m", set: put(0) }),
        numberField({ label: `${what}y`, value: at[1], unit: "m", set: put(1) })),
      this.app.earth.field(id, at));
  }

  /** @param {string} id */
  point(id) {
    const { store } = this.app;
    const all = pointsOf(store.doc);
    const point = all.find((p) => p.id === id);
    if (!point) return [];
    const isEnd = id === "start" || id === "goal";
    if (id === "land") {
      return [this.title("landing", "straight down to the ground"), point.at ? this.placeFields(id, point.at) : null, this.delete("Delete")];
    }
    return [
      this.title(point.name, isEnd ? (id === "start" ? "start of the route" : "goal of the route") : `via point ${all.indexOf(point)} of ${store.doc.route?.via?.length ?? 0}`),
      textField({ label: "Name", value: point.given ?? "", placeholder: point.name, set: (value) => store.edit(setOnPoint(store.doc, id, "name", value || undefined)) }),
      point.at ? this.placeFields(id, point.at) : null,
      this.height(id),
      h("div", { class: "pair" },
        numberField({ label: "Dwell", value: point.dwell || null, unit: "s", step: 1, min: 0, placeholder: "0", set: (value) => store.edit(setOnPoint(store.doc, id, "dwell_s", value || undefined), { merge: `dwell:${id}` }) }),
        isEnd ? numberField({ label: "Heading", value: point.heading, unit: "°", step: 5, placeholder: "free", set: (value) => store.edit(setOnPoint(store.doc, id, "heading_deg", value ?? undefined), { merge: `heading:${id}` }) }) : null),
      this.delete(id === "start" ? null : "Delete"),
    ];
  }

  /** How high a point is, by whatever it is counted from; null in the plane. @param {string} id */
  height(id) {
    const { store } = this.app;
    const height = heightOf(store.doc, id);
    if (!height) return null;
    const label = { agl: "Height above ground", z: "Height", takeoff: "Takes off to, above ground" }[height.kind];
    return numberField({ label, value: height.value, unit: "m", step: 0.5, set: (value) => value !== null && store.edit(withHeight(store.doc, id, value), { merge: `height:${id}` }) });
  }

  /** @param {string} id */
  obstacle(id) {
    const { store, app } = /** @type {any} */ ({ store: this.app.store, app: this.app });
    const owner = whole(id);
    const ref = /** @type {import("../core/mission.js").Ref} */ (refOf(id));
    const one = obstaclesOf(store.doc).find((o) => o.id === owner);
    if (!one) return [];
    const { shape, item } = one;
    const isUnseen = one.list === "unseen";
    const at = anchorOf(store.doc, id);
    return [
      this.title(one.name, `${shape?.title(item) ?? "no shape"}${ref.vertex >= 0 ? `, ${shape?.vertexName} ${ref.vertex + 1}` : ""}`),
      textField({ label: "Name", value: one.given ?? "", placeholder: one.name, set: (value) => store.edit(setKey(store.doc, owner, "name", value || undefined)) }),
      at ? this.placeFields(id, at) : null,
      ...(shape?.fields(item) ?? []).map((field) => this.shapeField(owner, field)),
      this.reach(owner, item),
      ...motionFields(app, owner, item.motion ? ref.vertex : -1),
      checkbox({ label: "Unseen: only the sensor finds it", value: isUnseen, set: () => app.toggleUnseen() }),
      !isUnseen && (shape?.hasSides ?? true) ? choice({
        label: "Pass on", value: one.side ?? "", options: [["", isSpatial(store.doc) ? "any side" : "either side"], ["left", "left"], ["right", "right"], ...(isSpatial(store.doc) ? /** @type {[string, string][]} */ ([["over", "over"], ["under", "under"]]) : [])],
        set: (value) => store.edit(forceSide(store.doc, [one.index], value || null)),
      }) : null,
      this.delete(ref.vertex >= 0 ? `Delete ${shape?.vertexName}` : "Delete"),
    ];
  }

  /** From where to where a flat shape stands in space; null for others, and in the plane. @param {string} id @param {any} item */
  reach(id, item) {
    const { store } = this.app;
    if (!isSpatial(store.doc) || item.ball || item.box || item.voxels || item.capsule?.from?.length === 3) return null;
    const range = Array.isArray(item.height_m) ? item.height_m : null;
    const put = (/** @type {number} */ end) => (/** @type {number|null} */ value) => {
      if (value === null) store.edit(setKey(store.doc, id, "height_m", undefined));
      else {
        const next = range ? [...range] : end ? [0, value] : [value, value + 10];
        next[end] = value;
        store.edit(setKey(store.doc, id, "height_m", next), { merge: `reach:${id}` });
      }
    };
    return h("div", { class: "pair" },
      numberField({ label: "Floor", value: range?.[0] ?? null, unit: "m", step: 0.5, placeholder: "none", set: put(0) }),
      numberField({ label: "Roof", value: range?.[1] ?? null, unit: "m", step: 0.5, placeholder: "none", set: put(1) }));
  }

  /** A field that a kind of obstacle has. @param {string} id @param {import("../shapes/shape.js").ShapeField} field */
  shapeField(id, field) {
    const { store } = this.app;
    if (field.type === "note") return h("p", { class: "hint" }, field.text);
    if (field.type === "choice") {
      const set = (/** @type {string} */ value) => store.edit(reshaped(store.doc, id, (_, item) => field.put(item, value)));
      return choice({ label: field.label, value: field.value, options: field.options, set });
    }
    const set = (/** @type {number|null} */ value) => {
      if (value !== null) store.edit(reshaped(store.doc, id, (_, item) => field.put(item, value)), { merge: `${field.label}:${id}` });
    };
    return numberField({ label: field.label, value: field.value, unit: field.unit, min: field.min, set });
  }

  /** @param {string} id of a fence or a speed zone */
  area(id) {
    const { store } = this.app;
    const owner = whole(id);
    const one = areasOf(store.doc).find((area) => area.id === owner);
    const ref = /** @type {import("../core/mission.js").Ref} */ (refOf(id));
    if (!one) return [];
    const at = anchorOf(store.doc, id);
    const isZone = one.kind === "zone";
    return [
      this.title(one.name, `${isZone ? "speed zone" : "fence: the robot stays inside"}, ${one.ring.length} corners${ref.vertex >= 0 ? `, corner ${ref.vertex + 1}` : ""}`),
      isZone ? textField({ label: "Name", value: one.given ?? "", placeholder: one.name, set: (value) => store.edit(setKey(store.doc, owner, "name", value || undefined)) }) : null,
      isZone ? numberField({ label: "Top speed in it", unit: "m/s", value: one.speed, min: 0.001, set: (value) => value !== null && store.edit(setKey(store.doc, owner, "max_speed_mps", value), { merge: `speed:${owner}` }) }) : null,
      at ? this.placeFields(id, at) : null,
      this.delete(ref.vertex >= 0 ? "Delete corner" : "Delete"),
    ];
  }

  /** @param {number} leg */
  span(leg) {
    const { store } = this.app;
    const points = pointsOf(store.doc);
    const from = points[leg]?.name ?? "", to = (points[leg + 1] ?? points[0])?.name ?? "";
    const range = store.curve && store.plan?.ok ? store.curve.legRange(leg) : null;
    const own = Array.isArray(store.doc.spline?.tension ?? store.doc.spline?.slack);
    return [
      this.title(`${from} → ${to}`, range ? `span ${leg + 1}, ${metres(range[1] - range[0], 1)}` : `span ${leg + 1}`),
      this.tension("Tension of this span", tensionsOf(store.doc)[leg], (value) => store.edit(setTension(store.doc, leg, value), { merge: `tension:${leg}` })),
      h("p", { class: "hint" }, "1 is the straight line, 0 Catmull–Rom, −1 loose. Or drag the span on the map. Double-click on it adds a via point."),
      own ? h("button", { type: "button", class: "button", onclick: () => store.edit(setTension(store.doc, null, tensionsOf(store.doc)[leg])) }, "Use for all spans") : null,
    ];
  }

  /** @param {string} label @param {number} value @param {(value: number) => void} set */
  tension(label, value, set) {
    return slider({
      label, value, min: Math.min(-1, Math.floor(value)), max: 1, step: 0.05, words: (next) => next.toFixed(2), set,
      grab: () => { this.isSliding = true; },
      drop: () => {
        this.isSliding = false;
        this.render();
      },
    });
  }

  /** @param {string} name @param {string} kind */
  title(name, kind) {
    return h("header", { class: "inspector-title" }, h("h3", {}, name), h("span", { class: "row-note" }, kind));
  }

  /** @param {string|null} label */
  delete(label) {
    return label ? h("button", { type: "button", class: "button is-danger", onclick: () => erase(this.app) }, icon("trash", 15), label) : null;
  }
}
