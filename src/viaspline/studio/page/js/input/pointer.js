/** Mouse, pen and fingers on the map: drag, draw, pan, pinch, zoom to the cursor. */

import {
  addCorner, addObstacle, addVia, forceSide, moveTo, setOnPoint, setRadius, setTension, tidy,
} from "../core/edits.js";
import { anchorOf, pointsOf, refOf, tensionsOf } from "../core/mission.js";
import { pick } from "./pick.js";

const SLOP = 4; // pixels that a click may move

/** @typedef {{move: (at: number[], event: PointerEvent) => void, end?: (moved: boolean, at: number[]) => void}} Gesture */

export class Pointer {
  /**
   * @param {import("../core/store.js").Store} store
   * @param {import("../geometry/camera.js").Camera} camera
   * @param {import("../draw/scene.js").Scene} scene
   * @param {(text: string) => void} say
   */
  constructor(store, camera, scene, say) {
    this.store = store;
    this.camera = camera;
    this.scene = scene;
    this.say = say;
    this.canvas = scene.canvas;
    /** @type {Map<number, [number, number]>} */ this.pointers = new Map();
    /** @type {Gesture|null} */ this.gesture = null;
    this.start = [0, 0];
    this.last = [0, 0];
    this.moved = false;
    this.gestures = 0;
    const on = (/** @type {string} */ type, /** @type {(e: any) => void} */ listener) => this.canvas.addEventListener(type, listener, { passive: false });
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    // Raw moves come as soon as the device tells them, not with the next frame.
    if ("onpointerrawupdate" in window) on("pointerrawupdate", (event) => this.raw(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", (event) => this.up(event));
    on("pointerleave", () => this.hover(null));
    on("wheel", (event) => this.wheel(event));
    on("dblclick", (event) => this.double(event));
    on("contextmenu", (event) => event.preventDefault());
    store.on("tool", () => this.drop());
  }

  /** @param {MouseEvent} event @returns {[number, number]} */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** A place in the world, on the grid if that is asked for. @param {number[]} at */
  snapped(at) {
    return this.camera.rounded(at, this.store.show.snap ? this.camera.step(28) : null);
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
    if (this.pointers.size === 2) {
      this.gesture = null;
      return;
    }
    this.start = [px, py];
    this.moved = false;
    this.gestures += 1;
    const isPan = event.button === 1 || event.button === 2 || this.store.tool === "pan";
    this.gesture = isPan ? this.pan(px, py) : this.begin(px, py, event.pointerType === "touch" ? 18 : 10);
  }

  /** @param {PointerEvent} event */
  raw(event) {
    if (this.gesture && this.pointers.size === 1 && this.pointers.has(event.pointerId)) this.drag(event);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const [px, py] = this.place(event);
    if (!this.pointers.has(event.pointerId)) {
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
    if (!this.moved && Math.hypot(px - this.start[0], py - this.start[1]) < SLOP) return;
    if (this.moved && px === this.last[0] && py === this.last[1]) return; // told raw already
    this.moved = true;
    this.last = [px, py];
    this.gesture?.move(this.camera.toWorld(px, py), event);
  }

  /** @param {PointerEvent} event */
  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    const [px, py] = this.place(event);
    if (this.pointers.size === 0) {
      if (event.type === "pointerup") this.gesture?.end?.(this.moved, this.camera.toWorld(px, py));
      this.gesture = null;
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
    if (store.tool === "polygon") this.closePolygon();
    if (store.tool !== "select") return;
    const found = pick(store, this.camera, px, py, 10);
    if (found?.kind === "path") this.addViaAt(this.camera.toWorld(px, py), found.leg);
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

  /** What a press begins. @param {number} px @param {number} py @param {number} reach @returns {Gesture} */
  begin(px, py, reach) {
    const { store, camera } = this;
    const at = camera.toWorld(px, py);
    if (store.tool === "circle") return this.drawCircle(at);
    if (store.tool === "polygon") return this.drawPolygon(px, py);
    const found = pick(store, camera, px, py, reach);
    if (store.tool === "via" && found?.kind !== "item" && found?.kind !== "handle") {
      const id = this.addViaAt(at, found?.kind === "path" ? found.leg : null);
      return this.dragItem(id, at);
    }
    if (!found) {
      const pan = this.pan(px, py);
      return { ...pan, end: (moved) => { if (!moved) store.select(null); } };
    }
    if (found.kind === "handle") return this.dragHandle(found.handle, at);
    if (found.kind === "item") {
      store.select(found.id);
      return this.dragItem(found.id, at);
    }
    if (found.kind === "side") {
      return { move: () => {}, end: (moved) => { if (!moved) this.force(found.entry, found.candidate.side); } };
    }
    store.select(`span:${found.leg}`);
    return this.dragSpan(found.leg, at);
  }

  /** @param {string} id @param {number[]} from @returns {Gesture} */
  dragItem(id, from) {
    const { store } = this;
    const anchor = anchorOf(store.doc, id);
    const merge = `drag:${this.gestures}`;
    if (!anchor) return { move: () => {} };
    this.canvas.style.cursor = "grabbing";
    const [dx, dy] = [anchor[0] - from[0], anchor[1] - from[1]];
    return {
      move: (at, event) => {
        const place = this.snapped([at[0] + dx, at[1] + dy]);
        store.edit(moveTo(store.doc, id, place), { merge, inputAt: event.timeStamp });
      },
    };
  }

  /** @param {{id: string, role: string}} handle @param {number[]} from @returns {Gesture} */
  dragHandle(handle, from) {
    const { store } = this;
    const merge = `drag:${this.gestures}`;
    const center = /** @type {number[]} */ (anchorOf(store.doc, handle.id));
    let { id } = handle;
    if (handle.role === "corner") {
      store.select(id);
      return this.dragItem(id, from);
    }
    return {
      move: (at, event) => {
        let doc = store.doc;
        if (handle.role === "radius") {
          const [radius] = this.snapped([Math.hypot(at[0] - center[0], at[1] - center[1])]);
          doc = setRadius(doc, id, radius);
        } else if (handle.role === "new-corner") {
          const ref = /** @type {import("../core/mission.js").Ref} */ (refOf(handle.id));
          if (id === handle.id) {
            id = `${ref.kind}:${ref.index}:${ref.vertex + 1}`;
            doc = addCorner(doc, handle.id, ref.vertex, this.snapped(at));
            store.edit(doc, { merge, select: id, inputAt: event.timeStamp });
            return;
          }
          doc = moveTo(doc, id, this.snapped(at));
        } else {
          const degrees = (Math.atan2(at[1] - center[1], at[0] - center[0]) * 180) / Math.PI;
          const step = event.shiftKey || store.show.snap ? 15 : 1;
          doc = setOnPoint(doc, id, "heading_deg", Math.round(degrees / step) * step + 0);
        }
        store.edit(doc, { merge, inputAt: event.timeStamp });
      },
      end: (moved) => {
        if (!moved && handle.role === "free-heading") store.edit(setOnPoint(store.doc, id, "heading_deg", 0));
      },
    };
  }

  /** Away from its chord a span gets looser, towards it tighter. @param {number} leg @param {number[]} from @returns {Gesture} */
  dragSpan(leg, from) {
    const { store } = this;
    const points = pointsOf(store.doc);
    const a = points[leg]?.at, b = (points[leg + 1] ?? points[0])?.at;
    if (!a || !b || store.doc.route?.order === "shortest") return { move: () => {} };
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const off = (/** @type {number[]} */ p) => ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length;
    const bulge = off(from), sign = Math.sign(bulge) || 1;
    const slack = (1 - tensionsOf(store.doc)[leg]) / 2;
    const whole = Math.max(Math.abs(bulge) / Math.max(slack, 0.1), 0.1 * length);
    const merge = `drag:${this.gestures}`;
    return {
      move: (at, event) => {
        const next = slack + ((off(at) - bulge) * sign) / whole;
        const tension = 1 - 2 * Math.min(2, Math.max(0, next));
        store.edit(setTension(store.doc, leg, tension), { merge, inputAt: event.timeStamp });
      },
    };
  }

  /** @param {number[]} from @returns {Gesture} */
  drawCircle(from) {
    const center = this.snapped(from);
    const put = (/** @type {number[]} */ at) => {
      const [radius] = this.snapped([Math.hypot(at[0] - center[0], at[1] - center[1])]);
      this.scene.draft = { circle: { center, radius } };
      this.scene.later();
    };
    return {
      move: (at) => put(at),
      end: (moved, at) => {
        if (moved) put(at);
        const radius = moved ? this.scene.draft?.circle.radius : tidy(this.camera.step(40));
        this.scene.draft = null;
        this.finishObstacle({ circle: { center, radius: Math.max(radius || 0, 0.05) } });
      },
    };
  }

  /** @param {number} px @param {number} py @returns {Gesture} */
  drawPolygon(px, py) {
    const { scene, camera } = this;
    const corners = scene.draft?.corners ?? [];
    const first = corners[0] ? camera.toScreen(corners[0][0], corners[0][1]) : null;
    if (first && corners.length > 2 && Math.hypot(first[0] - px, first[1] - py) < 12) {
      this.closePolygon();
      return { move: () => {} };
    }
    this.addPolygonCorner(camera.toWorld(px, py));
    return { move: () => {} };
  }

  /** @param {number[]} at */
  addPolygonCorner(at) {
    const corners = this.scene.draft?.corners ?? [];
    const place = this.snapped(at), last = corners.at(-1);
    if (last && last[0] === place[0] && last[1] === place[1]) return;
    this.scene.draft = { corners: [...corners, place], at: null };
    this.say(`corner ${corners.length + 1}${corners.length >= 2 ? "; Enter closes the polygon" : ""}`);
    this.scene.later();
  }

  closePolygon() {
    const corners = this.scene.draft?.corners ?? [];
    this.scene.draft = null;
    if (corners.length > 2) this.finishObstacle({ polygon: corners });
    else this.say("a polygon needs three corners");
    this.scene.later();
  }

  /** @param {any} obstacle */
  finishObstacle(obstacle) {
    const { store } = this;
    const doc = addObstacle(store.doc, "known", obstacle);
    const id = `known:${doc.world.known.length - 1}`;
    store.edit(doc, { select: id });
    store.setTool("select");
    this.say("obstacle added");
  }

  /** Stop what a tool has begun. */
  drop() {
    if (!this.scene.draft) return false;
    this.scene.draft = null;
    this.scene.later();
    return true;
  }

  /** Add a via point, within a leg or at the end. @param {number[]} at @param {number|null} leg */
  addViaAt(at, leg) {
    const { store } = this;
    const count = (store.doc.route?.via ?? []).length;
    const index = leg === null || store.doc.route?.order === "shortest" ? count : Math.min(leg, count);
    const id = `via:${index}`;
    store.edit(addVia(store.doc, index, this.snapped(at)), { select: id, merge: `drag:${this.gestures}` });
    return id;
  }

  /** Take the other side of a group. @param {any} entry @param {string} side */
  force(entry, side) {
    this.store.edit(forceSide(this.store.doc, entry.items, side));
    this.say(`${entry.members.join(", ")}: passed on the ${side}`);
  }

  /** @param {number} px @param {number} py */
  hoverAt(px, py) {
    const { store, camera, scene } = this;
    const found = pick(store, camera, px, py, 10);
    if (scene.draft?.corners) {
      scene.draft = { ...scene.draft, at: this.snapped(camera.toWorld(px, py)) };
      scene.later();
    }
    store.lookAt(found?.kind === "path" ? found.s : null);
    const side = found?.kind === "side" ? found.candidate : null;
    if (side !== scene.hoveredSide) {
      scene.hoveredSide = side;
      scene.later();
    }
    this.hover(found?.kind === "item" ? found.id : null);
    const drawing = store.tool === "circle" || store.tool === "polygon" || store.tool === "via";
    this.canvas.style.cursor = found?.kind === "handle" ? "move"
      : store.tool === "pan" ? "grab" : drawing ? "crosshair" : found ? "pointer" : "";
    this.canvas.title = side ? `pass on the ${side} instead: click` : "";
    this.store.tell("place");
    this.at = camera.toWorld(px, py);
  }

  /** @param {string|null} id */
  hover(id) {
    if (id === null) this.at = null;
    if (id === this.store.hover) return;
    this.store.hover = id;
    this.scene.later();
  }
}
