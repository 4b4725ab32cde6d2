/** Mouse, pen and fingers on the map: drag, draw, pan, pinch, zoom to the cursor. */

import { forceSide } from "../core/edits.js";
import { whole } from "../core/mission.js";
import { Dragging } from "./dragging.js";
import { Drawing } from "./drawing.js";
import { pick } from "./pick.js";
import { goesByCorners, makes, shapeToolOf } from "./tools.js";
import { LongPress, afterwards } from "./touch.js";

const CLICK_SLOP_PX = 4; // pixels that a click may move

/** Whether nothing is to snap; Ctrl as well, as some desktops keep Alt for themselves. @param {MouseEvent} event */
const isFree = (event) => event.altKey || event.ctrlKey || event.metaKey;

/** @typedef {{move: (at: number[], event: PointerEvent) => void, end?: (moved: boolean, at: number[]) => void, cancel?: () => void}} Gesture */

export class Pointer {
  /**
   * @param {import("../core/store.js").Store} store
   * @param {import("../geometry/camera.js").Camera} camera
   * @param {import("../draw/scene.js").Scene} scene
   * @param {(text: string) => void} say
   * @param {any} app the menu, the measuring tool and what selects several
   */
  constructor(store, camera, scene, say, app) {
    this.app = app;
    this.snap = app.snap;
    this.longPress = new LongPress((px, py) => {
      this.stop();
      app.menu.at(px, py, true);
    });
    this.store = store;
    this.camera = camera;
    this.scene = scene;
    this.say = say;
    this.canvas = scene.canvas;
    const snapped = (/** @type {number[]} */ at) => this.snapped(at);
    this.dragging = new Dragging(store, scene.canvas, snapped, (ids) => this.snap.begin(ids));
    this.drawing = new Drawing(store, camera, scene, snapped, say);
    /** @type {Map<number, [number, number]>} */ this.pointers = new Map();
    /** @type {Gesture|null} */ this.gesture = null;
    this.start = [0, 0];
    this.last = [0, 0];
    this.moved = false;
    const on = (/** @type {string} */ type, /** @type {(e: any) => void} */ listener) => this.canvas.addEventListener(type, listener, { passive: false });
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    // Raw moves come as soon as the device tells them, not with the next frame.
    if ("onpointerrawupdate" in window) on("pointerrawupdate", (event) => this.raw(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", (event) => this.up(event));
    on("pointerleave", () => this.leave());
    on("wheel", (event) => this.wheel(event));
    on("dblclick", (event) => this.double(event));
    on("contextmenu", (event) => event.preventDefault());
    store.on("tool", () => this.drawing.drop());
  }

  /** @param {MouseEvent} event @returns {[number, number]} */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** A place in the world, on a point or the grid if that is asked for. @param {number[]} at @returns {number[]} */
  snapped(at) {
    return this.snap.place(at);
  }

  /** Break off what a press has begun. */
  stop() {
    this.gesture?.cancel?.();
    this.gesture = null;
    this.drawing.drop();
    this.snap.end();
  }

  /** @param {PointerEvent} event */
  down(event) {
    this.canvas.focus({ preventScroll: true });
    const [px, py] = this.place(event);
    this.pointers.set(event.pointerId, [px, py]);
    try {
      this.canvas.setPointerCapture(event.pointerId);
    } catch { /* a pointer that is gone already */ }
    event.preventDefault();
    this.scene.cross = null;
    this.longPress.end();
    if (this.pointers.size === 2) {
      if (!goesByCorners(this.store.tool)) this.stop(); // two fingers move and zoom the map
      this.gesture = null;
      return;
    }
    if (this.pointers.size > 2) return;
    this.snap.end();
    this.snap.isPointing = true;
    this.snap.isFree = isFree(event);
    this.start = [px, py];
    this.moved = false;
    this.dragging.count += 1;
    if (event.button === 1 || event.button === 2 || this.store.tool === "pan") {
      const pan = this.pan(px, py);
      this.gesture = event.button === 2 ? { ...pan, end: (moved) => { if (!moved) this.app.menu.at(px, py); } } : pan;
      return;
    }
    const isTouch = event.pointerType === "touch";
    const begin = () => this.begin(px, py, isTouch ? 18 : 10, event.shiftKey || event.ctrlKey || event.metaKey);
    if (isTouch) this.longPress.begin(px, py);
    this.gesture = isTouch && makes(this.store.tool) ? afterwards(begin) : begin();
  }

  /** @param {PointerEvent} event */
  raw(event) {
    if (this.gesture && this.pointers.size === 1 && this.pointers.has(event.pointerId)) this.drag(event);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const [px, py] = this.place(event);
    if (!this.pointers.has(event.pointerId)) {
      this.snap.isFree = isFree(event);
      this.hoverAt(px, py);
      return;
    }
    if (this.pointers.size >= 2) this.pinch(event.pointerId, px, py);
    else if (this.gesture) this.drag(event);
    this.pointers.set(event.pointerId, [px, py]);
  }

  /** @param {PointerEvent} event */
  drag(event) {
    const [px, py] = this.place(event);
    if (!this.moved && Math.hypot(px - this.start[0], py - this.start[1]) < CLICK_SLOP_PX) return;
    if (this.moved && px === this.last[0] && py === this.last[1]) return; // told raw already
    this.moved = true;
    this.longPress.end();
    this.snap.isFree = isFree(event);
    this.last = [px, py];
    this.gesture?.move(this.camera.toWorld(px, py), event);
  }

  /** @param {PointerEvent} event */
  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    const [px, py] = this.place(event);
    this.longPress.end();
    if (this.pointers.size === 0) {
      if (event.type === "pointerup") this.gesture?.end?.(this.moved, this.camera.toWorld(px, py));
      this.gesture = null;
      this.snap.end();
      this.canvas.style.cursor = "";
    }
  }

  /** @param {number} id @param {number} px @param {number} py */
  pinch(id, px, py) {
    const others = [...this.pointers].filter(([other]) => other !== id).map(([, at]) => at);
    const old = /** @type {[number, number]} */ (this.pointers.get(id));
    const [ox, oy] = others[0];
    const before = Math.hypot(old[0] - ox, old[1] - oy), after = Math.hypot(px - ox, py - oy);
    if (before > 8) this.camera.zoom(after / before, (px + ox) / 2, (py + oy) / 2);
    this.camera.pan((px - old[0]) / 2, (py - old[1]) / 2);
    this.store.tell("view");
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    event.preventDefault();
    const [px, py] = this.place(event);
    const unit = event.deltaMode === 1 ? 24 : 1;
    this.camera.zoom(Math.exp(-event.deltaY * unit * (event.ctrlKey ? 0.01 : 0.0016)), px, py);
    this.store.tell("view");
  }

  /** @param {MouseEvent} event */
  double(event) {
    const { store } = this;
    const [px, py] = this.place(event);
    if (store.tool === "measure") this.app.measure.close();
    if (goesByCorners(store.tool)) this.drawing.close();
    if (store.tool !== "select") return;
    const found = pick(store, this.camera, px, py, 10, this.scene.time);
    if (found?.kind === "path") this.dragging.addVia(this.camera.toWorld(px, py), found.leg);
  }

  /** @param {number} px @param {number} py @returns {Gesture} */
  pan(px, py) {
    let last = [px, py];
    this.canvas.style.cursor = "grabbing";
    return {
      move: (_, event) => {
        const [x, y] = this.place(event);
        this.camera.pan(x - last[0], y - last[1]);
        last = [x, y];
        this.store.tell("view");
      },
    };
  }

  /** What a press begins. @param {number} px @param {number} py @param {number} reach @param {boolean} isMore besides what is selected @returns {Gesture} */
  begin(px, py, reach, isMore) {
    const { store, camera, scene } = this;
    const { selecting, measure } = this.app;
    const at = camera.toWorld(px, py);
    if (store.tool === "measure") {
      measure.add(this.snapped(at));
      return { move: () => {} };
    }
    if (goesByCorners(store.tool)) return this.drawing.corner(px, py);
    if (shapeToolOf(store.tool)) return this.drawing.drag(at);
    const found = pick(store, camera, px, py, reach, scene.time);
    if ((isMore && store.tool === "select" && found?.kind !== "handle") || store.tool === "several") {
      const id = found?.kind === "item" ? found.id : found?.kind === "handle" ? found.handle.id : null;
      if (id && store.tool === "several" && selecting.isGroup && store.chosen.includes(whole(id))) {
        const drag = selecting.dragged(whole(id), at);
        return { ...drag, end: (moved) => { if (!moved) selecting.toggle(id); } };
      }
      const box = selecting.boxed(at);
      return id ? { ...box, end: (moved, to) => (moved ? box.end?.(true, to) : selecting.toggle(id)) } : box;
    }
    if (store.tool === "via" && found?.kind !== "item" && found?.kind !== "handle" && found?.kind !== "robot") {
      const id = this.dragging.addVia(at, found?.kind === "path" ? found.leg : null);
      return this.dragging.item(id, at);
    }
    if (!found) {
      const pan = this.pan(px, py);
      return { ...pan, end: (moved) => { if (!moved) store.select(null); } };
    }
    if (found.kind === "handle") return this.dragging.handle(found.handle, at);
    if (found.kind === "item" && selecting.isGroup && store.chosen.includes(found.id)) return selecting.dragged(found.id, at);
    if (found.kind === "item") {
      store.select(found.id);
      return this.dragging.item(found.id, at);
    }
    if (found.kind === "robot") {
      store.choose(found.robot);
      if (found.id === null) return { move: () => {} };
      store.select(found.id);
      return this.dragging.item(found.id, at);
    }
    if (found.kind === "side") {
      return { move: () => {}, end: (moved) => { if (!moved) this.force(found.entry, found.candidate.side); } };
    }
    store.select(`span:${found.leg}`);
    return this.dragging.span(found.leg, at);
  }

  /** Take the other side of a group. @param {any} entry @param {string} side */
  force(entry, side) {
    this.store.edit(forceSide(this.store.doc, entry.items, side));
    this.say(`${entry.members.join(", ")}: passed on the ${side}`);
  }

  /** @param {number} px @param {number} py */
  hoverAt(px, py) {
    const { store, camera, scene } = this;
    const found = pick(store, camera, px, py, 10, scene.time);
    this.snap.isPointing = true;
    if (scene.draft?.corners || store.tool === "measure") {
      const there = this.snapped(camera.toWorld(px, py));
      if (store.tool === "measure") this.app.measure.hover(there);
      else scene.draft = { ...scene.draft, at: there };
      scene.later();
    } else this.snap.forget();
    store.lookAt(found?.kind === "path" ? found.s : null);
    const side = found?.kind === "side" ? found.candidate : null;
    if (side !== scene.hoveredSide) {
      scene.hoveredSide = side;
      scene.later();
    }
    this.hover(found?.kind === "item" ? found.id : null);
    this.canvas.style.cursor = found?.kind === "handle" ? "move"
      : store.tool === "pan" ? "grab" : makes(store.tool) ? "crosshair" : found ? "pointer" : "";
    this.canvas.title = side ? `pass on the ${side} instead: click` : "";
    this.store.tell("place");
    this.at = camera.toWorld(px, py);
  }

  leave() {
    this.hover(null);
    this.snap.forget();
    if (this.app.measure.ahead) this.app.measure.hover(null);
  }

  /** @param {string|null} id */
  hover(id) {
    if (id === null) this.at = null;
    if (id === this.store.hover) return;
    this.store.hover = id;
    this.scene.later();
  }
}
