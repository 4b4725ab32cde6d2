/** What can be done with the thing under the pointer, as entries of a menu. */

import { addVertex, forceSide, moveVia, remove, setOnPoint, setTension } from "../core/edits.js";
import { anchorOf, isArea, isObstacle, isPoint, obstaclesOf, part, pathOf, refOf, shapedAt, spanCount, tensionsOf, whole } from "../core/mission.js";

/** @typedef {import("./context_menu.js").MenuEntry} MenuEntry */

/**
 * @param {any} app @param {any} found as `pick` gives it
 * @param {number[]|null} at where the menu is opened [m]; null: not on the map
 * @returns {MenuEntry[]}
 */
export function entriesOf(app, found, at) {
  const { store } = app;
  if (found?.kind === "handle") return entriesOf(app, { kind: "item", id: found.handle.id }, at);
  if (found?.kind === "item" && app.selecting.isGroup) return [...ofGroup(app), null, ...ofMap(app, at)];
  if (found?.kind === "item") return [...ofItem(app, found.id), null, ...ofMap(app, at)];
  if (found?.kind === "path") return [...ofSpan(app, found.leg, at), null, ...ofMap(app, at)];
  if (found?.kind === "side") {
    const { entry, candidate } = found;
    return [{ label: `Pass on the ${candidate.side}`, icon: "check", act: () => app.pointer.force(entry, candidate.side) }, null, ...ofMap(app, at)];
  }
  if (found?.kind === "robot") return [{ label: "Edit this robot", icon: "select", act: () => { store.choose(found.robot); store.select(found.id); } }, null, ...ofMap(app, at)];
  return [...(at ? ofPlace(app, at) : []), ...ofMap(app, at)];
}

/** What is done with a place where nothing is. @param {any} app @param {number[]} at @returns {MenuEntry[]} */
function ofPlace(app, at) {
  const { pointer } = app;
  const add = () => {
    pointer.dragging.count += 1;
    pointer.dragging.addVia(at, null);
    app.say("via point added");
  };
  return [
    { label: "Add a via point at the end", icon: "via", act: add },
    { label: "Measure from here", icon: "measure", key: "M", act: () => app.measure.from(pointer.snapped(at)) },
  ];
}

/** What is done with all that is selected. @param {any} app @returns {MenuEntry[]} */
const ofGroup = (app) => [
  { label: "Copy", icon: "file", key: "Ctrl+C", act: () => app.clipboard.copy() },
  { label: "Cut", key: "Ctrl+X", act: () => app.clipboard.cut() },
  { label: "Duplicate", icon: "plus", key: "Ctrl+D", act: () => app.clipboard.duplicate() },
  { label: "Delete", icon: "trash", key: "Del", act: () => app.selecting.erase() },
];

/** @param {any} app @param {string} id @returns {MenuEntry[]} */
function ofItem(app, id) {
  const { store } = app;
  if (id.startsWith("span:")) return ofSpan(app, Number(id.slice(5)), null);
  const ref = /** @type {import("../core/mission.js").Ref} */ (refOf(id));
  /** @type {MenuEntry[]} */ const entries = [{ label: "Edit its fields", icon: "select", key: "Enter", act: () => app.inspector.focus() }];
  if (isPoint(id)) entries.push(...ofPoint(app, id, ref));
  if (isObstacle(id)) entries.push(...ofObstacle(app, id));
  if (ref.vertex >= 0 && (isObstacle(id) || isArea(id))) entries.push(...ofVertex(app, id, ref));
  if (id.startsWith("bounds")) return entries;
  entries.push(null, ...ofGroup(app));
  if (id === "start") entries.pop(); // a route needs it
  const anchor = anchorOf(store.doc, id);
  if (anchor) entries.push({ label: "Measure from here", icon: "measure", key: "M", act: () => app.measure.from(anchor.slice(0, 2)) });
  return entries;
}

