/** What the robots of a fleet are drawn with: a route, a trail, a disc, an arrow to whom one waits for. */

/** @typedef {import("../draw/pen.js").Pen} Pen */
/** @typedef {{x: number, y: number, heading: number, radius: number, colour: string, isChosen: boolean}} Placed */

const TRAIL_S = 12; // that a trail goes back [s]
const TRAIL_PIECES = 12;
const LEAST_RADIUS_PX = 6.5;

/** @param {Pen} pen @param {{spans: number[], points: any[], colour: string, isStale: boolean, isThin: boolean}} route `isThin`: one of many */
export function drawRoute(pen, { spans, points, colour, isStale, isThin }) {
  const { ctx, camera, colours } = pen;
  ctx.lineCap = ctx.lineJoin = "round";
  if (spans.length) {
    ctx.beginPath();
    pen.spans(spans);
    if (!isStale && !isThin) pen.stroke(colours.casing, 4.5);
    ctx.globalAlpha = isStale || isThin ? 0.5 : 0.85;
    pen.stroke(colour, isThin ? 1.2 : 2, isStale ? [2, 5] : []);
    ctx.globalAlpha = 1;
  }
  for (const point of points) {
    if (!point.at) continue;
    const [x, y] = camera.toScreen(point.at[0], point.at[1]);
    const isEnd = point.id === "start" || point.id === "goal";
    ctx.beginPath();
    const half = isThin ? 2.6 : 4.5;
    if (point.id === "goal") ctx.rect(x - half, y - half, 2 * half, 2 * half);
    else ctx.arc(x, y, isThin ? (isEnd ? 3 : 1.8) : isEnd ? 4.5 : 3, 0, 2 * Math.PI);
    pen.fill(colours.paper);
    pen.stroke(colour, isThin ? 1 : isEnd ? 2 : 1.5);
  }
}

/** Where it was just now, fainter the longer ago. @param {Pen} pen @param {import("../geometry/curve.js").Curve} curve @param {number} now [s] @param {string} colour */
export function drawTrail(pen, curve, now, colour) {
  const { ctx, camera } = pen;
  let before = curve.at(curve.distanceAt(now));
  ctx.lineCap = "round";
  for (let k = 1; k <= TRAIL_PIECES; k += 1) {
    const at = curve.at(curve.distanceAt(now - (TRAIL_S * k) / TRAIL_PIECES));
    if (at.s === before.s) continue;
    ctx.beginPath();
    ctx.moveTo(...camera.toScreen(before.x, before.y));
    ctx.lineTo(...camera.toScreen(at.x, at.y));
    ctx.globalAlpha = 0.6 * (1 - (k - 1) / TRAIL_PIECES);
    pen.stroke(colour, 7);
    before = at;
  }
  ctx.globalAlpha = 1;
}

/** The circle of its body, and which way it looks. @param {Pen} pen @param {Placed} robot */
export function drawDisc(pen, { x, y, heading, radius, colour, isChosen }) {
  const { ctx, camera, colours } = pen;
  const [px, py] = camera.toScreen(x, y);
  const r = Math.max(LEAST_RADIUS_PX, radius * camera.scale);
  ctx.beginPath();
  ctx.arc(px, py, r, 0, 2 * Math.PI);
  pen.fill(colour);
  pen.stroke(isChosen ? colours.ink : colours.casing, isChosen ? 2.4 : 1.4);
  ctx.beginPath();
  ctx.moveTo(px, py);
  ctx.lineTo(px + r * Math.cos(heading), py - r * Math.sin(heading));
  pen.stroke(colours.casing, 1.6);
}

/** An arrow from who waits to whom it waits for. @param {Pen} pen @param {Placed} from @param {Placed} to */
export function drawWait(pen, from, to) {
  const { ctx, camera, colours } = pen;
  const [ax, ay] = camera.toScreen(from.x, from.y);
  const [bx, by] = camera.toScreen(to.x, to.y);
  const gap = Math.max(LEAST_RADIUS_PX, to.radius * camera.scale) + 3;
  const size = Math.hypot(bx - ax, by - ay);
  if (size < gap + 6) return;
  const [ux, uy] = [(bx - ax) / size, (by - ay) / size];
  const [ex, ey] = [bx - ux * gap, by - uy * gap];
  ctx.beginPath();
  ctx.moveTo(ax, ay);
  ctx.lineTo(ex, ey);
  pen.stroke(colours.casing, 4);
  pen.stroke(colours.tightest, 1.8, [6, 4]);
  ctx.beginPath();
  ctx.moveTo(ex, ey);
  ctx.lineTo(ex - 10 * ux + 5 * uy, ey - 10 * uy - 5 * ux);
  ctx.lineTo(ex - 10 * ux - 5 * uy, ey - 10 * uy + 5 * ux);
  ctx.closePath();
  pen.fill(colours.tightest);
}
