/**
 * Where what moves is: a motion as it stands in a mission, at an instant of the mission's clock. It
 * says where things are drawn and nothing else; what is proven of them comes from the server.
 */

const TRAIL_PIECES = 60;
const JUMP_RATIO = 1.5; // a step longer than it goes in its time is a jump

/** @typedef {{x: number, y: number, z: number, heading: number, vx: number, vy: number}} Frame a place [m], z 0 in the plane; a heading [rad], a velocity [m/s] */
/** @typedef {Record<string, any>} Motion */

/** Whether a motion says where something is. @param {any} motion */
export function isMotion(motion) {
  const pair = (/** @type {any} */ p) => Array.isArray(p) && p.length >= 2 && p.length <= 3 && p.every(Number.isFinite);
  const frame = (/** @type {any} */ k) => Array.isArray(k) && k.length >= 3 && k.length <= 5 && k.every(Number.isFinite);
  const { keyframes } = motion ?? {};
  return Array.isArray(keyframes) ? keyframes.length > 0 && keyframes.every(frame) : pair(motion?.from) && pair(motion?.velocity_mps);
}

/** Whether a motion says heights: it is one in space. @param {Motion} motion */
export const isLifted = ({ keyframes, from }) => (keyframes ? keyframes.some((/** @type {number[]} */ k) => k.length > 4) : from.length > 2);

/** @param {Motion} motion @param {number} time [s] @returns {Frame|null} null while it isn't there */
export function frameAt(motion, time) {
  const { keyframes: frames } = motion;
  if (!frames) {
    const [vx, vy, vz = 0] = motion.velocity_mps;
    const [x, y, z = 0] = motion.from;
    return { x: x + vx * time, y: y + vy * time, z: z + vz * time, heading: 0, vx, vy };
  }
  const first = frames[0][0], last = frames.at(-1)[0], lasts = last - first;
  const goesOn = motion.after === "loop" || motion.after === "bounce";
  if (goesOn && lasts > 0) return onRound(motion, time, first, lasts);
  if (time < first) {
    const isAbsent = motion.before ? motion.before === "absent" : motion.after === "vanish";
    return isAbsent ? null : standing(frames, 0);
  }
  if (time >= last) return motion.after === "vanish" ? null : standing(frames, frames.length - 1);
  return between(frames, time, 1);
}

/** @param {Motion} motion @param {number} time @param {number} first @param {number} lasts [s] */
function onRound(motion, time, first, lasts) {
  const round = motion.after === "loop" ? lasts : 2 * lasts;
  const done = time - first - Math.floor((time - first) / round) * round;
  return done < lasts ? between(motion.keyframes, first + done, 1) : between(motion.keyframes, first + 2 * lasts - done, -1);
}

/** On the way from one keyframe to the next, or back. @param {number[][]} frames @param {number} time @param {1|-1} way @returns {Frame} */
function between(frames, time, way) {
  let low = 0, high = Math.max(frames.length - 2, 0);
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (frames[middle][0] <= time) low = middle;
    else high = middle - 1;
  }
  const a = frames[low], b = frames[low + 1] ?? a;
  const lasts = b[0] - a[0] || 1;
  const share = Math.min(Math.max((time - a[0]) / lasts, 0), 1);
  const next = Math.min(low + 1, frames.length - 1);
  const from = headingOf(frames, low), to = headingOf(frames, next), z = heightOf(frames, low);
  return {
    x: a[1] + share * (b[1] - a[1]), y: a[2] + share * (b[2] - a[2]), z: z + share * (heightOf(frames, next) - z), heading: from + share * (to - from),
    vx: (way * (b[1] - a[1])) / lasts, vy: (way * (b[2] - a[2])) / lasts,
  };
}

/** @param {number[][]} frames @param {number} index @returns {Frame} */
const standing = (frames, index) => ({ x: frames[index][1], y: frames[index][2], z: heightOf(frames, index), heading: headingOf(frames, index), vx: 0, vy: 0 });

/** The heading of a keyframe [rad]: its own, or that of one before. @param {number[][]} frames @param {number} index */
function headingOf(frames, index) {
  for (let i = index; i >= 0; i -= 1) if (frames[i].length > 3) return (frames[i][3] * Math.PI) / 180;
  return 0;
}

/** The height of a keyframe [m]: its own, or that of one before. @param {number[][]} frames @param {number} index */
function heightOf(frames, index) {
  for (let i = index; i >= 0; i -= 1) if (frames[i].length > 4) return frames[i][4];
  return 0;
}

/** How far from there it may be [m]. @param {Motion} motion @param {number} time [s] */
export function errorAt({ error }, time) {
  return Number(error?.position_m ?? 0) + Number(error?.growth_mps ?? 0) * Math.max(0, time);
}

/** From the frame of a thing to the map. @param {Frame} frame @param {number[]} at */
export function outOf({ x, y, heading }, [px, py]) {
  const c = Math.cos(heading), s = Math.sin(heading);
  return [x + c * px - s * py, y + s * px + c * py];
}

/** From the map to the frame of a thing. @param {Frame} frame @param {number[]} at */
export function into({ x, y, heading }, [px, py]) {
  const c = Math.cos(heading), s = Math.sin(heading);
  return [c * (px - x) + s * (py - y), -s * (px - x) + c * (py - y)];
}

/** The lines that it goes along from one time to another, cut where it jumps or isn't there. @param {Motion} motion @param {number} begin @param {number} end [s] @returns {number[][][]} */
export function waysOf(motion, begin, end) {
  const step = (end - begin) / TRAIL_PIECES;
  /** @type {number[][][]} */ const ways = [[]];
  /** @type {Frame|null} */ let before = null;
  for (let i = 0; i <= TRAIL_PIECES; i += 1) {
    const now = frameAt(motion, begin + i * step);
    const reach = now && before ? JUMP_RATIO * step * Math.max(Math.hypot(now.vx, now.vy), Math.hypot(before.vx, before.vy)) : 0;
    const isCut = !now || !before || Math.hypot(now.x - before.x, now.y - before.y) > reach + 1e-9;
    if (isCut && ways.at(-1)?.length) ways.push([]);
    if (now) ways.at(-1)?.push([now.x, now.y]);
    before = now;
  }
  return ways.filter((way) => way.length > 1);
}

/** The line that it goes along, from one time to another if it has no keyframes. @param {Motion} motion @param {number} begin @param {number} end [s] @returns {number[][]} */
export function trailOf(motion, begin, end) {
  if (motion.keyframes) return motion.keyframes.map((/** @type {number[]} */ k) => k.slice(1, 3));
  return [begin, end].map((time) => {
    const { x, y } = /** @type {Frame} */ (frameAt(motion, time));
    return [x, y];
  });
}
