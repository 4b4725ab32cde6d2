/** The robots of a fleet on the map: their routes, each in its colour, and where they are at an instant. */

import { isFleet, membersOf, missionOf, robotName } from "../core/fleet.js";
import { pointsOf } from "../core/mission.js";
import { robotColour } from "./colours.js";
import { drawDisc, drawRoute, drawTrail, drawWait } from "./robot_marks.js";

/** @typedef {import("../draw/pen.js").Pen} Pen */

const MOST_NAMED = 40;
const MANY = 20; // robots, of more of which routes are thin

export class FleetLayer {
  /** @param {import("../core/store.js").Store} store @param {import("../preview.js").Preview} preview @param {import("../replay.js").Drive} drive */
  constructor(store, preview, drive) {
    this.store = store;
    this.preview = preview;
    this.drive = drive;
  }

  /** What is played, the drive or the plan, and the instant that is looked at [s]. @returns {{played: any, now: number, isOn: boolean}} */
  get shown() {
    const { store, preview, drive } = this;
    if (drive.run?.fleet) return { played: drive.run.fleet, now: drive.time, isOn: true };
    return { played: store.fleetPlan, now: preview.time, isOn: preview.isOn };
  }

  /** The colour of the robot that is chosen; null for a mission. @param {Pen} pen @returns {string|null} */
  chosenColour(pen) {
    const { robot } = this.store;
    return robot === null ? null : robotColour(robot, pen.isDark);
  }

  /** Routes of those that aren't chosen: under everything that is edited. @param {Pen} pen */
  drawRoutes(pen) {
    const { store } = this;
    if (!isFleet(store.file)) return;
    const isStale = store.fleetPlan?.answer?.ok === false || store.isLate;
    const members = membersOf(store.file);
    members.forEach((_, i) => {
      if (i === store.robot) return;
      const robot = store.fleetPlan?.byName.get(robotName(store.file, i));
      const points = pointsOf(missionOf(store.file, i, store.missions));
      drawRoute(pen, { spans: robot?.path?.spans ?? [], points, colour: robotColour(i, pen.isDark), isStale, isThin: members.length > MANY });
    });
  }

  /** All robots at the instant that is looked at, where they come from, and who waits for whom. @param {Pen} pen */
  drawRobots(pen) {
    const { store } = this;
    const { played: plan, now, isOn } = this.shown;
    if (!isFleet(store.file) || !plan || store.isLate) return;
    const index = new Map(membersOf(store.file).map((_, i) => [robotName(store.file, i), i]));
    const placed = new Map();
    for (const robot of plan.driving) {
      const { times } = robot.law;
      const i = index.get(robot.name);
      if (i === undefined || (robot.leaves && now > times.at(-1))) continue;
      const colour = robotColour(i, pen.isDark);
      if (isOn && now > times[0]) drawTrail(pen, robot.curve, now, colour);
      placed.set(robot.name, { ...robot.curve.at(robot.curve.distanceAt(now)), radius: robot.radius, colour, isChosen: i === store.robot });
    }
    for (const { robot, waits_for: other, from, until } of plan.waits) {
      const [a, b] = [placed.get(robot), placed.get(other)];
      if (a && b && from <= now && now <= until) drawWait(pen, a, b);
    }
    for (const one of placed.values()) drawDisc(pen, one);
  }

  /** Names beside where the robots are: of many, of those that wait, whom they wait for, and the one chosen. @param {Pen} pen @returns {import("../draw/labels.js").Label[]} */
  labels(pen) {
    const { store } = this;
    const { played: plan, now } = this.shown;
    const members = membersOf(store.file);
    if (!members.length || !plan || !store.show.names) return [];
    const concerned = new Set(plan.waits.filter((/** @type {any} */ wait) => wait.from <= now && now <= wait.until).flatMap((/** @type {any} */ wait) => [wait.robot, wait.waits_for]));
    return members.flatMap((_, i) => {
      const robot = plan.byName.get(robotName(store.file, i));
      const isChosen = i === store.robot;
      if (!robot?.curve || (members.length > MOST_NAMED && !isChosen && !concerned.has(robot.name))) return [];
      const at = robot.curve.at(robot.curve.distanceAt(now));
      const [x, y] = pen.camera.toScreen(at.x, at.y);
      const away = Math.max(10, robot.radius * pen.camera.scale + 5);
      return [{ text: robot.name, x, y, away, colour: robotColour(i, pen.isDark), bold: true, rank: isChosen ? 0 : 2 }];
    });
  }
}
