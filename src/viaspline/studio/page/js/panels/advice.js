/** The advice on tension: asked for by a button, in the words of the command line, taken by another. */

import { withSpline } from "../core/edits.js";
import { h } from "./dom.js";

export class Advice {
  /** @param {any} app @param {() => void} render shows it anew */
  constructor(app, render) {
    this.app = app;
    this.render = render;
    this.isAsked = false;
    /** @type {{doc: any, words: string, tension: number|number[]|null, isNew: boolean}|null} */ this.given = null;
  }

  async ask() {
    const { app } = this;
    const { doc } = app.store;
    this.isAsked = true;
    this.render();
    try {
      const { words, tension, is_new: isNew } = await app.link.ask({ type: "advise" });
      this.given = { doc, words, tension, isNew };
      app.say(words);
    } catch (error) {
      app.toast(/** @type {Error} */ (error).message, "is-bad");
    } finally {
      this.isAsked = false;
      this.render();
    }
  }

  take() {
    const { store } = this.app;
    if (!this.given) return;
    store.edit(withSpline(store.doc, this.given.tension));
    this.given = null;
  }

  /** @returns {Node[]} */
  rows() {
    const given = this.given?.doc === this.app.store.doc ? this.given : null;
    return [
      h("div", { class: "advice" },
        h("button", { type: "button", class: "button", disabled: this.isAsked || !this.app.store.plan?.ok, onclick: () => this.ask() }, this.isAsked ? "Planning with other tensions …" : "Suggest a tension"),
        given?.isNew ? h("button", { type: "button", class: "button is-primary", onclick: () => this.take() }, "Take it") : null),
      ...(given ? [h("p", { class: "hint" }, given.words)] : []),
    ];
  }
}
