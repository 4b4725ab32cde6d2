/** The path, what was weighed, the points of the route, gates, what is looked at, the altitude band. */

import * as THREE from "../../../vendor/three.min.js";
import { viridis } from "../../draw/theme.js";
import { linesOf, materialOf, tubeOf } from "./meshes.js";

/** @typedef {import("./colours.js").SolidColours} SolidColours */

const MARK_PX = 22; // of a point of the route
const TUBE_SHARE = 0.0028; // of what is seen: the radius of the path
const MOST_SAMPLES = 700;
const SHADES = 40; // of speed

/** @type {Map<string, any>} */ const pictures = new Map();

/** The path as a tube, coloured by speed. @param {any} app @param {number[]} origin @param {number} size of what is seen [m] @param {SolidColours} colours */
export function pathOf({ store }, origin, size, colours) {
  const { curve, doc, show } = store;
  const list = curve.solidSamples;
  const step = Math.max(1, Math.ceil(list.length / MOST_SAMPLES));
  const some = list.filter((/** @type {any} */ _, /** @type {number} */ i) => i % step === 0 || i === list.length - 1)
    .filter((/** @type {any} */ p, /** @type {number} */ i, /** @type {any[]} */ all) => !i || Math.hypot(p.x - all[i - 1].x, p.y - all[i - 1].y, p.z - all[i - 1].z) > 1e-6);
  const line = some.map(({ x, y, z }) => [x, y, z]);
  const radius = size * TUBE_SHARE;
  if (store.plan?.ok === false || store.isLate) return dashed(line, origin, colours.stale, radius);
  const top = Number(doc.robot?.max_speed_mps ?? 2) || 1;
  const plain = new THREE.Color(colours.path);
  const shades = Array.from({ length: SHADES + 1 }, (_, k) => new THREE.Color(viridis(k / SHADES)).toArray());
  const one = plain.toArray();
  const colourOf = (/** @type {number} */ i) => {
    if (!show.speed) return one;
    return shades[Math.min(Math.max(Math.round((some[i].speed / top) * SHADES), 0), SHADES)];
  };
  return new THREE.Mesh(tubeOf(line, origin, radius, colourOf), materialOf("MeshLambertMaterial", { vertexColors: true }));
}

