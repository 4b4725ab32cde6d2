/**
 * Variants of the mission, planned by the server one after the other and drawn over the same map.
 *
 * They are edits of the document as it stands when they are planned; once that has changed, they
 * are of another mission and can't be taken over until they are planned anew.
 */

import { diff } from "../core/diff.js";
import { robotColour } from "../fleet/colours.js";
import { CompareCard } from "./compare_card.js";
import { letterOf, rowOf } from "./compare_row.js";

const MOST = 12;
const BAND_PX = 1.8; // how much wider each path is than the next: where they agree all are seen

/** @typedef {import("./compare_row.js").Row} Row */

export class Compare {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** @type {Row[]} */ this.rows = [];
    /** @type {any} */ this.base = null; // the document that they are variants of
    this.number = 0; // of what is asked of the server
    /** @type {Row[]} */ this.asked = [];
    this.isOpen = false;
    /** @type {Row|null} */ this.hovered = null;
    this.card = new CompareCard(this);
    app.store.on("document ledger", () => { if (this.isOpen) this.card.later(); });
    app.store.on("file", () => this.close());
  }

  get isRunning() {
    return this.asked.some((row) => row.state === "waiting" || row.state === "planning");
  }

  /** Whether the rows are of the mission that is on the screen. */
  get isOfNow() {
    return this.base === this.app.store.doc;
  }

  open() {
    const { store } = this.app;
    if (store.robot !== null) {
      this.app.toast("Variants are compared of one robot's mission, not of a fleet.");
      return;
    }
    if (!this.isOpen) {
      this.isOpen = true;
      this.base = store.doc;
      this.rows = [rowOf({ name: "as it stands", make: (doc) => doc })];
      this.card.show();
      this.plan();
      if (this.card.covers) this.app.fit();
    }
    this.card.focus();
  }

  close() {
    if (!this.isOpen) return;
    this.isOpen = false;
    this.stop();
    this.rows = [];
    this.hovered = null;
    this.card.hide();
    this.app.scene.later();
  }

  /** @param {import("./variant_kinds.js").Variant[]} variants */
  add(variants) {
    const fresh = variants.filter(({ name }) => !this.rows.some((row) => row.name === name));
    const room = MOST - this.rows.length;
    if (fresh.length > room) this.app.toast(`At most ${MOST} rows: take some out first.`);
    this.rows.push(...fresh.slice(0, Math.max(0, room)).map(rowOf));
    this.plan();
  }

  /** @param {Row} row */
  drop(row) {
    this.rows = this.rows.filter((one) => one !== row);
    if (row.state === "planning" || row.state === "waiting") this.plan();
    this.changed();
  }

  /** Plan every row that isn't planned, of the mission as it is now. */
  async plan() {
    const { app } = this;
    if (!this.isOfNow) for (const row of this.rows) Object.assign(row, { state: "stopped", result: null });
    this.base = app.store.doc;
    const asked = this.rows.filter((row) => row.state !== "done");
    this.asked = asked;
    const number = (this.number += 1);
    asked.forEach((row, i) => { row.state = i ? "waiting" : "planning"; });
    this.changed();
    if (!asked.length) return;
    try {
      await app.link.told();
      const variants = asked.map((row) => diff(this.base, row.make(this.base)));
      const answer = await app.link.ask({ type: "compare", number, variants });
      if (answer.stopped) this.settle(number);
    } catch (error) {
      this.settle(number);
      app.toast(/** @type {Error} */ (error).message, "is-bad");
    }
  }

  /** Rows that won't come any more say so. @param {number} number */
  settle(number) {
    if (number !== this.number) return;
    for (const row of this.asked) if (row.state !== "done") row.state = "stopped";
    this.changed();
  }

  stop() {
    if (!this.isRunning) return;
    this.app.link.send({ type: "stop_comparing" });
    this.settle(this.number);
    this.number += 1;
    this.asked = [];
    this.changed();
  }

  /** What the server says of a row. @param {any} message */
  take(message) {
    if (!this.isOpen || message.number !== this.number) return;
    const row = this.asked[message.index];
    Object.assign(row, { state: "done", result: message });
    const next = this.asked[message.index + 1];
    if (next) next.state = "planning";
    else this.app.say("all variants are planned");
    this.changed();
  }

  /** Make the mission a variant's: one step of undo. @param {Row} row */
  takeOver(row) {
    const { store } = this.app;
    if (!this.isOfNow) return;
    const doc = row.make(store.doc);
    this.close();
    store.edit(doc);
    this.app.toast(`Taken over: ${row.name}`, "", { label: "Undo", act: () => this.app.undo() });
  }

  /** @param {Row|null} row */
  hover(row) {
    this.hovered = row;
    this.app.scene.later();
  }

  changed() {
    this.card.later();
    this.app.scene.later();
  }

  /** @param {import("../draw/pen.js").Pen} pen */
  draw(pen) {
    if (!this.isOpen || !this.isOfNow) return;
    const { ctx, colours } = pen;
    const drawn = this.rows.flatMap((row, i) => (row.result?.ok ? [{ row, i }] : []));
    ctx.lineCap = ctx.lineJoin = "round";
    drawn.forEach(({ row, i }, k) => {
      const width = 3 + BAND_PX * Math.min(drawn.length - 1 - k, 4);
      ctx.beginPath();
      pen.spans(row.result.spans);
      if (this.hovered === row) pen.stroke(colours.ink, width + 5);
      else if (!k) pen.stroke(colours.casing, width + 3);
      pen.stroke(robotColour(i, pen.isDark), width);
    });
    const { hovered } = this;
    if (!hovered?.result?.ok) return;
    ctx.beginPath();
    pen.spans(hovered.result.spans);
    pen.stroke(robotColour(this.rows.indexOf(hovered), pen.isDark), 4);
  }

  /** The letter of each path, beside it. @param {import("../draw/pen.js").Pen} pen @returns {import("../draw/labels.js").Label[]} */
  labels({ camera, colours }) {
    if (!this.isOpen || !this.isOfNow) return [];
    return this.rows.flatMap((row, i) => {
      if (!row.result?.ok) return [];
      const { spans } = row.result;
      const k = 8 * Math.floor(((i + 1) / (this.rows.length + 1)) * (spans.length / 8));
      const [x, y] = camera.toScreen(spans[k], spans[k + 1]);
      return [{ text: letterOf(i), x, y, away: 14, colour: colours.label, bold: true, rank: 0, plate: true }];
    });
  }
}
