/** The points of the route, their headings, the detour points, and the handles of what is selected. */

import { anchorOf, isPoint, part, pathOf, shapedAt, whole } from "../core/mission.js";

/** @typedef {import("./pen.js").Pen} Pen */

const DOT_PX = 2.6;
export const HEADING_REACH_PX = 44; // pixels from a point to the handle of its heading

/** @param {Pen} pen @param {any[]} points @param {{selection: string|null, hover: string|null, shown: Set<string>}} state those that aren't `shown` are dots */
export function drawPoints(pen, points, { selection, hover, shown }) {
  const { ctx, camera, colours } = pen;
  drawDots(pen, points.filter((point) => point.at && !shown.has(point.id)));
  points.forEach((point, i) => {
    if (!point.at || !shown.has(point.id)) return;
    const [x, y] = camera.toScreen(point.at[0], point.at[1]);
    const isSelected = selection === point.id;
    if (isSelected || hover === point.id) {
      ctx.beginPath();
      ctx.arc(x, y, isSelected ? 17 : 14, 0, 2 * Math.PI);
      pen.fill(colours.selectSoft);
      if (isSelected) pen.stroke(colours.select, 2);
    }
    if (point.heading !== null) drawHeading(pen, x, y, point.heading, isSelected);
    ctx.beginPath();
    if (point.dwell > 0) ctx.roundRect(x - 9, y - 9, 18, 18, 4); // a station is square
    else ctx.arc(x, y, point.id === "start" || point.id === "goal" || point.id === "land" ? 9 : 8, 0, 2 * Math.PI);
    const isLast = point.id === "goal" || point.id === "land";
    const fill = point.id === "start" ? colours.start : isLast ? colours.goal : point.dwell > 0 ? colours.station : colours.paper;
    pen.fill(fill);
    pen.stroke(isSelected ? colours.select : point.dwell > 0 ? "#5a5200" : colours.ink, isSelected ? 2.4 : 1.8);
    ctx.font = `600 ${i > 99 ? 8 : 10}px Inter, system-ui, sans-serif`;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillStyle = point.id === "start" || isLast ? colours.paper : point.dwell > 0 ? "#1b1f24" : colours.ink;
    const letter = point.id === "start" ? "S" : point.id === "goal" ? "G" : point.id === "land" ? "L" : String(i);
    ctx.fillText(letter, x, y + 0.5);
  });
}

/** Points for whose numbers there is no room. @param {Pen} pen @param {any[]} points */
function drawDots(pen, points) {
  const { ctx, camera, colours } = pen;
  ctx.beginPath();
  for (const { at } of points) {
    const [x, y] = camera.toScreen(at[0], at[1]);
    if (x < -4 || y < -4 || x > camera.width + 4 || y > camera.height + 4) continue;
    ctx.moveTo(x + DOT_PX, y);
    ctx.arc(x, y, DOT_PX, 0, 2 * Math.PI);
  }
  pen.fill(colours.paper);
  pen.stroke(colours.ink, 1.2);
}

/** @param {Pen} pen @param {number} x @param {number} y @param {number} heading [deg] @param {boolean} isSelected */
function drawHeading(pen, x, y, heading, isSelected) {
  const { ctx, colours } = pen;
  const angle = (-heading * Math.PI) / 180;
  const [hx, hy] = [x + Math.cos(angle) * HEADING_REACH_PX, y + Math.sin(angle) * HEADING_REACH_PX];
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(hx, hy);
  pen.stroke(isSelected ? colours.select : colours.ink, 1.6);
  ctx.save();
  ctx.translate(hx, hy);
  ctx.rotate(angle);
  ctx.beginPath();
  ctx.moveTo(6, 0);
  ctx.lineTo(-5, 5);
  ctx.lineTo(-5, -5);
  ctx.closePath();
  pen.fill(isSelected ? colours.select : colours.ink);
  ctx.restore();
}

/** @param {Pen} pen @param {any[]} vias of the plan */
export function drawDetours(pen, vias) {
  const { ctx, camera, colours } = pen;
  for (const via of vias) {
    if (via[3] !== "detour") continue;
    const [x, y] = camera.toScreen(via[1], via[2]);
    ctx.beginPath();
    ctx.moveTo(x, y - 5);
    ctx.lineTo(x + 5, y);
    ctx.lineTo(x, y + 5);
    ctx.lineTo(x - 5, y);
    ctx.closePath();
    pen.fill(colours.detour);
    pen.stroke(colours.ink, 1);
  }
}

/**
 * The handles of what is selected, each with the id or the role that dragging it changes.
 * @param {any} doc @param {string|null} selection @param {import("../geometry/camera.js").Camera} camera
 * @returns {{id: string, role: string, x: number, y: number}[]}
 */
export function handlesOf(doc, selection, camera) {
  if (!selection || selection.startsWith("span:")) return [];
  const handles = [];
  const owner = whole(selection);
  const shaped = shapedAt(doc, selection);
  const item = part(doc, pathOf(selection));
  const on = (/** @type {number} */ x, /** @type {number} */ y) => {
    const [px, py] = camera.toScreen(x, y);
    return { x: px, y: py };
  };
  if (isPoint(selection) && (selection === "start" || selection === "goal")) {
    const at = anchorOf(doc, selection);
    const heading = Array.isArray(item) ? null : item?.heading_deg;
    if (at) {
      const angle = (-(Number.isFinite(heading) ? heading : 0) * Math.PI) / 180;
      const { x, y } = on(at[0], at[1]);
      const role = Number.isFinite(heading) ? "heading" : "free-heading";
      handles.push({ id: selection, role, x: x + Math.cos(angle) * HEADING_REACH_PX, y: y + Math.sin(angle) * HEADING_REACH_PX });
    }
  } else if (shaped) {
    for (const { role, at, vertex } of shaped.shape.handles(shaped.item, camera.scale)) {
      handles.push({ id: vertex < 0 ? owner : `${owner}:${vertex}`, role, ...on(at[0], at[1]) });
    }
  } else if (selection.startsWith("bounds") && Array.isArray(item)) {
    for (let i = 0; i < 4; i += 1) {
      const [x, y] = /** @type {number[]} */ (anchorOf(doc, `bounds:${i}`));
      handles.push({ id: `bounds:${i}`, role: "corner", ...on(x, y) });
    }
  }
  return handles;
}

/** @param {Pen} pen @param {any} doc @param {string|null} selection */
export function drawHandles(pen, doc, selection) {
  const { ctx, colours, camera } = pen;
  const shaped = shapedAt(doc, selection);
  if (shaped?.shape.hasOutline) {
    ctx.beginPath();
    shaped.shape.trace(pen, shaped.item);
    pen.stroke(colours.select, 2);
  }
  for (const handle of handlesOf(doc, selection, camera)) {
    ctx.beginPath();
    if (handle.role === "new-corner") ctx.arc(handle.x, handle.y, 3.5, 0, 2 * Math.PI);
    else if (handle.role === "corner") ctx.rect(handle.x - 5, handle.y - 5, 10, 10);
    else ctx.arc(handle.x, handle.y, 6, 0, 2 * Math.PI);
    const isNow = handle.role === "corner" && handle.id === selection;
    pen.fill(isNow ? colours.select : handle.role === "heading" ? colours.select : colours.paper);
    pen.stroke(colours.select, handle.role === "new-corner" ? 1.2 : 1.8, handle.role === "free-heading" ? [2, 2] : []);
  }
}
