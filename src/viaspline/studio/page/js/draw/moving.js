/** What moves, at an instant: where it goes, where it may be, its outline and its velocity. */

import { errorAt, frameAt, outOf, trailOf, waysOf } from "../geometry/motion.js";
import { hatch } from "./obstacles.js";
import { Pen } from "./pen.js";

/** @typedef {import("../core/mission.js").Outlined} Outlined */
/** @typedef {import("../geometry/motion.js").Frame} Frame */
/** @typedef {Outlined & {frame: Frame|null}} Placed where it is; null while it isn't there */

const ARROW_S = 1; // an arrow is as long as the way in this time
const SHORTEST_ARROW_PX = 6;
const MOST_WHOLE = 12; // things whose whole way is drawn; of more, what they go while the robot drives
const MOST_DOTS = 60; // keyframes of one thing that are marked

/** @param {Outlined[]} moving @param {number} time [s] @returns {Placed[]} */
export const placedAt = (moving, time) => moving.map((one) => ({ ...one, frame: frameAt(one.item.motion, time) }));

/** A pen for what stands in a frame. @param {Pen} pen @param {Frame} frame */
function penIn(pen, frame) {
  const { camera } = pen;
  const framed = { scale: camera.scale, toScreen: (/** @type {number} */ x, /** @type {number} */ y) => camera.toScreen(.../** @type {[number, number]} */ (outOf(frame, [x, y]))) };
  return new Pen(pen.ctx, /** @type {any} */ (framed), pen.colours);
}

/** Put outlines into the path of the canvas. @param {Pen} pen @param {Placed[]} moving */
function outlines(pen, moving) {
  pen.ctx.beginPath();
  for (const one of moving) if (one.frame) one.shape.trace(penIn(pen, one.frame), one.item);
}

/** Where things go: lines through their keyframes. @param {Pen} pen @param {Outlined[]} moving @param {{begin: number, end: number}} span [s] @param {string|null} selected */
export function drawTrails(pen, moving, { begin, end }, selected) {
  const { ctx, camera, colours } = pen;
  ctx.lineJoin = ctx.lineCap = "round";
  if (moving.length > MOST_WHOLE) {
    drawWaysOfMany(pen, moving, begin, end);
    moving = moving.filter((one) => one.id === selected);
  }
  for (const one of moving) {
    const colour = one.list === "unseen" ? colours.unseen : colours.moving;
    const line = trailOf(one.item.motion, begin, end).map(([x, y]) => camera.toScreen(x, y));
    ctx.globalAlpha = one.id === selected ? 0.9 : 0.55;
    ctx.beginPath();
    line.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
    pen.stroke(colour, 1.3, [5, 5]);
    if (one.isRecorded) continue;
    const dots = one.item.motion.keyframes ? line : line.slice(0, 1);
    if (dots.length > MOST_DOTS) continue;
    ctx.globalAlpha = 1;
    ctx.beginPath();
    for (const [x, y] of dots) {
      ctx.moveTo(x + 3.2, y);
      ctx.arc(x, y, 3.2, 0, 2 * Math.PI);
    }
    pen.fill(colours.paper);
    pen.stroke(colour, 1.4);
  }
  ctx.globalAlpha = 1;
}

/** @param {Pen} pen @param {Outlined[]} moving @param {number} begin @param {number} end [s] */
function drawWaysOfMany(pen, moving, begin, end) {
  const { ctx, camera, colours } = pen;
  ctx.globalAlpha = 0.35;
  ctx.beginPath();
  for (const way of moving.flatMap((one) => waysOf(one.item.motion, begin, end))) {
    way.map(([x, y]) => camera.toScreen(x, y)).forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
  }
  pen.stroke(colours.moving, 1.1, [4, 4]);
  ctx.globalAlpha = 1;
}

/**
 * What moves, where it is: the room that is kept round it, where it may be, its outline, its velocity.
 * @param {Pen} pen @param {Placed[]} moving
 * @param {{time: number, required: number|null, marked: (string|null)[], isFound: (one: Outlined) => boolean}} how
 */
