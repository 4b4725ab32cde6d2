/** Puts the page together: state, connection, map, panels. */

import { replaced, toggleUnseen } from "./core/edits.js";
import { Compare } from "./compare/compare.js";
import { Link } from "./core/link.js";
import { areasOf, exists, isObstacle, obstaclesOf, pointsOf, refOf, shapedAt, whole } from "./core/mission.js";
import { Store } from "./core/store.js";
import { Preview } from "./preview.js";
import { EarlyPath } from "./early_path.js";
import { Drive } from "./replay.js";
import { onTheme } from "./draw/theme.js";
import { Scene } from "./draw/scene.js";
import { Files } from "./files/files.js";
import { Fleet } from "./fleet/fleet.js";
import { Background } from "./geo/background.js";
import { Earth } from "./geo/earth.js";
import { GroundPanel } from "./geo/ground_panel.js";
import { keepSaving, kept } from "./files/autosave.js";
import { unpacked } from "./files/share.js";
import { boxAll, boxOfInterest } from "./files/svg.js";
import { Camera } from "./geometry/camera.js";
import { Curve } from "./geometry/curve.js";
import { SpatialCurve } from "./geometry/spatial_curve.js";
import { listenToKeys } from "./input/keyboard.js";
import { Pointer } from "./input/pointer.js";
import { Measure } from "./measure/measure.js";
import { ContextMenu } from "./menu/context_menu.js";
import { Inspector } from "./panels/inspector.js";
import { Lists } from "./panels/lists.js";
import { Plots } from "./panels/plots.js";
import { SpaceTimePanel } from "./panels/space_time.js";
import { Settings } from "./panels/settings.js";
import { Summary } from "./panels/summary.js";
import { Timeline } from "./panels/timeline.js";
import { listenToBars } from "./panels/bars.js";
import { listenToEdges } from "./panels/edges.js";
import { h, isUpToDate } from "./panels/dom.js";
import { Clipboard } from "./select/clipboard.js";
import { Selecting } from "./select/selecting.js";
import { Snap } from "./snap/snap.js";
import { Space } from "./space/space.js";

/** @type {any} */
const app = {};
/** @type {any} */ (window).studio = app; // for tests, benchmarks and the curious

app.store = new Store();
app.camera = new Camera();
app.drive = new Drive(app.store);
app.preview = new Preview(app.store);
app.scene = new Scene(/** @type {HTMLCanvasElement} */ (document.querySelector("#map")), app.store, app.camera, app.drive, app.preview);
app.early = app.scene.early = new EarlyPath(app.store);
/** How long each drag took from the hand to the screen [ms]. @type {number[]} */ app.latencies = [];
app.ready = false;

// --- what is said

const LATE_MS = 400;

const live = /** @type {HTMLElement} */ (document.querySelector("#live"));
/** Tell a screen reader. @param {string} text */
app.say = (text) => { live.textContent = text; };

/** A passing note. @param {string} text @param {string} [kind] @param {{label: string, act: () => void}} [button] */
app.toast = (text, kind = "", button = undefined) => {
  const box = /** @type {HTMLElement} */ (document.querySelector("#toasts"));
  const note = h("div", { class: `toast ${kind}`, role: kind === "is-bad" ? "alert" : "status" }, h("span", {}, text));
  if (button) note.append(h("button", { type: "button", class: "link", onclick: () => { note.remove(); button.act(); } }, button.label));
  box.replaceChildren(note);
  setTimeout(() => note.remove(), button ? 15000 : 5000);
};

/** @param {string} id */
app.describe = (id) => {
  const { doc } = app.store;
  const point = pointsOf(doc).find((p) => p.id === id);
  if (point) return `${point.name} at ${app.earth.words(point.at)}`;
  const one = [...obstaclesOf(doc), ...areasOf(doc)].find((o) => o.id === whole(id));
  const ref = refOf(id);
  const corner = ref && ref.vertex >= 0 ? `, ${shapedAt(doc, id)?.shape.vertexName} ${ref.vertex + 1}` : "";
  return `${one?.name ?? id}${corner}${id.startsWith("unseen") ? ", unseen" : ""}${id.startsWith("zone") ? ", speed zone" : ""}`;
};

// --- the connection

app.link = new Link(hear);

/** @param {any} message */
function hear(message) {
  const { store, summary } = app;
  if (message.type === "hello") greet(message);
  else if (message.type === "planned") planned(message);
  else if (message.type === "provisional") early(message);
  else if (message.type === "variant") app.compare.take(message);
  else if (message.type === "ledger") {
    if (message.rev === store.plan?.rev) putLedger(message.entries);
  } else if (message.type === "space_time") {
    if (message.rev === store.plan?.rev) putSpaceTime(message);
  } else if (message.type === "profile") {
    if (message.rev === store.plan?.rev) app.space.putProfile(message);
  } else if (message.type === "compiling") {
    summary.busy = message.done ? "" : `compiling the planner, once on this machine: ${message.count} parts so far`;
    store.tell("status");
  } else if (message.type === "background") app.background.take(message.background);
  else if (message.type === "driving") app.timeline.progress(message.done);
  else if (message.type === "closed") {
    summary.busy = "the studio has gone; waiting for it";
    store.tell("status");
  } else if (message.type === "refused") app.toast(message.message, "is-bad");
}

