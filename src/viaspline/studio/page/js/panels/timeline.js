/**
 * The line of time: of the plan, or of a drive while one is played. Play, pause, step, scrub, how
 * fast; every event is a mark on it.
 */

import { FleetRun } from "../core/fleet_run.js";
import { PLAY_FACTORS } from "../replay.js";
import { clock, down, metres, seconds } from "../units.js";
import { fill, h, icon, lazily } from "./dom.js";
import { meaning } from "./meaning.js";

/** Each kind of event has a sign of its own, so that colour is not all. */
const EVENT_SIGNS = {
  started: ["▶", "is-plain"], detected: ["◉", "is-seen"], replanned: ["↝", "is-replan"], via: ["•", "is-plain"],
  arrived: ["■", "is-stop"], dwell: ["□", "is-stop"], skipped: ["✕", "is-bad"], braked: ["▼", "is-seen"],
  stopped: ["■", "is-bad"], reached: ["⚑", "is-good"], contact: ["✕", "is-bad"], waits: ["▼", "is-seen"],
  tightest: ["△", "is-seen"], "goes on": ["▶", "is-plain"], swapped: ["⇄", "is-replan"],
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
    this.marksSoon = lazily(() => this.drawMarks(), 150);
    fill(this.factor, ...PLAY_FACTORS.map((f) => h("option", { value: String(f), selected: f === app.drive.factor }, `${f}×`)));
    this.factor.addEventListener("change", () => { app.drive.factor = Number(this.factor.value); });
    this.watch = find("#watch");
    this.button.addEventListener("click", () => (app.drive.run ? this.toggle() : this.drive()));
    this.watch.addEventListener("click", () => this.toggle());
    this.scrub.addEventListener("input", () => {
      const time = Number(this.scrub.value); // a pause draws the line of time anew
      this.played.pause();
      this.played.seek(time);
    });
    this.scrub.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!way) return;
      this.nudge(way, event.shiftKey);
      event.preventDefault();
    });
    find("#step-back").addEventListener("click", () => this.played.step(-1));
    find("#step-on").addEventListener("click", () => this.played.step(1));
    find("#leave-drive").addEventListener("click", () => this.leave());
    app.drive.on(() => this.render());
    app.preview.on(() => this.render());
    app.store.on("run plan file status", () => this.render());
    app.store.on("robot", () => { if (app.drive.run?.fleet) this.marksSoon(); });
    this.shown = null;
    this.lastEvent = null;
    this.render();
  }

  /** What is played: the drive, or the plan. */
  get played() {
    const { drive, preview } = this.app;
    return drive.run ? drive : preview;
  }

  toggle() {
    if (this.played.isPlaying) this.played.pause();
    else this.played.play();
  }

  /** A little later or earlier. @param {number} way 1 or -1 @param {boolean} far */
  nudge(way, far) {
    const { played } = this;
    const step = (played.end - played.begin) / (far ? 20 : 200);
    played.pause();
    played.seek(played.time + way * step);
    this.app.say(seconds(played.time));
  }

  /** Drive the mission as it is now, then play it. */
  async drive() {
    const { store, link, drive, toast } = this.app;
    if (this.isAsked) {
      link.send({ type: "halt" });
      return;
    }
    if (!this.canDrive) {
      toast("There is no path to drive yet.");
      return;
    }
    this.isAsked = true;
    this.app.preview.pause();
    this.progress(0);
    this.app.say("driving");
    try {
      await this.app.settled();
      const { file, fleetPlan } = store;
      const answer = await link.ask({ type: "drive", seed: 0 });
      if (answer.type === "driven" && file === store.file) {
        store.run = fleetPlan ? { ...answer, fleet: new FleetRun(answer, fleetPlan) } : answer;
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

  /** Whether there is a plan: of a fleet, of any of its robots. */
  get canDrive() {
    const { store } = this.app;
    return store.fleetPlan ? store.fleetPlan.answer?.ok && store.fleetPlan.driving.length > 0 : store.plan?.ok;
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
    const { drive, store, preview } = this.app;
    const { run } = drive;
    this.panel.classList.toggle("is-driving", !!run);
    document.body.classList.toggle("is-driving", !!run);
    this.panel.classList.toggle("is-late", !run && store.isLate); // its times are of an older document
    const verb = this.isAsked ? "Stop" : run ? (drive.isPlaying ? "Pause" : "Play") : "Drive";
    this.dress(this.button, verb, icon(verb === "Pause" ? "pause" : verb === "Stop" ? "stop" : "play", 16), verb);
    const canPlay = this.played.end > this.played.begin;
    this.button.disabled = !run && !this.isAsked && !this.canDrive;
    const watch = preview.isPlaying ? "Pause the plan" : "Play the plan";
    this.dress(this.watch, watch, icon(preview.isPlaying ? "pause" : "watch"));
    this.watch.setAttribute("aria-label", watch);
    this.watch.title = `${watch} (W)`;
    this.watch.disabled = this.scrub.disabled = !canPlay;
    const shown = run ?? store.fleetPlan?.answer ?? store.goodPlan;
    if (shown !== this.shown) {
      this.shown = shown;
      this.scrub.min = String(this.played.begin);
      this.scrub.max = String(canPlay ? this.played.end : this.played.begin + 1);
      if (run) this.drawMarks();
      else this.marksSoon(); // plans come as fast as something is dragged
      this.lastEvent = null;
    }
    if (!run) this.renderPlan();
    else this.renderDrive();
    for (const mark of this.marks.children) mark.classList.toggle("is-past", Number(mark.dataset.time) <= this.played.time);
  }

  /** @param {HTMLElement} button @param {string} verb what it does now @param {...(Node|string)} children */
  dress(button, verb, ...children) {
    if (button.dataset.verb === verb) return;
    button.dataset.verb = verb;
    fill(button, ...children);
  }

  renderPlan() {
    const { store, preview } = this.app;
    const isMoved = preview.isPlaying || preview.time > preview.begin;
    this.scrub.value = String(preview.time);
    this.scrub.setAttribute("aria-valuetext", seconds(preview.time));
    const speed = store.curve?.speedAt(store.curve.distanceAt(preview.time)) ?? 0;
    this.clock.textContent = !store.plan?.ok ? "–" : isMoved ? `${clock(preview.time)} · ${speed.toFixed(2)} m/s` : seconds(store.plan.duration);
    if (this.isAsked) return;
    const last = preview.moments().filter((/** @type {{time: number}} */ { time }) => time <= preview.time + 1e-6).at(-1);
    this.note.textContent = isMoved && last ? `${clock(last.time)} ${last.text}` : store.robot === null ? "Drive the mission in simulation, with what is not on the map." : "Drive all robots in simulation, or play them as they are planned.";
  }

  renderDrive() {
    const { drive } = this.app;
    const { run } = drive;
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
      if (run.fleet) fill(this.note, ...fleetWords(run));
      else this.note.textContent = run.reached
        ? `reached the goal in ${seconds(run.duration)}, ${metres(run.distance, 1)}, ${nearness(run)} · ${run.replans.length} re-plan${run.replans.length === 1 ? "" : "s"}`
        : `did not reach the goal: ${run.reason}`;
    }
  }

  /** What happens on the line of time; of a fleet that drives, to the robot that is chosen. @returns {{time: number, kind: string, words: string}[]} */
  events() {
    const { drive, preview } = this.app;
    if (!drive.run) return preview.moments().map((/** @type {any} */ moment) => ({ time: moment.time, kind: moment.kind, words: moment.text }));
    return drive.moments().map((/** @type {any} */ event) => ({ time: event.time, kind: event.kind, words: event.message }));
  }

  drawMarks() {
    const { played } = this;
    const lasts = played.end - played.begin || 1;
    const wide = this.marks.clientWidth || 400;
    let free = -Infinity; // events at the same time stand side by side
    fill(this.marks, ...this.events().map((event) => {
      const [sign, kind] = /** @type {any} */ (EVENT_SIGNS)[event.kind] ?? ["•", "is-plain"];
      const mark = h("button", { type: "button", class: `mark ${kind}`, tabindex: "-1", title: `${clock(event.time)} ${event.words}`, "aria-label": `${clock(event.time)} ${event.words}`, "data-time": event.time, onclick: () => { this.played.pause(); this.played.seek(event.time); } }, sign);
      const left = Math.max((wide * (event.time - played.begin)) / lasts, free);
      free = left + 15;
      mark.style.left = `${(100 * left) / wide}%`;
      return mark;
    }));
  }
}

/** How near a robot came to anything, or what touched it. @param {any} run */
function nearness(run) {
  if (run.touched) return run.touched;
  return run.clearance === null ? "with nothing near" : `never closer than ${metres(run.clearance)}`;
}

/** What came of the drive of a fleet. @param {any} run @returns {(Node|string)[]} */
function fleetWords(run) {
  const late = `${seconds(Math.abs(run.mean_delay))} ${run.mean_delay < 0 ? "sooner" : "later"} than planned in the mean`;
  const apart = run.clearance === null ? [] : [", ", meaning("fleets-and-space", "proven"), ` ${down(run.clearance)} apart`];
  return [`${run.reached ? "all" : run.arrived} arrived in ${seconds(run.duration)}, ${late}`, ...apart, run.reason ? `: ${run.reason}` : ""];
}
