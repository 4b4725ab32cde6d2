/** Drive: play, pause, step, scrub, how fast; every event is a mark on the line of time. */

import { PLAY_FACTORS } from "../replay.js";
import { clock, metres, seconds } from "../units.js";
import { fill, h, icon } from "./dom.js";

/** Each kind of event has a sign of its own, so that colour is not all. */
const EVENT_SIGNS = {
  started: ["▶", "is-plain"], detected: ["◉", "is-seen"], replanned: ["↝", "is-replan"], via: ["•", "is-plain"],
  arrived: ["■", "is-stop"], dwell: ["□", "is-stop"], skipped: ["✕", "is-bad"], braked: ["▼", "is-seen"],
  stopped: ["■", "is-bad"], reached: ["⚑", "is-good"], contact: ["✕", "is-bad"],
};

export class Timeline {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    const find = (/** @type {string} */ id) => /** @type {any} */ (document.querySelector(id));
    this.panel = find("#timeline");
    this.button = find("#play");
    this.scrub = find("#scrub");
    this.marks = find("#marks");
    this.clock = find("#clock");
    this.note = find("#drive-note");
    this.factor = find("#factor");
    this.isAsked = false;
    fill(this.factor, ...PLAY_FACTORS.map((f) => h("option", { value: String(f), selected: f === app.drive.factor }, `${f}×`)));
    this.factor.addEventListener("change", () => { app.drive.factor = Number(this.factor.value); });
    this.button.addEventListener("click", () => (app.drive.run ? (app.drive.isPlaying ? app.drive.pause() : app.drive.play()) : this.drive()));
    this.scrub.addEventListener("input", () => {
      app.drive.pause();
      app.drive.seek(Number(this.scrub.value));
    });
    find("#step-back").addEventListener("click", () => app.drive.step(-1));
    find("#step-on").addEventListener("click", () => app.drive.step(1));
    find("#leave-drive").addEventListener("click", () => this.leave());
    app.drive.on(() => this.render());
    app.store.on("run plan", () => this.render());
    this.shown = null;
    this.lastEvent = null;
    this.render();
  }

  /** Drive the mission as it is now, then play it. */
  async drive() {
    const { store, link, drive, toast } = this.app;
    if (this.isAsked) {
      link.send({ type: "halt" });
      return;
    }
    if (!store.plan?.ok) {
      toast("There is no path to drive yet.");
      return;
    }
    this.isAsked = true;
    this.progress(0);
    this.app.say("driving");
    try {
      await this.app.settled();
      const doc = store.doc;
      const answer = await link.ask({ type: "drive", seed: 0 });
      if (answer.type === "driven" && doc === store.doc) {
        store.run = answer;
        store.select(null);
        store.lookAt(null);
        store.tell("run");
        drive.factor = this.fitting(answer.duration);
        this.factor.value = String(drive.factor);
        drive.play();
      }
    } catch (error) {
      toast(/** @type {Error} */ (error).message);
    } finally {
      this.isAsked = false;
      this.app.summary.busy = ""; // what a first drive compiles is compiled
      store.tell("status");
      this.render();
    }
  }

  /** A factor with which a drive takes about half a minute. @param {number} duration */
  fitting(duration) {
    return PLAY_FACTORS.reduce((best, f) => (Math.abs(duration / f - 30) < Math.abs(duration / best - 30) ? f : best));
  }

  leave() {
    this.app.store.run = null;
    this.app.store.tell("run");
  }

  /** @param {number} done from 0 to 1 */
  progress(done) {
    if (this.isAsked) this.note.textContent = `simulating … ${Math.round(100 * done)} %`;
  }

  render() {
    const { drive, store } = this.app;
    const { run } = drive;
    this.panel.classList.toggle("is-driving", !!run);
    document.body.classList.toggle("is-driving", !!run);
    const verb = this.isAsked ? "Stop" : run ? (drive.isPlaying ? "Pause" : "Play") : "Drive";
    if (this.button.dataset.verb !== verb) {
      this.button.dataset.verb = verb;
      fill(this.button, icon(verb === "Pause" ? "pause" : verb === "Stop" ? "stop" : "play", 16), verb);
    }
    this.button.disabled = !run && !this.isAsked && !store.plan?.ok;
    this.scrub.disabled = !run;
    if (run !== this.shown) {
      this.shown = run;
      this.scrub.max = String(run?.duration ?? 1);
      this.drawMarks();
      this.lastEvent = null;
    }
    if (!run) {
      this.clock.textContent = store.plan?.ok ? seconds(store.plan.duration) : "–";
      this.scrub.value = "0";
      if (!this.isAsked) this.note.textContent = "Drive the mission in simulation, with what is not on the map.";
      return;
    }
    this.scrub.value = String(drive.time);
    this.scrub.setAttribute("aria-valuetext", clock(drive.time));
    const state = drive.state();
    this.clock.textContent = `${clock(drive.time)} · ${state.speed.toFixed(2)} m/s`;
    const event = drive.events().at(-1);
    const stay = drive.stay();
    this.note.textContent = stay ? `${event?.message ?? ""}: ${stay.left.toFixed(0)} s left` : event ? `${clock(event.time)} ${event.message}` : "";
    if (event !== this.lastEvent) {
      this.lastEvent = event;
      if (event) this.app.say(event.message);
    }
    if (drive.time >= run.duration && !drive.isPlaying) {
      this.note.textContent = run.reached
        ? `reached the goal in ${seconds(run.duration)}, ${metres(run.distance, 1)}, never closer than ${metres(run.clearance)} · ${run.replans.length} re-plan${run.replans.length === 1 ? "" : "s"}`
        : `did not reach the goal: ${run.reason}`;
    }
    for (const mark of this.marks.children) mark.classList.toggle("is-past", Number(mark.dataset.time) <= drive.time);
  }

  drawMarks() {
    const { drive } = this.app;
    const { run } = drive;
    const wide = this.marks.clientWidth || 400;
    let free = -Infinity; // events at the same time stand side by side
    fill(this.marks, ...(run?.events ?? []).map((/** @type {any} */ event) => {
      const [sign, kind] = /** @type {any} */ (EVENT_SIGNS)[event.kind] ?? ["•", "is-plain"];
      const mark = h("button", { type: "button", class: `mark ${kind}`, tabindex: "-1", title: `${clock(event.time)} ${event.message}`, "aria-label": `${clock(event.time)} ${event.message}`, "data-time": event.time, onclick: () => { drive.pause(); drive.seek(event.time); } }, sign);
      const left = Math.max((wide * event.time) / run.duration, free);
      free = left + 15;
      mark.style.left = `${(100 * left) / wide}%`;
      return mark;
    }));
  }
}
