/**
 * The path unrolled as it is worked with: points of the route are dragged up and down, the cursor
 * goes along the path, keys go from point to point and lift them.
 */

import { heightOf, withHeight } from "../core/heights.js";
import { onTheme } from "../draw/theme.js";
import { fitted, lazily } from "../panels/dom.js";
import { LEFT_PX, RIGHT_PX } from "./elevation_frame.js";
import { ElevationPicture } from "./elevation_picture.js";

const REACH_PX = 14;

export class Elevation extends ElevationPicture {
  /** @param {any} app @param {import("./space.js").Space} space */
  constructor(app, space) {
    super(app, space);
    this.count = 0; // of drags: the edits of one are undone together
    const soon = () => this.later();
    app.store.on("plan profile hover run selection document scene", soon);
    app.drive.on(soon);
    app.preview.on(soon);
    onTheme(soon);
    fitted(this);
    const on = (/** @type {string} */ type, /** @type {(e: any) => void} */ listener) => this.canvas.addEventListener(type, listener);
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", () => this.up());
    on("pointercancel", () => this.up());
    on("pointerleave", () => { if (!this.held) app.store.lookAt(null); });
    on("keydown", (event) => this.key(event));
    this.sayHeight = lazily(() => { if (app.store.selection) app.say(space.words(app.store.selection)); }, 400);
  }

  /** @param {PointerEvent} event @returns {string|null} */
  pick({ offsetX: px, offsetY: py }) {
    let best = REACH_PX, found = null;
    for (const { id, x, y } of this.points()) {
      const away = Math.hypot(x - px, y - py) - (id === this.app.store.selection ? 2 : 0);
      if (away < best) {
        best = away;
        found = id;
      }
    }
    return found;
  }

  /** @param {PointerEvent} event */
  down(event) {
    const { store } = this.app;
    const id = this.pick(event);
    this.follow(event);
    if (!id) return;
    store.select(id);
    const height = heightOf(store.doc, id);
    if (!height) {
      this.app.toast(id === "land" ? "Where it lands is on the ground: its height can't be dragged." : "This point has no height of its own.");
      return;
    }
    this.canvas.setPointerCapture(event.pointerId);
    this.count += 1;
    this.held = { id, from: event.offsetY, value: height.value };
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { store } = this.app;
    if (!this.held) {
      this.follow(event);
      this.canvas.style.cursor = this.pick(event) ? "ns-resize" : "crosshair";
      return;
    }
    const { id, from, value } = this.held;
    const raw = value + (from - event.offsetY) / this.pixelsPerMetre;
    const unit = Math.max(0.01, 10 ** Math.floor(Math.log10(1 / this.pixelsPerMetre)));
    const next = Math.round(raw / unit) * unit;
    store.edit(withHeight(store.doc, id, next), { merge: `drag-height:${this.count}`, inputAt: event.timeStamp });
  }

  up() {
    if (!this.held) return;
    this.held = null;
    this.sayHeight();
    this.later();
  }

  /** The cursor on the path. @param {PointerEvent} event */
  follow(event) {
    const { store } = this.app;
    if (!store.curve || !this.width) return;
    const part = (event.offsetX - LEFT_PX) / (this.width - LEFT_PX - RIGHT_PX);
    store.lookAt(part < 0 || part > 1 ? null : part * store.curve.length);
  }

  /** Left and right go from point to point, up and down lift the one that is selected. @param {KeyboardEvent} event */
  key(event) {
    const { store, say, describe } = this.app;
    const points = this.points();
    const along = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const up = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (along) {
      const i = points.findIndex(({ id }) => id === store.selection);
      const next = points[i < 0 ? (along > 0 ? 0 : points.length - 1) : Math.min(Math.max(i + along, 0), points.length - 1)];
      if (next) {
        store.select(next.id);
        say(`${describe(next.id)}, ${this.space.words(next.id)}`);
      }
    } else if (up) {
      if (!store.selection || !this.space.lift(store.selection, up, event.shiftKey)) say("nothing that has a height is selected");
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
