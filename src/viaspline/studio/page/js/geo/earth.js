/** Where on earth the mission lies: places as latitudes and longitudes, read under the cursor and typed. */

import { moveTo } from "../core/edits.js";
import { textField } from "../panels/dom.js";
import { place, tidy } from "../units.js";
import { exactWords, pairFrom, shortWords } from "./degrees.js";
import { LocalFrame, MAX_REACH_M } from "./local_frame.js";

export class Earth {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** @type {number[]|null} */ this.known = null;
    /** @type {LocalFrame|null} */ this.local = null;
    this.listen(/** @type {HTMLElement} */ (document.querySelector("#where")));
  }

  /** The mission's frame on earth; null if nobody said where it lies. @returns {LocalFrame|null} */
  get frame() {
    const { origin } = this.app.store;
    if (origin !== this.known) {
      this.known = origin;
      this.local = origin ? new LocalFrame(origin[0], origin[1]) : null;
    }
    return this.local;
  }

  /** A place for reading: metres, and degrees where they are known. @param {number[]} at x, y [m] */
  words(at) {
    const degrees = this.degrees(at);
    return degrees ? `${place(at)} · ${degrees}` : place(at);
  }

  /** Latitude and longitude for reading; nothing where they aren't known. @param {number[]|null} at x, y [m] */
  degrees(at) {
    const { frame } = this;
    return frame && at && Math.hypot(at[0], at[1]) <= MAX_REACH_M ? shortWords(frame.toGeodetic(at)) : "";
  }

  /** A field with the latitude and longitude of what is selected; null without an origin. @param {string} id @param {number[]} at */
  field(id, at) {
    const { app, frame } = this;
    if (!frame) return null;
    return textField({
      label: "Latitude, longitude", value: exactWords(frame.toGeodetic(at)), placeholder: "47.3977, 8.5456",
      set: (text) => {
        const pair = pairFrom(text);
        if (!pair) return this.refuse(`${text || "nothing"} isn't a latitude and a longitude such as 47.3977, 8.5456`);
        if (frame.arc(...pair) > MAX_REACH_M) return this.refuse(`${shortWords(pair)} is more than ${MAX_REACH_M / 1000} km from the mission's 0, 0`);
        app.store.edit(moveTo(app.store.doc, id, frame.toLocal(...pair).map(tidy)));
        return true;
      },
    });
  }

  /** @param {string} text */
  refuse(text) {
    this.app.toast(text, "is-bad");
    return false;
  }

  /** Show the place under the cursor, also while something is dragged. @param {HTMLElement} output */
  listen(output) {
    const { canvas } = this.app.scene;
    canvas.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
      const box = canvas.getBoundingClientRect();
      output.textContent = this.words(this.app.camera.toWorld(event.clientX - box.left, event.clientY - box.top));
    });
    canvas.addEventListener("pointerleave", () => { output.textContent = ""; });
  }
}
