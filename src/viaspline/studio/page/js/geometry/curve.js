/**
 * The path that the server has proven, ready to be drawn: Bézier spans, and samples of them with
 * distance, heading, curvature and speed. Samples serve eyes and cursors only.
 */

const SAMPLES_PER_SPAN = 20;

/** @typedef {{x: number, y: number, s: number, heading: number, curvature: number, speed: number}} Sample */

export class Curve {
  /** @param {any} plan the server's answer */
  constructor(plan) {
    this.plan = plan;
    /** @type {number[]} */ this.spans = plan.spans;
    this.count = plan.spans.length / 8;
    /** @type {number[]} */ this.joints = plan.joints; // distances of the spans' ends [m]
    this.length = plan.length;
    this.law = plan.law;
    this.vias = plan.vias;
    /** Parameters of the route's points: the legs are between them. @type {number[]} */
    this.stops = plan.vias.filter((/** @type {any} */ via) => via[3] === "user").map((/** @type {any} */ via) => Math.round(via[4]));
    /** @type {Sample[]|null} */ this.cached = null;
    /** Samples of the same path with another law. @type {Sample[]|null} */ this.earlier = null;
  }

  /** The same path, driven otherwise. @param {any} law */
  timed(law) {
    const next = new /** @type {typeof Curve} */ (this.constructor)({ ...this.plan, law });
    next.earlier = this.cached ?? this.earlier;
    return next;
  }

  /** Samples of where it runs; their speeds may be those of an earlier law. @returns {Sample[]} */
  get shape() {
    return this.cached ?? this.earlier ?? this.samples;
  }

  /** Evaluate a span. @param {number} k @param {number} w from 0 to 1 */
  point(k, w) {
    const p = this.spans, i = 8 * k, v = 1 - w;
    const a = v * v * v, b = 3 * v * v * w, c = 3 * v * w * w, d = w * w * w;
    return [
      a * p[i] + b * p[i + 2] + c * p[i + 4] + d * p[i + 6],
      a * p[i + 1] + b * p[i + 3] + c * p[i + 5] + d * p[i + 7],
    ];
  }

  /** How fast it runs by the parameter of a span [m]. @param {number} k @param {number} w */
  speedIn(k, w) {
    const [dx, dy] = this.derivatives(k, w);
    return Math.hypot(dx, dy);
  }

  /** First and second derivative. @param {number} k @param {number} w */
  derivatives(k, w) {
    const p = this.spans, i = 8 * k, v = 1 - w;
    const at = (/** @type {number} */ o) => [
      3 * (v * v * (p[i + 2 + o] - p[i + o]) + 2 * v * w * (p[i + 4 + o] - p[i + 2 + o]) + w * w * (p[i + 6 + o] - p[i + 4 + o])),
      6 * (v * (p[i + 4 + o] - 2 * p[i + 2 + o] + p[i + o]) + w * (p[i + 6 + o] - 2 * p[i + 4 + o] + p[i + 2 + o])),
    ];
    const [dx, ddx] = at(0), [dy, ddy] = at(1);
    return [dx, dy, ddx, ddy];
  }

  /** @returns {Sample[]} */
  get samples() {
    if (this.cached) return this.cached;
    if (this.earlier) return (this.cached = this.earlier.map((sample) => ({ ...sample, speed: this.speedAt(sample.s) })));
    const found = [];
    const per = this.count > 400 ? 6 : this.count > 120 ? 10 : SAMPLES_PER_SPAN;
    for (let k = 0; k < this.count; k += 1) {
      const speeds = [];
      for (let j = 0; j <= per; j += 1) {
        speeds.push(this.speedIn(k, j / per));
      }
      const sums = [0];
      for (let j = 1; j <= per; j += 1) sums.push(sums[j - 1] + (speeds[j - 1] + speeds[j]) / 2);
      const start = this.joints[k], width = this.joints[k + 1] - start, total = sums[per] || 1;
      for (let j = 0; j <= per; j += 1) found.push(this.sample(k, j / per, start + (width * sums[j]) / total));
    }
    this.cached = found;
    return found;
  }

  /** @param {number} k @param {number} w @param {number} s @returns {Sample} */
  sample(k, w, s) {
    const [x, y] = this.point(k, w);
    let [dx, dy, ddx, ddy] = this.derivatives(k, w);
    let size = Math.hypot(dx, dy);
    if (size < 1e-9) { // a repeated control point: the direction just beside it
      [dx, dy, ddx, ddy] = this.derivatives(k, w < 0.5 ? 1e-3 : 1 - 1e-3);
      size = Math.hypot(dx, dy) || 1;
    }
    return { x, y, s, heading: Math.atan2(dy, dx), curvature: (dx * ddy - dy * ddx) / size ** 3, speed: this.speedAt(s) };
  }