let greeted = false;

/** @param {any} hello */
async function greet(hello) {
  const { store } = app;
  app.summary.busy = "";
  app.empty = hello.empty;
  app.drives = hello.drives;
  store.tell("status");
  if (greeted) { // the studio came back: go on with what is here
    app.link.plan(store.file, store.revision, store.inputAt);
    return;
  }
  greeted = true;
  store.folder = hello.folder;
  const scene = location.hash.startsWith("#m=") ? await unpacked(location.hash.slice(3)) : null;
  store.open(hello.document, hello.name);
  store.origin = hello.origin;
  if (scene) {
    if (JSON.stringify(scene.doc) !== JSON.stringify(store.file)) store.editFile(scene.doc);
    app.toast("The scene of this address is open.");
  } else restore();
  app.fitSoon();
  app.scene.drawn.push(() => performance.mark("studio-open")); // can be laid out, not yet planned
  app.scene.later();
  if (hello.problem) app.toast(hello.problem, "is-bad");
  else if (hello.warnings.length) app.toast(hello.warnings.join("; "));
}

/** Bring back what wasn't saved. */
function restore() {
  const { store } = app;
  const found = kept(store.folder, store.name, store.file);
  if (!found) return;
  const { file } = store;
  store.editFile(found.doc);
  const text = found.isOfOtherFile ? "Unsaved changes are back; the file has changed since." : "Your unsaved changes are back.";
  app.toast(text, "", { label: "Drop them", act: () => store.editFile(file) });
}

/** @param {any} answer */
function planned(answer) {
  const { store } = app;
  app.summary.busy = "";
  if (answer.fleet !== undefined) app.fleet.take(answer);
  else {
    store.plan = answer;
    if (answer.ok) {
      store.goodPlan = answer;
      store.curve = answer.space ? new SpatialCurve(answer) : new Curve(answer);
      if (answer.ledger) putLedger(answer.ledger);
    }
  }
  if (answer.rev === store.revision) store.isLate = false;
  if (answer.ok && store.cursor !== null && store.cursor > (store.curve?.length ?? 0)) store.lookAt(null);
  if (app.fitWhenPlanned) {
    app.fitWhenPlanned = false;
    app.fit();
  }
  measured(answer.inputAt);
  if (!app.ready) {
    app.scene.drawn.push(() => {
      app.ready = true;
      performance.mark("studio-ready");
      document.body.dataset.ready = "yes";
    });
  }
  app.scene.now();
  store.tell("plan");
}

/** A path that isn't proven, while its plan is made: what is drawn besides is of an older document. @param {any} message */
function early(message) {
  app.early.take(message);
  if (!app.early.shown) return;
  app.store.isLate = true;
  app.summary.busy = app.early.words;
  measured(message.inputAt);
  app.scene.now();
  app.store.tell("status");
}

/** Note how long it took from the hand to the screen. @param {number|undefined} inputAt [ms] */
function measured(inputAt) {
  if (inputAt === undefined) return;
  app.scene.drawn.push((/** @type {number} */ now) => {
    app.latencies.push(now - inputAt);
    if (app.latencies.length > 5000) app.latencies.shift();
  });
}

/** @param {any[]} entries */
function putLedger(entries) {
  app.store.ledger = entries;
  app.scene.afterwards();
  app.store.tell("ledger");
}

/** @param {any} message */
function putSpaceTime(message) {
  app.store.spaceTime = message;
  app.store.tell("space-time");
}

/** Wait until the server has planned what is on the screen. @returns {Promise<void>} */
app.settled = async () => {
  const { store } = app;
  for (let i = 0; store.plan?.rev !== store.revision; i += 1) {
    if (i > 3000) throw new Error("the studio doesn't answer");
    await new Promise((resolve) => setTimeout(resolve, 10));
  }
};

/** Whether map and panels show what is known; of what is still asked of the server they can't. */
app.isUpToDate = () => isUpToDate() && app.scene.isUpToDate;

// --- files

/** @param {any} answer */
app.opened = (answer) => {
  app.link.sent = answer.document; // the server has it already
  app.store.open(answer.document, answer.name);
  app.store.origin = answer.origin;
  history.replaceState(null, "", location.pathname + location.search);
  restore();
  app.fitSoon();
  if (answer.warnings.length) app.toast(answer.warnings.join("; "));
};

