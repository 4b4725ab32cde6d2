/** The drive as it is played: what the sensor reaches, what it has shown, the trail and the robot. */

import { innerRadius } from "../core/mission.js";
import { outline, sizeOf } from "./body.js";
import { viridis } from "./theme.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("../replay.js").Drive} Drive */

/** @param {Pen} pen @param {Drive} drive */
export function drawSight(pen, drive) {
  const { ctx, camera, colours } = pen;
  const sight = drive.run?.sight;
  if (!sight) return;
  const state = drive.state();
  ctx.beginPath();
  if (sight.kind === "range") {
    pen.disc(state.x, state.y, sight.reach);
  } else {
    const k = drive.frame();
    const fan = sight.fans[k];
    const at = drive.stateAt(sight.times[k]);
    ctx.moveTo(...camera.toScreen(at.x, at.y));
    fan.forEach((/** @type {number} */ range, /** @type {number} */ i) => {
      const angle = at.heading + sight.first + i * sight.step;
      ctx.lineTo(...camera.toScreen(at.x + range * Math.cos(angle), at.y + range * Math.sin(angle)));
    });
    ctx.closePath();
  }
  pen.fill(colours.sensorFill);
  pen.stroke(colours.sensor, 1.2, [4, 4]);
  if (sight.kind === "lidar") {
    ctx.fillStyle = colours.unseen;
    for (const [x, y, time] of sight.hits) {
      if (time > drive.time) break; // in order of time
      const [px, py] = camera.toScreen(x, y);
      ctx.fillRect(px - 1.2, py - 1.2, 2.4, 2.4);
    }
  }
}

/** The path that the robot follows now, and the one that it left. @param {Pen} pen @param {Drive} drive @param {number[]} planned */
export function drawFollowed(pen, drive, planned) {
  const { ctx, colours } = pen;
  const past = drive.replans();
  const now = past.at(-1)?.spans ?? planned;
  const before = past.length ? past.at(-2)?.spans ?? planned : null;
  ctx.lineCap = "round";
  if (before) {
    ctx.beginPath();
    pen.spans(before);
    pen.stroke(colours.stale, 1.6, [2, 5]);
  }
  ctx.beginPath();
  pen.spans(now);
  pen.stroke(colours.casing, 5);
  pen.stroke(colours.path, 2);
}

/** @param {Pen} pen @param {Drive} drive @param {number} maxSpeed [m/s] */
export function drawTrail(pen, drive, maxSpeed) {
  const { ctx, camera, colours } = pen;
  const { x, y, speed } = drive.run.samples;
  const last = drive.index();
  const state = drive.state();
  const step = Math.max(1, Math.floor(last / 1500));
  const points = [];
  for (let i = 0; i <= last; i += step) points.push([x[i], y[i], speed[i]]);
  points.push([state.x, state.y, state.speed]);
  ctx.lineCap = ctx.lineJoin = "round";
  ctx.beginPath();
  points.forEach(([px, py], i) => {
    const [sx, sy] = camera.toScreen(px, py);
    if (i) ctx.lineTo(sx, sy);
    else ctx.moveTo(sx, sy);
  });
  pen.stroke(colours.ink, 5.4);
  let shade = -1;
  points.forEach(([px, py, v], i) => {
    const [sx, sy] = camera.toScreen(px, py);
    const next = Math.round((v / maxSpeed) * 20);
    if (i) ctx.lineTo(sx, sy);
    if (next !== shade || i === points.length - 1) {
      if (shade >= 0) pen.stroke(viridis(shade / 20), 4);
      ctx.beginPath();
      ctx.moveTo(sx, sy);
      shade = next;
    }
  });
}

/**
 * The robot with its heading, and what is left of a stay.
 * @param {Pen} pen @param {{x: number, y: number, heading: number}} state @param {import("./body.js").Body} body
 * @param {{colour: string, stop: {left: number, part: number}|null}} look
 */
export function drawRobot(pen, state, body, { colour, stop }) {
  const { ctx, camera, colours } = pen;
  const [x, y] = camera.toScreen(state.x, state.y);
  const size = sizeOf(pen, body);
  const r = Math.max(body.footprint ? Math.min(innerRadius(body) * camera.scale, size) : size, 9);
  ctx.beginPath();
  if (body.footprint && size > 12) outline(pen, body, state);
  else ctx.arc(x, y, r, 0, 2 * Math.PI);
  pen.fill(colour);
  pen.stroke(colours.paper, 2);
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(-state.heading);
  ctx.beginPath();
  ctx.moveTo(r * 0.62, 0);
  ctx.lineTo(-r * 0.4, r * 0.48);
  ctx.lineTo(-r * 0.15, 0);
  ctx.lineTo(-r * 0.4, -r * 0.48);
  ctx.closePath();
  pen.fill(colours.paper);
  ctx.restore();
  if (stop) { // a station counts down as a ring that closes
    ctx.beginPath();
    ctx.arc(x, y, r + 6, -Math.PI / 2, -Math.PI / 2 + 2 * Math.PI * stop.part);
    pen.stroke(colours.ink, 4);
    ctx.font = "600 12px Inter, system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
    const text = `${stop.left.toFixed(0)} s`;
    const w = ctx.measureText(text).width + 8;
    ctx.beginPath();
    ctx.roundRect(x - w / 2, y - r - 28, w, 18, 4);
    pen.fill(colours.plate);
    ctx.fillStyle = colours.ink;
    ctx.fillText(text, x, y - r - 12);
  }
}
