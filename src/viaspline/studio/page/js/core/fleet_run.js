/** A drive of a fleet that was simulated: every robot on its planned path, by the law that it drove. */

/** @typedef {import("../geometry/curve.js").Curve} Curve */
/** @typedef {import("./fleet_plan.js").RobotPlan} RobotPlan */

export class FleetRun {
  /** @param {any} answer the server's @param {import("./fleet_plan.js").FleetPlan} plan that was driven */
  constructor(answer, plan) {
    /** @type {import("./fleet_plan.js").Wait[]} */ this.waits = answer.waits;
    /** @type {Map<string, RobotPlan & {curve: Curve}>} */ this.byName = new Map();
    for (const { name, law } of answer.robots) {
      const planned = plan.byName.get(name);
      if (planned?.curve) this.byName.set(name, { ...planned, law, curve: planned.curve.timed(law) });
    }
  }

  /** The robots that were driven. */
  get driving() {
    return [...this.byName.values()];
  }

  /** Where a robot is at a time, and how fast. @param {string} name @param {number} time [s] */
  stateOf(name, time) {
    const curve = this.byName.get(name)?.curve;
    if (!curve) return { x: 0, y: 0, heading: 0, speed: 0 };
    const at = curve.at(curve.distanceAt(time));
    return { ...at, speed: curve.speedAt(at.s) };
  }
}
