/**
 * The picture of the path unrolled: its height over the distance, with the ground, what stands under,
 * over and beside it, and the altitude band.
 */

import { theme, viridis } from "../draw/theme.js";
import { drawAround } from "./elevation_around.js";
import { drawAxes } from "./elevation_axes.js";
import { BOTTOM_PX, LEFT_PX, RIGHT_PX, TOP_PX, stroke } from "./elevation_frame.js";
import { drawCursor, drawPoint, drawTightest } from "./elevation_marks.js";
import { nearestFrom } from "./nearest_from.js";

const SPEED_SHADES = 24;

export class ElevationPicture {
  /** @param {any} app @param {import("./space.js").Space} space */
  constructor(app, space) {
    this.app = app;
    this.space = space;
    this.canvas = /** @type {HTMLCanvasElement} */ (document.querySelector("#elevation"));
    this.ctx = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    this.width = 0; // [CSS pixel]
    this.height = 0;
    /** From where to where heights are drawn [m]: it stays while something is dragged. @type {number[]} */ this.range = [0, 1];
    /** @type {{id: string, from: number, value: number}|null} */ this.held = null;
    /** Where names stand already: middle, height, width [CSS pixel]. @type {number[][]} */ this.named = [];
    this.flownTo = 0; // where along the path the robot was last [m]
    this.isDue = false;
  }

