/**
 * The state of the page: the document and its history, what is selected, the newest plan.
 *
 * What is edited is a mission: all of the file, or of a fleet's that of the robot that is chosen.
 *
 * Whoever wants to know of changes listens for a topic: `document`, `selection`, `plan`, `ledger`,
 * `space-time`, `run`, `view`, `file`, `tool`, `hover`, `status`, `robot`, `elsewhere`, `origin`,
 * `background`.
 */

import { isFleet, membersOf, missionOf, withMission } from "./fleet.js";
import { exists } from "./mission.js";

/** @typedef {{file: any, robot: number|null, selection: string|null, others: readonly string[], merge: string|null, time: number}} Entry */

const MAX_UNDO_STEPS = 500;
const MERGE_MS = 900;

export class Store {
  constructor() {
    /** @type {Map<string, Set<() => void>>} */
    this.listeners = new Map();
    /** @type {any} */ this.file = {}; // what the file holds
    /** @type {any} */ this.doc = {}; // the mission that is edited
    /** @type {number|null} */ this.robot = null; // whose mission that is, of a fleet
    /** @type {Record<string, any>} */ this.missions = {}; // what stands in the files of a fleet's robots
    /** @type {string|null} */ this.name = null;
    this.folder = "";
    /** @type {number[]|null} */ this.place = null;
    /** @type {any} */ this.savedFile = null;
    /** @type {string|null} */ this.selection = null;
    /** What is selected besides: points, obstacles and areas. @type {readonly string[]} */ this.others = [];
    this.revision = 0;
    /** When the newest input came that the document follows [ms]. */ this.inputAt = 0;
    /** @type {Entry[]} */ this.past = [];
    /** @type {Entry[]} */ this.future = [];
    /** @type {any} */ this.plan = null; // the newest answer, with a path or with problems
    /** @type {import("../geometry/curve.js").Curve|null} */ this.curve = null;
    /** @type {any} */ this.goodPlan = null; // the newest answer with a path
    /** @type {import("./fleet_plan.js").FleetPlan|null} */ this.fleetPlan = null;
    /** @type {any[]} */ this.ledger = [];
    /** @type {any} */ this.spaceTime = null; // when the path is blocked by what moves, of the newest plan that said it
    this.isLate = false; // the newest plan is of another document than the one on the screen
    /** @type {any} */ this.run = null;
    /** @type {number|null} */ this.cursor = null; // distance along the path that is looked at [m]
    /** @type {string|null} */ this.hover = null;
    this.tool = "select";
    this.show = {
      rings: true, losers: true, comb: false, speed: true, grid: true, snap: false, points: true, detours: true, names: true, body: true,
    };
  }

  /** @param {string} topic @param {() => void} listener */
  on(topic, listener) {
    for (const one of topic.split(" ")) {
      if (!this.listeners.has(one)) this.listeners.set(one, new Set());
      this.listeners.get(one)?.add(listener);
    }
  }

  /** @param {string} topic */
  tell(topic) {
    this.listeners.get(topic)?.forEach((listener) => listener());
  }

  /** Latitude and longitude of 0, 0 [deg]; null if nobody knows. */
  get origin() {
    return this.place;
  }

  set origin(pair) {
    if (String(pair) === String(this.place)) return;
    this.place = pair;
    this.tell("origin");
  }

  get dirty() {
    return this.file !== this.savedFile;
  }

  /**
   * Change the mission that is edited.
   * @param {any} doc
   * @param {{merge?: string|null, select?: string|null, others?: readonly string[], inputAt?: number}} [options] edits in a row
   *   with the same `merge` are undone together
   */
  edit(doc, options = {}) {
    const file = this.robot === null ? doc : withMission(this.file, this.robot, this.doc, doc);
    if (doc !== this.doc && file === this.file) this.tell("elsewhere");
    this.editFile(doc === this.doc ? this.file : file, options);
  }

