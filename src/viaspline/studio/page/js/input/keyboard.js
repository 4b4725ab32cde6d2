/** Everything by keyboard. What the keys do stands in the help sheet as well. */

import { moveTo, moveVia, remove, setTension } from "../core/edits.js";
import { anchorOf, idsOf, isObstacle, refOf, tensionsOf } from "../core/mission.js";
import { TOOLS, goesByCorners, makes, shapeToolOf } from "./tools.js";

const LAYERS = { g: "grid", s: "snap", j: "points", l: "losers", r: "rings", k: "comb", d: "detours", x: "speed", o: "body" };
const ARROW_STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** @param {any} app */
export function listenToKeys(app) {
  const { scene } = app;
  addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]")) return;
    app.pointer.snap.isPointing = false;
    if (event.key === "ContextMenu" || (event.key === "F10" && event.shiftKey)) {
      if (!(event.target instanceof HTMLInputElement)) {
        app.menu.byKey();
        event.preventDefault();
      }
      return;
    }
    const isTyping = event.target instanceof HTMLElement && event.target.matches("input:not([type=range]):not([type=checkbox]), select, textarea");
    if (event.ctrlKey || event.metaKey) {
      if (command(app, event, isTyping)) event.preventDefault();
      return;
    }
    if (isTyping) {
      if (event.key === "Escape") scene.canvas.focus();
      return;
    }
    const onMap = document.activeElement === scene.canvas || document.activeElement === document.body;
    const onSlider = event.target instanceof HTMLInputElement && event.target.type === "range";
    if (event.altKey && (event.key === "ArrowUp" || event.key === "ArrowDown")) {
      reorder(app, event.key === "ArrowUp" ? -1 : 1);
      event.preventDefault();
      return;
    }
    if (onMap && event.key in ARROW_STEPS) {
      arrow(app, /** @type {number[]} */ (/** @type {any} */ (ARROW_STEPS)[event.key]), event.shiftKey);
      event.preventDefault();
    } else if (onMap && onKey(app, event)) event.preventDefault();
    else if (!event.altKey && single(app, event, onSlider)) event.preventDefault();
  });
}

/** Keys with Ctrl. @param {any} app @param {KeyboardEvent} event @param {boolean} isTyping */
function command(app, event, isTyping) {
  const key = event.key.toLowerCase();
  if (key === "s") app.files.save();
  else if (key === "o") app.files.open();
  else if (key === "e") app.files.export();
  else if (isTyping) return false;
  else if (key === "z") event.shiftKey ? app.redo() : app.undo();
  else if (key === "y") app.redo();
  else if (key === "a") app.selecting.all();
  else if (key === "d") app.clipboard.duplicate();
  else return false;
  return true;
}

/** Keys that mean something on the map only. @param {any} app @param {KeyboardEvent} event */
function onKey(app, event) {
  const { store, scene, pointer } = app;
  if (event.key === "PageUp" || event.key === "PageDown") return !!store.selection && app.space.lift(store.selection, event.key === "PageUp" ? 1 : -1, event.shiftKey);
  if (event.key === "Tab") return document.activeElement === scene.canvas && next(app, event.shiftKey ? -1 : 1);
  if (event.key === "Enter") {
    if (store.tool === "measure" && !scene.cross) app.measure.close();
    else if (scene.draft?.corners && !scene.cross) pointer.drawing.close();
    else if (scene.cross) place(app);
    else if (store.selection) app.inspector.focus();
    else return false;
    return true;
  }
  if (event.key === "Delete" || event.key === "Backspace") {
    if (store.tool === "measure" && app.measure.back()) return true;
    if (scene.draft?.corners?.length) {
      scene.draft = { corners: scene.draft.corners.slice(0, -1), at: null };
      scene.later();
    } else erase(app);
    return true;
  }
  return false;
}

/** Take out what is selected. @param {any} app */
export function erase({ store, say, selecting }) {
  if (selecting.isGroup) {
    selecting.erase();
    return;
  }
  if (!store.selection || store.selection.startsWith("span:")) return;
  const doc = remove(store.doc, store.selection);
  if (doc === store.doc) {
    say(store.selection === "start" ? "a route needs its start" : "that can't be deleted");
    return;
  }
  store.edit(doc, { select: null });
  say("deleted");
}

/** Keys that work wherever the focus is. @param {any} app @param {KeyboardEvent} event @param {boolean} onSlider */
function single(app, event, onSlider) {
  const { store, scene, drive, pointer } = app;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const tool = TOOLS.find((one) => one.key.toLowerCase() === key);
  const isButton = event.target instanceof HTMLButtonElement || event.target instanceof HTMLInputElement;
  if (event.key === "?") app.help();
  else if (event.key === "Escape") {
    if (!pointer.drawing.drop() && !app.measure.drop()) {
      if (scene.cross) scene.cross = null;
      else if (store.tool !== "select") store.setTool("select");
      else store.select(null);
    }
    scene.canvas.focus();
    scene.later();
  } else if (event.key === " ") {
    if (isButton && !onSlider) return false;
    drive.run ? app.timeline.toggle() : app.timeline.drive();
  } else if (tool) {
    store.setTool(tool.name);
    scene.canvas.focus();
    if (makes(store.tool)) showCross(app);
  } else if (key in LAYERS) store.toggle(/** @type {any} */ (LAYERS)[key]);
  else if (key === "e" && store.selection) app.selecting.pin();
  else if (key === "u" && isObstacle(store.selection)) app.toggleUnseen();
  else if (key === "n" && store.selection) app.inspector.focus();
  else if (key === "f") app.fit();
  else if (key === "+" || key === "=") zoom(app, 1.25);
  else if (key === "-") zoom(app, 0.8);
  else if (key === "t") tension(app, event.shiftKey ? -0.1 : 0.1);
  else if (key === ".") app.timeline.played.step(1);
  else if (key === ",") app.timeline.played.step(-1);
  else if (key === "w") app.timeline.toggle();
  else return false;
  return true;
}