export function drawMoving(pen, moving, { time, required, marked, isFound }) {
  const { ctx, colours } = pen;
  const there = moving.filter((one) => one.frame);
  const known = there.filter((one) => one.list === "known");
  ctx.lineJoin = "round";
  ctx.globalAlpha = 0.5;
  if (required !== null) drawRooms(pen, known, time, required);
  for (const one of there) drawTube(pen, one, time);
  ctx.globalAlpha = 1;
  outlines(pen, known);
  pen.fill(colours.movingFill);
  pen.stroke(colours.moving, 1.4);
  for (const one of there) if (one.list === "unseen") drawUnseen(pen, one, isFound(one));
  for (const one of there) if (one.frame) drawVelocity(pen, one, one.frame);
  outlines(pen, there.filter((one) => marked.includes(one.id)));
  pen.stroke(colours.select, 1.6);
}

/** @param {Pen} pen @param {Placed[]} known @param {number} time @param {number} required [m] */
function drawRooms(pen, known, time, required) {
  const { camera, colours } = pen;
  for (const [colour, edge] of /** @type {[string, number][]} */ ([[colours.haloEdge, 1.6], [colours.halo, -0.4]])) {
    for (const one of known) {
      const reach = (required + errorAt(one.item.motion, time)) * camera.scale;
      if (reach < 1.5) continue;
      outlines(pen, [one]);
      pen.stroke(colour, 2 * reach + edge);
    }
  }
}

/** Where it may be by then, faint. @param {Pen} pen @param {Placed} one @param {number} time */
function drawTube(pen, one, time) {
  const width = 2 * errorAt(one.item.motion, time) * pen.camera.scale;
  if (width < 1) return;
  outlines(pen, [one]);
  pen.stroke(one.list === "unseen" ? pen.colours.unseenFill : pen.colours.movingTube, width);
}

/** As what stands and isn't on the map. @param {Pen} pen @param {Placed} one @param {boolean} found */
function drawUnseen(pen, one, found) {
  const { ctx, colours } = pen;
  outlines(pen, [one]);
  pen.fill(found ? colours.unseenFill : colours.paper, "evenodd");
  ctx.save();
  ctx.clip("evenodd");
  hatch(pen, boxOnScreen(pen, one), found ? colours.unseen : colours.unseenFill);
  ctx.restore();
  outlines(pen, [one]);
  pen.stroke(colours.unseen, found ? 2 : 1.2, found ? [] : [5, 3]);
}

/** The box round something that moves [CSS pixel]. @param {Pen} pen @param {Placed} one */
export function boxOnScreen({ camera }, { shape, item, frame }) {
  const reach = shape.reach(item) * camera.scale;
  const [x, y] = frame ? camera.toScreen(frame.x, frame.y) : [NaN, NaN];
  return [x - reach, y - reach, x + reach, y + reach];
}

/** An arrow as long as the way in a second. @param {Pen} pen @param {Placed} one @param {Frame} frame */
function drawVelocity(pen, one, frame) {
  const { ctx, camera, colours } = pen;
  const [x, y] = camera.toScreen(frame.x, frame.y);
  const [ex, ey] = camera.toScreen(frame.x + frame.vx * ARROW_S, frame.y + frame.vy * ARROW_S);
  const length = Math.hypot(ex - x, ey - y);
  if (length < SHORTEST_ARROW_PX) return;
  const [ux, uy] = [(ex - x) / length, (ey - y) / length];
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(ex - 5 * ux, ey - 5 * uy);
  pen.stroke(one.list === "unseen" ? colours.unseen : colours.moving, 1.8);
  ctx.beginPath();
  ctx.moveTo(ex, ey);
  ctx.lineTo(ex - 8 * ux - 4 * uy, ey - 8 * uy + 4 * ux);
  ctx.lineTo(ex - 8 * ux + 4 * uy, ey - 8 * uy - 4 * ux);
  ctx.closePath();
  pen.fill(one.list === "unseen" ? colours.unseen : colours.moving);
}
