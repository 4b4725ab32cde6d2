/** The list of the route's points and of the obstacles: select, put in another order, delete. */

import { heightOf } from "../core/heights.js";
import { moveVia } from "../core/edits.js";
import { areasOf, obstaclesOf, pointsOf, refOf, whole } from "../core/mission.js";
import { erase, reorder } from "../input/keyboard.js";
import { withHeight, withKey } from "../geo/row_words.js";
import { DRAWN } from "../shapes/registry.js";
import { fill, h, icon, iconButton, lazily } from "./dom.js";
import { keptRows } from "./kept_rows.js";

const DRAWING_WORDS = DRAWN.map(({ tool }) => `a ${tool.words} (${tool.key})`).join(" or ");

export class Lists {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.route = /** @type {HTMLElement} */ (document.querySelector("#route-list"));
    this.obstacles = /** @type {HTMLElement} */ (document.querySelector("#obstacle-list"));
    this.areas = /** @type {HTMLElement} */ (document.querySelector("#area-list"));
    /** @type {number|null} */ this.dragged = null;
    this.signature = "";
    /** @type {string|null} */ this.inView = null; // the selection whose row was last brought into view
    /** @type {Set<string>} */ this.chosen = new Set(); // whose rows are marked
    const render = lazily(() => this.render(), 80);
    app.store.on("document selection file", render);
    this.route.addEventListener("keydown", (event) => this.key(event));
    this.obstacles.addEventListener("keydown", (event) => this.key(event));
    this.areas.addEventListener("keydown", (event) => this.key(event));
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const rows = [.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("#left .row-main"))];
    const i = rows.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    if (i < 0 || event.altKey) return;
    const to = event.key === "ArrowDown" ? i + 1 : event.key === "ArrowUp" ? i - 1 : -1;
    if (rows[to]) {
      rows[to].focus();
      rows[to].click();
      event.preventDefault();
    }
    if (event.key === "Delete" || event.key === "Backspace") {
      erase(this.app);
      event.preventDefault();
    }
    event.key === "ArrowDown" || event.key === "ArrowUp" ? event.stopPropagation() : null;
  }

  /** With Shift or Ctrl besides what is selected. @param {MouseEvent} event @param {string} id */
  pick(event, id) {
    const { store, selecting } = this.app;
    if (event.shiftKey || event.ctrlKey || event.metaKey) selecting.toggle(id);
    else store.select(id);
  }

  /** @param {string} id of a row */
  isChosen(id) {
    return this.chosen.has(id);
  }

  render() {
    if (this.dragged !== null) return;
    const { store } = this.app;
    const points = pointsOf(store.doc);
    const obstacles = obstaclesOf(store.doc);
    const areas = areasOf(store.doc);
    // Rows say nothing of places, so while something is dragged they stay as they are.
    const signature = JSON.stringify([
      store.chosen, store.doc.route?.order, points.map((p) => [p.id, p.name, p.dwell]),
      obstacles.map((o) => [o.id, o.name, o.side, o.shape?.key, !!o.item?.motion]), areas.map((a) => [a.id, a.name, a.speed]),
      points.map((p) => heightOf(store.doc, p.id)?.value),
    ]);
    if (signature === this.signature) return;
    this.signature = signature;
    this.chosen = new Set(store.chosen.map(whole));
    const { order } = store.doc.route ?? {};
    keptRows(this.route, points.map((point, i) => ({
      says: [point.id, point.name, point.dwell, i, store.selection === point.id, this.isChosen(point.id), order, heightOf(store.doc, point.id)?.value], make: () => this.pointRow(point, i),
    })));
    this.bringIntoView();
    fill(
      this.obstacles,
      ...(obstacles.length ? obstacles.map((one) => withKey(this.obstacleRow(one), one)) : [h("li", { class: "empty" }, `None yet: draw ${DRAWING_WORDS}.`)]),
    );
    fill(this.areas, ...areas.map((one) => this.areaRow(one)));
    /** @type {HTMLElement} */ (document.querySelector("#area-section")).hidden = !areas.length;
    /** @type {HTMLElement} */ (document.querySelector("#area-count")).textContent = String(areas.length);
    const many = (/** @type {number} */ n, /** @type {string} */ word) => `${n} ${word}${n === 1 ? "" : "s"}`;
    /** @type {HTMLElement} */ (document.querySelector("#route-count")).textContent = many(points.length, "point");
    /** @type {HTMLElement} */ (document.querySelector("#obstacle-count")).textContent = String(obstacles.length);
  }

  /** Show the row of what has been selected elsewhere. */
  bringIntoView() {
    const { selection } = this.app.store;
    if (selection === this.inView) return;
    this.inView = selection;
    const row = /** @type {HTMLElement|null} */ (selection && this.route.querySelector(`[data-id="${CSS.escape(selection)}"]`));
    if (row && !row.contains(document.activeElement)) row.scrollIntoView({ block: "nearest" });
  }

  /** @param {any} point @param {number} i */
  pointRow(point, i) {
    const { app } = this;
    const { store } = app;
    const isSelected = this.isChosen(point.id);
    const ref = refOf(point.id);
    const badge = point.id === "start" ? "S" : point.id === "goal" ? "G" : point.id === "land" ? "L" : String(i);
    const main = h(
      "button", { type: "button", class: "row-main", "aria-pressed": String(isSelected), "aria-label": `${point.name}${point.dwell ? `, stays ${point.dwell} seconds` : ""}`, onclick: (/** @type {MouseEvent} */ event) => this.pick(event, point.id) },
      h("span", { class: `badge ${point.id === "start" ? "is-start" : point.id === "goal" || point.id === "land" ? "is-goal" : point.dwell > 0 ? "is-station" : ""}` }, badge),
      h("span", { class: "row-name", title: point.name }, point.name),
      point.dwell > 0 ? h("span", { class: "row-note" }, `${point.dwell} s`) : null,
    );
    const row = h("li", { class: `row${isSelected ? " is-selected" : ""}`, "data-id": point.id }, main);
    if (ref?.kind === "via" && store.doc.route?.order !== "shortest") {
      if (store.selection === point.id) {
        row.append(
          iconButton("up", `${point.name}: earlier`, () => reorder(app, -1), { class: "icon-button small" }),
          iconButton("down", `${point.name}: later`, () => reorder(app, 1), { class: "icon-button small" }),
        );
      }
      this.draggable(row, main, ref.index);
    }
    return withHeight(row, app, point);
  }

  /** Rows are dragged into another order. @param {HTMLElement} row @param {HTMLElement} grip @param {number} index */
  draggable(row, grip, index) {
    const { store } = this.app;
    grip.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.pointerType === "touch") return;
      const startY = event.clientY;
      let to = index;
      const move = (/** @type {PointerEvent} */ e) => {
        if (this.dragged === null && Math.abs(e.clientY - startY) < 6) return;
        this.dragged = index;
        row.classList.add("is-dragged");
        const rows = [...this.route.children].filter((r) => r.getAttribute("data-id")?.startsWith("via:"));
        const over = rows.findIndex((r) => e.clientY < r.getBoundingClientRect().bottom);
        to = over < 0 ? rows.length - 1 : over;
        rows.forEach((r, i) => r.classList.toggle("is-target", i === to && i !== index));
      };
      const end = () => {
        removeEventListener("pointermove", move);
        removeEventListener("pointerup", end);
        if (this.dragged === null) return;
        this.dragged = null;
        this.signature = "";
        if (to !== index) store.edit(moveVia(store.doc, index, to), { select: `via:${to}` });
        this.render();
      };
      addEventListener("pointermove", move);
      addEventListener("pointerup", end);
    });
  }

  /** @param {any} one */
  areaRow(one) {
    const { store } = this.app;
    const isSelected = this.isChosen(one.id);
    const speed = one.speed === null ? null : `≤ ${Number(one.speed.toFixed(2))} m/s`;
    return h(
      "li", { class: `row${isSelected ? " is-selected" : ""}`, "data-id": one.id },
      h(
        "button", { type: "button", class: "row-main", "aria-pressed": String(isSelected), "aria-label": `${one.name}, ${one.kind === "zone" ? `speed zone, ${speed ?? "no speed"}` : "the robot stays inside"}`, onclick: (/** @type {MouseEvent} */ event) => this.pick(event, one.id) },
        h("span", { class: "glyph" }, icon(one.kind, 16)),
        h("span", { class: "row-name", title: one.name }, one.name),
        speed ? h("span", { class: "row-note" }, speed) : null,
      ),
    );
  }

  /** @param {import("../core/mission.js").Obstacle} one */
  obstacleRow(one) {
    const { app } = this;
    const { store } = app;
    const isSelected = this.isChosen(one.id);
    const isUnseen = one.list === "unseen";
    return h(
      "li", { class: `row${isSelected ? " is-selected" : ""}`, "data-id": one.id },
      h(
        "button", { type: "button", class: "row-main", "aria-pressed": String(isSelected), "aria-label": `${one.name}, ${one.shape?.name ?? "no shape"}${isUnseen ? ", unseen" : ""}`, onclick: (/** @type {MouseEvent} */ event) => this.pick(event, one.id) },
        h("span", { class: `glyph${isUnseen ? " is-unseen" : ""}` }, icon(one.shape?.key ?? "warn", 16)),
        h("span", { class: "row-name", title: one.name }, one.name),
        one.item?.motion ? h("span", { class: "row-note" }, "moves") : null,
        one.side ? h("span", { class: "row-note" }, `pass ${one.side}`) : null,
        isUnseen ? h("span", { class: "row-note is-unseen" }, "unseen") : null,
      ),
    );
  }
}