/** @param {any} app @param {number} factor */
function zoom({ camera, store }, factor) {
  camera.zoom(factor, camera.width / 2, camera.height / 2);
  store.tell("view");
}

/** To the next thing on the map; past the last one the focus moves on. @param {any} app @param {1|-1} way */
function next({ store, say, describe, camera }, way) {
  const ids = idsOf(store.doc);
  const at = store.selection ? ids.indexOf(store.selection) : way > 0 ? -1 : ids.length;
  const id = ids[at + way];
  if (!id) {
    if (!store.others.length) store.select(null);
    return false;
  }
  store.select(id, store.others);
  const anchor = anchorOf(store.doc, id);
  if (anchor) {
    const [x, y] = camera.toScreen(anchor[0], anchor[1]);
    if (x < 0 || y < 0 || x > camera.width || y > camera.height) {
      [camera.x, camera.y] = anchor;
      store.tell("view");
    }
  }
  say(describe(id));
  return true;
}

/** Move what is selected, the cross, or the map. @param {any} app @param {number[]} way @param {boolean} far */
function arrow({ store, scene, camera, pointer, say, selecting, measure }, way, far) {
  const step = store.show.snap ? camera.step(28) : camera.step(5);
  const [dx, dy] = way.map((part) => part * step * (far ? 10 : 1));
  if (scene.cross) {
    scene.cross = pointer.snapped([scene.cross[0] + dx * 2, scene.cross[1] + dy * 2]);
    if (scene.draft?.corners) scene.draft = { ...scene.draft, at: scene.cross };
    if (store.tool === "measure") measure.hover(scene.cross);
    scene.later();
    return;
  }
  if (selecting.isGroup) {
    selecting.nudge([dx, dy]);
    return;
  }
  const id = store.selection;
  const anchor = id && !id.startsWith("span:") ? anchorOf(store.doc, id) : null;
  if (!anchor || !id) {
    camera.pan(-way[0] * 60, way[1] * 60);
    store.tell("view");
    return;
  }
  const at = pointer.snapped([anchor[0] + dx, anchor[1] + dy]);
  store.edit(moveTo(store.doc, id, at), { merge: `nudge:${id}` });
  say(`${at[0]}, ${at[1]}`);
}

/** A cross in the middle of the map, for tools without a mouse. @param {any} app */
function showCross({ scene, camera, pointer, say }) {
  scene.cross = pointer.snapped([camera.x, camera.y]);
  scene.later();
  say("move the cross with the arrows, Enter sets a point");
}

/** @param {any} app */
function place(app) {
  const { store, scene, pointer } = app;
  if (store.tool === "via") {
    pointer.dragging.count += 1;
    pointer.dragging.addVia(scene.cross, null);
    app.say("via point added");
  } else if (store.tool === "measure") {
    const last = app.measure.places.at(-1);
    if (!app.measure.isDone && last && last[0] === scene.cross[0] && last[1] === scene.cross[1]) app.measure.close();
    else app.measure.add([...scene.cross]);
  } else if (goesByCorners(store.tool)) {
    const corners = scene.draft?.corners ?? [];
    const [x, y] = pointer.snapped(scene.cross);
    const last = corners.at(-1);
    if (corners.length > 2 && ((last[0] === x && last[1] === y) || (corners[0][0] === x && corners[0][1] === y))) {
      scene.cross = null;
      pointer.drawing.close();
    } else pointer.drawing.addCorner(scene.cross);
  } else if (shapeToolOf(store.tool)) {
    pointer.drawing.click(scene.cross);
    scene.cross = null;
  }
  scene.later();
}

/** Earlier or later in the route. @param {any} app @param {1|-1} way */
export function reorder({ store, say }, way) {
  const ref = refOf(store.selection);
  if (ref?.kind !== "via") return;
  const to = ref.index + way;
  const doc = moveVia(store.doc, ref.index, to);
  if (doc === store.doc) return;
  store.edit(doc, { select: `via:${to}` });
  say(`now via point ${to + 1}`);
}

/** @param {any} app @param {number} by */
function tension({ store, say }, by) {
  const span = store.selection?.startsWith("span:") ? Number(store.selection.slice(5)) : null;
  const list = tensionsOf(store.doc);
  const now = Math.min(1, Math.max(-1, (span === null ? list[0] ?? 0 : list[span]) + by));
  store.edit(setTension(store.doc, span, now), { merge: "tension" });
  say(`tension ${now.toFixed(1)}`);
}
