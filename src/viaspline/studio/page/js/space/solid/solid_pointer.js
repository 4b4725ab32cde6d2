/** Mouse, fingers and keys in the 3-D view: turn, move, zoom; points are dragged in plan, and lifted by a handle. */

import * as THREE from "../../../vendor/three.min.js";
import { moveTo } from "../../core/edits.js";
import { heightOf, withHeight } from "../../core/heights.js";

const REACH_PX = 14, TOUCH_REACH_PX = 22;
const SLOP_PX = 4;
const TURN_RAD = 0.12;

/** @typedef {{id: string, kind: "plan"|"height"}} Held */

export class SolidPointer {
  /** @param {import("./solid_view.js").SolidView} view */
  constructor(view) {
    this.view = view;
    this.app = view.app;
    this.count = 0;
    /** @type {(Held & {offset: number[], value: number, from: number[], moved: boolean})|null} */ this.held = null;
    // Before the controls: what takes a point keeps them from turning the view.
    const on = (/** @type {string} */ type, /** @type {(e: any) => void} */ listener) => view.canvas.addEventListener(type, listener, { capture: true });
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", (event) => this.up(event));
    on("keydown", (event) => this.key(event));
    this.controls = new THREE.OrbitControls(view.camera, view.canvas);
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = true;
    this.controls.maxPolarAngle = 0.98 * Math.PI;
    this.controls.addEventListener("change", () => view.later());
    this.isTurned = false; // by hand, since it was fitted
    this.controls.addEventListener("start", () => { this.isTurned = true; });
  }

  /** @param {PointerEvent} event @returns {[number, number]} */
  place({ clientX, clientY }) {
    const box = this.view.canvas.getBoundingClientRect();
    return [clientX - box.left, clientY - box.top];
  }

  /** What lies under a pixel. @param {number} px @param {number} py @param {number} reach @returns {Held|null} */
  pick(px, py, reach) {
    const { view } = this;
    const { selection } = this.app.store;
    const near = (/** @type {number[]} */ at) => {
      const seen = view.toScreen(at);
      return seen ? Math.hypot(seen[0] - px, seen[1] - py) : Infinity;
    };
    const handle = view.handlePlace();
    if (handle && selection && near(handle) < reach) return { id: selection, kind: "height" };
    let best = reach, found = null;
    for (const { id, at } of view.space.points()) {
      const away = near(at) - (id === selection ? 2 : 0);
      if (away < best) {
        best = away;
        found = id;
      }
    }
    return found ? { id: found, kind: "plan" } : null;
  }

  /** @param {PointerEvent} event */
  down(event) {
    this.view.canvas.focus({ preventScroll: true });
    const [px, py] = this.place(event);
    const found = event.button === 0 ? this.pick(px, py, event.pointerType === "touch" ? TOUCH_REACH_PX : REACH_PX) : null;
    const { store } = this.app;
    if (!found || this.app.drive.run) return;
    store.select(found.id);
    const point = this.view.space.points().find(({ id }) => id === found.id);
    if (!point) return;
    const kind = event.shiftKey ? "height" : found.kind;
    if (kind === "height" && !heightOf(store.doc, found.id)) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.app.snap.isPointing = false; // not on the map
    this.view.canvas.setPointerCapture(event.pointerId);
    this.count += 1;
    const from = kind === "plan" ? this.onLevel(px, py, point.at[2]) : this.upright(px, py, point.at);
    if (!from) return;
    this.held = { id: found.id, kind, offset: point.at.map((value, k) => value - from[k]), value: heightOf(store.doc, found.id)?.value ?? 0, from: [px, py, from[2], point.at[2]], moved: false };
  }

  /** @param {PointerEvent} event */
  move(event) {
    const [px, py] = this.place(event);
    const { store, pointer } = this.app;
    const { held } = this;
    if (!held) {
      const found = event.buttons ? null : this.pick(px, py, REACH_PX);
      this.view.canvas.style.cursor = found ? (found.kind === "height" ? "ns-resize" : "move") : "";
      return;
    }
    event.stopImmediatePropagation();
    if (!held.moved && Math.hypot(px - held.from[0], py - held.from[1]) < SLOP_PX) return;
    held.moved = true;
    const options = { merge: `drag-solid:${this.count}`, inputAt: event.timeStamp };
    if (held.kind === "plan") {
      const at = this.onLevel(px, py, held.from[3]);
      if (!at) return;
      store.edit(moveTo(store.doc, held.id, pointer.snapped([at[0] + held.offset[0], at[1] + held.offset[1]])), options);
      return;
    }
    const point = this.view.space.points().find(({ id }) => id === held.id);
    const at = point && this.upright(px, py, point.at);
    if (at) store.edit(withHeight(store.doc, held.id, Math.round((held.value + at[2] - held.from[2]) * 20) / 20), options);
  }

  /** @param {PointerEvent} event */
  up(event) {
    if (!this.held) return;
    const { id, moved } = this.held;
    this.held = null;
    event.stopImmediatePropagation();
    if (moved) this.app.say(`${this.app.describe(id)}, ${this.view.space.words(id)}`);
  }

  /** @param {number} px @param {number} py */
  ray(px, py) {
    const { canvas, camera } = this.view;
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((2 * px) / canvas.clientWidth - 1, 1 - (2 * py) / canvas.clientHeight), camera);
    return caster.ray;
  }

  /** Where a pixel's ray meets a plane, in metres of the mission. @param {number} px @param {number} py @param {any} plane @returns {number[]|null} */
  meet(px, py, plane) {
    const at = this.ray(px, py).intersectPlane(plane, new THREE.Vector3());
    if (!at || at.distanceTo(this.view.camera.position) > 40 * this.view.size) return null;
    return at.toArray().map((/** @type {number} */ value, /** @type {number} */ k) => value + this.view.origin[k]);
  }

  /** On the level of a height. @param {number} px @param {number} py @param {number} z [m] */
  onLevel(px, py, z) {
    return this.meet(px, py, new THREE.Plane(new THREE.Vector3(0, 0, 1), -(z - this.view.origin[2])));
  }

  /** On the upright plane through a place that faces the eye. @param {number} px @param {number} py @param {number[]} at */
  upright(px, py, at) {
    const place = this.view.placed(at);
    const facing = this.view.camera.position.clone().sub(place).setZ(0);
    if (facing.lengthSq() < 1e-12) return null; // straight from above: up and down can't be told
    return this.meet(px, py, new THREE.Plane().setFromNormalAndCoplanarPoint(facing.normalize(), place));
  }

  /** Arrows turn the view, plus and minus zoom. @param {KeyboardEvent} event */
  key(event) {
    const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const zoom = { "+": 0.85, "=": 0.85, "-": 1.18 }[event.key];
    if (event.altKey || event.ctrlKey || event.metaKey || (!turn && !zoom)) return;
    const { camera } = this.view;
    const arm = camera.position.clone().sub(this.controls.target);
    if (turn) {
      arm.applyAxisAngle(new THREE.Vector3(0, 0, 1), turn[0] * TURN_RAD);
      const level = Math.hypot(arm.x, arm.y), length = arm.length();
      const tilt = Math.min(Math.max(Math.atan2(arm.z, level) - turn[1] * TURN_RAD, -1.4), 1.54);
      const share = (length * Math.cos(tilt)) / (level || 1e-9);
      arm.set(arm.x * share, arm.y * share, length * Math.sin(tilt));
    }
    if (zoom) arm.multiplyScalar(zoom);
    this.isTurned = true;
    camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.view.later();
    event.preventDefault();
    event.stopPropagation();
  }
}
