/** From metres to pixels and back: y is up in the world and down on the screen. */

const MAX_PX_PER_M = 4000; // pixels a metre
const MIN_PX_PER_M = 1e-4;

export class Camera {
  constructor() {
    this.x = 0; // the middle of the view [m]
    this.y = 0;
    this.scale = 1; // pixels a metre
    this.width = 1; // [CSS pixel]
    this.height = 1;
  }

  /** @param {number} x @param {number} y @returns {[number, number]} */
  toScreen(x, y) {
    return [(x - this.x) * this.scale + this.width / 2, this.height / 2 - (y - this.y) * this.scale];
  }

  /** @param {number} px @param {number} py @returns {[number, number]} */
  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  /** Zoom so that what is under a pixel stays there. @param {number} factor @param {number} px @param {number} py */
  zoom(factor, px, py) {
    const [x, y] = this.toWorld(px, py);
    this.scale = Math.min(MAX_PX_PER_M, Math.max(MIN_PX_PER_M, this.scale * factor));
    const [nx, ny] = this.toWorld(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  /** @param {number} dx @param {number} dy [CSS pixel] */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** What is in the middle, and how large: it stays the same until the view is moved. */
  get view() {
    return `${this.x} ${this.y} ${this.scale}`;
  }

  /** Show a box whole. @param {number[]} box x_min, y_min, x_max, y_max [m] @param {{top: number, right: number, bottom: number, left: number}} inset */
  fit(box, inset) {
    const w = Math.max(box[2] - box[0], 1e-3), h = Math.max(box[3] - box[1], 1e-3);
    const room = [this.width - inset.left - inset.right, this.height - inset.top - inset.bottom];
    this.scale = Math.min(MAX_PX_PER_M, Math.max(MIN_PX_PER_M, Math.min(Math.max(room[0], 40) / w, Math.max(room[1], 40) / h)));
    this.x = (box[0] + box[2]) / 2 - (inset.left - inset.right) / 2 / this.scale;
    this.y = (box[1] + box[3]) / 2 + (inset.top - inset.bottom) / 2 / this.scale;
  }

  /** A step of 1, 2 or 5 times a power of ten that is about so many pixels wide [m]. @param {number} pixels */
  step(pixels) {
    const raw = pixels / this.scale;
    const power = 10 ** Math.floor(Math.log10(raw));
    return power * (raw / power < 1.5 ? 1 : raw / power < 3.5 ? 2 : raw / power < 7.5 ? 5 : 10);
  }

  /** Round to what a pixel can tell, or to the grid. @param {number[]} at @param {number|null} grid [m] */
  rounded(at, grid) {
    const unit = grid ?? Math.max(1e-3, 10 ** Math.floor(Math.log10(0.6 / this.scale)));
    const digits = Math.max(0, Math.min(6, Math.ceil(-Math.log10(unit) + 1e-9)));
    return at.map((value) => Number((Math.round(value / unit) * unit).toFixed(digits)));
  }
}
