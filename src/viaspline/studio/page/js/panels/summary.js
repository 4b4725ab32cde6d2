/** What has been proven, what it costs, what was weighed; or why there is no path, and the way out. */

import { forceSide, replaced } from "../core/edits.js";
import { idAt, obstaclesOf, part, pointsOf } from "../core/mission.js";
import { missionOf, robotName } from "../core/fleet.js";
import { heightRows } from "../space/height_rows.js";
import { timingRows } from "./timing.js";
import { bend, down, metres, number, place, seconds } from "../units.js";
import { fill, h, icon, lazily, sentence } from "./dom.js";
import { meaning } from "./meaning.js";

const PROVEN = "proven";

export class Summary {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#summary"));
    this.status = /** @type {HTMLElement} */ (document.querySelector("#status"));
    this.busy = "";
    this.wasOk = true;
    this.isOpen = false; // the reasons why a path doesn't drive well
    const render = lazily(() => this.render(), 80);
    app.store.on("plan ledger status", render);
    app.store.on("file", () => this.render()); // what was proven of the file before isn't of this one
    app.store.on("plan", () => this.announce());
  }

  /** Tell people who don't see the map when a path is lost or found. */
  announce() {
    const { plan } = this.app.store;
    if (!plan || plan.ok === this.wasOk) return;
    this.wasOk = plan.ok;
    this.app.say(plan.ok ? `there is a path again, ${metres(plan.length, 1)}` : `${plan.gave_up ? "" : "no path: "}${plan.problems[0]?.text ?? ""}`);
  }

  render() {
    const { store } = this.app;
    const { plan } = store;
    if (this.busy) this.pill("is-busy", "…", this.busy);
    else if (!plan) this.pill("is-busy", "…", "planning");
    else if (store.fleetPlan?.answer.ok) this.fleetPill(store.fleetPlan);
    else if (plan.ok) this.pill("is-good", "check", `${plan.certificate.clearance === null ? "nothing to keep clear of" : "proven clear"} · ${metres(plan.length, 1)} · ${seconds(plan.duration)}`, "a-path");
    else if (plan.gave_up) this.pill("is-bad", "warn", plan.problems[0]?.text ?? "gave up");
    else this.pill("is-bad", "warn", `no path: ${plan.problems[0]?.text ?? ""}`);
    this.panel.classList.toggle("is-late", store.isLate);
    if (!plan) fill(this.panel, h("p", { class: "hint" }, "What is proven is said here once it is planned."));
    else if (plan.ok) fill(this.panel, ...this.good(plan));
    else fill(this.panel, ...this.bad(plan));
  }

  /** @param {import("../core/fleet_plan.js").FleetPlan} fleet */
  fleetPill({ driving, byName, certificate, missing, served, isWhole, lasts }) {
    if (served) this.pill("is-good", "check", `proven apart · ${byName.size} robots · ${seconds(lasts[1])}`, "fleets-and-space");
    else if (!isWhole) this.pill("is-busy", "…", `${driving.length} of ${byName.size} served, trying other ways`);
    else if (missing.length) this.pill("is-bad", "warn", `${driving.length} of ${byName.size} served: ${missing[0].name}: ${missing[0].missing?.reason ?? ""}`);
    else this.pill("is-bad", "warn", `too near: ${metres(certificate.separation)} of ${metres(certificate.required)}`);
  }

  /**
   * @param {string} kind @param {string} sign @param {string} text
   * @param {"a-path"|"fleets-and-space"} [section] where the word with which a proof begins leads to
   */
  pill(kind, sign, text, section) {
    this.status.className = `status ${kind}`;
    fill(this.status, sign === "…" ? h("span", { class: "spinner", "aria-hidden": "true" }) : icon(/** @type {any} */ (sign), 16), h("span", { class: "status-text" }, ...(section && text.startsWith(PROVEN) ? [meaning(section, PROVEN), text.slice(PROVEN.length)] : [text])));
    this.status.title = text;
  }

  /** @param {any} plan */
  good(plan) {
    const proof = plan.certificate;
    const row = (/** @type {string} */ name, /** @type {string} */ value) => [h("dt", {}, name), h("dd", {}, value)];
    return [
      h("div", { class: "proof" },
        proof.clearance === null ? null : h("span", { class: "proof-figure" }, down(proof.clearance)),
        h("span", { class: "proof-words" }, proof.clearance === null ? "nothing to keep clear of" : h("span", {}, meaning("a-path", "proven"), ` clear of everything (${metres(proof.required)} asked)`),
          proof.nearest ? h("button", { type: "button", class: "link", onclick: () => this.app.lookAtPlace(proof.at, proof.distance) }, `tightest at ${proof.nearest}`) : null)),
      plan.drivability ? this.drives(plan.drivability) : null,
      h("dl", { class: "figures" },
        ...row("Length", metres(plan.length, 1)), ...row("Duration", seconds(plan.duration)),
        ...row("Sharpest", bend(plan.curvature)), ...(this.app.store.robot !== null ? [] : row("Planned in", plan.ms < 1000 ? `${plan.ms.toFixed(1)} ms` : seconds(plan.ms / 1000)))),
      this.app.store.robot === null ? h("button", { type: "button", class: "link", onclick: () => this.app.compare.open() }, "Compare variants …") : null,
      ...heightRows(plan),
      ...timingRows(this.app, plan),
      ...this.groups(),
    ];
  }

  /** How the path drives: a chip, which opens into the reasons where it doesn't drive well. @param {any} drive */
  drives(drive) {
    const { app } = this;
    const link = (/** @type {string} */ text, /** @type {number[]|null} */ at, /** @type {number|null} */ distance) =>
      at ? h("button", { type: "button", class: "link", onclick: () => app.lookAtPlace(at, distance) }, text) : h("span", {}, text);
    const across = `at most ${number(drive.max_lateral_accel_mps2)} m/s² across the path`;
    if (drive.verdict === "good") {
      return h("div", { class: "drives is-good", title: across }, icon("check", 14), meaning("how-it-drives", "drives well"),
        drive.sharpest_at ? link("sharpest place", drive.sharpest_at, drive.sharpest_distance_m) : null);
    }
    const { reasons } = drive;
    const count = reasons.length > 1 ? ` · ${reasons.length} reasons` : "";
    return h("details", {
      class: "drives is-rough", open: this.isOpen, title: reasons.slice(0, 6).map((/** @type {any} */ r) => r.text).join("\n"),
      ontoggle: (/** @type {Event} */ event) => { this.isOpen = /** @type {HTMLDetailsElement} */ (event.target).open; },
    },
    h("summary", {}, icon("warn", 14), h("span", {}, `drives roughly${count}`)),
    h("ul", {}, ...reasons.slice(0, 12).map((/** @type {any} */ r) => h("li", {}, link(sentence(r.text), r.at, r.distance_m)))),
    h("p", { class: "hint" }, meaning("how-it-drives", "How this is judged")),
    reasons.length > 12 ? h("p", { class: "hint" }, `and ${reasons.length - 12} more in plan.json`) : null);
  }

  groups() {
    const { store } = this.app;
    if (!store.ledger.length) return [];
    const shown = store.ledger.slice(0, 12);
    const more = store.ledger.length - shown.length;
    return [
      h("h3", {}, store.curve?.isSpatial ? "Ways past" : "Either side"),
      store.plan?.space?.is_whole === false ? h("p", { class: "hint" }, "The other ways are weighed once nothing changes any more.") : null,
      h("ul", { class: "groups" }, ...shown.map((/** @type {any} */ entry) => this.group(entry))),
      more > 0 ? h("p", { class: "hint" }, `and ${more} more groups`) : null,
    ];
  }

  /** @param {any} entry */
  group(entry) {
    const { store, app } = { store: this.app.store, app: this.app };
    const name = entry.members.length > 2 ? `${entry.members[0]} and ${entry.members.length - 1} more` : entry.members.join(" and ");
    const { forced } = entry; // of the plan that is shown: what is being edited may ask for another
    const side = (/** @type {string} */ which) => {
      const candidate = entry.candidates.find((/** @type {any} */ c) => c.side === which);
      const text = candidate?.length ? `${metres(candidate.length, 1)}, ${seconds(candidate.duration)}` : forced && forced !== which ? "forbidden" : candidate?.impossible ? "blocked" : "–";
      const how = ["over", "under", "straight", "through"].includes(which) ? which : `on the ${which}`;
      return h("button", {
        type: "button", class: "side", "aria-pressed": String(!!candidate?.chosen), disabled: !entry.forceable || which === "straight",
        "aria-label": `pass ${name} ${how}, ${text}`, title: candidate?.impossible ?? candidate?.passedOver ?? `pass ${how}`,
        onclick: () => {
          store.edit(forceSide(store.doc, entry.items, which));
          app.say(`${name}: passed ${how}`);
        },
      }, h("span", { class: "side-name" }, which), h("span", {}, text));
    };
    const tried = entry.candidates.map((/** @type {any} */ c) => c.side);
    const sides = store.curve?.isSpatial ? tried : ["left", "right", ...tried.filter((/** @type {string} */ one) => one === "through")];
    return h("li", { class: "group" },
      h("div", { class: "group-name" }, h("span", { title: name }, name),
        forced ? h("button", { type: "button", class: "link", onclick: () => store.edit(forceSide(store.doc, entry.items, null)) }, `forced ${forced} · free it`) : null),
      h("div", { class: "sides" }, ...sides.map(side)));
  }

  /** @param {any} plan */
  bad(plan) {
    const { store, fleet } = this.app;
    const shown = plan.problems.slice(0, 6);
    return [
      h("div", { class: "problem-head" }, icon("warn", 18), h("span", {}, plan.gave_up ? "Not known whether there is a path" : plan.problems.length > 1 ? `No path: ${plan.problems.length} faults` : "No path")),
      ...shown.map((/** @type {any} */ problem) => {
        const id = idAt(problem.path);
        const key = problem.path.length ? this.nameOf(problem.path, problem.robot) : null;
        return h("div", { class: "problem" },
          key ? h("button", { type: "button", class: "link problem-key", onclick: () => { fleet.choose(problem.robot); if (id) store.select(id); } }, key) : null,
          h("p", {}, sentence(problem.text)),
          h("div", { class: "remedies" }, ...this.remedies(problem)),
          problem.changes.length ? null : h("p", { class: "hint" }, sentence(problem.remedy)));
      }),
      plan.problems.length > shown.length ? h("p", { class: "hint" }, `and ${plan.problems.length - shown.length} more`) : null,
    ];
  }

  /** @param {any} problem */
  remedies(problem) {
    const { store, app } = { store: this.app.store, app: this.app };
    return problem.changes.map((/** @type {any} */ change) => {
      const label = this.changeLabel(change);
      return h("button", {
        type: "button", class: "button is-remedy",
        onclick: () => {
          app.fleet.choose(problem.robot);
          let { path } = change;
          const isAt = path.at(-1) === "at";
          if (isAt && Array.isArray(part(store.doc, path.slice(0, -1)))) path = path.slice(0, -1); // the short form [x, y]
          store.edit(replaced(store.doc, path, change.value ?? undefined));
          app.say(label);
        },
      }, label);
    });
  }

  /** @param {{path: (string|number)[], value: any, robot?: number|null}} change */
  changeLabel({ path, value, robot }) {
    const last = path.at(-1);
    if (last === "at") return `Move ${this.nameOf(path, robot)} to ${place(value)}`;
    if (last === "agl_m") return `Set the height of ${this.nameOf(path.slice(0, -1), robot)} to ${number(value)} m above ground`;
    if (last === "clearance_m") return `Set the clearance to ${number(value)} m`;
    if (last === "pass_on" || last === "never_pass_on") return `Let ${this.nameOf(path)} be passed on either side`;
    return `Set ${path.join(".")} to ${value}`;
  }

  /** @param {(string|number)[]} path @param {number|null} [robot] of a fleet, whose it is */
  nameOf(path, robot = null) {
    const { file, doc: chosen, missions } = this.app.store;
    if (robot !== null) return `${robotName(file, robot)}: ${this.nameIn(missionOf(file, robot, missions), path)}`;
    return this.nameIn(chosen, path);
  }

  /** @param {any} doc @param {(string|number)[]} path */
  nameIn(doc, path) {
    const id = idAt(path);
    const point = pointsOf(doc).find((p) => p.id === id) ?? obstaclesOf(doc).find((o) => id?.startsWith(o.id));
    return point?.name ?? path.reduce((/** @type {string} */ text, step) => (typeof step === "number" ? `${text}[${step}]` : text ? `${text}.${step}` : String(step)), "");
  }
}