  /**
   * Change what the file holds.
   * @param {any} file
   * @param {{merge?: string|null, select?: string|null, others?: readonly string[], inputAt?: number, robot?: number|null}} [options] `robot` is chosen
   */
  editFile(file, { merge = null, select, others, inputAt, robot } = {}) {
    if (file === this.file && (select === undefined || select === this.selection)) return;
    if (file !== this.file) {
      const now = performance.now();
      const last = this.past.at(-1);
      const joins = merge !== null && last?.merge === merge && (merge.startsWith("drag") || now - last.time < MERGE_MS);
      if (joins && last) last.time = now;
      else {
        this.past.push({ ...this.now, merge, time: now });
        if (this.past.length > MAX_UNDO_STEPS) this.past.shift();
      }
      this.future = [];
      this.put(file, inputAt, robot);
    }
    if (select !== undefined) this.select(select, others);
  }

  get now() {
    return { file: this.file, robot: this.robot, selection: this.selection, others: this.others };
  }

  /** @param {any} file @param {number} [inputAt] @param {number|null} [robot] the one that is edited from now on */
  put(file, inputAt, robot = this.robot) {
    const before = this.robot;
    this.file = file;
    this.robot = robot;
    this.take();
    this.revision += 1;
    this.inputAt = inputAt ?? performance.now();
    if (this.run) {
      this.run = null; // it was driven on another mission
      this.tell("run");
    }
    const others = this.others.filter((id) => exists(this.doc, id));
    if (this.selection && !exists(this.doc, this.selection)) this.select(others.at(-1) ?? null, others);
    else if (others.length < this.others.length) this.select(this.selection, others);
    this.tell("document");
    if (this.robot !== before) this.tell("robot");
  }

  /** Take the mission that is edited out of the file. */
  take() {
    const count = membersOf(this.file).length;
    this.robot = isFleet(this.file) && count ? Math.min(this.robot ?? 0, count - 1) : null;
    this.doc = this.robot === null ? this.file : missionOf(this.file, this.robot, this.missions);
  }

  /** Edit another robot of the fleet. @param {number} robot */
  choose(robot) {
    if (robot === this.robot || this.robot === null) return;
    this.robot = robot;
    this.take();
    this.select(null);
    this.tell("robot");
  }

  /** @param {Entry[]} from @param {Entry[]} to */
  travel(from, to) {
    const entry = from.pop();
    if (!entry) return false;
    to.push({ ...this.now, merge: null, time: 0 });
    this.put(entry.file, undefined, entry.robot);
    const isThere = exists(this.doc, entry.selection);
    this.select(isThere ? entry.selection : null, isThere ? entry.others.filter((id) => exists(this.doc, id)) : []);
    return true;
  }

  undo() {
    return this.travel(this.past, this.future);
  }

  redo() {
    return this.travel(this.future, this.past);
  }

  /** Begin with another document; nothing can be undone. @param {any} file @param {string|null} name */
  open(file, name) {
    this.past = [];
    this.future = [];
    this.name = name;
    this.savedFile = file;
    this.robot = null;
    this.missions = {};
    this.fleetPlan = null;
    this.selection = null;
    this.others = [];
    this.goodPlan = this.plan = this.curve = null;
    this.ledger = [];
    this.spaceTime = null;
    this.show.speed = !isFleet(file); // each robot of a fleet has a colour of its own
    this.put(file);
    this.tell("selection");
    this.tell("file");
  }

  /** @param {string|null} id @param {readonly string[]} [others] what is selected besides */
  select(id, others = []) {
    if (id === this.selection && others.join() === this.others.join()) return;
    this.selection = id;
    this.others = others;
    this.tell("selection");
  }

  /** All that is selected, each once; what the fields show stands last. @returns {string[]} */
  get chosen() {
    const besides = this.others.filter((id) => id !== this.selection);
    return this.selection ? [...besides, this.selection] : besides;
  }

  /** @param {string} tool */
  setTool(tool) {
    if (tool === this.tool) return;
    this.tool = tool;
    this.tell("tool");
  }

  /** @param {keyof Store["show"]} what */
  toggle(what) {
    this.show[what] = !this.show[what];
    this.tell("view");
  }

  /** @param {number|null} distance */
  lookAt(distance) {
    if (distance === this.cursor) return;
    this.cursor = distance;
    this.tell("hover");
  }
}
