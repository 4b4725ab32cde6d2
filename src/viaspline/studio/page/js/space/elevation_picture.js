/**
 * The picture of the path unrolled: its height over the distance, with the ground, what stands under,
 * over and beside it, and the altitude band.
 */

import { theme, viridis } from "../draw/theme.js";

export const LEFT_PX = 52, RIGHT_PX = 14;
const TOP_PX = 20, BOTTOM_PX = 20;
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
    this.axes(colours);
    ctx.save();
    ctx.beginPath();
    ctx.rect(LEFT_PX, TOP_PX - 8, width - LEFT_PX - RIGHT_PX, height - TOP_PX - BOTTOM_PX + 10);
    ctx.clip();
    const { profile } = this.space;
    if (profile) this.around(profile, colours, profile.rev === store.plan?.rev ? 1 : 0.5);
    this.path(curve, colours, isStale);
    if (!drive.run) this.provisional(colours);
    if (drive.run?.samples?.z) this.flight(drive, colours);
    ctx.restore();
    this.tightest(colours, isStale);
    for (const point of this.points()) this.point(point, colours);
    const s = drive.run ? this.flown() : store.cursor ?? (preview.isOn ? curve.distanceAt(preview.time) : null);
    if (s !== null) this.cursor(curve, s, colours);
  }

  /** @param {any} colours */
  axes(colours) {
    const { ctx, width, height } = this;
    const [low, high] = this.range;
    ctx.font = "500 10px Inter, system-ui, sans-serif";
    ctx.textBaseline = "middle";
    ctx.textAlign = "right";
    const step = roundStep(((high - low) * 26) / (height - TOP_PX - BOTTOM_PX));
    ctx.lineWidth = 1;
    for (let z = Math.ceil(low / step) * step; z <= high; z += step) {
      const y = Math.round(this.y(z)) + 0.5;
      ctx.strokeStyle = colours.grid;
      ctx.beginPath();
      ctx.moveTo(LEFT_PX, y);
      ctx.lineTo(width - RIGHT_PX, y);
      ctx.stroke();
      ctx.fillStyle = colours.muted;
      ctx.fillText(String(Number(z.toFixed(2))), LEFT_PX - 6, y);
    }
    ctx.textAlign = "left";
    ctx.fillText("height [m] along the path", LEFT_PX, 8);
    const length = this.app.store.curve.length;
    const along = roundStep((length * 90) / (width - LEFT_PX - RIGHT_PX));
    this.legend(colours);
    ctx.fillStyle = colours.muted;
    ctx.textAlign = "center";
    for (let s = 0; s <= length; s += along) ctx.fillText(s ? String(s) : "0 m", Math.max(this.x(s), LEFT_PX + 8), height - 8);
  }

  /** What is what, on the right above the drawing. @param {any} colours */
  legend(colours) {
    const { ctx, width } = this;
    const { profile } = this.space;
    const has = (/** @type {(number|null)[]|undefined} */ edge) => !!edge?.some((z) => z !== null);
    const beside = (/** @type {number} */ m) => !!profile?.near.some((/** @type {any} */ one) => one.meets.includes(m));
    /** @type {[string, string, string, boolean][]} */ const all = [
      ["altitude band", colours.zone, "", has(profile?.low) || has(profile?.high)],
      [`beside, within ${profile?.beside ?? 10} m`, colours.haloEdge, colours.halo, beside(0)],
      ["under or over", colours.obstacleEdge, colours.obstacle, beside(1)],
    ];
    let right = width - RIGHT_PX;
    ctx.textAlign = "right";
    for (const [text, edge, face, isThere] of all) {
      const wide = ctx.measureText(text).width;
      if (!isThere || right - wide < LEFT_PX + 200) continue;
      ctx.fillStyle = colours.muted;
      ctx.fillText(text, right, 8);
      right -= wide + 18;
      ctx.beginPath();
      if (face) ctx.rect(right, 4, 13, 8);
      else {
        ctx.moveTo(right - 4, 8);
        ctx.lineTo(right + 14, 8);
      }
      if (face) {
        ctx.fillStyle = face;
        ctx.fill();
      }
      stroke(ctx, edge, 1, face ? [] : [5, 3]);
      right -= 16;
    }
  }

  /** Ground, band and what stands near. @param {any} profile @param {any} colours @param {number} alpha */
  around(profile, colours, alpha) {
    const { ctx } = this;
    const length = this.app.store.curve.length;
    const last = profile.distances.at(-1) || 1;
    const x = (/** @type {number} */ i) => this.x((profile.distances[i] / last) * length);
    ctx.globalAlpha = alpha;
    for (const part of runs(profile.ground)) {
      ctx.beginPath();
      part.forEach((i, k) => (k ? ctx.lineTo(x(i), this.y(profile.ground[i])) : ctx.moveTo(x(i), this.y(profile.ground[i]))));
      ctx.strokeStyle = colours.contourText;
      ctx.lineWidth = 1.2;
      ctx.stroke();
      ctx.lineTo(x(/** @type {number} */ (part.at(-1))), this.height);
      ctx.lineTo(x(part[0]), this.height);
      ctx.closePath();
      ctx.fillStyle = colours.ground;
      ctx.fill();
    }
    this.named = this.points().map(({ x: px, y }) => [px, y, 16]);
    for (const near of profile.near) this.silhouette(near, x, colours);
    for (const edge of [profile.low, profile.high]) {
      for (const part of runs(edge)) {
        ctx.beginPath();
        part.forEach((i, k) => (k ? ctx.lineTo(x(i), this.y(edge[i])) : ctx.moveTo(x(i), this.y(edge[i]))));
        ctx.strokeStyle = colours.zone;
        ctx.lineWidth = 1.2;
        ctx.setLineDash([6, 4]);
        ctx.stroke();
        ctx.setLineDash([]);
      }
    }
    ctx.globalAlpha = 1;
  }

  /** One thing: dark where it is under or over the path, light where it is beside it. @param {any} near @param {(i: number) => number} x @param {any} colours */
  silhouette({ first, low, high, meets, name }, x, colours) {
    const { ctx } = this;
    const half = (x(1) - x(0)) / 2;
    for (const dark of [0, 1]) {
      ctx.fillStyle = dark ? colours.obstacle : colours.halo;
      ctx.strokeStyle = dark ? colours.obstacleEdge : colours.haloEdge;
      for (const part of runs(meets.map((/** @type {number} */ m) => (m === dark ? 1 : null)))) {
        ctx.beginPath();
        part.forEach((i, k) => (k ? ctx.lineTo(x(first + i) + half, this.y(high[i])) : ctx.moveTo(x(first + i) - half, this.y(high[i]))));
        if (part.length === 1) ctx.lineTo(x(first + part[0]) + half, this.y(high[part[0]]));
        [...part].reverse().forEach((i, k) => ctx.lineTo(x(first + i) + (k ? -half : half), this.y(low[i])));
        ctx.closePath();
        ctx.fill();
        ctx.lineWidth = 1;
        ctx.stroke();
      }
    }
    const [left, right] = [x(first), x(first + low.length - 1)];
    const wide = 5.5 * name.length;
    ctx.fillStyle = colours.muted;
    ctx.font = "500 10px Inter, system-ui, sans-serif";
    ctx.textAlign = "center";
    const x0 = (left + right) / 2, y0 = Math.max(this.y(high[Math.floor(high.length / 2)]) - 7, TOP_PX);
    const isTaken = this.named.some(([other, y, half]) => Math.abs(x0 - other) < (wide + half) / 2 + 4 && Math.abs(y0 - y) < 12);
    if (!name || right - left < wide || isTaken) return;
    this.named.push([x0, y0, wide]);
    ctx.fillText(name, x0, y0);
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

  /** @param {any} colours @param {boolean} isStale */
  tightest(colours, isStale) {
    const { plan } = this.app.store;
    if (isStale || !plan?.ok || plan.certificate.distance === null || plan.certificate.clearance === null) return;
    const { ctx } = this;
    const [x, y] = [this.x(plan.certificate.distance), this.y(plan.space.tightest_z)];
    ctx.beginPath();
    ctx.moveTo(x, y + 3);
    ctx.lineTo(x + 5, y + 12);
    ctx.lineTo(x - 5, y + 12);
    ctx.closePath();
    ctx.fillStyle = colours.tightest;
    ctx.fill();
  }

  /** @param {{id: string, x: number, y: number, label: string, dwell?: number}} point @param {any} colours */
  point({ id, x, y, label, dwell = 0 }, colours) {
    const { ctx, app } = this;
    const isSelected = id === app.store.selection;
    ctx.beginPath();
    if (dwell > 0) ctx.roundRect(x - 7, y - 7, 14, 14, 3);
    else ctx.arc(x, y, 7, 0, 2 * Math.PI);
    const isLast = id === "goal" || id === "land";
    ctx.fillStyle = id === "start" ? colours.start : isLast ? colours.goal : dwell > 0 ? colours.station : colours.paper;
    ctx.fill();
    ctx.lineWidth = isSelected ? 2.6 : 1.5;
    ctx.strokeStyle = isSelected ? colours.select : colours.ink;
    ctx.stroke();
    ctx.fillStyle = id === "start" || isLast ? colours.paper : dwell > 0 ? "#1b1f24" : colours.ink;
    ctx.font = "600 9px Inter, system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillText(label, x, y + 0.5);
    const words = isSelected ? this.space.words(id) : "";
    if (!words) return;
    ctx.font = "600 11px Inter, system-ui, sans-serif";
    const w = ctx.measureText(words).width + 8;
    const left = Math.min(Math.max(x - w / 2, LEFT_PX), this.width - w - 2);
    const top = y - 27 < TOP_PX ? y + 11 : y - 27;
    ctx.fillStyle = colours.plate;
    ctx.fillRect(left, top, w, 16);
    ctx.fillStyle = colours.select;
    ctx.textAlign = "left";
    ctx.fillText(words, left + 4, top + 8.5);
  }

  /** @param {any} curve @param {number} s @param {any} colours */
  cursor(curve, s, colours) {
    const { ctx, height, width } = this;
    const { drive } = this.app;
    const state = drive.run?.samples?.z ? drive.state() : curve.at(s);
    const [x, y] = [this.x(s), this.y(state.z)];
    ctx.beginPath();
    ctx.moveTo(x, TOP_PX);
    ctx.lineTo(x, height - BOTTOM_PX);
    ctx.strokeStyle = colours.muted;
    ctx.lineWidth = 1;
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(x, y, 4.5, 0, 2 * Math.PI);
    ctx.fillStyle = drive.run ? colours.robot : colours.path;
    ctx.fill();
    ctx.strokeStyle = colours.paper;
    ctx.stroke();
    const ground = this.space.groundAt(state.x, state.y);
    const text = `${s.toFixed(1)} m · ${state.z.toFixed(1)} m high${ground === null ? "" : ` · ${(state.z - ground).toFixed(1)} m above ground`}`;
    ctx.font = "600 11px Inter, system-ui, sans-serif";
    const w = ctx.measureText(text).width + 8;
    ctx.fillStyle = colours.plate;
    const left = Math.min(Math.max(x - w / 2, LEFT_PX + 150), width - w - 4);
    ctx.fillRect(left, 0, w, 16);
    ctx.fillStyle = colours.ink;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillText(text, left + 4, 8);
  }
}

