/** Obstacles, the room that is kept round them, and what is not on the robot's map. */

import { outlined } from "../core/mission.js";

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {import("../core/mission.js").Obstacle} Obstacle */
/** @typedef {import("../core/mission.js").Outlined} Outlined */

/** One ring round all obstacles together: strokes that join, an edge first and then its inside. @param {Pen} pen @param {Outlined[]} known @param {number} required [m] */
export function drawHalos(pen, known, required) {
  const { ctx, camera, colours } = pen;
  const reach = required * camera.scale;
  if (reach < 1.5) return;
  ctx.lineJoin = "round";
  ctx.beginPath();
  for (const obstacle of known) pen.shape(obstacle);
  pen.stroke(colours.haloEdge, 2 * reach + 1.6);
  pen.stroke(colours.halo, 2 * reach - 0.4);
}

/** @param {Pen} pen @param {Outlined[]} known */
export function drawKnown(pen, known) {
  const { ctx, colours } = pen;
  ctx.lineJoin = "round";
  ctx.beginPath();
  for (const obstacle of known) pen.shape(obstacle);
  pen.fill(colours.obstacle, "nonzero");
  pen.stroke(colours.obstacleEdge, 1.2);
  for (const obstacle of known) if (obstacle.side) drawSide(pen, obstacle);
}

/** @param {Pen} pen @param {Outlined[]} known @param {string|null} hover */
export function drawHovered(pen, known, hover) {
  const under = hover ? known.find((obstacle) => obstacle.id === hover) : null;
  if (!under) return;
  pen.ctx.beginPath();
  pen.shape(under);
  pen.stroke(pen.colours.select, 1.5);
}

/** Polygons with holes can't be filled together with others. @param {Pen} pen @param {Outlined} obstacle */
export function drawPierced(pen, obstacle) {
  pen.ctx.beginPath();
  pen.shape(obstacle);
  pen.fill(pen.colours.obstacle, "evenodd");
  pen.stroke(pen.colours.obstacleEdge, 1.2);
}

/** @param {Pen} pen @param {Obstacle[]} unseen @param {(obstacle: Obstacle) => boolean} isFound @param {string|null} hover */
export function drawUnseen(pen, unseen, isFound, hover) {
  const { ctx, colours } = pen;
  for (const obstacle of outlined(unseen)) {
    const found = isFound(obstacle);
    ctx.beginPath();
    pen.shape(obstacle);
    pen.fill(found ? colours.unseenFill : colours.paper, "evenodd");
    ctx.save();
    ctx.clip("evenodd");
    hatch(pen, screenBox(pen.camera, obstacle), found ? colours.unseen : colours.unseenFill);
    ctx.restore();
    ctx.beginPath();
    pen.shape(obstacle);
    const isHovered = obstacle.id === hover;
    pen.stroke(isHovered ? colours.select : colours.unseen, found ? 2 : 1.2, found ? [] : [5, 3]);
  }
}

/** Lines across a box. @param {Pen} pen @param {number[]} box [CSS pixel] @param {string} colour */
export function hatch(pen, box, colour) {
  const { ctx, camera } = pen;
  const [x0, y0, x1, y1] = [Math.max(box[0], -9), Math.max(box[1], -9), Math.min(box[2], camera.width + 9), Math.min(box[3], camera.height + 9)];
  if (x1 <= x0 || y1 <= y0) return;
  ctx.beginPath();
  for (let c = Math.floor((x0 - (y1 - y0)) / 7) * 7; c < x1; c += 7) {
    ctx.moveTo(c, y1);
    ctx.lineTo(c + (y1 - y0), y0);
  }
  pen.stroke(colour, 1.2);
}

/** The box round an obstacle [CSS pixel]. @param {import("../geometry/camera.js").Camera} camera @param {Outlined} obstacle */
export function screenBox(camera, { shape, item }) {
  const [x0, y0, x1, y1] = shape.box(item) ?? [0, 0, 0, 0];
  const [left, bottom] = camera.toScreen(x0, y0), [right, top] = camera.toScreen(x1, y1);
  return [left, top, right, bottom];
}

/** The side that is asked for, as a letter in the obstacle's middle. @param {Pen} pen @param {Outlined} obstacle */
function drawSide(pen, obstacle) {
  const { ctx, camera, colours } = pen;
  const [x0, y0, x1, y1] = screenBox(camera, obstacle);
  if (x1 - x0 < 16) return;
  const [x, y] = [(x0 + x1) / 2, (y0 + y1) / 2];
  ctx.beginPath();
  ctx.roundRect(x - 8, y - 8, 16, 16, 4);
  pen.fill(colours.loser);
  ctx.fillStyle = colours.paper;
  ctx.font = "600 10px Inter, system-ui, sans-serif";
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(obstacle.side === "left" ? "L" : "R", x, y + 0.5);
}