  /** @param {number} s @returns {Sample} */
  at(s) {
    const list = this.shape;
    const i = Math.min(Math.max(search(list, s), 0), list.length - 2);
    const a = list[i], b = list[i + 1];
    const t = b.s > a.s ? Math.min(Math.max((s - a.s) / (b.s - a.s), 0), 1) : 0;
    const mix = (/** @type {number} */ p, /** @type {number} */ q) => p + t * (q - p);
    const turn = Math.atan2(Math.sin(b.heading - a.heading), Math.cos(b.heading - a.heading));
    return {
      x: mix(a.x, b.x), y: mix(a.y, b.y), s, heading: a.heading + t * turn,
      curvature: mix(a.curvature, b.curvature), speed: this.speedAt(s),
    };
  }

  /** Speed at a distance: v² is linear between the points of the law. @param {number} s */
  speedAt(s) {
    const { distances: d, speeds: v } = this.law;
    const i = lower(d, s);
    const part = d[i + 1] > d[i] ? (s - d[i]) / (d[i + 1] - d[i]) : 0;
    return Math.sqrt(Math.max(0, v[i] ** 2 + Math.min(Math.max(part, 0), 1) * (v[i + 1] ** 2 - v[i] ** 2)));
  }

  /** Time of arrival [s]. @param {number} s */
  timeAt(s) {
    const { distances: d, speeds: v, times: t } = this.law;
    const i = lower(d, s);
    const sum = v[i] + this.speedAt(s);
    return Math.min(t[i] + (sum > 0 ? (2 * (s - d[i])) / sum : 0), t[i + 1]);
  }

  /** How far it gets by a time [m]: speed is linear in time between the points of the law. @param {number} time [s] */
  distanceAt(time) {
    const { distances: d, speeds: v, times: t } = this.law;
    const i = lower(t, time);
    const lasts = t[i + 1] - t[i];
    const late = Math.min(Math.max(time - t[i], 0), lasts);
    const accel = lasts > 0 ? (v[i + 1] - v[i]) / lasts : 0;
    return Math.min(d[i] + late * (v[i] + (accel * late) / 2), d[i + 1]);
  }

  /** The nearest place on the path. @param {number} x @param {number} y @returns {{s: number, away: number, span: number, x: number, y: number}} */
  nearest(x, y) {
    const list = this.shape;
    const per = list.length / this.count;
    let best = { s: 0, away: Infinity, span: 0, x: 0, y: 0 };
    for (let i = 0; i + 1 < list.length; i += 1) {
      if (i % per === per - 1) continue; // from one span to the next
      const a = list[i], b = list[i + 1];
      const dx = b.x - a.x, dy = b.y - a.y;
      const size = dx * dx + dy * dy;
      const t = size > 0 ? Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / size)) : 0;
      const away = Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
      if (away < best.away) {
        best = { s: a.s + t * (b.s - a.s), away, span: Math.floor(i / per), x: a.x + t * dx, y: a.y + t * dy };
      }
    }
    return best;
  }

  /** The leg (span between two points of the route) that a span of the curve is part of. @param {number} span */
  legOf(span) {
    let leg = 0;
    while (leg + 2 < this.stops.length && this.stops[leg + 1] <= span) leg += 1;
    return leg;
  }

  /** First and last distance of a leg [m]. @param {number} leg @returns {[number, number]} */
  legRange(leg) {
    return [this.joints[this.stops[leg] ?? 0] ?? 0, this.joints[this.stops[leg + 1] ?? this.count] ?? this.length];
  }
}

/** The last sample that is not past a distance. @param {Sample[]} list @param {number} s */
function search(list, s) {
  let low = 0, high = list.length - 1;
  while (low < high) {
    const mid = (low + high + 1) >> 1;
    if (list[mid].s <= s) low = mid;
    else high = mid - 1;
  }
  return low;
}

/** The stretch of a law that a distance, or a time, lies in. @param {number[]} d @param {number} s */
function lower(d, s) {
  let low = 0, high = d.length - 2;
  while (low < high) {
    const mid = (low + high) >> 1;
    if (d[mid + 1] < s - 1e-9) low = mid + 1;
    else high = mid;
  }
  return Math.max(low, 0);
}
