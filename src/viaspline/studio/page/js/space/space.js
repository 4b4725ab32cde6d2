/**
 * A mission in space on the page: what stands in its world, its elevation, its 3-D view. The 3-D
 * view and three.js are asked for when the first such mission is opened, and not before.
 */

import { heightOf, isSpatial, withHeight } from "../core/heights.js";
import { pointsOf } from "../core/mission.js";
import { number } from "../units.js";
import { Elevation } from "./elevation.js";
import { PlanLayer } from "./plan_layer.js";
import { Views } from "./views.js";

const NUDGE_M = 0.5;

export class Space {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** What stands in the world. @type {any} */ this.scene = null;
    /** Its name. @type {string|null} */ this.name = null;
    /** What is near the path, of the newest plan that said it. @type {any} */ this.profile = null;
    /** @type {any} */ this.solid = null; // the 3-D view
    this.isAsked = false;
    this.isOn = false;
    this.layer = new PlanLayer(this);
    app.scene.space = this.layer;
    this.views = new Views(app, this);
    this.elevation = new Elevation(app, this);
    app.store.on("document", () => this.follow());
    app.store.on("plan", () => this.take());
    app.store.on("file", () => { this.profile = null; });
  }

  /** Whether the document is one in space decides what the page is made of. */
  follow() {
    const isOn = isSpatial(this.app.store.doc) && this.app.store.robot === null;
    if (isOn === this.isOn) return;
    this.isOn = isOn;
    document.body.classList.toggle("is-spatial", isOn);
    if (isOn) this.open();
    this.views.show();
    this.app.scene.later();
  }

  /** The newest plan: its world is fetched if it isn't here. */
  take() {
    const { store } = this.app;
    const name = store.plan?.space?.scene ?? null;
    if (!this.isOn || name === null || name === this.name) return;
    this.name = name;
    this.fetch(name);
  }

  /** @param {string} name */
  async fetch(name) {
    try {
      const answer = await fetch(`/scenes/${name}.json${location.search}`);
      if (!answer.ok) throw new Error(await answer.text());
      const scene = await answer.json();
      if (name !== this.name) return; // another one is on its way
      this.scene = scene;
      this.layer.forget();
      this.solid?.setScene(scene);
      this.app.store.tell("scene");
      this.app.scene.later();
    } catch (error) {
      this.name = null;
      this.app.toast(`what stands in the world couldn't be fetched: ${/** @type {Error} */ (error).message}`, "is-bad");
    }
  }

  /** Open the 3-D view, once; a browser without WebGL is told so, and the other views stay. */
  async open() {
    if (this.isAsked) return;
    this.isAsked = true;
    try {
      const { openSolidView } = await import("./solid/solid_view.js");
      this.solid = await openSolidView(this.app, this);
      if (this.scene) this.solid.setScene(this.scene);
      this.app.store.tell("scene");
    } catch (error) {
      this.views.fail(/** @type {Error} */ (error).message);
    }
  }

  /** @param {any} message */
  putProfile(message) {
    this.profile = message;
    this.app.store.tell("profile");
  }

  /** How high the ground is at a place, as far as what is drawn knows [m]. @param {number} x @param {number} y @returns {number|null} */
  groundAt(x, y) {
    const { scene } = this;
    if (!scene?.terrain) return scene?.flat ?? null;
    const { origin, cell, nx, ny, heights } = scene.terrain;
    const u = Math.min(Math.max((x - origin[0]) / cell, 0), nx - 1.001), v = Math.min(Math.max((y - origin[1]) / cell, 0), ny - 1.001);
    const i = Math.floor(u), j = Math.floor(v), a = u - i, b = v - j;
    const z = (/** @type {number} */ di, /** @type {number} */ dj) => heights[(j + dj) * nx + i + di];
    if ([z(0, 0), z(1, 0), z(0, 1), z(1, 1)].some((one) => one === null)) return null;
    return (1 - b) * ((1 - a) * z(0, 0) + a * z(1, 0)) + b * ((1 - a) * z(0, 1) + a * z(1, 1));
  }

  /**
   * The points of the route with their heights, where these are known: of those that the plan has
   * as they are, exactly; of others as near as the drawn ground tells.
   * @returns {{id: string, at: number[], name: string, dwell: number, stop: any}[]}
   */
  points() {
    const { store } = this.app;
    const stops = store.goodPlan?.space?.stops ?? [];
    const points = pointsOf(store.doc);
    const found = [];
    points.forEach((point, i) => {
      if (!point.at) return;
      const stop = stops.find((/** @type {any} */ one) => one.index === i) ?? null;
      const [x, y] = point.at;
      const isThere = stop && Math.abs(stop.at[0] - x) < 1e-3 && Math.abs(stop.at[1] - y) < 1e-3;
      const height = heightOf(store.doc, point.id);
      const ground = isThere ? stop.ground ?? 0 : this.groundAt(x, y) ?? 0;
      let z = stop?.at[2] ?? ground;
      if (point.id === "land") z = ground;
      else if (height) z = height.kind === "z" ? height.value : ground + height.value;
      found.push({ id: point.id, at: [x, y, z], name: point.name, dwell: point.dwell, stop });
    });
    return /** @type {any} */ (found);
  }

  /**
   * Legs that the newest plan doesn't have as they are now asked for, as lines through their points:
   * what is shown while a plan is under way, and proven of nothing.
   * @returns {number[][][]}
   */
  provisional() {
    const { store } = this.app;
    const stops = store.goodPlan?.space?.stops;
    if (!this.isOn || !stops || store.plan?.rev === store.revision) return [];
    const points = this.points().map((point) => (point.id === "land" ? { ...point, at: [point.at[0], point.at[1], Math.max(point.at[2], stops.at(-1)?.at[2] ?? -Infinity)] } : point));
    const isMoved = points.map(({ at, stop }) => !stop || at.some((value, k) => Math.abs(value - stop.at[k]) > 1e-3));
    const count = new Set(stops.map((/** @type {any} */ stop) => stop.index)).size - (store.doc.route?.closed ? 1 : 0);
    if (points.length !== count) isMoved.fill(true);
    if (!isMoved.some(Boolean)) return [];
    const legs = [];
    for (let k = 0; k + 1 < points.length; k += 1) {
      if (![k - 1, k, k + 1, k + 2].some((i) => isMoved[i])) continue;
      const four = [k - 1, k, k + 1, k + 2].map((i) => points[Math.min(Math.max(i, 0), points.length - 1)].at);
      legs.push(leg(four));
    }
    return legs;
  }

  /** Move a point up or down. @param {string} id @param {number} way 1 or -1 @param {boolean} far */
  lift(id, way, far) {
    const { store, say } = this.app;
    const height = heightOf(store.doc, id);
    if (!height) return false;
    const value = Math.round((height.value + way * NUDGE_M * (far ? 10 : 1)) * 100) / 100;
    store.edit(withHeight(store.doc, id, value), { merge: `lift:${id}` });
    say(this.words(id));
    return true;
  }

  /** How high a point is, in words. @param {string} id */
  words(id) {
    const height = heightOf(this.app.store.doc, id);
    if (!height) return "";
    const { kind, value } = height;
    return kind === "z" ? `${number(value, 2)} m high` : `${number(value, 2)} m above ground`;
  }
}

const LEG_PIECES = 16;

/** Catmull and Rom's curve between the middle two of four places. @param {number[][]} places @returns {number[][]} */
function leg([a, b, c, d]) {
  const line = [];
  for (let i = 0; i <= LEG_PIECES; i += 1) {
    const t = i / LEG_PIECES;
    line.push(b.map((_, k) => {
      const [m, n] = [(c[k] - a[k]) / 2, (d[k] - b[k]) / 2];
      return (2 * t ** 3 - 3 * t ** 2 + 1) * b[k] + (t ** 3 - 2 * t ** 2 + t) * m + (3 * t ** 2 - 2 * t ** 3) * c[k] + (t ** 3 - t ** 2) * n;
    }));
  }
  return line;
}
