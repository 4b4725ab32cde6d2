/** Curvature and speed along the path; they follow the cursor on the map, and the map follows theirs. */

import { pointsOf } from "../core/mission.js";
import { onTheme, theme } from "../draw/theme.js";
import { fitted, lazily } from "./dom.js";

const LEFT_PX = 58, RIGHT_PX = 14, TOP_PX = 18, GAP_PX = 24, BOTTOM_PX = 20;
const TWO_NUMBERS_PX = 26; // a strip that is less tall has the upper one alone

/** What the upper strip shows: curvature, or in space how fast it climbs. @param {any} curve @returns {{name: string, unit: string, of: (p: any) => number}} */
const bendOf = (curve) => (curve.isSpatial ? { name: "climb", unit: "m/s", of: (p) => p.climb } : { name: "curvature", unit: "1/m", of: (p) => p.curvature });

export class Plots {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.canvas = /** @type {HTMLCanvasElement} */ (document.querySelector("#plots"));
    this.ctx = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    this.width = 0; // [CSS pixel]
    this.height = 0;
    const draw = lazily(() => this.draw(), 60);
    app.store.on("plan hover run document status", draw);
    app.drive.on(draw);
    onTheme(draw);
    fitted(this);
    this.canvas.addEventListener("pointermove", (event) => this.follow(event));
    this.canvas.addEventListener("pointerdown", (event) => this.follow(event));
    this.canvas.addEventListener("pointerleave", () => app.store.lookAt(null));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /** @param {PointerEvent} event */
  follow(event) {
    const { curve } = this.app.store;
    if (!curve || !this.width) return;
    const part = (event.offsetX - LEFT_PX) / (this.width - LEFT_PX - RIGHT_PX);
    this.app.store.lookAt(part < 0 || part > 1 ? null : part * curve.length);
  }

  /** Arrows move the cursor along the path. @param {KeyboardEvent} event */
  key(event) {
    const { store } = this.app;
    const way = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (!way || !store.curve) return;
    const step = store.curve.length / (event.shiftKey ? 20 : 200);
    store.lookAt(Math.min(store.curve.length, Math.max(0, (store.cursor ?? 0) + way * step)));
    const at = store.curve.at(store.cursor ?? 0);
    this.app.say(`${at.s.toFixed(1)} m, ${at.speed.toFixed(2)} metres a second`);
    event.preventDefault();
    event.stopPropagation();
  }

  draw() {
    const { ctx, width, height } = this;
    if (!width || !height) return;
    const { store, drive } = this.app;
    const { curve } = store;
    const colours = theme();
    const ratio = this.canvas.width / width;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    if (!curve) return;
    const tall = (height - TOP_PX - BOTTOM_PX - GAP_PX) / 2;
    const x = (/** @type {number} */ s) => LEFT_PX + (s / (curve.length || 1)) * (width - LEFT_PX - RIGHT_PX);
    ctx.globalAlpha = store.plan?.ok === false || store.isLate ? 0.4 : 1;
    this.ticks(curve, x, colours);
    /** @type {import("../geometry/curve.js").Sample[]} */ const list = curve.samples;
    const bend = bendOf(curve);
    const most = Math.max(...list.map((p) => Math.abs(bend.of(p))).filter(Number.isFinite), 1e-3);
    const top = Number(store.doc.robot?.max_speed_mps ?? 2) || 1;
    this.strip(bend.name, bend.unit, [-most, most], TOP_PX, tall, colours);
    this.line(list.map((p) => [x(p.s), TOP_PX + tall * (0.5 - bend.of(p) / most / 2)]), colours.comb);
    this.strip("speed", "m/s", [0, top], TOP_PX + tall + GAP_PX, tall, colours);
    const fast = TOP_PX + tall + GAP_PX;
    const even = Array.from({ length: Math.ceil(width) + 1 }, (_, i) => (i / Math.ceil(width)) * curve.length);
    const places = [...even, ...curve.law.distances].sort((a, b) => a - b); // the stops themselves as well
    this.line(places.map((s) => [x(s), fast + tall * (1 - curve.speedAt(s) / top)]), colours.path);
    ctx.globalAlpha = 1;
    const cursor = drive.run ? this.driven(curve) : store.cursor;
    if (cursor !== null) this.cursor(curve, cursor, x, tall, most, colours);
  }

  /** Where on the planned path the robot is: it may be driving on another one. @param {any} curve */
  driven(curve) {
    const state = this.app.drive.state();
    return curve.nearest(state.x, state.y).s;
  }

