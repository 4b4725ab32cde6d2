/**
 * A fleet document in the page's words. Whatever is edited is one mission: of a fleet, that of the
 * robot that is chosen. It is taken out of the document as a mission, and what has changed in it is
 * put back where it belongs: the world is everybody's, the robot is its kind's, the route its own.
 */

import { replaced } from "./diff.js";
import { placeOf } from "./mission.js";

/** @typedef {import("./diff.js").Path} Path */

const FIRST_KIND = "robot"; // what a kind is called that nobody has named
const SEPARATION_M = 1; // between the robots of a fleet that is begun here

/** Whether a document holds a fleet. @param {any} file */
export const isFleet = (file) => Array.isArray(file?.fleet);

/** The robots of a fleet as the document has them. @param {any} file @returns {any[]} */
export const membersOf = (file) => (isFleet(file) ? file.fleet : []);

/** What a robot is called. @param {any} file @param {number} index */
export const robotName = (file, index) => String(membersOf(file)[index]?.name ?? `robot ${index + 1}`);

/** The names of the kinds of robots. @param {any} file @returns {string[]} */
export const kindsOf = (file) => Object.keys(file?.robots ?? {});

/** The kind of a robot; null if it has a file of its own. @param {any} file @param {number} index @returns {string|null} */
export function kindOf(file, index) {
  const member = membersOf(file)[index];
  if (!member || member.mission) return null;
  return member.robot ?? kindsOf(file)[0] ?? FIRST_KIND;
}

/** The file of a robot's mission, from the folder of the studio. @param {string|null} fleet its file @param {string} mission as that names it */
export function missionFile(fleet, mission) {
  const steps = [...(fleet ?? "").split("/").slice(0, -1), ...mission.split("/")];
  /** @type {string[]} */ const path = [];
  for (const step of steps) {
    if (step === "..") path.pop();
    else if (step && step !== ".") path.push(step);
  }
  return path.join("/");
}

/** How many robots are of a kind. @param {any} file @param {string} kind */
export const countOfKind = (file, kind) => membersOf(file).filter((_, i) => kindOf(file, i) === kind).length;

/**
 * The mission of a robot.
 * @param {any} file @param {number} index
 * @param {Record<string, any>} missions what stands in the files of robots that have one
 */
export function missionOf(file, index, missions = {}) {
  const member = membersOf(file)[index] ?? {};
  const own = member.mission ? missions[member.mission] ?? {} : member;
  const robot = member.mission ? own.robot : file.robots?.[/** @type {string} */ (kindOf(file, index))];
  const parts = { world: file.world, robot, route: own.route, spline: own.spline ?? (member.mission ? undefined : file.spline) };
  return Object.fromEntries(Object.entries(parts).filter(([, value]) => value !== undefined));
}

/**
 * The fleet with the mission of a robot put back.
 * @param {any} file @param {number} index @param {any} before the mission as it was @param {any} after as it is to be
 * @returns {any} the same if what has changed stands in another file
 */
export function withMission(file, index, before, after) {
  const member = membersOf(file)[index] ?? {};
  const kind = kindOf(file, index);
  let next = file;
  const put = (/** @type {string} */ key, /** @type {Path} */ path) => {
    if (after[key] !== before[key]) next = replaced(next, path, after[key]);
  };
  put("world", ["world"]);
  if (member.mission) return next;
  put("robot", ["robots", /** @type {string} */ (kind)]);
  put("route", ["fleet", index, "route"]);
  put("spline", ["fleet", index, "spline"]);
  return next;
}

/**
 * Whose mission a place in the document is part of, and where in that.
 * @param {any} file @param {Path} path
 * @returns {{robot: number|null, path: Path}}
 */
export function placeInMission(file, path) {
  const [section, index, ...rest] = path;
  if (section === "fleet" && typeof index === "number") return { robot: index, path: rest };
  if (section === "robots" && typeof index === "string") {
    const robot = membersOf(file).findIndex((_, i) => kindOf(file, i) === index);
    return { robot: robot < 0 ? null : robot, path: ["robot", ...rest] };
  }
  return { robot: null, path };
}

/** A mission as a fleet of one. @param {any} mission */
export function fleetOf(mission) {
  const { world, robot, route, spline, ...rest } = mission;
  const member = { name: "r1", robot: FIRST_KIND, route: route ?? {} };
  return { ...rest, ...(world ? { world } : {}), separation_m: SEPARATION_M, robots: { [FIRST_KIND]: robot ?? {} }, ...(spline ? { spline } : {}), fleet: [member] };
}

/**
 * Another robot, on the way of one that there is, set off to the side.
 * @param {any} file @param {number} like @param {any} mission of that one @param {number} aside [m]
 * @returns {[any, number]} the fleet, and which robot of it is the new one
 */
export function addRobot(file, like, mission, aside) {
  const members = membersOf(file);
  const names = new Set(members.map((one) => one.name));
  let number = members.length + 1;
  while (names.has(`r${number}`)) number += 1;
  const { name: _, mission: __, route: ___, ...rest } = members[like] ?? {};
  const [dx, dy] = sideways(mission.route, aside);
  const added = { name: `r${number}`, ...rest, route: moved(mission.route ?? {}, dx, dy) };
  return [replaced(file, ["fleet"], [...members, added]), members.length];
}

/** Which way is beside a route. @param {any} route @param {number} aside [m] */
function sideways(route, aside) {
  const start = placeOf(route?.start), next = placeOf(route?.via?.[0]) ?? placeOf(route?.goal);
  if (!start || !next) return [0, aside];
  const [x, y] = [next[0] - start[0], next[1] - start[1]];
  const size = Math.hypot(x, y) || 1;
  return [(-y / size) * aside, (x / size) * aside];
}

/** A route with all of its points moved. @param {any} route @param {number} dx @param {number} dy [m] */
function moved(route, dx, dy) {
  const round = (/** @type {number} */ v) => Math.round(v * 100) / 100;
  const point = (/** @type {any} */ one) => {
    const at = placeOf(one);
    if (!at) return one;
    const { name: _, ...rest } = Array.isArray(one) ? {} : one;
    const place = [round(at[0] + dx), round(at[1] + dy), ...at.slice(2)];
    return Array.isArray(one) ? place : { ...rest, at: place };
  };
  return {
    ...route,
    ...(route.start === undefined ? {} : { start: point(route.start) }),
    ...(Array.isArray(route.via) ? { via: route.via.map(point) } : {}),
    ...(route.goal === undefined || route.goal === null ? {} : { goal: point(route.goal) }),
  };
}

/** @param {any} file @param {number} index @returns {any} the same if it is the last robot */
export const removeRobot = (file, index) => (membersOf(file).length > 1 ? replaced(file, ["fleet", index], undefined) : file);

/** Set a key of a robot; undefined takes it out. @param {any} file @param {number} index @param {string} key @param {unknown} value */
export const setOnRobot = (file, index, key, value) => replaced(file, ["fleet", index, key], value);