/** @param {any} app @param {string} id @param {import("../core/mission.js").Ref} ref @returns {MenuEntry[]} */
function ofPoint({ store, say }, id, ref) {
  /** @type {MenuEntry[]} */ const entries = [];
  const point = part(store.doc, pathOf(id));
  const vias = store.doc.route?.via?.length ?? 0;
  const reorder = (/** @type {number} */ to) => {
    store.edit(moveVia(store.doc, ref.index, to), { select: `via:${to}` });
    say(`now via point ${to + 1}`);
  };
  if (ref.kind === "via" && store.doc.route?.order !== "shortest") {
    if (ref.index > 0) entries.push({ label: "Earlier in the route", icon: "up", key: "Alt+↑", act: () => reorder(ref.index - 1) });
    if (ref.index < vias - 1) entries.push({ label: "Later in the route", icon: "down", key: "Alt+↓", act: () => reorder(ref.index + 1) });
  }
  if (id === "start" || id === "goal") {
    const isFree = !Number.isFinite(point?.heading_deg);
    entries.push({ label: isFree ? "Give it a heading" : "Let its heading go free", act: () => store.edit(setOnPoint(store.doc, id, "heading_deg", isFree ? 0 : undefined)) });
  }
  const order = id === "start" ? 0 : ref.kind === "via" ? ref.index + 1 : -1;
  if (order >= 0 && order < spanCount(store.doc)) entries.push({ label: "Select the span after it", icon: "next", act: () => store.select(`span:${order}`) });
  return entries;
}

/** @param {any} app @param {string} id @returns {MenuEntry[]} */
function ofObstacle(app, id) {
  const { store } = app;
  const one = obstaclesOf(store.doc).find((other) => other.id === whole(id));
  if (!one) return [];
  const isUnseen = one.list === "unseen";
  /** @type {MenuEntry[]} */ const entries = [{ label: "Unseen: only the sensor finds it", key: "U", isChecked: isUnseen, act: () => app.toggleUnseen() }];
  if (isUnseen || !(one.shape?.hasSides ?? true)) return entries;
  for (const side of ["left", "right"]) {
    entries.push({ label: `Pass on the ${side}`, isChecked: one.side === side, act: () => store.edit(forceSide(store.doc, [one.index], one.side === side ? null : side)) });
  }
  return entries;
}

/** @param {any} app @param {string} id @param {import("../core/mission.js").Ref} ref @returns {MenuEntry[]} */
function ofVertex({ store, say }, id, ref) {
  const found = shapedAt(store.doc, id);
  if (!found) return [];
  const name = found.shape.vertexName;
  const vertices = found.shape.vertices(found.item);
  const [a, b] = [vertices[ref.vertex], vertices[(ref.vertex + 1) % vertices.length]];
  const grown = a && b ? addVertex(store.doc, id, ref.vertex, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]) : store.doc;
  const without = remove(store.doc, id);
  return [
    ...(grown === store.doc ? [] : [{ label: `Add a ${name} after it`, icon: "plus", act: () => { store.edit(grown, { select: `${whole(id)}:${ref.vertex + 1}` }); say(`${name} added`); } }]),
    ...(without === store.doc ? [] : [{ label: `Delete this ${name}`, icon: "trash", act: () => { store.edit(without, { select: whole(id) }); say(`${name} deleted`); } }]),
  ];
}

/** @param {any} app @param {number} leg @param {number[]|null} at @returns {MenuEntry[]} */
function ofSpan(app, leg, at) {
  const { store, pointer } = app;
  const middle = () => {
    const [a, b] = store.curve.legRange(leg);
    const { x, y } = store.curve.at((a + b) / 2);
    return [x, y];
  };
  const own = Array.isArray(store.doc.spline?.tension ?? store.doc.spline?.slack);
  const add = () => {
    pointer.dragging.count += 1;
    pointer.dragging.addVia(at ?? middle(), leg);
    app.say("via point added");
  };
  return [
    ...(at || (store.curve && store.plan?.ok) ? [{ label: at ? "Add a via point here" : "Add a via point in its middle", icon: "via", act: add }] : []),
    { label: "Edit its tension", icon: "select", key: "Enter", act: () => app.inspector.focus() },
    { label: "Straight: tension 1", act: () => store.edit(setTension(store.doc, leg, 1)) },
    ...(own ? [{ label: "Use its tension for all spans", act: () => store.edit(setTension(store.doc, null, tensionsOf(store.doc)[leg])) }] : []),
  ];
}

/** What is done with the map as such. @param {any} app @param {number[]|null} at @returns {MenuEntry[]} */
function ofMap(app, at) {
  return [
    ...(at ? [{ label: "Paste here", key: "Ctrl+V", act: () => app.clipboard.pasteHere(at) }] : []),
    { label: "Select everything", key: "Ctrl+A", act: () => app.selecting.all() },
    { label: "Show everything", icon: "fit", key: "F", act: () => app.fit() },
  ];
}
