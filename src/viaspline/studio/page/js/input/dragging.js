/** What is dragged on the map: points, obstacles and areas, their handles, spans of the path. */

import { addVertex, addVia as withVia, moveTo, reshaped, setOnPoint, setTension } from "../core/edits.js";
import { anchorOf, isObstacle, pointsOf, refOf, tensionsOf } from "../core/mission.js";

/** @typedef {import("./pointer.js").Gesture} Gesture */

export class Dragging {
  /**
   * @param {import("../core/store.js").Store} store
   * @param {HTMLCanvasElement} canvas
   * @param {(at: number[]) => number[]} snapped
   * @param {(ids: readonly string[]) => void} begin told what is dragged
   */
  constructor(store, canvas, snapped, begin) {
    this.store = store;
    this.canvas = canvas;
    this.snapped = snapped;
    this.begin = begin;
    this.count = 0; // of gestures: the edits of one are undone together
  }

  /** @param {string} id @param {number[]} from @returns {Gesture} */
  item(id, from) {
    const { store } = this;
    const anchor = anchorOf(store.doc, id);
    const merge = `drag:${this.count}`;
    if (!anchor) return { move: () => {} };
    this.begin([id]);
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
  handle(handle, from) {
    const { store } = this;
    const merge = `drag:${this.count}`;
    const center = /** @type {number[]} */ (anchorOf(store.doc, handle.id));
    let { id } = handle;
    this.begin([id]);
    if (handle.role === "corner") {
      store.select(id);
      return this.item(id, from);
    }
    return {
      move: (at, event) => {
        let doc = store.doc;
        if (handle.role === "new-corner") {
          const ref = /** @type {import("../core/mission.js").Ref} */ (refOf(handle.id));
          if (id === handle.id) {
            id = `${ref.kind}:${ref.index}:${ref.vertex + 1}`;
            doc = addVertex(doc, handle.id, ref.vertex, this.snapped(at));
            store.edit(doc, { merge, select: id, inputAt: event.timeStamp });
            return;
          }
          doc = moveTo(doc, id, this.snapped(at));
        } else if (isObstacle(id)) {
          doc = reshaped(doc, id, (shape, item) => shape.dragged(item, handle.role, at, this.snapped));
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
  span(leg, from) {
    const { store } = this;
    const points = pointsOf(store.doc);
    const a = points[leg]?.at, b = (points[leg + 1] ?? points[0])?.at;
    if (!a || !b || store.doc.route?.order === "shortest") return { move: () => {} };
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const off = (/** @type {number[]} */ p) => ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length;
    const bulge = off(from), sign = Math.sign(bulge) || 1;
    const slack = (1 - tensionsOf(store.doc)[leg]) / 2;
    const whole = Math.max(Math.abs(bulge) / Math.max(slack, 0.1), 0.1 * length);
    const merge = `drag:${this.count}`;
    return {
      move: (at, event) => {
        const next = slack + ((off(at) - bulge) * sign) / whole;
        const tension = 1 - 2 * Math.min(2, Math.max(0, next));
        store.edit(setTension(store.doc, leg, tension), { merge, inputAt: event.timeStamp });
      },
    };
  }

  /** Add a via point, within a leg or at the end. @param {number[]} at @param {number|null} leg */
  addVia(at, leg) {
    const { store } = this;
    const count = (store.doc.route?.via ?? []).length;
    const index = leg === null || store.doc.route?.order === "shortest" ? count : Math.min(leg, count);
    const id = `via:${index}`;
    this.begin([]);
    store.edit(withVia(store.doc, index, this.snapped(at)), { select: id, merge: `drag:${this.count}` });
    return id;
  }
}
