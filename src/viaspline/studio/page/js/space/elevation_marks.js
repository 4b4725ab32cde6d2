/** Marks on a path unrolled: its tightest place, its points, and where one looks. */

import { BOTTOM_PX, LEFT_PX, TOP_PX } from "./elevation_frame.js";

/** @param {import("./elevation_picture.js").ElevationPicture} picture @param {any} colours @param {boolean} isStale */
export function drawTightest(picture, colours, isStale) {
  const { plan } = picture.app.store;
  if (isStale || !plan?.ok || plan.certificate.distance === null || plan.certificate.clearance === null) return;
  const { ctx } = picture;
  const [x, y] = [picture.x(plan.certificate.distance), picture.y(plan.space.tightest_z)];
  ctx.beginPath();
  ctx.moveTo(x, y + 3);
  ctx.lineTo(x + 5, y + 12);
  ctx.lineTo(x - 5, y + 12);
  ctx.closePath();
  ctx.fillStyle = colours.tightest;
  ctx.fill();
}

/** @param {import("./elevation_picture.js").ElevationPicture} picture @param {{id: string, x: number, y: number, label: string, dwell?: number}} point @param {any} colours */
export function drawPoint(picture, { id, x, y, label, dwell = 0 }, colours) {
  const { ctx, app } = picture;
  const isSelected = id === app.store.selection;
  ctx.beginPath();
  if (dwell > 0) ctx.roundRect(x - 7, y - 7, 14, 14, 3);
  else ctx.arc(x, y, 7, 0, 2 * Math.PI);
  const isLast = id === "goal" || id === "land";
  ctx.fillStyle = id === "start" ? colours.start : isLast ? colours.goal : dwell > 0 ? colours.station : colours.paper;
  ctx.fill();
  ctx.lineWidth = isSelected ? 2.6 : 1.5;
  ctx.strokeStyle = isSelected ? colours.select : colours.ink;
  ctx.stroke();
  ctx.fillStyle = id === "start" || isLast ? colours.paper : dwell > 0 ? "#1b1f24" : colours.ink;
  ctx.font = "600 9px Inter, system-ui, sans-serif";
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(label, x, y + 0.5);
  const words = isSelected ? picture.space.words(id) : "";
  if (!words) return;
  ctx.font = "600 11px Inter, system-ui, sans-serif";
  const w = ctx.measureText(words).width + 8;
  const left = Math.min(Math.max(x - w / 2, LEFT_PX), picture.width - w - 2);
  const top = y - 27 < TOP_PX ? y + 11 : y - 27;
  ctx.fillStyle = colours.plate;
  ctx.fillRect(left, top, w, 16);
  ctx.fillStyle = colours.select;
  ctx.textAlign = "left";
  ctx.fillText(words, left + 4, top + 8.5);
}

/** @param {import("./elevation_picture.js").ElevationPicture} picture @param {any} curve @param {number} s @param {any} colours */
export function drawCursor(picture, curve, s, colours) {
  const { ctx, height, width } = picture;
  const { drive } = picture.app;
  const state = drive.run?.samples?.z ? drive.state() : curve.at(s);
  const [x, y] = [picture.x(s), picture.y(state.z)];
  ctx.beginPath();
  ctx.moveTo(x, TOP_PX);
  ctx.lineTo(x, height - BOTTOM_PX);
  ctx.strokeStyle = colours.muted;
  ctx.lineWidth = 1;
  ctx.stroke();
  ctx.beginPath();
  ctx.arc(x, y, 4.5, 0, 2 * Math.PI);
  ctx.fillStyle = drive.run ? colours.robot : colours.path;
  ctx.fill();
  ctx.strokeStyle = colours.paper;
  ctx.stroke();
  const ground = picture.space.groundAt(state.x, state.y);
  const text = `${s.toFixed(1)} m · ${state.z.toFixed(1)} m high${ground === null ? "" : ` · ${(state.z - ground).toFixed(1)} m above ground`}`;
  ctx.font = "600 11px Inter, system-ui, sans-serif";
  const w = ctx.measureText(text).width + 8;
  ctx.fillStyle = colours.plate;
  const left = Math.min(Math.max(x - w / 2, LEFT_PX + 150), width - w - 4);
  ctx.fillRect(left, 0, w, 16);
  ctx.fillStyle = colours.ink;
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.fillText(text, left + 4, 8);
}
