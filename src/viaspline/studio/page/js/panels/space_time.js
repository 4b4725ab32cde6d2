/**
 * The path over time: how far along it the robot is when, and what is blocked then by what moves. It
 * follows the instant of the map, and dragging in it moves that.
 */

import { onTheme, theme } from "../draw/theme.js";
import { seconds } from "../units.js";
import { fitted, lazily } from "./dom.js";

const LEFT_PX = 40, RIGHT_PX = 10, TOP_PX = 18, BOTTOM_PX = 20;
const FONT = "10px Inter, system-ui, sans-serif";

export class SpaceTimePanel {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.canvas = /** @type {HTMLCanvasElement} */ (document.querySelector("#space-time"));
    this.ctx = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    this.width = this.height = 0;
    const draw = lazily(() => this.draw(), 30);
    app.store.on("plan space-time hover selection run status", draw);
    app.drive.on(draw);
    app.preview.on(draw);
    onTheme(draw);
    fitted(this);
    const scrub = (/** @type {PointerEvent} */ event) => this.follow(event, event.buttons > 0);
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.follow(event, true);
    });
    this.canvas.addEventListener("pointermove", scrub);
    this.canvas.addEventListener("pointerleave", () => app.store.lookAt(null));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /** What is shown: nothing where nothing moves. */
  get shown() {
    const { store } = this.app;
    return store.goodPlan?.timing ? store.spaceTime : null;
  }

  /** Where on the panel a distance and a time are [CSS pixel]. @param {number} s [m] @param {number} t [s] @returns {[number, number]} */
  at(s, t) {
    const { begin, end } = this.shown;
    const length = this.app.store.goodPlan?.length || 1;
    return [LEFT_PX + (s / length) * (this.width - LEFT_PX - RIGHT_PX), this.height - BOTTOM_PX - ((t - begin) / (end - begin || 1)) * (this.height - TOP_PX - BOTTOM_PX)];
  }

  /** @param {PointerEvent} event @param {boolean} isHeld */
  follow(event, isHeld) {
    const { store, drive, preview } = this.app;
    if (!this.shown || !this.width) return;
    const { begin, end } = this.shown;
    const across = (event.offsetX - LEFT_PX) / (this.width - LEFT_PX - RIGHT_PX);
    const up = (this.height - BOTTOM_PX - event.offsetY) / (this.height - TOP_PX - BOTTOM_PX);
    if (isHeld) {
      const played = drive.run ? drive : preview;
      played.pause();
      played.seek(begin + up * (end - begin));
    } else store.lookAt(across < 0 || across > 1 ? null : across * store.goodPlan.length);
  }

  /** Arrows move the instant. @param {KeyboardEvent} event */
  key(event) {
    const way = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
    if (!way || !this.shown) return;
    this.app.timeline.nudge(way, event.shiftKey);
    event.preventDefault();
    event.stopPropagation();
  }

  draw() {
    const { ctx, width, height, app } = this;
    document.body.classList.toggle("has-motion", !!this.shown);
    if (!width || !height) return;
    const ratio = this.canvas.width / width;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    const { shown } = this;
    if (!shown) return;
    const colours = theme();
    const { store } = app;
    ctx.globalAlpha = store.plan?.ok === false || store.isLate || shown.rev !== store.plan?.rev ? 0.45 : 1;
    this.axes(shown, colours);
    ctx.save();
    ctx.beginPath();
    ctx.rect(LEFT_PX, TOP_PX, width - LEFT_PX - RIGHT_PX, height - TOP_PX - BOTTOM_PX);
    ctx.clip();
    for (const one of shown.blocked) this.blocked(one, colours);
    this.line(shown.free, colours.loser, 1.3, [5, 4]);
    this.line(shown.law, colours.path, 2, []);
    ctx.restore();
    this.names(shown, colours);
    ctx.globalAlpha = 1;
    this.instant(shown, colours);
  }

  /** @param {any} shown @param {any} colours */
  axes(shown, colours) {
    const { ctx, width, height } = this;
    const { begin, end } = shown;
    ctx.font = `500 ${FONT}`;
    ctx.fillStyle = colours.muted;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillText("time [s] over distance; dashed: if nothing moved", LEFT_PX, TOP_PX - 9);
    ctx.strokeStyle = colours.gridBold;
    ctx.lineWidth = 1;
    const raw = (end - begin) / Math.max(2, (height - TOP_PX - BOTTOM_PX) / 28);
    const power = 10 ** Math.floor(Math.log10(raw || 1));
    const step = power * (raw / power <= 1 ? 1 : raw / power <= 2 ? 2 : raw / power <= 5 ? 5 : 10);
    ctx.textAlign = "right";
    for (let t = Math.ceil(begin / step) * step; t <= end + 1e-9; t += step) {
      const y = Math.round(this.at(0, t)[1]) + 0.5;
      ctx.beginPath();
      ctx.moveTo(LEFT_PX, y);
      ctx.lineTo(width - RIGHT_PX, y);
      ctx.stroke();
      ctx.fillText(String(Number(t.toFixed(2))), LEFT_PX - 6, y);
    }
    ctx.strokeStyle = colours.haloEdge;
    ctx.strokeRect(LEFT_PX + 0.5, TOP_PX + 0.5, width - LEFT_PX - RIGHT_PX - 1, height - TOP_PX - BOTTOM_PX - 1);
    ctx.textBaseline = "alphabetic";
    ctx.textAlign = "left";
    ctx.fillText("0", LEFT_PX, height - 6);
    ctx.textAlign = "right";
    ctx.fillText(`${this.app.store.goodPlan.length.toFixed(1)} m`, width - RIGHT_PX, height - 6);
  }

  /** @param {any} one @param {any} colours */
  blocked({ obstacle, rings }, colours) {
    const { ctx } = this;
    const { selection, goodPlan } = this.app.store;
    const isSelected = !!selection?.startsWith(`${goodPlan.timing.items[obstacle]}`);
    ctx.beginPath();
    for (const ring of rings) this.trace(ring, true);
    ctx.fillStyle = colours.movingFill;
    ctx.fill("evenodd");
    ctx.strokeStyle = isSelected ? colours.select : colours.moving;
    ctx.lineWidth = isSelected ? 2 : 1;
    ctx.stroke();
  }

  /** What blocks, in the largest of its places, where names don't meet. @param {any} shown @param {any} colours */
  names(shown, colours) {
    const { ctx } = this;
    const size = (/** @type {number[]} */ b) => (b[2] - b[0]) * (b[3] - b[1]);
    const places = shown.blocked.map((/** @type {any} */ { obstacle, rings }) => {
      const boxes = rings.map((/** @type {number[]} */ ring) => this.boxOf(ring));
      return { obstacle, box: boxes.reduce((/** @type {number[]} */ x, /** @type {number[]} */ y) => (size(y) > size(x) ? y : x)) };
    });
    places.sort((/** @type {any} */ x, /** @type {any} */ y) => size(y.box) - size(x.box));
    ctx.font = `600 ${FONT}`;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillStyle = colours.ink;
    /** @type {number[][]} */ const taken = [];
    for (const { obstacle, box } of places) {
      const half = ctx.measureText(obstacle).width / 2;
      if (box[3] - box[1] < 13 || 2 * half > box[2] - box[0] + 30) continue;
      const x = Math.min(Math.max((box[0] + box[2]) / 2, LEFT_PX + half + 2), this.width - RIGHT_PX - half - 2), y = (box[1] + box[3]) / 2;
      if (taken.some(([tx, ty, th]) => Math.abs(tx - x) < half + th + 4 && Math.abs(ty - y) < 13)) continue;
      taken.push([x, y, half]);
      ctx.fillText(obstacle, x, y);
    }
  }

  /** @param {number[]} ring */
  boxOf(ring) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < ring.length; i += 2) {
      const [x, y] = this.at(ring[i], ring[i + 1]);
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    }
    return box;
  }

  /** @param {number[]} points s, t, s, t, … @param {boolean} isClosed */
  trace(points, isClosed) {
    const { ctx } = this;
    for (let i = 0; i < points.length; i += 2) {
      const [x, y] = this.at(points[i], points[i + 1]);
      if (i) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
    }
    if (isClosed) ctx.closePath();
  }

  /** @param {number[]} points @param {string} colour @param {number} wide @param {number[]} dash */
  line(points, colour, wide, dash) {
    const { ctx } = this;
    ctx.beginPath();
    this.trace(points, false);
    ctx.strokeStyle = colour;
    ctx.lineWidth = wide;
    ctx.lineJoin = "round";
    ctx.setLineDash(dash);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  /** Where the robot is at the instant of the map, and the distance that is looked at. @param {any} shown @param {any} colours */
  instant(shown, colours) {
    const { ctx, app, width, height } = this;
    const { store, drive, preview } = app;
    const time = drive.run ? drive.time : preview.time;
    const state = drive.run ? drive.state() : null;
    const s = state ? store.curve.nearest(state.x, state.y).s : store.curve.distanceAt(time);
    const [x, y] = this.at(s, Math.min(time, shown.end));
    ctx.strokeStyle = colours.ink;
    ctx.lineWidth = 1.2;
    ctx.beginPath();
    ctx.moveTo(LEFT_PX, y);
    ctx.lineTo(width - RIGHT_PX, y);
    if (store.cursor !== null) {
      const across = this.at(store.cursor, 0)[0];
      ctx.moveTo(across, TOP_PX);
      ctx.lineTo(across, height - BOTTOM_PX);
    }
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(x, y, 4.5, 0, 2 * Math.PI);
    ctx.fillStyle = drive.run ? colours.robot : colours.path;
    ctx.fill();
    ctx.strokeStyle = colours.paper;
    ctx.lineWidth = 1.5;
    ctx.stroke();
    const text = seconds(time);
    ctx.font = `600 ${FONT}`;
    const w = ctx.measureText(text).width + 6;
    const left = x + w + 14 > width - RIGHT_PX ? x - w - 8 : x + 8;
    ctx.fillStyle = colours.plate;
    ctx.fillRect(left, y - 16, w, 14);
    ctx.fillStyle = colours.ink;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillText(text, left + 3, y - 9);
  }
}