  /** @param {any} curve @param {(s: number) => number} x @param {any} colours */
  ticks(curve, x, colours) {
    const { ctx, height } = this;
    ctx.font = "500 10px Inter, system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.textBaseline = "alphabetic";
    let free = -Infinity, lined = -Infinity;
    let count = 0;
    const users = curve.vias.filter((/** @type {any} */ v) => v[3] === "user");
    for (const via of users) {
      const px = x(via[5]);
      const isLined = px - lined >= 4; // else the lines of many points make one grey field
      if (isLined) lined = px;
      ctx.strokeStyle = colours.gridBold;
      ctx.lineWidth = 1;
      ctx.beginPath();
      ctx.moveTo(px, TOP_PX);
      ctx.lineTo(px, /** @type {number} */ (height) - BOTTOM_PX);
      if (isLined) ctx.stroke();
      const { route } = this.app.store.doc;
      const number = route?.closed ? count % pointsOf(this.app.store.doc).length : count; // of a lap
      const text = number === 0 ? "S" : !route?.closed && count === users.length - 1 ? "G" : String(number);
      count += 1;
      const half = ctx.measureText(text).width / 2;
      if (px - half < free + 6) continue;
      ctx.fillStyle = colours.muted;
      ctx.fillText(text, px, /** @type {number} */ (height) - 6);
      free = px + half;
    }
  }

  /** @param {string} name @param {string} unit @param {number[]} range @param {number} y @param {number} tall @param {any} colours */
  strip(name, unit, range, y, tall, colours) {
    const { ctx } = this;
    const width = /** @type {number} */ (this.width);
    ctx.strokeStyle = colours.haloEdge;
    ctx.lineWidth = 1;
    ctx.beginPath();
    const base = range[0] < 0 ? y + tall / 2 : y + tall;
    ctx.moveTo(LEFT_PX, Math.round(base) + 0.5);
    ctx.lineTo(width - RIGHT_PX, Math.round(base) + 0.5);
    ctx.stroke();
    ctx.font = "500 10px Inter, system-ui, sans-serif";
    ctx.textAlign = "right";
    ctx.textBaseline = "middle";
    ctx.fillStyle = colours.muted;
    ctx.fillText(String(Number(range[1].toPrecision(2))), LEFT_PX - 6, y + 4);
    if (tall >= TWO_NUMBERS_PX) ctx.fillText(String(Number(range[0].toPrecision(2))), LEFT_PX - 6, y + tall - 3);
    ctx.textAlign = "left";
    ctx.fillText(`${name} [${unit}]`, LEFT_PX, y - 9);
  }

  /** @param {number[][]} points @param {string} colour */
  line(points, colour) {
    const { ctx } = this;
    ctx.beginPath();
    points.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
    ctx.strokeStyle = colour;
    ctx.lineWidth = 1.6;
    ctx.lineJoin = "round";
    ctx.stroke();
  }

  /** @param {any} curve @param {number} s @param {(s: number) => number} x @param {number} tall @param {number} most @param {any} colours */
  cursor(curve, s, x, tall, most, colours) {
    const { ctx } = this;
    const width = /** @type {number} */ (this.width), height = /** @type {number} */ (this.height);
    const at = curve.at(s);
    const px = x(s);
    ctx.beginPath();
    ctx.moveTo(px, TOP_PX);
    ctx.lineTo(px, height - BOTTOM_PX);
    ctx.strokeStyle = colours.ink;
    ctx.lineWidth = 1.2;
    ctx.stroke();
    const speed = this.app.drive.run ? this.app.drive.state().speed : at.speed;
    const bend = bendOf(curve).of(this.app.drive.run?.samples?.z ? this.app.drive.state() : at);
    const texts = [[bend.toFixed(curve.isSpatial ? 2 : 3).replace(/^-(0\.0+)$/, "$1"), TOP_PX + tall * (0.5 - bend / most / 2)], [`${speed.toFixed(2)} m/s`, TOP_PX + tall + GAP_PX + 10], [`${s.toFixed(1)} m · ${(this.app.drive.run ? this.app.drive.time : curve.timeAt(s)).toFixed(1)} s`, height - 9]];
    ctx.font = "600 11px Inter, system-ui, sans-serif";
    for (const [text, y] of /** @type {[string, number][]} */ (texts)) {
      const w = ctx.measureText(text).width + 8;
      const left = px + w + 8 > width ? px - w - 4 : px + 4;
      ctx.fillStyle = colours.plate;
      ctx.fillRect(left, Math.max(1, y - 8), w, 16);
      ctx.fillStyle = colours.ink;
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      ctx.fillText(text, left + 4, Math.max(9, y));
    }
  }
}
