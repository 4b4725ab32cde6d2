/** A drive that is played: where the robot is at a time, what it has seen, what it is doing. */

import { robotName } from "./core/fleet.js";
import { Playback } from "./playback.js";

export const PLAY_FACTORS = [0.5, 1, 2, 5, 10, 20, 50];

export class Drive extends Playback {
  /** @param {import("./core/store.js").Store} store */
  constructor(store) {
    super();
    this.store = store;
    /** @type {any} */ this.run = null;
    this.factor = 10;
    store.on("run", () => {
      if (store.run === this.run) return;
      this.run = store.run;
      this.begin = this.time = this.run?.begin ?? this.run?.samples.time[0] ?? 0;
      this.end = this.run?.duration ?? 0;
      this.isPlaying = false;
      this.tell();
    });
  }

  /** To the event before or after. @param {1|-1} way */
  step(way) {
    if (this.run) this.stepTo(way, this.moments().map((/** @type {any} */ event) => event.time));
  }

  /** What happens; of a fleet, to the robot that is chosen. @returns {any[]} */
  moments() {
    const { file, robot } = this.store;
    const name = this.run.fleet ? robotName(file, robot ?? 0) : null;
    return this.run.events.filter((/** @type {any} */ event) => name === null || event.robot === name);
  }

  /** The last sample that is not later than now. */
  index(time = this.time) {
    const list = this.run.samples.time;
    let low = 0, high = list.length - 1;
    while (low < high) {
      const mid = (low + high + 1) >> 1;
      if (list[mid] <= time) low = mid;
      else high = mid - 1;
    }
    return low;
  }

  state() {
    return this.stateAt(this.time);
  }

  /** Of a fleet that of the robot that is chosen. @param {number} time */
  stateAt(time) {
    const { file, robot } = this.store;
    if (this.run.fleet) return this.run.fleet.stateOf(robotName(file, robot ?? 0), time);
    const s = this.run.samples;
    const i = this.index(time), j = Math.min(i + 1, s.time.length - 1);
    const t = s.time[j] > s.time[i] ? Math.min(1, (time - s.time[i]) / (s.time[j] - s.time[i])) : 0;
    const mix = (/** @type {number[]} */ list) => list[i] + t * (list[j] - list[i]);
    const state = { x: mix(s.x), y: mix(s.y), heading: mix(s.heading), speed: mix(s.speed) };
    return s.z ? { ...state, z: mix(s.z), climb: mix(s.climb) } : state;
  }

  /** The look of a lidar that is nearest to now. */
  frame() {
    const times = this.run.sight.times;
    let best = 0;
    times.forEach((/** @type {number} */ time, /** @type {number} */ i) => {
      if (time <= this.time) best = i;
    });
    return best;
  }

  /** Whether the sensor has shown an unseen obstacle by now. @param {number} index */
  hasSeen(index) {
    const seen = this.run?.sight?.kind === "range" ? this.run.sight.seen[index] : null;
    return seen !== null && seen !== undefined && seen <= this.time;
  }

  /** The re-plans so far. @returns {any[]} */
  replans() {
    return this.run.replans.filter((/** @type {any} */ replan) => replan.time <= this.time);
  }

  /** The events so far. @returns {any[]} */
  events() {
    return this.run.events.filter((/** @type {any} */ event) => event.time <= this.time + 1e-6);
  }

  /** The stay at a station: seconds left, and which part of it. @returns {{left: number, part: number}|null} */
  stay() {
    for (const event of this.run.events) {
      const dwell = event.kind === "arrived" ? Number(event.data?.dwell_s) : 0;
      if (dwell > 0 && event.time <= this.time && this.time < event.time + dwell) {
        const left = event.time + dwell - this.time;
        return { left, part: left / dwell };
      }
    }
    return null;
  }
}
