/** The measuring tool: a line of places, each leg's length and bearing, and their sum. */

import { theme } from "../draw/theme.js";
import { fill, h } from "../panels/dom.js";
import { metres } from "../units.js";
import { bearingOf, headingOf, lengthOf, sumOf } from "./lengths.js";

/** @typedef {import("../draw/pen.js").Pen} Pen */

const ROOM_PX = 14; // that a leg on the screen has besides the words in its middle

export class Measure {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** @type {number[][]} */ this.places = [];
    /** Where the next place would be. @type {number[]|null} */ this.ahead = null;
    this.isDone = false; // the next place begins anew
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#measured"));
    app.scene.overlays.push((/** @type {Pen} */ pen) => this.draw(pen));
    app.store.on("tool", () => { if (app.store.tool !== "measure") this.drop(); });
    app.store.on("file", () => this.drop());
  }

  /** Set a place. @param {number[]} at */
  add(at) {
    if (this.isDone) this.places = [];
    this.isDone = false;
    const last = this.places.at(-1);
    if (last && last[0] === at[0] && last[1] === at[1]) return;
    this.places = [...this.places, at];
    this.ahead = null;
    this.changed();
    this.app.say(this.places.length < 2 ? "measuring from here" : this.words());
  }

  /** Begin at a place. @param {number[]} at */
  from(at) {
    this.app.store.setTool("measure");
    this.places = [];
    this.isDone = false;
    this.add(at);
  }

  /** @param {number[]|null} at null: not on the map */
  hover(at) {
    if (!this.places.length || this.isDone) return;
    this.ahead = at;
    this.changed();
  }

  /** No more places. */
  close() {
    this.ahead = null;
    this.isDone = true;
    this.changed();
  }

  /** Take the last place back. */
  back() {
    if (!this.places.length) return false;
    this.places = this.places.slice(0, -1);
    this.isDone = false;
    this.changed();
    return true;
  }

  /** Stop, and show nothing more. */
  drop() {
    if (!this.places.length) return false;
    this.places = [];
    this.ahead = null;
    this.isDone = false;
    this.changed();
    return true;
  }

  get line() {
    return this.ahead ? [...this.places, this.ahead] : this.places;
  }

  words() {
    const { line } = this;
    const [a, b] = line.slice(-2);
    const bearing = bearingOf(a, b), heading = headingOf(a, b);
    const last = `${metres(lengthOf(a, b))}, bearing ${bearing.toFixed(1)}°, heading ${heading.toFixed(1)}°`;
    return line.length > 2 ? `${last}; ${line.length - 1} legs, ${metres(sumOf(line))} in all` : last;
  }

  changed() {
    const { line, panel, app } = this;
    panel.hidden = line.length < 2;
    if (line.length > 1) {
      const [a, b] = line.slice(-2);
      const legs = line.length - 1;
      fill(panel,
        h("strong", {}, metres(sumOf(line))),
        h("span", {}, legs > 1 ? `in ${legs} legs; the last ${metres(lengthOf(a, b))}` : ""),
        h("span", { title: "clockwise from north" }, `bearing ${bearingOf(a, b).toFixed(1)}°`),
        h("span", { title: "anticlockwise from x, as heading_deg counts" }, `heading ${headingOf(a, b).toFixed(1)}°`));
    }
    app.scene.later();
  }

  /** @param {Pen} pen */
  draw(pen) {
    const { line } = this;
    if (!line.length) return;
    const { ctx, camera } = pen;
    const colours = theme();
    const seen = line.map(([x, y]) => camera.toScreen(x, y));
    ctx.lineJoin = "round";
    for (const [colour, width] of /** @type {[string, number][]} */ ([[colours.paper, 5], [colours.ink, 2]])) {
      ctx.beginPath();
      seen.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
      pen.stroke(colour, width, width > 2 ? [] : [7, 4]);
    }
    for (const [x, y] of seen) {
      ctx.beginPath();
      ctx.arc(x, y, 4, 0, 2 * Math.PI);
      pen.fill(colours.paper);
      pen.stroke(colours.ink, 1.8);
    }
    for (let k = 1; k < line.length; k += 1) this.drawLeg(pen, line[k - 1], line[k], seen[k - 1], seen[k]);
  }

  /** @param {Pen} pen @param {number[]} a @param {number[]} b @param {number[]} p @param {number[]} q a and b on the screen */
  drawLeg(pen, a, b, p, q) {
    const { ctx, colours } = pen;
    const text = `${metres(lengthOf(a, b))} · ${bearingOf(a, b).toFixed(0).padStart(3, "0")}°`;
    ctx.font = "600 11px Inter, system-ui, sans-serif";
    const width = ctx.measureText(text).width + 10;
    if (Math.hypot(q[0] - p[0], q[1] - p[1]) < width + ROOM_PX) return;
    const [x, y] = [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
    ctx.beginPath();
    ctx.roundRect(x - width / 2, y - 9, width, 18, 5);
    pen.fill(colours.paper);
    pen.stroke(colours.ink, 1);
    ctx.fillStyle = colours.ink;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillText(text, x, y + 0.5);
  }
}
