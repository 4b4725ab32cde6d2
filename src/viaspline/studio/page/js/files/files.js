/** New, open, save, export, add a map, copy the address of the scene. */

import { addObstacle } from "../core/edits.js";
import { fill, h, icon } from "../panels/dom.js";
import { meaning } from "../panels/meaning.js";
import { robotName } from "../core/fleet.js";
import { packed } from "./share.js";
import { svgOf } from "./svg.js";

const PLAN_EXPORTS = [
  ["plan.json", "The exact curve, its proof and what was weighed: the bytes that viaspline plan writes"],
  ["path.csv", "The path as equally spaced points with heading, curvature, speed and time"],
  ["plan.png", "The picture that viaspline plan draws"],
  ["scene.svg", "The scene as curves, in metres"],
  ["scene.png", "The map as it is on the screen"],
];
const PATH_EXPORTS = [
  ["path.plan", "QGroundControl: way points, speeds, dwells, fences"],
  ["path.waypoints", "QGC WPL 110: way points for ArduPilot's ground stations"],
  ["path.yaml", "ROS: nav_msgs/Path as YAML"],
  ["path.mcap", "ROS: nav_msgs/Path as a bag"],
  ["path.geojson", "GeoJSON: the line with speeds and times, the via points"],
  ["path.kml", "KML: for Google Earth"],
  ["path.gpx", "GPX: a route for chart plotters and hand-held receivers"],
]; // the path as few straight lines, proven again
const ONE_ROBOT = ["plan.json", "path.csv", "plan.png", ...PATH_EXPORTS.map(([kind]) => kind)]; // of a fleet, that which is chosen
const RUN_EXPORTS = [
  ["run.json", "What was driven, every event and every re-plan"],
  ["run.csv", "The driven path over time"],
  ["run.png", "The picture of the drive"],
];

const FLEET_EXPORTS = [
  ["fleet.json", "Who drives when, what is proven, who passes first: the bytes that viaspline plan writes"],
  ["fleet.png", "The picture that viaspline plan draws of the fleet"],
];
const FLEET_RUN_EXPORTS = [
  ["run.json", "When each robot arrived, what held it up, and what is proven of the drive"],
  ["run.png", "The picture of the drive"],
];

