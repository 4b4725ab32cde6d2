/** What has been proven of a fleet: how far apart its robots stay, where and when; who waits; who isn't served. */

import { isFleet, membersOf, robotName } from "../core/fleet.js";
import { fill, h, lazily, sentence } from "../panels/dom.js";
import { clock, down, metres, seconds } from "../units.js";
import { meaning } from "../panels/meaning.js";

const MOST_SHOWN = 8; // robots that aren't served, and waits, one by one

export class FleetProof {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.panel = /** @type {HTMLElement} */ (document.querySelector("#fleet-proof"));
    app.store.on("plan robot status", lazily(() => this.render(), 80));
    app.store.on("file", () => this.render());
  }

  render() {
    const { store } = this.app;
    const plan = store.fleetPlan;
    this.panel.classList.toggle("is-late", store.isLate);
    if (!isFleet(store.file)) return;
    if (!plan?.answer) {
      fill(this.panel, h("p", { class: "hint" }, "What is proven is said here once it is planned."));
      return;
    }
    fill(this.panel, ...(plan.certificate ? [...(plan.driving.length ? this.separation(plan.certificate) : []), ...this.figures(plan)] : []), ...this.missing(plan), ...this.waits(plan));
  }

  /** @param {any} proof */
  separation(proof) {
    const words = proof.pair ? h("span", {}, meaning("fleets-and-space", "proven"), ` apart at all times (${metres(proof.required)} asked)`) : "there is nobody to keep apart from";
    const look = () => this.lookAt(proof.at_s, proof.at[0]);
    return [h("div", { class: `proof${proof.holds ? "" : " is-bad"}` },
      h("span", { class: "proof-figure" }, proof.separation === null ? "–" : down(proof.separation)),
      h("span", { class: "proof-words" }, proof.holds ? words : `too near: ${metres(proof.required)} asked`,
        proof.pair && proof.at ? h("button", { type: "button", class: "link", onclick: look }, `${proof.pair[0]} and ${proof.pair[1]}${proof.at_s === null ? "" : ` at ${clock(proof.at_s)}`}`) : null))];
  }

  /** @param {import("../core/fleet_plan.js").FleetPlan} plan */
  figures(plan) {
    const { driving, byName, answer } = plan;
    const late = driving.reduce((sum, { law, alone }) => sum + Math.max(0, law.times.at(-1) - law.times[0] - alone), 0);
    const row = (/** @type {string} */ name, /** @type {string} */ value) => [h("dt", {}, name), h("dd", {}, value)];
    return [h("dl", { class: "figures" },
      ...row("Served", `${driving.length} of ${byName.size}`), ...row("All home", clock(plan.lasts[1])),
      ...row("Late", seconds(late)), ...row("Planned in", answer.ms < 1000 ? `${answer.ms.toFixed(1)} ms` : seconds(answer.ms / 1000)))];
  }

  /** Who isn't served, and why. @param {import("../core/fleet_plan.js").FleetPlan} plan */
  missing(plan) {
    const { missing } = plan;
    if (!missing.length) return [];
    const soon = plan.isWhole ? [] : [h("p", { class: "hint" }, "Other ways are being tried.")];
    return [h("h3", {}, plan.isWhole ? "Not served" : "Not served yet"), ...soon].concat(missing.slice(0, MOST_SHOWN).map((robot) => h("div", { class: "problem" },
      this.named(robot.name, "link problem-key"), ` ${robot.missing?.outcome}`,
      h("p", {}, sentence(robot.missing?.reason ?? "")), h("p", { class: "hint" }, sentence(robot.missing?.remedy ?? "")))))
      .concat(missing.length > MOST_SHOWN ? [h("p", { class: "hint" }, `and ${missing.length - MOST_SHOWN} more`)] : []);
  }

  /** Who waits for whom: those of the robot that is chosen first. @param {import("../core/fleet_plan.js").FleetPlan} plan */
  waits(plan) {
    const { store } = this.app;
    const chosen = robotName(store.file, store.robot);
    const concerns = (/** @type {any} */ wait) => (wait.robot === chosen || wait.waits_for === chosen ? 1 : 0);
    const waits = [...plan.waits].sort((a, b) => concerns(b) - concerns(a) || b.seconds - a.seconds);
    if (!waits.length) return plan.driving.length > 1 ? [h("p", { class: "hint" }, "Nobody has to wait.")] : [];
    return [h("h3", {}, "Waits"),
      h("ul", { class: "moments" }, ...waits.slice(0, MOST_SHOWN).map((wait) => h("li", {},
        this.named(wait.robot, "link"), ` waits ${wait.seconds.toFixed(1)} s for `, this.named(wait.waits_for, "link"), " ",
        h("button", { type: "button", class: "link", onclick: () => this.seek(wait.until - wait.seconds / 2) }, `at ${clock(Math.max(0, wait.from))}`)))),
      waits.length > MOST_SHOWN ? h("p", { class: "hint" }, `and ${waits.length - MOST_SHOWN} more`) : null];
  }

  /** A robot's name, which chooses it. @param {string} name @param {string} kind */
  named(name, kind) {
    const { store } = this.app;
    const robot = membersOf(store.file).findIndex((_, i) => robotName(store.file, i) === name);
    return h("button", { type: "button", class: kind, onclick: () => this.app.fleet.choose(robot < 0 ? null : robot) }, name);
  }

  /** @param {number} time [s] */
  seek(time) {
    this.app.preview.pause();
    this.app.preview.seek(time);
  }

  /** @param {number|null} time [s] @param {number[]} at */
  lookAt(time, at) {
    if (time !== null) this.seek(time);
    this.app.lookAtPlace(at, null);
  }
}