  /** Draw in the next frame. */
  later() {
    if (this.isDue || !this.space.isOn) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.draw();
    });
  }

  // --- from metres to pixels

  /** @param {number} s distance along the path [m] */
  x(s) {
    const length = this.app.store.curve?.length || 1;
    return LEFT_PX + (s / length) * (this.width - LEFT_PX - RIGHT_PX);
  }

  /** @param {number} z [m] */
  y(z) {
    const [low, high] = this.range;
    return TOP_PX + ((high - z) / (high - low)) * (this.height - TOP_PX - BOTTOM_PX);
  }

  get pixelsPerMetre() {
    return (this.height - TOP_PX - BOTTOM_PX) / (this.range[1] - this.range[0]);
  }

  /**
   * Where the points of the route are drawn: where the newest path passes them, as high as they are
   * asked to be.
   * @returns {{id: string, x: number, y: number, label: string, dwell: number}[]}
   */
  points() {
    const { curve } = this.app.store;
    if (!curve) return [];
    return this.space.points().flatMap(({ id, at, stop, dwell }, i) => {
      if (!stop) return []; // no path has been by there yet
      const isLand = id === "land";
      const label = id === "start" ? "S" : id === "goal" ? "G" : isLand ? "L" : String(i);
      const s = isLand ? curve.length : stop.distance;
      return [{ id, x: this.x(s), y: this.y(at[2]), label, dwell }];
    });
  }

  // --- drawing

  /** What is drawn has to be within the range; it isn't changed while a point is dragged. */
  fitRange() {
    if (this.held) return;
    const { curve } = this.app.store;
    let low = Infinity, high = -Infinity;
    const take = (/** @type {number|null} */ z) => {
      if (z === null || !Number.isFinite(z)) return;
      low = Math.min(low, z);
      high = Math.max(high, z);
    };
    for (const { z } of curve?.solidSamples ?? []) take(z);
    for (const { at } of this.space.points()) take(at[2]);
    const { profile } = this.space;
    profile?.ground.forEach(take);
    const most = high;
    [...(profile?.low ?? []), ...(profile?.high ?? [])].forEach(take);
    const spread = Math.max(most - low, 1);
    high = Math.min(high, most + 2 * spread); // a band far above doesn't press the path to the floor
    if (!(high > low)) [low, high] = [low - 1, low + 1];
    const grow = Math.max(0.08 * (high - low), 0.5);
    if (Number.isFinite(low)) this.range = [low - grow, high + grow];
  }

  draw() {
    const { ctx, width, height } = this;
    if (!width || !height || !this.space.isOn) return;
    const { store, drive, preview } = this.app;
    const { curve } = store;
    const colours = theme();
    const ratio = this.canvas.width / width;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    if (!curve?.isSpatial) return;
    this.fitRange();
    const isStale = store.plan?.ok === false || store.isLate;
    drawAxes(this, colours);
    ctx.save();
    ctx.beginPath();
    ctx.rect(LEFT_PX, TOP_PX - 8, width - LEFT_PX - RIGHT_PX, height - TOP_PX - BOTTOM_PX + 10);
    ctx.clip();
    const { profile } = this.space;
    if (profile) drawAround(this, profile, colours, profile.rev === store.plan?.rev ? 1 : 0.5);
    this.path(curve, colours, isStale);
    if (!drive.run) this.provisional(colours);
    if (drive.run?.samples?.z) this.flight(drive, colours);
    ctx.restore();
    drawTightest(this, colours, isStale);
    for (const point of this.points()) drawPoint(this, point, colours);
    const s = drive.run ? this.flown() : store.cursor ?? (preview.isOn ? curve.distanceAt(preview.time) : null);
    if (s !== null) drawCursor(this, curve, s, colours);
  }

  /** @param {any} curve @param {any} colours @param {boolean} isStale */
  path(curve, colours, isStale) {
    const { ctx } = this;
    const { show, doc } = this.app.store;
    /** @type {import("../geometry/spatial_curve.js").SpatialSample[]} */ const list = curve.solidSamples;
    ctx.lineJoin = ctx.lineCap = "round";
    const trace = () => {
      ctx.beginPath();
      list.forEach(({ s, z }, i) => (i ? ctx.lineTo(this.x(s), this.y(z)) : ctx.moveTo(this.x(s), this.y(z))));
    };
    trace();
    if (isStale) {
      stroke(ctx, colours.stale, 2, [2, 5]);
      return;
    }
    stroke(ctx, colours.casing, 5);
    trace();
    stroke(ctx, show.speed ? colours.ink : colours.path, show.speed ? 4 : 2.6);
    if (!show.speed) return;
    const top = Number(doc.robot?.max_speed_mps ?? 2) || 1;
    let shade = -1;
    list.forEach((sample, i) => {
      const next = Math.round((sample.speed / top) * (SPEED_SHADES - 1));
      if (i) ctx.lineTo(this.x(sample.s), this.y(sample.z));
      if (next === shade && i + 1 < list.length) return;
      if (shade >= 0) stroke(ctx, viridis(shade / (SPEED_SHADES - 1)), 2.6);
      ctx.beginPath();
      ctx.moveTo(this.x(sample.s), this.y(sample.z));
      shade = next;
    });
  }

  /** Legs that aren't planned as they are asked for: lines between their points. @param {any} colours */
  provisional(colours) {
    const { ctx, app } = this;
    if (!this.space.provisional().length) return;
    const points = this.points();
    ctx.beginPath();
    points.forEach(({ id, x, y }, i) => {
      const before = points[i - 1], after = points[i + 1];
      if (id !== app.store.selection) return;
      if (before) {
        ctx.moveTo(before.x, before.y);
        ctx.lineTo(x, y);
      } else ctx.moveTo(x, y);
      if (after) ctx.lineTo(after.x, after.y);
    });
    stroke(ctx, colours.select, 1.4, [3, 4]);
  }

  /** Where the robot has been, by the planned path's distance. @param {any} drive @param {any} colours */
  flight(drive, colours) {
    const { ctx } = this;
    const { x, y, z } = drive.run.samples;
    const last = drive.index();
    const step = Math.max(1, Math.floor(last / 400));
    const { curve } = this.app.store;
    ctx.beginPath();
    let s = 0;
    for (let i = 0; i <= last; i += step) {
      s = nearestFrom(curve, [x[i], y[i], z[i]], s);
      if (i) ctx.lineTo(this.x(s), this.y(z[i]));
      else ctx.moveTo(this.x(s), this.y(z[i]));
    }
    stroke(ctx, colours.robot, 1.8);
    this.flownTo = s;
  }

  /** How far along the planned path the robot is [m]. */
  flown() {
    const { curve } = this.app.store;
    const state = this.app.drive.state();
    return nearestFrom(curve, [state.x, state.y, state.z ?? 0], this.flownTo);
  }

}
