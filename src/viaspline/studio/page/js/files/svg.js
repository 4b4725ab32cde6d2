/** The scene as SVG: the path as the very Bézier curves that were proven, in metres. */

import { robotColour } from "../fleet/colours.js";
import { membersOf, missionOf, robotName } from "../core/fleet.js";
import { areasOf, obstaclesOf, outlined, pointsOf, requiredOf, tracksOf } from "../core/mission.js";
import { boxOf } from "../geometry/rings.js";
import { polygon } from "../shapes/polygon.js";

/** @param {import("../core/store.js").Store} store @returns {string} */
export function svgOf(store) {
  const { doc } = store;
  const obstacles = outlined(obstaclesOf(doc));
  const required = requiredOf(doc);
  const box = boxAll(store) ?? [0, 0, 1, 1];
  const size = Math.max(box[2] - box[0], box[3] - box[1]);
  const pad = size * 0.04, line = size / 400;
  const spans = store.goodPlan?.spans ?? [];
  const bounds = doc.world?.bounds;
  const rings = (/** @type {number[][][]} */ all, /** @type {string} */ rest) => all.length ? polygon.svg({ polygon: all[0], holes: all.slice(1) }, rest) : "";
  const areas = areasOf(doc).filter((area) => area.ring.length);
  const parts = [
    ...areas.filter((a) => a.kind === "zone").map((a) => rings([a.ring], `fill="#fdf1da" stroke="#8a6200" stroke-width="${line / 2}" stroke-dasharray="${line / 2} ${line}"`)),
    rings(store.goodPlan?.corridor ?? [], `fill="none" stroke="#00795a" stroke-width="${line / 2}" stroke-dasharray="${3 * line} ${1.5 * line}"`),
    ...areas.filter((a) => a.kind === "fence").map((a) => rings([a.ring], `fill="none" stroke="#6f7985" stroke-width="${line / 2}"`)),
    ...obstacles.filter((o) => o.list === "known").map((o) => o.shape.svg(o.item, `fill="#f0f2f5" stroke="#f0f2f5" stroke-width="${2 * required}" stroke-linejoin="round"`)),
    ...obstacles.map((o) => o.shape.svg(o.item, o.list === "known" ? `fill="#aeb5bf" stroke="#4d5661" stroke-width="${line / 2}"` : `fill="#fbe3d3" stroke="#c24e00" stroke-width="${line / 2}" stroke-dasharray="${2 * line} ${line}"`)),
    Array.isArray(bounds) ? `<rect x="${bounds[0]}" y="${bounds[1]}" width="${bounds[2] - bounds[0]}" height="${bounds[3] - bounds[1]}" fill="none" stroke="#6f7985" stroke-width="${line / 2}"/>` : "",
    ...otherPaths(store).map(([d, colour]) => `<path d="${d}" fill="none" stroke="${colour}" stroke-width="${line / 2}" stroke-linecap="round"/>`),
    `<path d="${pathData(spans)}" fill="none" stroke="${store.robot === null ? "#0072b2" : robotColour(store.robot, false)}" stroke-width="${line}" stroke-linecap="round"/>`,
    ...pointsOf(doc).filter((p) => p.at).map((p) => {
      const [x, y] = /** @type {number[]} */ (p.at);
      const fill = p.id === "start" ? "#008f68" : p.id === "goal" ? "#1b1f24" : p.dwell ? "#f0e442" : "#ffffff";
      const name = p.given ? `<text transform="translate(${x + 3 * line} ${y + 3 * line}) scale(1 -1)" font-size="${6 * line}" font-family="sans-serif" fill="#1b1f24">${escaped(p.given)}</text>` : "";
      return `<circle cx="${x}" cy="${y}" r="${2 * line}" fill="${fill}" stroke="#1b1f24" stroke-width="${line / 2}"/>${name}`;
    }),
  ];
  const [w, h] = [box[2] - box[0] + 2 * pad, box[3] - box[1] + 2 * pad];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${box[0] - pad} ${-box[3] - pad} ${w} ${h}" width="${w}" height="${h}">\n<rect x="${box[0] - pad}" y="${-box[3] - pad}" width="${w}" height="${h}" fill="#fff"/>\n<g transform="scale(1 -1)">\n${parts.filter(Boolean).join("\n")}\n</g>\n</svg>\n`;
}

