/** The dialog in which a picture is chosen and placed under the map. */

import { choice, h, icon, textField } from "../panels/dom.js";
import { boxAll } from "../files/svg.js";
import { number } from "../units.js";
import { exactWords, numbersFrom, pairFrom } from "./degrees.js";

const GRIDS = /** @type {[string, string][]} */ ([["metres", "metres of the mission: x, y"], ["degrees", "degrees: latitude, longitude"], ["other", "metres of UTM or Web Mercator"]]);
const FALLBACK_BOX = [0, 0, 100, 100];

export class PictureForm {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
  }

  /** Have something kept beside the mission, and show what came of it. @param {{origin?: string, background?: any}} what */
  async remember(what) {
    const { app } = this;
    const answer = await app.link.ask({ type: "remember", ...what });
    app.store.origin = answer.origin;
    app.background.take(answer.background);
    return answer;
  }

  choose() {
    const { files, link } = this.app;
    files.attempt(async () => {
      const { pictures } = await link.ask({ type: "pictures" });
      files.show("Put a picture underneath", pictures.length
        ? h("ul", { class: "file-list" }, ...pictures.map((/** @type {string} */ name) => h("li", {}, h("button", { type: "button", class: "file", onclick: () => this.place(name) }, icon("picture", 16), h("span", {}, name)))))
        : h("p", { class: "hint" }, "There is no picture in this folder: PNG, JPEG, or GeoTIFF. Copy one beside the mission's file, with its world file if it has one."));
    });
  }

  /** Ask where a picture lies. @param {string} picture @param {any} [before] where it lies now */
  place(picture, before = null) {
    const { files, link } = this.app;
    files.attempt(async () => {
      const facts = await link.ask({ type: "picture", picture });
      const byFile = facts.place && (!before || !before.corners);
      /** @type {any} */ const asked = {
        by: byFile ? "file" : "corners", origin: "",
        grid: before?.grid?.startsWith("EPSG") ? "other" : before?.grid ?? "metres", code: before?.grid?.startsWith("EPSG") ? before.grid : "EPSG:326",
        low: before?.corners ? before.corners[0].join(", ") : "", high: before?.corners ? before.corners[1].join(", ") : "",
      };
      if (!before) this.propose(asked, facts.size);
      this.ask(picture, facts, asked, before?.opacity);
    });
  }

  /** Corners that show the picture under all of the mission. @param {any} asked @param {number[]} size */
  propose(asked, [width, height]) {
    const [x0, y0, x1] = boxAll(this.app.store) ?? FALLBACK_BOX;
    asked.low = [x0, y0].map((value) => number(value)).join(", ");
    asked.high = [x1, y0 + ((x1 - x0) * height) / width].map((value) => number(value)).join(", ");
  }

  /** @param {string} picture @param {any} facts @param {any} asked changed while the dialog is open @param {number} [opacity] */
  ask(picture, facts, asked, opacity) {
    const { files, store } = this.app;
    const again = () => this.ask(picture, facts, asked, opacity);
    const set = (/** @type {string} */ key) => (/** @type {string} */ value) => {
      asked[key] = value;
      if (key === "by" || key === "grid") again();
    };
    const isKnown = asked.by === "file" && facts.place.grid;
    const needsOrigin = !store.origin && (isKnown ? facts.place.grid !== "metres" : asked.grid !== "metres");
    const words = asked.grid === "degrees" ? "latitude, longitude" : "x, y";
    const fields = [
      facts.place ? choice({ label: "Where it lies", value: asked.by, options: [["file", `as ${facts.place.source} says`], ["corners", "by two corners"]], set: set("by") }) : null,
      isKnown ? h("p", { class: "hint" }, `${facts.place.source} is in ${facts.place.grid}.`)
        : choice({ label: asked.by === "file" ? `The numbers in ${facts.place.source} are` : "The corners are", value: asked.grid, options: GRIDS, set: set("grid") }),
      !isKnown && asked.grid === "other" ? textField({ label: "Grid", value: asked.code, placeholder: "EPSG:32632", set: set("code") }) : null,
      ...(asked.by === "corners" ? [
        textField({ label: `Bottom left: ${words}`, value: asked.low, set: set("low") }),
        textField({ label: `Top right: ${words}`, value: asked.high, set: set("high") }),
      ] : []),
      needsOrigin ? textField({ label: "Latitude, longitude of the mission's 0, 0", value: asked.origin, placeholder: "47.3977, 8.5456", set: set("origin") }) : null,
    ];
    const go = (/** @type {Event} */ event) => {
      event.preventDefault();
      files.attempt(() => this.put(picture, facts, asked, { opacity, needsOrigin }));
    };
    files.show(`Place ${picture.replace(/^.*\//, "")}`, h("form", { onsubmit: go },
      h("p", { class: "hint" }, `${facts.size[0]} × ${facts.size[1]} pixels. It is only looked at: nothing is planned with it.`), ...fields,
      h("div", { class: "dialog-buttons" }, h("button", { type: "button", class: "button", onclick: () => files.dialog.close() }, "Cancel"), h("button", { type: "submit", class: "button is-primary" }, "Put it underneath"))));
  }

  /** @param {string} picture @param {any} facts @param {any} asked @param {{opacity?: number, needsOrigin: boolean}} more */
  async put(picture, facts, asked, { opacity, needsOrigin }) {
    const { app } = this;
    const grid = asked.grid === "other" ? asked.code.trim().toUpperCase() : asked.grid;
    /** @type {any} */ const background = { picture, grid, ...(opacity === undefined ? {} : { opacity }) };
    if (asked.by === "corners") {
      const read = grid === "degrees" ? pairFrom : numbersFrom;
      background.corners = [asked.low, asked.high].map((text) => {
        const pair = read(text);
        if (!pair) throw new Error(`${text || "nothing"} is no ${grid === "degrees" ? "latitude and longitude such as 47.3977, 8.5456" : "pair of numbers such as 120, 45.5"}`);
        return pair;
      });
    }
    /** @type {{origin?: string, background: any}} */ const what = { background };
    if (needsOrigin) {
      const origin = pairFrom(asked.origin);
      if (!origin) throw new Error("Give the latitude and longitude of the mission's 0, 0, such as 47.3977, 8.5456: else nobody knows where the picture lies.");
      what.origin = exactWords(origin);
    }
    await this.remember(what);
    app.files.dialog.close();
    this.lookFor();
  }

  /** Say where the picture is if it lies out of sight. */
  lookFor() {
    const { app } = this;
    const [x0, y0, x1, y1] = app.background.box ?? FALLBACK_BOX;
    const [left, top] = app.camera.toWorld(0, 0);
    const [right, bottom] = app.camera.toWorld(app.camera.width, app.camera.height);
    const isInSight = x0 < right && x1 > left && y0 < top && y1 > bottom;
    if (isInSight) app.say("the picture lies under the map");
    else app.toast("The picture lies out of sight.", "", { label: "Look at it", act: () => {
      app.camera.fit([x0, y0, x1, y1], { top: 62, right: 40, bottom: 48, left: 76 });
      app.store.tell("view");
    } });
  }
}
