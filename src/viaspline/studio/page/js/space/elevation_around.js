/** What stands around a path unrolled: the ground, the altitude band, things under, over and beside it. */

import { TOP_PX } from "./elevation_frame.js";

/** Ground, band and what stands near. @param {import("./elevation_picture.js").ElevationPicture} picture @param {any} profile @param {any} colours @param {number} alpha */
export function drawAround(picture, profile, colours, alpha) {
  const { ctx } = picture;
  const length = picture.app.store.curve.length;
  const last = profile.distances.at(-1) || 1;
  const x = (/** @type {number} */ i) => picture.x((profile.distances[i] / last) * length);
  ctx.globalAlpha = alpha;
  for (const part of runs(profile.ground)) {
    ctx.beginPath();
    part.forEach((i, k) => (k ? ctx.lineTo(x(i), picture.y(profile.ground[i])) : ctx.moveTo(x(i), picture.y(profile.ground[i]))));
    ctx.strokeStyle = colours.contourText;
    ctx.lineWidth = 1.2;
    ctx.stroke();
    ctx.lineTo(x(/** @type {number} */ (part.at(-1))), picture.height);
    ctx.lineTo(x(part[0]), picture.height);
    ctx.closePath();
    ctx.fillStyle = colours.ground;
    ctx.fill();
  }
  picture.named = picture.points().map(({ x: px, y }) => [px, y, 16]);
  for (const near of profile.near) drawSilhouette(picture, near, x, colours);
  for (const edge of [profile.low, profile.high]) {
    for (const part of runs(edge)) {
      ctx.beginPath();
      part.forEach((i, k) => (k ? ctx.lineTo(x(i), picture.y(edge[i])) : ctx.moveTo(x(i), picture.y(edge[i]))));
      ctx.strokeStyle = colours.zone;
      ctx.lineWidth = 1.2;
      ctx.setLineDash([6, 4]);
      ctx.stroke();
      ctx.setLineDash([]);
    }
  }
  ctx.globalAlpha = 1;
}

/** One thing: dark where it is under or over the path, light where it is beside it. @param {import("./elevation_picture.js").ElevationPicture} picture @param {any} near @param {(i: number) => number} x @param {any} colours */
function drawSilhouette(picture, { first, low, high, meets, name }, x, colours) {
  const { ctx } = picture;
  const half = (x(1) - x(0)) / 2;
  for (const dark of [0, 1]) {
    ctx.fillStyle = dark ? colours.obstacle : colours.halo;
    ctx.strokeStyle = dark ? colours.obstacleEdge : colours.haloEdge;
    for (const part of runs(meets.map((/** @type {number} */ m) => (m === dark ? 1 : null)))) {
      ctx.beginPath();
      part.forEach((i, k) => (k ? ctx.lineTo(x(first + i) + half, picture.y(high[i])) : ctx.moveTo(x(first + i) - half, picture.y(high[i]))));
      if (part.length === 1) ctx.lineTo(x(first + part[0]) + half, picture.y(high[part[0]]));
      [...part].reverse().forEach((i, k) => ctx.lineTo(x(first + i) + (k ? -half : half), picture.y(low[i])));
      ctx.closePath();
      ctx.fill();
      ctx.lineWidth = 1;
      ctx.stroke();
    }
  }
  const [left, right] = [x(first), x(first + low.length - 1)];
  const wide = 5.5 * name.length;
  ctx.fillStyle = colours.muted;
  ctx.font = "500 10px Inter, system-ui, sans-serif";
  ctx.textAlign = "center";
  const x0 = (left + right) / 2, y0 = Math.max(picture.y(high[Math.floor(high.length / 2)]) - 7, TOP_PX);
  const isTaken = picture.named.some(([other, y, half]) => Math.abs(x0 - other) < (wide + half) / 2 + 4 && Math.abs(y0 - y) < 12);
  if (!name || right - left < wide || isTaken) return;
  picture.named.push([x0, y0, wide]);
  ctx.fillText(name, x0, y0);
}

/** The indices of values that are there, in runs. @param {(number|null)[]} values @returns {number[][]} */
function runs(values) {
  /** @type {number[][]} */ const found = [];
  values.forEach((value, i) => {
    if (value === null) return;
    if (i && values[i - 1] !== null && found.length) /** @type {number[]} */ (found.at(-1)).push(i);
    else found.push([i]);
  });
  return found;
}
