/**
 * The state of the page: the document and its history, what is selected, the newest plan.
 *
 * Whoever wants to know of changes listens for a topic: `document`, `selection`, `plan`, `ledger`,
 * `space-time`, `run`, `view`, `file`, `tool`, `hover`, `status`.
 */

import { exists } from "./mission.js";

/** @typedef {{doc: any, selection: string|null, merge: string|null, time: number}} Entry */

const MAX_UNDO_STEPS = 500;
const MERGE_MS = 900;

export class Store {
  constructor() {
    /** @type {Map<string, Set<() => void>>} */
    this.listeners = new Map();
    /** @type {any} */ this.doc = {};
    /** @type {string|null} */ this.name = null;
    this.folder = "";
    /** @type {number[]|null} */ this.origin = null; // latitude and longitude of 0, 0, if known
    /** @type {any} */ this.savedDoc = null;
    /** @type {string|null} */ this.selection = null;
    this.revision = 0;
    /** When the newest input came that the document follows [ms]. */ this.inputAt = 0;
    /** @type {Entry[]} */ this.past = [];
    /** @type {Entry[]} */ this.future = [];
    /** @type {any} */ this.plan = null; // the newest answer, with a path or with problems
    /** @type {import("../geometry/curve.js").Curve|null} */ this.curve = null;
    /** @type {any} */ this.goodPlan = null; // the newest answer with a path
    /** @type {any[]} */ this.ledger = [];
    /** @type {any} */ this.spaceTime = null; // when the path is blocked by what moves, of the newest plan that said it
    this.isLate = false; // the newest plan is of another document than the one on the screen
    /** @type {any} */ this.run = null;
    /** @type {number|null} */ this.cursor = null; // distance along the path that is looked at [m]
    /** @type {string|null} */ this.hover = null;
    this.tool = "select";
    this.show = {
      rings: true, losers: true, comb: false, speed: true, grid: true, snap: false, detours: true, names: true, body: true,
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

  get dirty() {
    return this.doc !== this.savedDoc;
  }

  /**
   * Change the document.
   * @param {any} doc
   * @param {{merge?: string|null, select?: string|null, inputAt?: number}} [options] edits in a row
   *   with the same `merge` are undone together
   */
  edit(doc, { merge = null, select, inputAt } = {}) {
    if (doc === this.doc && (select === undefined || select === this.selection)) return;
    if (doc !== this.doc) {
      const now = performance.now();
      const last = this.past.at(-1);
      const joins = merge !== null && last?.merge === merge && (merge.startsWith("drag") || now - last.time < MERGE_MS);
      if (joins && last) last.time = now;
      else {
        this.past.push({ doc: this.doc, selection: this.selection, merge, time: now });
        if (this.past.length > MAX_UNDO_STEPS) this.past.shift();
      }
      this.future = [];
      this.put(doc, inputAt);
    }
    if (select !== undefined) this.select(select);
  }

  /** @param {any} doc @param {number} [inputAt] */
  put(doc, inputAt) {
    this.doc = doc;
    this.revision += 1;
    this.inputAt = inputAt ?? performance.now();
    if (this.run) {
      this.run = null; // it was driven on another mission
      this.tell("run");
    }
    if (this.selection && !exists(doc, this.selection)) this.select(null);
    this.tell("document");
  }

  /** @param {Entry[]} from @param {Entry[]} to */
  travel(from, to) {
    const entry = from.pop();
    if (!entry) return false;
    to.push({ doc: this.doc, selection: this.selection, merge: null, time: 0 });
    this.put(entry.doc);
    this.select(exists(entry.doc, entry.selection) ? entry.selection : null);
    return true;
  }

  undo() {
    return this.travel(this.past, this.future);
  }

  redo() {
    return this.travel(this.future, this.past);
  }

  /** Begin with another document; nothing can be undone. @param {any} doc @param {string|null} name */
  open(doc, name) {
    this.past = [];
    this.future = [];
    this.name = name;
    this.savedDoc = doc;
    this.selection = null;
    this.goodPlan = this.plan = this.curve = null;
    this.ledger = [];
    this.spaceTime = null;
    this.put(doc);
    this.tell("selection");
    this.tell("file");
  }

  /** @param {string|null} id */
  select(id) {
    if (id === this.selection) return;
    this.selection = id;
    this.tell("selection");
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
