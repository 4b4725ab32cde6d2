/** Marks on the map: the tightest place, where there is no way, the cursor along the path, the scale. */

import { outline, sizeOf } from "./body.js";
import { viridis } from "./theme.js";

/** @typedef {import("./pen.js").Pen} Pen */

/** The tightest place with the gap that was proven. @param {Pen} pen @param {any} certificate @param {import("../core/mission.js").Outlined[]} known */
export function drawTightest(pen, certificate, known) {
  const { ctx, camera, colours } = pen;
  if (certificate.clearance === null) return;
  const [x, y] = camera.toScreen(certificate.at[0], certificate.at[1]);
  const nearest = known.find((obstacle) => obstacle.name === certificate.nearest);
  const edge = nearest ? nearest.shape.edgeNear(certificate.at, nearest.item) : null;
  if (edge) {
    const [ex, ey] = camera.toScreen(edge[0], edge[1]);
    ctx.beginPath();
    ctx.moveTo(x, y);
    ctx.lineTo(ex, ey);
    pen.stroke(colours.tightest, 2);
  }
  ctx.beginPath(); // a triangle: not told by its colour alone
  ctx.moveTo(x, y - 8);
  ctx.lineTo(x + 7, y + 5);
  ctx.lineTo(x - 7, y + 5);
  ctx.closePath();
  pen.fill(colours.tightest);
  pen.stroke(colours.paper, 1.5);
}

/** Where the robot comes nearest to what moves: the triangle, hollow. @param {Pen} pen @param {any} certificate */
export function drawTightestInTime(pen, certificate) {
  const { ctx, camera, colours } = pen;
  if (!certificate?.obstacle || !certificate.tightest_at) return;
  const [x, y] = camera.toScreen(certificate.tightest_at[0], certificate.tightest_at[1]);
  ctx.beginPath();
  ctx.moveTo(x, y - 8);
  ctx.lineTo(x + 7, y + 5);
  ctx.lineTo(x - 7, y + 5);
  ctx.closePath();
  pen.fill(colours.paper);
  pen.stroke(colours.moving, 2);
}

/** Where the path doesn't drive well: squares. @param {Pen} pen @param {any[]} reasons */
export function drawRough(pen, reasons) {
  const { ctx, camera, colours } = pen;
  for (const { at } of reasons) {
    if (!at) continue;
    const [x, y] = camera.toScreen(at[0], at[1]);
    ctx.beginPath();
    ctx.rect(x - 8, y - 8, 16, 16);
    pen.stroke(colours.paper, 4);
    pen.stroke(colours.zone, 2);
  }
}

/** Where there is no way. @param {Pen} pen @param {number[]} where */
export function drawProblem(pen, where) {
  const { ctx, camera, colours } = pen;
  const [x, y] = camera.toScreen(where[0], where[1]);
  ctx.beginPath();
  ctx.arc(x, y, 24, 0, 2 * Math.PI);
  pen.stroke(colours.problem, 2.5, [5, 4]);
  ctx.beginPath();
  ctx.moveTo(x - 7, y - 7);
  ctx.lineTo(x + 7, y + 7);
  ctx.moveTo(x + 7, y - 7);
  ctx.lineTo(x - 7, y + 7);
  pen.stroke(colours.problem, 3);
}

/** @param {Pen} pen @param {import("../geometry/curve.js").Sample} at @param {import("./body.js").Body} body */
export function drawCursor(pen, at, body) {
  const { ctx, camera, colours } = pen;
  const [x, y] = camera.toScreen(at.x, at.y);
  ctx.beginPath();
  if (sizeOf(pen, body) > 6) outline(pen, body, at);
  else ctx.arc(x, y, 6, 0, 2 * Math.PI);
  ctx.globalAlpha = 0.35;
  pen.fill(colours.path);
  ctx.globalAlpha = 1;
  pen.stroke(colours.ink, 1.5);
  ctx.beginPath();
  ctx.arc(x, y, 2.5, 0, 2 * Math.PI);
  pen.fill(colours.ink);
}