/** @param {any} answer @param {any} file what it held when it was sent */
app.saved = (answer, file) => {
  const { store } = app;
  if (JSON.stringify(answer.document) !== JSON.stringify(file) && store.file === file) {
    app.link.sent = file = answer.document; // maps have other names from another folder
    store.put(file);
  }
  store.name = answer.name;
  store.savedFile = file;
  store.tell("file");
};

// --- deeds that several places ask for

app.undo = () => { app.say(app.store.undo() ? "undone" : "nothing to undo"); };
app.redo = () => { app.say(app.store.redo() ? "redone" : "nothing to redo"); };

app.toggleUnseen = () => {
  const { store } = app;
  if (!isObstacle(store.selection)) return;
  const [doc, id] = toggleUnseen(store.doc, whole(store.selection));
  store.edit(doc, { select: id });
  app.say(id.startsWith("unseen") ? "not on the map: only the sensor finds it" : "on the map");
};

app.fit = () => {
  const box = boxOfInterest(app.store);
  if (!box) return;
  const narrow = document.body.clientWidth <= 760;
  app.space?.solid?.fit();
  app.space?.solid?.later("route");
  app.camera.fit(box, narrow ? { top: app.space?.isOn ? 118 : 70, right: 24, bottom: 40 + app.compare.card.covers, left: 24 } : { top: 62, right: 40, bottom: 48, left: 76 });
  app.fitted = app.camera.view;
  app.store.tell("view");
};
app.fitSoon = () => {
  app.fitWhenPlanned = true;
  app.fit();
};

/** @param {number[]} at @param {number|null} distance */
app.lookAtPlace = (at, distance) => {
  [app.camera.x, app.camera.y] = at;
  app.camera.scale = Math.max(app.camera.scale, 60 / Math.max(0.5, Number(app.store.doc.robot?.radius_m ?? 0.5) * 4));
  app.store.lookAt(distance);
  app.store.tell("view");
};

app.boundAll = () => {
  const box = boxAll(app.store);
  if (!box) return;
  const pad = Math.max(5, 0.1 * Math.max(box[2] - box[0], box[3] - box[1]));
  const bounds = [box[0] - pad, box[1] - pad, box[2] + pad, box[3] + pad].map((v) => Math.round(v));
  app.store.edit(replaced(app.store.doc, ["world", "bounds"], bounds), { select: "bounds:0" });
};

app.help = () => /** @type {HTMLDialogElement} */ (document.querySelector("#help")).showModal();

/** Show a panel on a narrow screen. @param {string} name */
app.openSheet = (name) => {
  document.body.dataset.sheet = name;
  document.querySelectorAll("#tabs button").forEach((tab) => tab.setAttribute("aria-selected", String(tab.getAttribute("data-sheet") === name)));
};

// --- everything together

app.snap = new Snap(app);
app.selecting = new Selecting(app);
app.clipboard = new Clipboard(app);
app.measure = new Measure(app);
app.menu = new ContextMenu(app);
app.fleet = new Fleet(app);
app.space = new Space(app);
app.pointer = new Pointer(app.store, app.camera, app.scene, app.say, app);
app.files = new Files(app);
app.lists = new Lists(app);
app.inspector = new Inspector(app);
app.settings = new Settings(app);
app.earth = new Earth(app);
app.background = app.scene.background = new Background(app);
app.ground = new GroundPanel(app);
app.summary = new Summary(app);
app.plots = new Plots(app);
app.spaceTime = new SpaceTimePanel(app);
app.timeline = new Timeline(app);
app.compare = app.scene.compare = new Compare(app);
listenToKeys(app);
listenToBars(app);
listenToEdges();
keepSaving(app.store);

let asked = -1; // the newest revision that the server was told of
app.store.on("document", () => {
  if (app.store.revision !== asked) app.link.plan(app.store.file, app.store.revision, app.store.inputAt);
  asked = app.store.revision;
  app.scene.soon();
});
let lateness = 0;
app.store.on("document", () => {
  lateness ||= setTimeout(() => { // what is drawn is not proven of what is asked for
    lateness = 0;
    if (!app.ready || app.store.plan?.rev === app.store.revision) return;
    app.store.isLate = true;
    app.summary.busy ||= "planning";
    app.store.tell("status");
    app.scene.later();
  }, LATE_MS);
});
app.store.on("selection view hover run robot", () => app.scene.later());
app.drive.on(() => app.scene.later());
app.preview.on(() => app.scene.later());
onTheme(() => app.scene.later());
app.exists = exists;
new ResizeObserver(() => {
  const first = app.camera.width === 1;
  const isUntouched = app.camera.view === app.fitted;
  app.scene.resize();
  if ((first || isUntouched) && app.store.name !== undefined) app.fit();
}).observe(app.scene.canvas);
