/** Heights on the map: contour lines of the ground, voxels, the heights of roofs, of points and of the provisional path. */

/** @typedef {import("../draw/pen.js").Pen} Pen */

const LEAST_ROOM_PX = 30; // width of an outline that has room for the height of its roof
const MOST_ROOFS = 60;
const CONTOUR_LABEL_PX = 130; // of a line at least that is told its height

export class PlanLayer {
  /** @param {import("./space.js").Space} space */
  constructor(space) {
    this.space = space;
    /** @type {Map<any, HTMLImageElement>} */ this.images = new Map();
    this.arrived = 0;
  }

  /** Another scene: its pictures are other ones. */
  forget() {
    this.images.clear();
  }

  /** What of it stands still while points are dragged: a change of it means to draw the ground anew. */
  get key() {
    return this.space.isOn ? `${this.space.name}/${this.space.scene !== null}/${this.arrived}` : "";
  }

  /** Under everything else. @param {Pen} pen */
  drawGround(pen) {
    const { scene, isOn } = this.space;
    if (!isOn || !scene) return;
    const { ctx, camera, colours } = pen;
    ctx.lineJoin = "round";
    for (const { line } of scene.contours) {
      ctx.beginPath();
      for (let i = 0; i < line.length; i += 2) {
        const [x, y] = camera.toScreen(line[i], line[i + 1]);
        if (i) ctx.lineTo(x, y);
        else ctx.moveTo(x, y);
      }
      pen.stroke(colours.contour, 1);
    }
    this.drawContourHeights(pen);
    for (const solid of scene.solids) if (solid.kind === "voxels") this.drawVoxels(pen, solid);
  }

  /** @param {Pen} pen */
  drawContourHeights(pen) {
    const { ctx, camera, colours } = pen;
    ctx.font = "500 10px Inter, system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    for (const { height, line } of this.space.scene.contours) {
      const count = line.length / 2;
      const k = 2 * Math.floor(count * 0.35);
      const last = Math.min(k + 2 * Math.max(1, Math.floor(count / 40)), line.length - 2);
      const [x0, y0] = camera.toScreen(line[k], line[k + 1]);
      const [x1, y1] = camera.toScreen(line[last], line[last + 1]);
      let length = 0;
      for (let i = 2; i < line.length && length < CONTOUR_LABEL_PX; i += 2) length += camera.scale * Math.hypot(line[i] - line[i - 2], line[i + 1] - line[i - 1]);
      if (length < CONTOUR_LABEL_PX) continue;
      let angle = Math.atan2(y1 - y0, x1 - x0);
      if (Math.abs(angle) > Math.PI / 2) angle += Math.PI; // never on its head
      ctx.save();
      ctx.translate(x0, y0);
      ctx.rotate(angle);
      const text = String(height), w = ctx.measureText(text).width + 6;
      ctx.fillStyle = colours.paper;
      ctx.fillRect(-w / 2, -6, w, 12);
      ctx.fillStyle = colours.contourText;
      ctx.fillText(text, 0, 0);
      ctx.restore();
    }
  }

  /** @param {Pen} pen @param {any} solid */
  drawVoxels(pen, solid) {
    let image = this.images.get(solid);
    if (!image) {
      image = new Image();
      image.onload = () => {
        this.arrived += 1;
        this.space.app.scene.later();
      };
      image.src = `data:image/png;base64,${solid.roofs}`;
      this.images.set(solid, image);
    }
    if (!image.complete || !image.naturalWidth) return;
    const { ctx, camera } = pen;
    const [x0, y0, , x1, y1] = solid.extent;
    const [left, top] = camera.toScreen(x0, y1), [right, bottom] = camera.toScreen(x1, y0);
    ctx.imageSmoothingEnabled = false;
    ctx.globalAlpha = solid.list === "unseen" ? 0.4 : pen.isDark ? 0.55 : 1;
    ctx.drawImage(image, left, top, right - left, bottom - top);
    ctx.globalAlpha = 1;
  }

  /** The legs that aren't planned yet as they are asked for. @param {Pen} pen */
  drawProvisional(pen) {
    const { ctx, camera, colours } = pen;
    for (const line of this.space.provisional()) {
      ctx.beginPath();
      line.forEach(([x, y], i) => {
        const [px, py] = camera.toScreen(x, y);
        if (i) ctx.lineTo(px, py);
        else ctx.moveTo(px, py);
      });
      pen.stroke(colours.select, 1.6, [3, 4]);
    }
  }

  /** Heights of roofs, and of the point that is selected. @param {Pen} pen @returns {import("../draw/labels.js").Label[]} */
  labels(pen) {
    const { isOn, scene, app } = this.space;
    if (!isOn || !scene) return [];
    const { camera, colours } = pen;
    const found = [];
    for (const solid of scene.solids) {
      const box = boxOf(solid);
      if (!box || solid.kind === "voxels" || found.length >= MOST_ROOFS) continue;
      const [left, bottom] = camera.toScreen(box[0], box[1]), [right, top] = camera.toScreen(box[2], box[3]);
      if (right - left < LEAST_ROOM_PX || right < 0 || left > camera.width || top > camera.height || bottom < 0) continue;
      const text = heightWords(solid);
      if (text) found.push({ text, x: (left + right) / 2, y: (top + bottom) / 2 + 16, away: 0, colour: colours.muted, rank: 5 });
    }
    const { selection } = app.store;
    const point = selection && this.space.points().find(({ id }) => id === selection);
    if (point) {
      const words = this.space.words(point.id);
      const [x, y] = camera.toScreen(point.at[0], point.at[1]);
      if (words) found.push({ text: words, x, y: y + 4, away: 18, colour: colours.select, bold: true, rank: 0, plate: true });
    }
    return found;
  }
}

/** From where to where a solid reaches in height. @param {any} solid */
export function heightWords(solid) {
  if (solid.kind !== "prism") return "";
  const { low, high } = solid;
  const say = (/** @type {number} */ z) => String(Number(z.toFixed(1)));
  if (high === null) return low === null ? "every height" : `above ${say(low)} m`;
  return low === null || low <= 0 ? `${say(high)} m` : `${say(low)}–${say(high)} m`;
}

/** The box of a solid from above [m]. @param {any} solid @returns {number[]|null} */
export function boxOf(solid) {
  if (solid.kind === "voxels") return [solid.extent[0], solid.extent[1], solid.extent[3], solid.extent[4]];
  if (solid.kind === "segment") {
    const { first: a, last: b, radius: r } = solid;
    return [Math.min(a[0], b[0]) - r, Math.min(a[1], b[1]) - r, Math.max(a[0], b[0]) + r, Math.max(a[1], b[1]) + r];
  }
  const rings = solid.parts.map((/** @type {number[][]} */ part) => part[0]);
  if (!rings.length) return null;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const ring of rings) {
    for (let i = 0; i < ring.length; i += 2) {
      box[0] = Math.min(box[0], ring[i]);
      box[1] = Math.min(box[1], ring[i + 1]);
      box[2] = Math.max(box[2], ring[i]);
      box[3] = Math.max(box[3], ring[i + 1]);
    }
  }
  return box;
}
