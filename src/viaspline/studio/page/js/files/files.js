/** New, open, save, export, add a map, copy the address of the scene. */

import { addObstacle } from "../core/edits.js";
import { fill, h, icon } from "../panels/dom.js";
import { packed } from "./share.js";
import { svgOf } from "./svg.js";

const EXPORTS = [
  ["plan.json", "The exact curve, its proof and what was weighed: the bytes that viaspline plan writes"],
  ["path.csv", "The path as equally spaced points with heading, curvature, speed and time"],
  ["plan.png", "The picture that viaspline plan draws"],
  ["scene.svg", "The scene as curves, in metres"],
  ["scene.png", "The map as it is on the screen"],
];
const OF_RUNS = [
  ["run.json", "What was driven, every event and every re-plan"],
  ["run.csv", "The driven path over time"],
  ["run.png", "The picture of the drive"],
];

export class Files {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.dialog = /** @type {HTMLDialogElement} */ (document.querySelector("#dialog"));
    this.title = /** @type {HTMLElement} */ (document.querySelector("#dialog-title"));
    this.body = /** @type {HTMLElement} */ (document.querySelector("#dialog-body"));
    document.querySelector("#dialog-close")?.addEventListener("click", () => this.dialog.close());
    this.dialog.addEventListener("click", (event) => { if (event.target === this.dialog) this.dialog.close(); });
    this.dialog.addEventListener("close", () => app.scene.canvas.focus());
  }

  /** @param {string} title @param {...(Node|string|null)} children */
  show(title, ...children) {
    this.title.textContent = title;
    fill(this.body, ...children);
    if (!this.dialog.open) this.dialog.showModal();
  }

  /** @param {() => Promise<void>} work */
  async attempt(work) {
    try {
      await work();
    } catch (error) {
      this.app.toast(/** @type {Error} */ (error).message, "is-bad");
    }
  }

  /** Ask before edits are left behind. @param {() => void} go */
  leaving(go) {
    if (!this.app.store.dirty) {
      go();
      return;
    }
    this.show("Leave unsaved changes?", h("p", {}, `The changes of ${this.app.store.name ?? "this new mission"} are not saved in its file. The browser keeps them until you come back to it.`),
      h("div", { class: "dialog-buttons" },
        h("button", { type: "button", class: "button", onclick: () => this.dialog.close() }, "Stay"),
        h("button", { type: "button", class: "button is-primary", onclick: () => { this.dialog.close(); go(); } }, "Leave them")));
  }

  blank() {
    this.leaving(() => this.attempt(async () => this.app.opened(await this.app.link.ask({ type: "new" }))));
  }

  open() {
    this.attempt(async () => {
      const { missions } = await this.app.link.ask({ type: "files" });
      this.show(`Open from ${this.app.store.folder}`, missions.length
        ? h("ul", { class: "file-list" }, ...missions.map((/** @type {string} */ name) => h("li", {}, h("button", { type: "button", class: `file${name === this.app.store.name ? " is-current" : ""}`, onclick: () => { this.dialog.close(); this.leaving(() => this.load(name)); } }, icon("file", 16), h("span", {}, name)))))
        : h("p", { class: "hint" }, "There is no mission file in this folder."));
    });
  }

  /** @param {string} name */
  load(name) {
    this.attempt(async () => this.app.opened(await this.app.link.ask({ type: "open", name })));
  }

  /** Save under its name, or ask for one. */
  save() {
    const { name } = this.app.store;
    if (name && /\.ya?ml$/i.test(name)) this.attempt(() => this.write(name, false));
    else this.saveAs();
  }

  saveAs() {
    const { name } = this.app.store;
    const input = h("input", { type: "text", class: "wide-input", value: name ? name.replace(/\.[^.]+$/, ".yaml") : "mission.yaml", "aria-label": "File name", spellcheck: "false" });
    const go = (/** @type {Event} */ event) => {
      event.preventDefault();
      const wanted = input.value.trim();
      this.attempt(() => this.write(/\.ya?ml$/i.test(wanted) ? wanted : `${wanted}.yaml`, false));
    };
    this.show(`Save in ${this.app.store.folder}`, h("form", { onsubmit: go }, h("label", { class: "field" }, h("span", { class: "field-name" }, "File name"), input),
      h("div", { class: "dialog-buttons" }, h("button", { type: "button", class: "button", onclick: () => this.dialog.close() }, "Cancel"), h("button", { type: "submit", class: "button is-primary" }, "Save"))));
    input.focus();
    input.setSelectionRange(0, input.value.replace(/\.ya?ml$/, "").length);
  }

  /** @param {string} name @param {boolean} replace */
  async write(name, replace) {
    const { app } = this;
    await app.settled();
    const doc = app.store.doc;
    const answer = await app.link.ask({ type: "save", name, replace });
    if (answer.type === "exists") {
      this.show("Replace the file?", h("p", {}, `${name} is there already.`), h("div", { class: "dialog-buttons" },
        h("button", { type: "button", class: "button", onclick: () => this.saveAs() }, "Another name"),
        h("button", { type: "button", class: "button is-primary", onclick: () => this.attempt(() => this.write(name, true)) }, "Replace")));
      return;
    }
    this.dialog.close();
    app.saved(answer, doc);
    app.toast(`Saved ${name}`);
  }

  export() {
    const { store } = this.app;
    const list = [...EXPORTS, ...(store.run ? OF_RUNS : [])];
    this.show("Export", h("ul", { class: "file-list" }, ...list.map(([kind, words]) => h("li", {}, h("button", { type: "button", class: "file", onclick: () => this.attempt(() => this.take(kind)) }, icon("export", 16), h("span", {}, h("strong", {}, kind), h("small", {}, words)))))),
      store.run ? null : h("p", { class: "hint" }, "After a drive its files are here as well."));
  }

  /** @param {string} kind */
  async take(kind) {
    const { app } = this;
    const stem = (app.store.name ?? "mission").replace(/^.*\//, "").replace(/\.[^.]+$/, "");
    if (kind === "scene.svg") download(`${stem}.svg`, new Blob([svgOf(app.store)], { type: "image/svg+xml" }));
    else if (kind === "scene.png") {
      app.scene.draw();
      app.scene.canvas.toBlob((/** @type {Blob|null} */ blob) => blob && download(`${stem}.png`, blob), "image/png");
    } else {
      await app.settled();
      const answer = await app.link.ask({ type: "export", kind });
      const bytes = Uint8Array.from(atob(answer.data), (c) => c.charCodeAt(0));
      download(answer.name, new Blob([bytes]));
    }
    app.say(`${kind} exported`);
  }

  addMap() {
    this.attempt(async () => {
      const { maps } = await this.app.link.ask({ type: "files" });
      const base = (this.app.store.name ?? "").replace(/[^/]*$/, "");
      const add = (/** @type {string} */ name) => {
        this.dialog.close();
        const up = base.split("/").filter(Boolean).map(() => "..");
        const path = name.startsWith(base) ? name.slice(base.length) : [...up, name].join("/");
        const { store } = this.app;
        store.edit(addObstacle(store.doc, "known", { map: path }));
        this.app.fitSoon();
      };
      this.show("Put a map underneath", maps.length
        ? h("ul", { class: "file-list" }, ...maps.map((/** @type {string} */ name) => h("li", {}, h("button", { type: "button", class: "file", onclick: () => add(name) }, icon("map", 16), h("span", {}, name)))))
        : h("p", { class: "hint" }, "There is no map in this folder: ROS map_server (.yaml), MovingAI (.map), SVG or GeoJSON."));
    });
  }

  /** The address of the scene as it is now. */
  link() {
    this.attempt(async () => {
      const { store } = this.app;
      const url = new URL(location.href);
      url.hash = `m=${await packed({ name: store.name, doc: store.doc })}`;
      history.replaceState(null, "", url);
      try {
        await navigator.clipboard.writeText(url.href);
        this.app.toast("The address of this scene is copied.");
      } catch {
        this.app.toast("The address of this scene is in the address bar.");
      }
    });
  }
}

/** @param {string} name @param {Blob} blob */
function download(name, blob) {
  const url = URL.createObjectURL(blob);
  const a = h("a", { href: url, download: name });
  document.body.append(a);
  a.click();
  a.remove();
  setTimeout(() => URL.revokeObjectURL(url), 5000);
}
