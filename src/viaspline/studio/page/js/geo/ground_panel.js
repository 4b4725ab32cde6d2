/** What lies under the mission, in fields: the place of its 0, 0 on earth, and a picture of the ground. */

import { fill, h, icon, isTypedInto, lazily, slider, textField } from "../panels/dom.js";
import { metres } from "../units.js";
import { exactWords, pairFrom } from "./degrees.js";
import { PictureForm } from "./picture_form.js";

const LEAST_WORTH_SAYING_M = 0.05;

export class GroundPanel {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#ground-fields"));
    this.form = new PictureForm(app);
    this.isSliding = false;
    app.store.on("origin file background", lazily(() => this.render(), 60));
    const button = /** @type {HTMLElement} */ (document.querySelector("#add-picture"));
    button.prepend(icon("picture"));
    button.addEventListener("click", () => this.form.choose());
    this.render();
  }

  render() {
    if (this.isSliding || isTypedInto(this.panel)) return;
    fill(this.panel, this.origin(), ...this.background());
  }

  origin() {
    const { store, files } = this.app;
    const value = store.origin ? exactWords(store.origin) : "";
    if (store.origin && store.name && !/\.ya?ml$/i.test(store.name)) return h("p", { class: "hint" }, `0, 0 is at ${value}, as ${store.name} says.`);
    return textField({
      label: "Latitude, longitude of 0, 0", value, placeholder: "not known",
      set: (text) => {
        const pair = text ? pairFrom(text) : [];
        if (!pair) return this.app.earth.refuse(`${text} isn't a latitude and a longitude such as 47.3977, 8.5456`);
        files.attempt(() => this.form.remember({ origin: pair.join(", ") }));
        return true;
      },
    });
  }

  background() {
    const { files, background } = this.app;
    const { shown } = background;
    if (!shown) return [h("button", { type: "button", class: "button", onclick: () => this.form.choose() }, icon("picture", 15), "Put a picture underneath …")];
    const words = shown.problem ? h("p", { class: "hint is-bad" }, shown.problem) : this.opacity(shown);
    const off = shown.off_by > LEAST_WORTH_SAYING_M ? h("p", { class: "hint" }, `As a flat sheet it is off by up to ${metres(shown.off_by, shown.off_by < 1 ? 2 : 1)}.`) : null;
    return [
      h("p", { class: "picture-name", title: shown.picture }, icon("picture", 15), h("span", {}, shown.picture)), words, off,
      h("div", { class: "pair" },
        h("button", { type: "button", class: "button", onclick: () => this.form.place(shown.picture, shown) }, "Place it …"),
        h("button", { type: "button", class: "button", onclick: () => files.attempt(() => this.form.remember({ background: null })) }, "Take it away")),
    ];
  }

  /** @param {any} shown */
  opacity(shown) {
    const { files, background } = this.app;
    return slider({
      label: "Opacity of the picture", value: shown.opacity, min: 0, max: 1, step: 0.05, words: (value) => `${Math.round(100 * value)} %`,
      grab: () => { this.isSliding = true; },
      set: (value) => background.fade(value),
      drop: () => {
        this.isSliding = false;
        const { picture, grid, corners, opacity } = background.shown;
        files.attempt(() => this.form.remember({ background: { picture, grid, opacity, ...(corners ? { corners } : {}) } }));
      },
    });
  }
}