/** @param {number[][]} line @param {number[]} origin @param {string} color @param {number} radius [m] */
export function dashed(line, origin, color, radius) {
  const places = line.flatMap((p) => [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  const found = new THREE.Line(geometry, materialOf("LineDashedMaterial", { color, dashSize: 5 * radius, gapSize: 4 * radius }));
  found.computeLineDistances();
  return found;
}

/** The ways on other sides that were weighed. @param {any[]} ledger @param {number[]} origin @param {SolidColours} colours @param {number} radius [m] */
export function losersOf(ledger, origin, colours, radius) {
  const group = new THREE.Group();
  for (const entry of ledger) {
    for (const candidate of entry.candidates) {
      if (candidate.chosen || !candidate.spans3?.length) continue;
      group.add(dashed(linesAlong(candidate.spans3), origin, colours.loser, radius));
    }
  }
  return group;
}

/** Places along Bézier spans, x, y, z in turn. @param {number[]} spans @returns {number[][]} */
function linesAlong(spans) {
  const line = [];
  for (let k = 0; k < spans.length; k += 12) {
    for (let j = k ? 1 : 0; j <= 10; j += 1) {
      const w = j / 10, v = 1 - w;
      line.push([0, 1, 2].map((axis) => v * v * v * spans[k + axis] + 3 * v * v * w * spans[k + 3 + axis] + 3 * v * w * w * spans[k + 6 + axis] + w * w * w * spans[k + 9 + axis]));
    }
  }
  return line;
}

/** A round mark of always the same size on the screen. @param {string} label @param {string} fill @param {string} ink @param {string} edge @param {boolean} isSquare @param {boolean} isMarked */
function picture(label, fill, ink, edge, isSquare, isMarked) {
  const key = [label, fill, ink, edge, isSquare, isMarked].join();
  const kept = pictures.get(key);
  if (kept) return kept;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  ctx.beginPath();
  if (isSquare) ctx.roundRect(9, 9, 46, 46, 9);
  else ctx.arc(32, 32, 24, 0, 2 * Math.PI);
  ctx.fillStyle = fill;
  ctx.fill();
  ctx.lineWidth = isMarked ? 9 : 4;
  ctx.strokeStyle = edge;
  ctx.stroke();
  ctx.fillStyle = ink;
  ctx.font = `600 ${label.length > 2 ? 22 : 28}px Inter, system-ui, sans-serif`;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(label, 32, 34);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = "srgb";
  /** @type {any} */ (texture).isKept = true;
  if (pictures.size > 400) pictures.clear();
  pictures.set(key, texture);
  return texture;
}

/** @param {any} texture @param {number[]} at @param {number[]} origin @param {number} share of the height of the view */
function sprite(texture, at, origin, share) {
  const found = new THREE.Sprite(materialOf("SpriteMaterial", { sizeAttenuation: false, depthTest: false, transparent: true }, texture));
  found.position.set(at[0] - origin[0], at[1] - origin[1], at[2] - origin[2]);
  found.scale.setScalar(share);
  found.renderOrder = 10;
  return found;
}

/**
 * The points of the route, each with a line down to the ground.
 * @param {any} app @param {any[]} points @param {(x: number, y: number) => number|null} groundAt @param {number[]} origin
 * @param {SolidColours} colours @param {number} perPixel how much of the view's height a pixel is, times the lens
 */
export function pointsOf({ store }, points, groundAt, origin, colours, perPixel) {
  const group = new THREE.Group();
  const stems = [];
  points.forEach(({ id, at, dwell }, i) => {
    const isLast = id === "goal" || id === "land", isSelected = id === store.selection;
    const fill = id === "start" ? colours.start : isLast ? colours.goal : dwell > 0 ? colours.station : colours.paper;
    const ink = id === "start" || isLast ? colours.paper : dwell > 0 ? "#1b1f24" : colours.ink;
    const label = id === "start" ? "S" : id === "goal" ? "G" : id === "land" ? "L" : String(i);
    group.add(sprite(picture(label, fill, ink, isSelected ? colours.select : colours.ink, dwell > 0, isSelected), at, origin, MARK_PX * perPixel * (isSelected ? 1.3 : 1)));
    const ground = groundAt(at[0], at[1]);
    if (ground !== null && at[2] - ground > 0.05) stems.push([at, [at[0], at[1], ground]]);
  });
  if (stems.length) group.add(new THREE.LineSegments(linesOf(stems, origin), materialOf("LineBasicMaterial", { color: colours.muted, transparent: true, opacity: 0.7 })));
  return group;
}

/** The handle above the selected point that lifts it. @param {number[]} at @param {number[]} origin @param {SolidColours} colours @param {number} perPixel */
export function handleOf(at, origin, colours, perPixel) {
  return sprite(picture("↕", colours.paper, colours.select, colours.select, true, false), at, origin, 20 * perPixel);
}

/** Gates as frames, each with an arrow through it. @param {any} doc @param {number[]} origin @param {SolidColours} colours */
export function gatesOf(doc, origin, colours) {
  const group = new THREE.Group();
  const lines = [];
  for (const { gate } of (Array.isArray(doc.route?.via) ? doc.route.via : []).filter((/** @type {any} */ via) => Array.isArray(via?.gate?.at))) {
    const [x, y, z] = gate.at, angle = (Number(gate.facing_deg ?? 0) * Math.PI) / 180;
    const w = Number(gate.width_m ?? 1) / 2, t = Number(gate.height_m ?? 1) / 2;
    const ahead = [Math.cos(angle), Math.sin(angle)], left = [-ahead[1], ahead[0]];
    const corner = (/** @type {number} */ a, /** @type {number} */ b) => [x + a * w * left[0], y + a * w * left[1], z + b * t];
    const to = (/** @type {number} */ f, /** @type {number} */ s) => [x + f * w * ahead[0] + s * w * left[0], y + f * w * ahead[1] + s * w * left[1], z];
    lines.push([corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1), corner(1, 1)], [to(0, 0), to(1.2, 0)], [to(0.9, 0.2), to(1.2, 0), to(0.9, -0.2)]);
    const pane = new THREE.PlaneGeometry(2 * w, 2 * t);
    pane.rotateX(Math.PI / 2);
    pane.rotateZ(angle + Math.PI / 2);
    pane.translate(x - origin[0], y - origin[1], z - origin[2]);
    group.add(new THREE.Mesh(pane, materialOf("MeshBasicMaterial", { color: colours.corridor, transparent: true, opacity: 0.22, side: THREE.DoubleSide, depthWrite: false })));
  }
  if (lines.length) group.add(new THREE.LineSegments(linesOf(lines, origin), materialOf("LineBasicMaterial", { color: colours.corridor })));
  return group;
}

/** Lines from points to what they look at. @param {any} doc @param {any[]} points @param {number[]} origin @param {SolidColours} colours @param {number} radius [m] */
export function looksOf(doc, points, origin, colours, radius) {
  const group = new THREE.Group();
  for (const { id, at } of points) {
    const via = id.startsWith("via:") ? doc.route.via[Number(id.slice(4))] : null;
    const look = via?.look_at;
    if (!Array.isArray(look) || look.length !== 3 || !look.every(Number.isFinite)) continue;
    group.add(dashed([at, look], origin, colours.sensor, radius));
  }
  return group;
}

/** The altitude band as faint sheets: even ones, or ones above the ground. @param {(number|null)[]} band @param {any} scene @param {number[][]} path @param {number[]} origin @param {SolidColours} colours */
export function bandOf([low, high, aboveLeast, aboveMost], scene, path, origin, colours) {
  const group = new THREE.Group();
  const material = () => materialOf("MeshBasicMaterial", { color: colours.band, transparent: true, opacity: 0.1, side: THREE.DoubleSide, depthWrite: false });
  const x = path.map((p) => p[0]), y = path.map((p) => p[1]);
  const box = scene.bounds ?? [Math.min(...x) - 10, Math.min(...y) - 10, Math.max(...x) + 10, Math.max(...y) + 10];
  for (const z of [low, high]) {
    if (z === null) continue;
    const sheet = new THREE.PlaneGeometry(box[2] - box[0], box[3] - box[1]);
    sheet.translate((box[0] + box[2]) / 2 - origin[0], (box[1] + box[3]) / 2 - origin[1], z - origin[2]);
    group.add(new THREE.Mesh(sheet, material()));
    const rim = [[box[0], box[1], z], [box[2], box[1], z], [box[2], box[3], z], [box[0], box[3], z], [box[0], box[1], z]];
    group.add(new THREE.LineSegments(linesOf([rim], origin), materialOf("LineBasicMaterial", { color: colours.band, transparent: true, opacity: 0.8 })));
  }
  for (const above of [aboveLeast, aboveMost]) {
    if (above === null || !scene.terrain) continue;
    group.add(new THREE.LineSegments(linesOf(draped(scene.terrain, above), origin), materialOf("LineBasicMaterial", { color: colours.band, transparent: true, opacity: 0.4 })));
  }
  return group;
}

const DRAPED = 12; // lines each way of a sheet above the ground

/** Lines that follow the ground at a height above it. @param {any} terrain @param {number} above [m] */
function draped({ origin, cell, nx, ny, heights }, above) {
  /** @type {number[][][]} */ const lines = [];
  const place = (/** @type {number} */ i, /** @type {number} */ j) => {
    const z = heights[j * nx + i];
    return z === null ? null : [origin[0] + i * cell, origin[1] + j * cell, z + above];
  };
  const lay = (/** @type {(number[]|null)[]} */ row) => {
    /** @type {number[][]} */ let line = [];
    for (const at of [...row, null]) {
      if (at) line.push(at);
      else if (line.length) {
        lines.push(line);
        line = [];
      }
    }
  };
  const some = (/** @type {number} */ n) => Array.from({ length: DRAPED }, (_, k) => Math.round((k * (n - 1)) / (DRAPED - 1)));
  for (const j of some(ny)) lay(Array.from({ length: nx }, (_, i) => place(i, j)));
  for (const i of some(nx)) lay(Array.from({ length: ny }, (_, j) => place(i, j)));
  return lines;
}
