/** The picture under the map: fetched once, drawn as a flat sheet. */

export class Background {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** @type {any} */ this.shown = null; // as the server tells of it
    /** @type {HTMLImageElement|null} */ this.image = null;
    this.count = 0; // of pictures that have come
  }

  /** What the server says that lies under the mission. @param {any} shown */
  take(shown) {
    const { name: before } = this.shown ?? {};
    this.shown = shown;
    if (shown?.name !== before) this.load(shown?.name);
    this.app.store.tell("background");
    this.app.scene.later();
  }

  /** @param {string|undefined} name */
  load(name) {
    this.image = null;
    if (!name) return;
    const image = new Image();
    image.onload = () => {
      if (this.shown?.name !== name) return;
      this.image = image;
      this.count += 1;
      this.app.scene.later();
    };
    image.onerror = () => {
      if (this.shown?.name === name) this.app.toast("The picture under the map could not be fetched; open the mission again.", "is-bad");
    };
    image.src = `/backgrounds/${name}${location.search}`;
  }

  /** Changes with what is drawn. */
  get key() {
    return this.image ? [this.count, this.shown.opacity, ...this.shown.sheet].join() : "";
  }

  /** Seen at once, kept when it is let go of. @param {number} opacity */
  fade(opacity) {
    this.shown = { ...this.shown, opacity };
    this.app.scene.later();
  }

  /** The corners, from the top left one round [m]. @returns {number[][]} */
  get corners() {
    const [a, b, c, d, e, f] = this.shown?.sheet ?? [];
    return a === undefined ? [] : [[0, 0], [1, 0], [1, 1], [0, 1]].map(([u, v]) => [a + b * u + c * v, d + e * u + f * v]);
  }

  /** The box that holds it [m]; null if there is none. @returns {number[]|null} */
  get box() {
    const { corners } = this;
    if (!corners.length) return null;
    const [xs, ys] = [corners.map(([x]) => x), corners.map(([, y]) => y)];
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  }

  /** @param {import("../draw/pen.js").Pen} pen */
  draw(pen) {
    if (!this.image) return;
    const { ctx, camera } = pen;
    const [a, b, c, d, e, f] = this.shown.sheet;
    const [width, height] = [this.image.naturalWidth, this.image.naturalHeight];
    const [px, py] = camera.toScreen(a, d);
    ctx.save();
    ctx.globalAlpha = this.shown.opacity;
    ctx.transform((b * camera.scale) / width, (-e * camera.scale) / width, (c * camera.scale) / height, (-f * camera.scale) / height, px, py);
    ctx.imageSmoothingEnabled = Math.hypot(b, e) * camera.scale < 3 * width; // pixels are seen when they are large
    ctx.imageSmoothingQuality = "medium";
    ctx.drawImage(this.image, 0, 0);
    ctx.restore();
  }
}
