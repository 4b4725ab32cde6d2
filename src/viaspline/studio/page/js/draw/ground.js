/** What the robot drives on: the grid of lengths, maps of squares, bounds and fences. */

/** @typedef {import("./pen.js").Pen} Pen */

/** @param {Pen} pen */
export function drawGrid(pen) {
  const { ctx, camera, colours } = pen;
  const step = camera.step(28);
  const [x0, y1] = camera.toWorld(0, 0);
  const [x1, y0] = camera.toWorld(camera.width, camera.height);
  const lines = (/** @type {number} */ every, /** @type {string} */ colour) => {
    ctx.beginPath();
    for (let i = Math.ceil(x0 / every); i * every <= x1; i += 1) {
      const x = Math.round(camera.toScreen(i * every, 0)[0]) + 0.5;
      ctx.moveTo(x, 0);
      ctx.lineTo(x, camera.height);
    }
    for (let i = Math.ceil(y0 / every); i * every <= y1; i += 1) {
      const y = Math.round(camera.toScreen(0, i * every)[1]) + 0.5;
      ctx.moveTo(0, y);
      ctx.lineTo(camera.width, y);
    }
    pen.stroke(colour, 1);
  };
  lines(step, colours.grid);
  lines(step * 5, colours.gridBold);
}

/** Shade what lies beyond the bounds and the fences. @param {Pen} pen @param {any} doc */
export function drawOutside(pen, doc) {
  const { ctx, camera, colours } = pen;
  for (const ring of limitsOf(doc)) {
    ctx.beginPath();
    ctx.rect(0, 0, camera.width, camera.height);
    pen.ring(ring);
    pen.fill(colours.outside, "evenodd");
  }
}

/** @param {Pen} pen @param {any} doc @param {number} required [m] @param {boolean} rings */
export function drawLimits(pen, doc, required, rings) {
  const { ctx, colours } = pen;
  for (const ring of limitsOf(doc)) {
    ctx.beginPath();
    pen.ring(ring);
    pen.stroke(colours.bounds, 1.5);
  }
  const box = doc.world?.bounds;
  if (rings && Array.isArray(box) && box[2] - box[0] > 2 * required && box[3] - box[1] > 2 * required) {
    const [x0, y0, x1, y1] = [box[0] + required, box[1] + required, box[2] - required, box[3] - required];
    ctx.beginPath();
    pen.ring([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
    pen.stroke(colours.haloEdge, 1, [3, 4]);
  }
}

/** @param {any} doc @returns {number[][][]} */
function limitsOf(doc) {
  const rings = (Array.isArray(doc.world?.fences) ? doc.world.fences : []).filter((/** @type {any} */ r) => Array.isArray(r) && r.length > 2);
  const box = doc.world?.bounds;
  if (Array.isArray(box) && box.length === 4 && box.every(Number.isFinite)) {
    rings.unshift([[box[0], box[1]], [box[2], box[1]], [box[2], box[3]], [box[0], box[3]]]);
  }
  return rings;
}

/** Pictures of maps, fetched once and coloured for the theme. */
export class MapPictures {
  /** @param {() => void} arrived */
  constructor(arrived) {
    this.arrived = arrived;
    /** @type {Map<string, HTMLImageElement>} */ this.images = new Map();
    /** @type {Map<string, HTMLCanvasElement>} */ this.made = new Map();
    this.query = location.search;
    this.count = 0; // pictures that are there
  }

  /** @param {Pen} pen @param {any[]} grids @param {number} required [m] @param {boolean} rings */
  draw(pen, grids, required, rings) {
    for (const grid of grids) {
      if (!grid.picture) continue;
      const image = this.images.get(grid.picture) ?? this.load(grid.picture);
      if (!image.complete || !image.naturalWidth) continue;
      const pad = rings ? Math.ceil(required / grid.resolution) + 1 : 0;
      const finest = Math.max(1, Math.min(4, Math.floor(3000 / Math.max(grid.width, grid.height))));
      const canvas = this.coloured(grid, image, pen.colours, rings ? required / grid.resolution : 0, pad, finest);
      const { ctx, camera } = pen;
      const [px, py] = camera.toScreen(grid.origin[0], grid.origin[1]);
      const size = grid.resolution * camera.scale;
      ctx.save();
      ctx.translate(px, py);
      ctx.rotate(-grid.origin[2]);
      ctx.imageSmoothingEnabled = size < 1.5;
      ctx.drawImage(canvas, -pad * size, (-grid.height - pad) * size, (grid.width + 2 * pad) * size, (grid.height + 2 * pad) * size);
      ctx.restore();
    }
  }

  /** @param {string} name */
  load(name) {
    const image = new Image();
    image.onload = () => {
      this.count += 1;
      this.arrived();
    };
    image.src = `/grids/${name}.png${this.query}`;
    this.images.set(name, image);
    return image;
  }

  /**
   * The squares in the theme's colours, with the clearance round them as a halo.
   * @param {any} grid @param {HTMLImageElement} image @param {import("./theme.js").Theme} colours
   * @param {number} reach [cells] @param {number} pad [cells] @param {number} k pixels a cell
   */
  coloured(grid, image, colours, reach, pad, k) {
    const key = [grid.picture, colours.paper, grid.list, reach.toFixed(2)].join();
    const old = this.made.get(key);
    if (old) return old;
    const blocked = mask(image, 0, grid.list === "unseen" ? colours.unseen : colours.obstacleEdge);
    const unknown = mask(image, 128, colours.unknown);
    const canvas = document.createElement("canvas");
    canvas.width = (grid.width + 2 * pad) * k;
    canvas.height = (grid.height + 2 * pad) * k;
    const ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    ctx.imageSmoothingEnabled = false;
    if (reach > 0 && grid.list !== "unseen") {
      for (const [distance, colour] of /** @type {[number, string][]} */ ([[reach, colours.haloEdge], [reach - 1 / k, colours.halo]])) {
        const stamp = mask(image, 0, colour);
        for (let i = 0; i < 32; i += 1) {
          const [dx, dy] = [Math.cos((i * Math.PI) / 16) * distance, Math.sin((i * Math.PI) / 16) * distance];
          ctx.drawImage(stamp, (pad + dx) * k, (pad + dy) * k, grid.width * k, grid.height * k);
          ctx.drawImage(stamp, (pad + dx / 2) * k, (pad + dy / 2) * k, grid.width * k, grid.height * k);
        }
      }
    }
    ctx.drawImage(unknown, pad * k, pad * k, grid.width * k, grid.height * k);
    ctx.drawImage(blocked, pad * k, pad * k, grid.width * k, grid.height * k);
    if (this.made.size > 12) this.made.delete(/** @type {string} */ (this.made.keys().next().value));
    this.made.set(key, canvas);
    return canvas;
  }
}

/** The squares of one grey in a colour, the others transparent. @param {HTMLImageElement} image @param {number} grey @param {string} colour */
function mask(image, grey, colour) {
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
  ctx.drawImage(image, 0, 0);
  const pixels = ctx.getImageData(0, 0, canvas.width, canvas.height);
  for (let i = 0; i < pixels.data.length; i += 4) {
    pixels.data[i + 3] = Math.abs(pixels.data[i] - grey) < 40 ? 255 : 0;
  }
  ctx.putImageData(pixels, 0, 0);
  ctx.globalCompositeOperation = "source-in";
  ctx.fillStyle = colour;
  ctx.fillRect(0, 0, canvas.width, canvas.height);
  return canvas;
}
