/** The plan as it is played: where the robot and all that moves are at an instant of the mission's clock. */

import { robotName } from "./core/fleet.js";
import { Playback } from "./playback.js";

const MOST_VIAS = 60; // via points that are told one by one

export class Preview extends Playback {
  /** @param {import("./core/store.js").Store} store */
  constructor(store) {
    super();
    this.store = store;
    store.on("plan", () => this.follow());
    store.on("file", () => this.follow());
  }

  /** The newest plan is what is played; who draws plans hears of it by itself. */
  follow() {
    const before = this.time;
    const { goodPlan: plan, fleetPlan } = this.store;
    if (fleetPlan?.driving.length) {
      this.over(...fleetPlan.lasts);
      this.factor = Math.max(1, Math.round((this.end - this.begin) / 30));
    } else if (!plan) {
      this.isPlaying = false;
      this.over(0, 0);
    } else {
      const { times } = plan.law;
      this.over(times[0], plan.timing?.holds_until ?? times.at(-1));
      this.factor = Math.max(1, Math.round((this.end - this.begin) / 30));
    }
    if (this.time !== before) this.tell();
  }

  /** Whether there is something to be seen that isn't on the map anyway. */
  get isOn() {
    return (!!this.store.goodPlan || !!this.store.fleetPlan) && (this.isPlaying || this.time > this.begin || this.hasMotion);
  }

  /** Whether anything moves but the robot. */
  get hasMotion() {
    const { doc, plan } = this.store;
    if (!doc) return false;
    const moves = (/** @type {any} */ list) => Array.isArray(list) && list.some((item) => item?.motion);
    return moves(doc.world?.known) || moves(doc.world?.unseen) || !!plan?.tracks?.length;
  }

  /** Where the plan has the robot; null without one. @returns {import("./geometry/curve.js").Sample|null} */
  state() {
    const { curve } = this.store;
    return curve && curve.at(curve.distanceAt(this.time));
  }

  /** What happens when, in order. @returns {{time: number, kind: string, text: string, at: number[]|null}[]} */
  moments() {
    const { curve, goodPlan: plan } = this.store;
    if (!plan || !curve) return [];
    const users = plan.vias.filter((/** @type {any} */ via) => via[3] === "user");
    const vias = (users.length > MOST_VIAS ? [users[0], users.at(-1)] : users).map((/** @type {any} */ via, /** @type {number} */ i, /** @type {any[]} */ all) => ({
      time: curve.timeAt(via[5]), kind: via[6] > 0 ? "arrived" : i === all.length - 1 ? "reached" : i ? "via" : "started", text: via[0], at: [via[1], via[2]],
    }));
    const { fleetPlan, file, robot } = this.store;
    if (fleetPlan && robot !== null) {
      const held = fleetPlan.waitsOf(robotName(file, robot)).map((wait) => ({ time: Math.max(this.begin, wait.from), kind: "waits", text: `waits ${wait.seconds.toFixed(1)} s for ${wait.waits_for}`, at: null }));
      return [...vias, ...held].sort((a, b) => a.time - b.time);
    }
    const waits = (plan.timing?.waits ?? []).map((/** @type {any} */ wait) => ({ time: wait.at_s, kind: "waits", text: waitWords(wait), at: null }));
    const proof = plan.timing?.certificate;
    const tightest = proof?.obstacle && proof.tightest_at_s !== null ? [{ time: proof.tightest_at_s, kind: "tightest", text: `nearest to ${proof.obstacle}`, at: proof.tightest_at }] : [];
    return [...vias, ...waits, ...tightest].sort((a, b) => a.time - b.time);
  }

  /** @param {1|-1} way */
  step(way) {
    this.stepTo(way, this.moments().map(({ time }) => time));
  }
}

/** What the robot does for something that moves. @param {any} wait */
export function waitWords(wait) {
  const how = wait.stood_s > 0 ? `waits ${wait.stood_s.toFixed(1)} s` : "slows";
  return `${how} for ${wait.obstacle}`;
}