const SAVED_ENDINGS = [
  [".yaml", "viaspline, the whole mission (.yaml)"],
  [".plan", "QGroundControl (.plan)"],
  [".waypoints", "QGC WPL 110 (.waypoints)"],
  [".txt", "QGC WPL 110 (.txt)"],
];
const SAVED_NAME = /\.(ya?ml|plan|waypoints|txt)$/i;

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

  /** Do what may take a while; its button shows that, and begins it once. @param {HTMLElement} button @param {() => Promise<void>} work */
  async busily(button, work) {
    if (button.getAttribute("aria-busy") === "true") return;
    const sign = /** @type {Element} */ (button.firstElementChild);
    const turning = h("span", { class: "spinner", "aria-hidden": "true" });
    button.setAttribute("aria-busy", "true");
    sign.replaceWith(turning);
    await this.attempt(work);
    turning.replaceWith(sign);
    button.removeAttribute("aria-busy");
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
    const { name, origin } = this.app.store;
    const value = !name ? "mission.yaml" : SAVED_NAME.test(name) ? name : name.replace(/\.[^.]+$/, ".yaml");
    const input = h("input", { type: "text", class: "wide-input", value, "aria-label": "File name", spellcheck: "false" });
    const kind = h("select", { class: "wide-input", "aria-label": "Kind of file" }, ...SAVED_ENDINGS.map(([ending, words]) => h("option", { value: ending }, words)));
    const place = h("input", { type: "text", class: "wide-input", value: origin ? origin.join(", ") : "", placeholder: "47.3977, 8.5456", "aria-label": "Origin", spellcheck: "false" });
    const asked = h("label", { class: "field" }, h("span", { class: "field-name" }, "Latitude and longitude of 0, 0"), place);
    const follow = () => {
      const ending = input.value.trim().match(SAVED_NAME)?.[0].toLowerCase() ?? ".yaml";
      kind.value = ending === ".yml" ? ".yaml" : ending;
      asked.hidden = kind.value === ".yaml";
    };
    input.addEventListener("input", follow);
    kind.addEventListener("change", () => {
      input.value = input.value.trim().replace(SAVED_NAME, "") + kind.value;
      follow();
    });
    follow();
    const go = (/** @type {Event} */ event) => {
      event.preventDefault();
      const wanted = input.value.trim();
      this.attempt(() => this.write(SAVED_NAME.test(wanted) ? wanted : `${wanted}.yaml`, false, place.value));
    };
    this.show(`Save in ${this.app.store.folder}`, h("form", { onsubmit: go }, h("label", { class: "field" }, h("span", { class: "field-name" }, "File name"), input),
      h("label", { class: "field" }, h("span", { class: "field-name" }, "Kind of file"), kind), asked,
      h("div", { class: "dialog-buttons" }, h("button", { type: "button", class: "button", onclick: () => this.dialog.close() }, "Cancel"), h("button", { type: "submit", class: "button is-primary" }, "Save"))));
    input.focus();
    input.setSelectionRange(0, input.value.replace(SAVED_NAME, "").length);
  }

  /** @param {string} name @param {boolean} replace @param {string} [origin] */
  async write(name, replace, origin = "") {
    const { app } = this;
    await app.settled();
    const { file } = app.store;
    const answer = await app.link.ask({ type: "save", name, replace, origin: /\.ya?ml$/i.test(name) ? "" : origin });
    if (answer.type === "exists") {
      this.show("Replace the file?", h("p", {}, `${name} is there already.`), ...listed("What stands there and would be lost:", answer.lost), h("div", { class: "dialog-buttons" },
        h("button", { type: "button", class: "button", onclick: () => this.saveAs() }, "Another name"),
        h("button", { type: "button", class: "button is-primary", onclick: () => this.attempt(() => this.write(name, true, origin)) }, "Replace")));
      return;
    }
    app.store.origin = answer.origin;
    if (answer.lost.length) {
      this.show("Saved a part of the mission", ...listed(`Of the mission, ${name} can't carry:`, answer.lost),
        h("p", { class: "hint" }, "Save it as YAML to keep all of it."),
        h("div", { class: "dialog-buttons" }, h("button", { type: "button", class: "button is-primary", onclick: () => this.dialog.close() }, "OK")));
      return;
    }
    this.dialog.close();
    app.saved(answer, file);
    app.toast(`Saved ${name}`);
  }

  export() {
    const { store } = this.app;
    const isOfFleet = store.robot !== null;
    const whose = isOfFleet ? ` · ${robotName(store.file, store.robot ?? 0)}` : "";
    const own = PLAN_EXPORTS.map(([kind, words]) => [kind, ONE_ROBOT.includes(kind) ? `${words}${whose}` : words]);
    const list = [...(isOfFleet ? FLEET_EXPORTS : []), ...own, ...(!store.run ? [] : isOfFleet ? FLEET_RUN_EXPORTS : RUN_EXPORTS)];
    const place = h("input", { type: "text", class: "wide-input", value: store.origin ? store.origin.join(", ") : "", placeholder: "47.3977, 8.5456", "aria-label": "Origin", spellcheck: "false" });
    const items = (/** @type {string[][]} */ some) => h("ul", { class: "file-list" }, ...some.map(([kind, words]) => h("li", {}, h("button", { type: "button", class: "file", onclick: (/** @type {Event} */ event) => this.busily(/** @type {HTMLElement} */ (event.currentTarget), () => this.take(kind, place.value)) }, icon("export", 16), h("span", {}, h("strong", {}, kind), h("small", {}, words))))));
    this.show("Export", items(list),
      h("p", { class: "hint" }, "The path as few straight lines, ", meaning("a-path", "proven"), ` again as the file has them${whose}`),
      h("label", { class: "field" }, h("span", { class: "field-name" }, "Latitude and longitude of 0, 0 (all but those for ROS need it)"), place), items(PATH_EXPORTS),
      store.run ? null : h("p", { class: "hint" }, "After a drive its files are here as well."));
  }

  /** @param {string} kind @param {string} [origin] */
  async take(kind, origin = "") {
    const { app } = this;
    const stem = (app.store.name ?? "mission").replace(/^.*\//, "").replace(/\.[^.]+$/, "");
    if (kind === "scene.svg") download(`${stem}.svg`, new Blob([svgOf(app.store)], { type: "image/svg+xml" }));
    else if (kind === "scene.png") {
      app.scene.draw();
      app.scene.canvas.toBlob((/** @type {Blob|null} */ blob) => blob && download(`${stem}.png`, blob), "image/png");
    } else {
      await app.settled();
      const { file, robot } = app.store;
      const answer = await app.link.ask({ type: "export", kind, origin, ...(robot !== null && ONE_ROBOT.includes(kind) ? { robot: robotName(file, robot) } : {}) });
      const bytes = Uint8Array.from(atob(answer.data), (c) => c.charCodeAt(0));
      download(answer.name, new Blob([bytes]));
      if (answer.told?.length) {
        this.show(`Exported ${answer.name}`, ...listed(h("span", {}, "What is ", meaning("a-path", "proven"), " of it, and what it can't carry:"), answer.told),
          h("div", { class: "dialog-buttons" }, h("button", { type: "button", class: "button is-primary", onclick: () => this.dialog.close() }, "OK")));
      }
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
      url.hash = `m=${await packed({ name: store.name, doc: store.file })}`;
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

/** Some lines under a heading; nothing if there are none. @param {Node|string} heading @param {string[]} [lines] */
function listed(heading, lines = []) {
  return lines.length ? [h("p", {}, heading), h("ul", { class: "hint" }, ...lines.map((line) => h("li", {}, line)))] : [];
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
