/** The proven path: its curve, its speed as colour, its curvature as a comb; the ways not taken. */

import { viridis } from "./theme.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("../geometry/curve.js").Curve} Curve */

const SPEED_SHADES = 24;

/** @param {Pen} pen @param {Curve} curve @param {{speed: boolean, isStale: boolean, maxSpeed: number, colour?: string|null}} how `colour` is that of a robot of a fleet */
export function drawPath(pen, curve, { speed, isStale, maxSpeed, colour = null }) {
  const { ctx, colours } = pen;
  ctx.lineCap = ctx.lineJoin = "round";
  ctx.beginPath();
  pen.spans(curve.spans);
  if (isStale) {
    pen.stroke(colours.stale, 2, [2, 5]);
    return;
  }
  pen.stroke(colours.casing, 6);
  if (!speed) {
    if (colour) pen.stroke(colours.ink, 5);
    pen.stroke(colour ?? colours.path, 3);
    return;
  }
  pen.stroke(colours.ink, 4.4);
  drawShaded(pen, curve, maxSpeed);
}

/** @param {Pen} pen @param {Curve} curve @param {number} maxSpeed [m/s] */
function drawShaded(pen, curve, maxSpeed) {
  const { ctx, camera } = pen;
  const list = curve.samples;
  const per = list.length / curve.count;
  let shade = -1;
  for (let i = 0; i < list.length; i += 1) {
    const sample = list[i];
    const [x, y] = camera.toScreen(sample.x, sample.y);
    const next = i % per === per - 1 ? shade : Math.round((sample.speed / maxSpeed) * (SPEED_SHADES - 1));
    if (next !== shade && i % per !== per - 1) {
      if (shade >= 0) {
        ctx.lineTo(x, y);
        pen.stroke(viridis(shade / (SPEED_SHADES - 1)), 3);
      }
      ctx.beginPath();
      ctx.moveTo(x, y);
      shade = next;
    } else ctx.lineTo(x, y);
  }
  pen.stroke(viridis(shade / (SPEED_SHADES - 1)), 3);
}

/** Curvature as teeth that stand on the path, on the outer side. @param {Pen} pen @param {Curve} curve */
export function drawComb(pen, curve) {
  const { ctx, camera, colours } = pen;
  const list = curve.samples;
  const bends = list.map((sample) => Math.abs(sample.curvature)).filter(Number.isFinite).sort((a, b) => a - b);
  // The sharpest few don't make all others vanish: their teeth are cut off.
  const most = Math.max(Math.min(bends.at(-1) ?? 0, 5 * (bends[Math.floor(0.85 * bends.length)] ?? 0)), 1e-9);
  const tall = 46;
  /** @type {number[][]} */ const tips = [];
  ctx.beginPath();
  for (const sample of list) {
    const [x, y] = camera.toScreen(sample.x, sample.y);
    const size = -(Math.max(-most, Math.min(most, sample.curvature)) / most) * tall;
    const tip = [x - Math.sin(sample.heading) * size, y - Math.cos(sample.heading) * size];
    tips.push(tip);
    ctx.moveTo(x, y);
    ctx.lineTo(tip[0], tip[1]);
  }
  ctx.globalAlpha = 0.55;
  pen.stroke(colours.comb, 1);
  ctx.globalAlpha = 1;
  ctx.beginPath();
  tips.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
  pen.stroke(colours.comb, 1.4);
}

/** The sides that lost, which a click makes the ones to take. @param {Pen} pen @param {any[]} ledger @param {any} hovered */
export function drawLosers(pen, ledger, hovered) {
  const { ctx, colours } = pen;
  for (const entry of ledger) {
    for (const candidate of entry.candidates) {
      if (candidate.chosen || !candidate.spans.length) continue;
      const isHovered = candidate === hovered;
      ctx.beginPath();
      pen.spans(candidate.spans);
      ctx.globalAlpha = isHovered ? 1 : 0.6;
      pen.stroke(colours.loser, isHovered ? 3 : 1.5, [6, 4]);
      ctx.globalAlpha = 1;
    }
  }
}

/** The span that is selected. @param {Pen} pen @param {Curve} curve @param {number} leg */
export function drawLeg(pen, curve, leg) {
  const { ctx, colours } = pen;
  ctx.beginPath();
  pen.spans(curve.spans, curve.stops[leg], curve.stops[leg + 1] ?? curve.count);
  ctx.lineCap = "round";
  pen.stroke(colours.selectSoft, 14);
  pen.stroke(colours.select, 5.5);
}

/** Arrows that say which way it goes. @param {Pen} pen @param {Curve} curve */
export function drawArrows(pen, curve) {
  const { ctx, camera, colours } = pen;
  const count = Math.max(1, Math.min(60, Math.round((curve.length * camera.scale) / 170)));
  for (let i = 0; i < count; i += 1) {
    const at = curve.at((curve.length * (i + 0.5)) / count);
    const [x, y] = camera.toScreen(at.x, at.y);
    ctx.save();
    ctx.translate(x, y);
    ctx.rotate(-at.heading);
    ctx.beginPath();
    ctx.moveTo(6, 0);
    ctx.lineTo(-4, 4.5);
    ctx.lineTo(-2, 0);
    ctx.lineTo(-4, -4.5);
    ctx.closePath();
    pen.fill(colours.ink);
    pen.stroke(colours.casing, 1);
    ctx.restore();
  }
}
