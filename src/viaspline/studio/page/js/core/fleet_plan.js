/** The newest plan of a fleet: of each robot its path and its law; the server sends what is new of them. */

import { Curve } from "../geometry/curve.js";
import { placeInMission, robotName } from "./fleet.js";

/**
 * What there is of a robot.
 * @typedef {object} RobotPlan
 * @property {string} name
 * @property {number} radius of the circle that holds its body [m]
 * @property {boolean} leaves whether it is gone once it has arrived
 * @property {{outcome: string, reason: string, remedy: string}|null} missing why it has no plan
 * @property {number} alone how long it would drive if it were alone [s]
 * @property {number} duration how long it drives [s]
 * @property {any} path as a mission's plan has it; null without one
 * @property {any} law
 * @property {Curve|null} curve
 */

/** @typedef {{robot: string, waits_for: string, seconds: number, from: number, until: number}} Wait */

export class FleetPlan {
  constructor() {
    /** @type {Map<string, RobotPlan>} */ this.byName = new Map();
    /** @type {any} */ this.answer = null; // the newest
    /** @type {any} */ this.certificate = null; // of the newest that is a plan
    /** @type {Wait[]} */ this.waits = [];
    this.served = false;
    this.isWhole = true; // else more is tried to serve those who are not
  }

  /** Take up what the server says. @param {any} answer */
  take(answer) {
    this.answer = answer;
    if (!answer.fleet) return;
    const { robots, waits, certificate, served, is_whole: isWhole } = answer.fleet;
    this.byName = new Map(robots.map((/** @type {any} */ robot) => [robot.name, this.merged(robot)]));
    this.certificate = certificate;
    this.waits = waits;
    this.served = served;
    this.isWhole = isWhole;
  }

  /** @param {any} robot what is new of it @returns {RobotPlan} */
  merged(robot) {
    const known = this.byName.get(robot.name);
    const path = robot.path === undefined ? known?.path ?? null : robot.path;
    const law = robot.law === undefined ? known?.law ?? null : robot.law;
    if (!path || !law) return { ...robot, path: null, law: null, curve: null };
    const curve = path !== known?.path ? new Curve({ ...path, law }) : law !== known?.law ? known?.curve?.timed(law) ?? null : known?.curve ?? null;
    return { ...robot, path, law, curve };
  }

  /** The robots that have a path. @returns {(RobotPlan & {curve: Curve})[]} */
  get driving() {
    return /** @type {any} */ ([...this.byName.values()].filter((robot) => robot.curve));
  }

  get missing() {
    return [...this.byName.values()].filter((robot) => robot.missing);
  }

  /** From when to when anybody drives [s]. @returns {[number, number]} */
  get lasts() {
    const laws = this.driving.map(({ law }) => law.times);
    return laws.length ? [Math.min(0, ...laws.map((times) => times[0])), Math.max(...laws.map((times) => times.at(-1)))] : [0, 0];
  }

  /** How long robots wait for others, the longest first. @param {string} name @returns {Wait[]} */
  waitsOf(name) {
    return this.waits.filter((wait) => wait.robot === name).sort((a, b) => b.seconds - a.seconds);
  }

  /**
   * The plan of a robot as that of a mission.
   * @param {any} file @param {number} index of the robot
   */
  planOf(file, index) {
    const { rev, ms, grids, tracks, ok, problems } = this.answer;
    const head = { type: "planned", rev, ms, grids, tracks, gave_up: false };
    if (!ok) return { ...head, ok, problems: problems.map((/** @type {any} */ one) => problemOf(file, one)) };
    const robot = this.byName.get(robotName(file, index));
    if (robot?.curve) return { ...head, ok: true, ...robot.path, law: robot.law, duration: robot.duration, timing: null };
    const { outcome = "", reason = "", remedy = "" } = robot?.missing ?? {};
    return { ...head, ok: false, gave_up: outcome === "gave up", problems: reason ? [{ text: reason, remedy, path: [], where: null, changes: [] }] : [] };
  }

  /** The newest plan with a path that a robot had, as that of a mission. @param {any} file @param {number} index */
  goodPlanOf(file, index) {
    const robot = this.byName.get(robotName(file, index));
    const { rev, ms, grids, tracks } = this.answer;
    return robot?.curve ? { rev, ms, grids, tracks, ok: true, ...robot.path, law: robot.law, duration: robot.duration, timing: null } : null;
  }
}

/** A problem of a fleet as one of the robot that has it. @param {any} file @param {any} problem */
function problemOf(file, problem) {
  const { robot, path } = placeInMission(file, problem.path);
  const changes = problem.changes.map((/** @type {any} */ change) => ({ ...change, ...placeInMission(file, change.path) }));
  return { ...problem, path, changes, robot };
}