/** @param {CanvasRenderingContext2D} ctx @param {string} colour @param {number} width @param {number[]} [dash] */
function stroke(ctx, colour, width, dash = []) {
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.setLineDash(dash);
  ctx.stroke();
  ctx.setLineDash([]);
}

/** The next of 1, 2 and 5 times a power of ten. @param {number} least */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(Math.max(least, 1e-9)));
  return power * (least / power <= 1 ? 1 : least / power <= 2 ? 2 : least / power <= 5 ? 5 : 10);
}

/** The indices of values that are there, in runs. @param {(number|null)[]} values @returns {number[][]} */
function runs(values) {
  /** @type {number[][]} */ const found = [];
  values.forEach((value, i) => {
    if (value === null) return;
    if (i && values[i - 1] !== null && found.length) /** @type {number[]} */ (found.at(-1)).push(i);
    else found.push([i]);
  });
  return found;
}

const AHEAD = 0.06; // of the path: how far on from where it was something is looked for

const JUMP_M = 3; // nearer by so much, somewhere else is where it is: the time was set, not played

/** The distance of the place of a curve that is nearest; of two as near the one not far from where it was. @param {any} curve @param {number[]} place @param {number} from [m] */
function nearestFrom(curve, [x, y, z], from) {
  const reach = Math.max(AHEAD * curve.length, 20);
  let best = Infinity, found = from;
  for (const sample of curve.solidSamples) {
    const isFar = sample.s < from - reach || sample.s > from + reach;
    const away = Math.hypot(sample.x - x, sample.y - y, sample.z - z) + 1e-3 * Math.abs(sample.s - from) + (isFar ? JUMP_M : 0);
    if (away < best) {
      best = away;
      found = sample.s;
    }
  }
  return found;
}