/**
 * How long things are, and how fast the colours.
 * @param {Pen} pen @param {number} left @param {number} bottom [CSS pixel] @param {number|null} maxSpeed [m/s]
 */
export function drawScale(pen, left, bottom, maxSpeed) {
  const { ctx, camera, colours } = pen;
  const step = camera.step(90);
  const width = step * camera.scale;
  const y = camera.height - bottom;
  ctx.beginPath();
  ctx.roundRect(left - 8, y - 22, width + (maxSpeed === null ? 16 : 122), 30, 6);
  pen.fill(colours.plate);
  if (maxSpeed !== null) drawShades(pen, left + width + 18, y, maxSpeed);
  ctx.beginPath();
  ctx.moveTo(left, y - 5);
  ctx.lineTo(left, y);
  ctx.lineTo(left + width, y);
  ctx.lineTo(left + width, y - 5);
  pen.stroke(colours.muted, 1.5);
  ctx.font = "500 11px Inter, system-ui, sans-serif";
  ctx.fillStyle = colours.muted;
  ctx.textAlign = "center";
  ctx.textBaseline = "bottom";
  ctx.fillText(step >= 1000 ? `${step / 1000} km` : step >= 1 ? `${step} m` : `${Number((step * 100).toPrecision(3))} cm`, left + width / 2, y - 3);
}

/** @param {Pen} pen @param {number} x @param {number} y @param {number} maxSpeed */
function drawShades(pen, x, y, maxSpeed) {
  const { ctx, colours } = pen;
  for (let i = 0; i < 24; i += 1) {
    ctx.fillStyle = viridis(i / 23);
    ctx.fillRect(x + i * 3.5, y - 5, 4, 5);
  }
  ctx.fillStyle = colours.muted;
  ctx.font = "500 11px Inter, system-ui, sans-serif";
  ctx.textBaseline = "bottom";
  ctx.textAlign = "left";
  ctx.fillText("0", x, y - 6);
  ctx.textAlign = "right";
  ctx.fillText(`${Number(maxSpeed.toPrecision(2))} m/s`, x + 84, y - 6);
}

/** The cross that the keyboard moves. @param {Pen} pen @param {number[]} at */
export function drawCross(pen, at) {
  const { ctx, camera, colours } = pen;
  const [x, y] = camera.toScreen(at[0], at[1]);
  ctx.beginPath();
  ctx.moveTo(x - 14, y);
  ctx.lineTo(x + 14, y);
  ctx.moveTo(x, y - 14);
  ctx.lineTo(x, y + 14);
  pen.stroke(colours.paper, 4);
  pen.stroke(colours.select, 1.8);
}

/** What a tool is about to make. @param {Pen} pen @param {any} draft */
export function drawDraft(pen, draft) {
  const { ctx, camera, colours } = pen;
  if (draft.item) {
    ctx.beginPath();
    pen.shape(draft);
    pen.fill(colours.selectSoft);
    pen.stroke(colours.select, 2, [5, 4]);
  }
  if (draft.corners?.length) {
    ctx.beginPath();
    const ring = draft.at ? [...draft.corners, draft.at] : draft.corners;
    ring.forEach((/** @type {number[]} */ p, /** @type {number} */ i) => {
      const [x, y] = camera.toScreen(p[0], p[1]);
      if (i) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
    });
    if (ring.length > 2) {
      ctx.closePath();
      pen.fill(colours.selectSoft);
    }
    pen.stroke(colours.select, 2, [5, 4]);
    for (const p of draft.corners) {
      const [x, y] = camera.toScreen(p[0], p[1]);
      ctx.beginPath();
      ctx.rect(x - 4, y - 4, 8, 8);
      pen.fill(colours.paper);
      pen.stroke(colours.select, 1.8);
    }
  }
}