/** The spans of every path there is. @param {import("../core/store.js").Store} store @returns {number[][]} */
const spansOf = (store) => [store.goodPlan?.spans ?? [], ...(store.fleetPlan?.driving ?? []).map((robot) => robot.path.spans)];

/** The paths of the robots of a fleet that aren't chosen, with their colours. @param {import("../core/store.js").Store} store @returns {string[][]} */
function otherPaths(store) {
  return membersOf(store.file).flatMap((_, i) => {
    const path = i === store.robot ? null : store.fleetPlan?.byName.get(robotName(store.file, i))?.path;
    return path ? [[pathData(path.spans), robotColour(i, false)]] : [];
  });
}

/** @param {number[]} p */
function pathData(p) {
  let text = "";
  for (let i = 0; i < p.length; i += 8) {
    if (i === 0 || p[i] !== p[i - 2] || p[i + 1] !== p[i - 1]) text += `M${p[i]} ${p[i + 1]}`;
    text += `C${p.slice(i + 2, i + 8).join(" ")}`;
  }
  return text;
}

/** What is looked at: everything there is, without bounds that lie far out. @param {import("../core/store.js").Store} store */
export function boxOfInterest(store) {
  const inner = boxOf(placesOf(store));
  const all = boxAll(store);
  if (!all || !inner) return all;
  const size = Math.max(inner[2] - inner[0], inner[3] - inner[1], 1);
  const near = (/** @type {number} */ a, /** @type {number} */ b) => Math.abs(a - b) < 0.12 * size;
  return inner.map((value, i) => (near(value, all[i]) ? all[i] : value + (i < 2 ? -0.04 : 0.04) * size));
}

/** The box round everything in a scene [m]. @param {import("../core/store.js").Store} store */
export function boxAll(store) {
  const bounds = store.doc.world?.bounds;
  const corners = Array.isArray(bounds) ? [[bounds[0], bounds[1]], [bounds[2], bounds[3]]] : [];
  return boxOf([...placesOf(store), ...corners]);
}

/** Places round which everything lies but the bounds: routes, paths, obstacles, what moves, areas, maps [m]. @param {import("../core/store.js").Store} store */
function placesOf(store) {
  const { doc, run } = store;
  const routes = store.robot === null ? [doc] : membersOf(store.file).map((_, i) => missionOf(store.file, i, store.missions));
  const points = routes.flatMap((route) => pointsOf(route)).flatMap((p) => (p.at ? [p.at] : []));
  for (const { shape, item } of [...obstaclesOf(doc), ...tracksOf(store.plan?.tracks ?? [])]) {
    const box = shape?.box(item);
    if (box) points.push(box.slice(0, 2), box.slice(2));
  }
  for (const { ring } of areasOf(doc)) points.push(...ring);
  for (const span of spansOf(store)) for (let i = 0; i < span.length; i += 2) points.push([span[i], span[i + 1]]);
  for (const ring of store.goodPlan?.corridor ?? []) points.push(...ring);
  for (const grid of store.plan?.grids ?? []) {
    if (grid.extent) points.push(grid.extent.slice(0, 2), grid.extent.slice(2));
    for (const ring of grid.rings ?? []) points.push(...ring);
  }
  if (run?.samples?.x) run.samples.x.forEach((/** @type {number} */ x, /** @type {number} */ i) => points.push([x, run.samples.y[i]]));
  return points;
}

/** @param {string} text */
const escaped = (text) => text.replace(/[&<>"]/g, (c) => /** @type {any} */ ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
