/** The 3-D view: three.js, drawn when something has changed and not otherwise. */

import * as THREE from "../../../vendor/three.min.js";
import { onTheme } from "../../draw/theme.js";
import { solidColours } from "./colours.js";
import { cleared } from "./meshes.js";
import { moversOf } from "./mover_meshes.js";
import { robotOf, trailOf } from "./robot_mesh.js";
import { bandOf, dashed, gatesOf, handleOf, looksOf, losersOf, pathOf, pointsOf } from "./route_meshes.js";
import { SolidPointer } from "./solid_pointer.js";
import { worldOf } from "./world_meshes.js";

const LENS_DEG = 42;
const IDLE_SHARE = 3; // of the time that a picture takes: how long none is drawn after it
const LONGEST_PAUSE_MS = 300;
const SLOW_MS = 40; // a picture that takes longer is drawn with one pixel for each of the page
const HANDLE_PX = 46; // from the selected point up to the handle that lifts it

/** Open the view; without WebGL it throws, in words. @param {any} app @param {import("../space.js").Space} space */
export async function openSolidView(app, space) {
  const canvas = /** @type {HTMLCanvasElement} */ (document.querySelector("#solid"));
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) throw new Error("this browser offers no WebGL 2");
  return new SolidView(app, space, canvas, gl);
}

export class SolidView {
  /** @param {any} app @param {import("../space.js").Space} space @param {HTMLCanvasElement} canvas @param {WebGL2RenderingContext} gl */
  constructor(app, space, canvas, gl) {
    this.app = app;
    this.space = space;
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, context: gl, antialias: true });
    this.camera = new THREE.PerspectiveCamera(LENS_DEG, 1, 0.1, 1e5);
    this.camera.up.set(0, 0, 1);
    this.world = new THREE.Group();
    this.route = new THREE.Group();
    this.moving = new THREE.Group();
    this.stage = new THREE.Scene();
    this.light = new THREE.DirectionalLight("#ffffff", 1.6);
    this.light.position.set(-0.5, -0.8, 1.6);
    this.stage.add(this.world, this.route, this.moving, new THREE.HemisphereLight("#ffffff", "#8a8f98", 1.5), this.light);
    /** What stands at 0, 0, 0 of the picture [m]: numbers near it are small enough for a graphics card. */
    this.origin = [0, 0, 0];
    this.size = 100; // of what there is to be seen [m]
    this.scene = null;
    this.isDue = false;
    this.isFitted = false;
    this.band = ""; // in which heights it may fly
    /** What has to be made anew. */ this.stale = { world: true, route: true };
    this.drawn = 0; // pictures so far
    /** Of the newest picture, until the graphics card has it. @type {WebGLSync|null} */ this.fence = null;
    this.begunAt = 0; // when that was begun [ms]
    this.lasted = 0; // how long the one before took [ms]
    this.freeAt = 0; // when the next may begin [ms]
    this.pointer = new SolidPointer(this);
    const { store } = app;
    const route = () => {
      const band = String(store.goodPlan?.space?.band);
      if (band !== this.band) this.stale.world = true;
      this.band = band;
      this.later("route");
    };
    store.on("plan ledger document selection view profile scene", route);
    store.on("hover run", () => this.later());
    store.on("file", () => { this.isFitted = false; });
    app.drive.on(() => this.later());
    app.preview.on(() => this.later());
    onTheme(() => {
      this.stale.world = true;
      this.later("route");
    });
    new ResizeObserver(() => this.later("route")).observe(canvas);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      space.views.fail("the graphics card gave it up");
    });
    canvas.addEventListener("webglcontextrestored", () => {
      space.views.failure = "";
      space.views.show();
    });
  }

  /** @param {any} scene */
  setScene(scene) {
    this.scene = scene;
    this.stale.world = true;
    this.later("route");
  }

  /** Draw in the next frame. @param {"route"|null} [what] has changed */
  later(what = null) {
    if (what) this.stale[what] = true;
    if (this.isDue || !this.space.views.hasSolid) return;
    this.isDue = true;
    requestAnimationFrame(() => this.attempt());
  }

  /** Draw, unless the card is still at work: it never keeps the other views waiting for long. */
  attempt() {
    if (!this.isIdle()) {
      requestAnimationFrame(() => this.attempt());
      return;
    }
    this.isDue = false;
    if (!this.space.views.hasSolid) return;
    const gl = /** @type {WebGL2RenderingContext} */ (this.renderer.getContext());
    this.begunAt = performance.now();
    if (!this.draw()) return;
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
  }

  /** Whether the newest picture is done, and has been for long enough. */
  isIdle() {
    const gl = /** @type {WebGL2RenderingContext} */ (this.renderer.getContext());
    const now = performance.now();
    if (this.fence) {
      const state = gl.getSyncParameter(this.fence, gl.SYNC_STATUS);
      if (state !== gl.SIGNALED && !gl.isContextLost()) return false;
      gl.deleteSync(this.fence);
      this.fence = null;
      this.lasted = now - this.begunAt;
      this.freeAt = this.lasted > SLOW_MS ? now + Math.min(IDLE_SHARE * this.lasted, LONGEST_PAUSE_MS) : now;
    }
    return now >= this.freeAt;
  }

  /** The path seen from above and its heights, thinned. @returns {number[][]} */
  get line() {
    const list = this.app.store.curve?.solidSamples ?? [];
    return list.filter((/** @type {any} */ _, /** @type {number} */ i) => i % 5 === 0).map((/** @type {any} */ p) => [p.x, p.y, p.z]);
  }

  /** Draw now; false if there is nothing to draw yet. */
  draw() {
    const { canvas, camera, renderer } = this;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!width || !height || !this.app.store.curve?.isSpatial) return false;
    const ratio = this.lasted > SLOW_MS ? 1 : Math.min(devicePixelRatio || 1, 2);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      if (!this.pointer.isTurned) this.isFitted = false; // as it is laid out, it gets its size late
    }
    const colours = solidColours();
    renderer.setClearColor(colours.sky);
    if (!this.isFitted) this.fit();
    if (this.stale.world) this.buildWorld(colours);
    if (this.stale.route) this.buildRoute(colours);
    this.buildMoving(colours);
    renderer.render(this.stage, camera);
    this.drawn += 1;
    if (this.drawn === 1) this.space.views.show(); // it was said to be opened
    return true;
  }

  /** @param {import("./colours.js").SolidColours} colours */
  buildWorld(colours) {
    cleared(this.world);
    if (!this.scene) return;
    this.stale.world = false;
    const line = this.line;
    const heights = line.map((p) => p[2]);
    const floor = Math.min(this.scene.flat ?? Infinity, ...heights, ...(this.scene.terrain?.heights ?? []).filter((/** @type {number|null} */ z) => z !== null));
    const { band } = this.app.store.goodPlan?.space ?? {};
    if (band) this.world.add(bandOf(band, this.scene, line, this.origin, colours));
    this.world.add(worldOf(this.scene, { origin: this.origin, colours, floor, roof: Math.max(...heights) + 20, path: line }));
  }

  /** How much of the view's height a pixel is, as sprites of one size take it. */
  get perPixel() {
    return (2 * Math.tan((LENS_DEG * Math.PI) / 360)) / Math.max(this.canvas.clientHeight, 1);
  }

  /** @param {import("./colours.js").SolidColours} colours */
  buildRoute(colours) {
    cleared(this.route);
    this.stale.route = false;
    const { app, origin, space, size } = this;
    const { store } = app;
    const points = space.points();
    const radius = size * 0.003;
    this.route.add(pathOf(app, origin, size, colours));
    for (const line of space.provisional()) this.route.add(dashed(line, origin, colours.select, radius));
    if (store.show.losers && store.plan?.ok && !store.isLate) this.route.add(losersOf(store.ledger, origin, colours, radius));
    this.route.add(gatesOf(store.doc, origin, colours), looksOf(store.doc, points, origin, colours, radius));
    this.route.add(pointsOf(app, points, (x, y) => space.groundAt(x, y), origin, colours, this.perPixel));
  }

  /** What follows the eye or the instant: the robot, its trail, the handle of what is selected. @param {import("./colours.js").SolidColours} colours */
  buildMoving(colours) {
    cleared(this.moving);
    const { app, origin } = this;
    const { store, drive, preview } = app;
    const handle = this.handlePlace();
    if (handle) this.moving.add(handleOf(handle, origin, colours, this.perPixel));
    const state = drive.run ? drive.state() : store.cursor !== null ? store.curve.at(store.cursor) : preview.isOn && store.plan?.ok ? preview.state() : null;
    if (drive.run?.samples?.z) this.moving.add(trailOf(drive, origin, colours, this.size * 0.0022));
    const isSeen = (/** @type {number} */ index) => !!drive.run && drive.hasSeen(index);
    const movers = moversOf(store.doc, app.scene.time, origin, { colours, isSeen, size: this.size });
    if (movers.children.length) this.moving.add(movers);
    if (state?.z !== undefined) this.moving.add(robotOf(state, store.doc.robot ?? {}, origin, { colours, isFlying: !!drive.run, size: this.size }));
  }

  /** Where the handle stands that lifts the selected point; null without one. @returns {number[]|null} */
  handlePlace() {
    const { store, drive } = this.app;
    const point = drive.run ? null : this.space.points().find(({ id }) => id === store.selection);
    if (!point || !this.space.words(point.id)) return null;
    const away = this.camera.position.distanceTo(this.placed(point.at));
    return [point.at[0], point.at[1], point.at[2] + HANDLE_PX * this.perPixel * away];
  }

  /** A place as the picture has it. @param {number[]} at [m] */
  placed(at) {
    return new THREE.Vector3(at[0] - this.origin[0], at[1] - this.origin[1], at[2] - this.origin[2]);
  }

  /** Where a place is on the screen [CSS pixel]; null if it is behind the eye. @param {number[]} at [m] @returns {[number, number]|null} */
  toScreen(at) {
    this.camera.updateMatrixWorld();
    const seen = this.placed(at).project(this.camera);
    if (seen.z > 1) return null;
    return [((seen.x + 1) / 2) * this.canvas.clientWidth, ((1 - seen.y) / 2) * this.canvas.clientHeight];
  }

  /** Show the whole path. */
  fit() {
    const line = this.line;
    if (!line.length) return;
    const points = [...line, ...this.space.points().map(({ at }) => at)];
    const low = [0, 1, 2].map((k) => Math.min(...points.map((p) => p[k]))), high = [0, 1, 2].map((k) => Math.max(...points.map((p) => p[k])));
    this.origin = low.map((value, k) => (value + high[k]) / 2);
    this.size = Math.max(Math.hypot(...high.map((value, k) => value - low[k])), 2);
    const away = (0.58 * this.size) / Math.tan((LENS_DEG * Math.PI) / 360) / Math.min(1, Math.max(this.camera.aspect, 0.5));
    this.camera.position.set(-0.45 * away, -0.72 * away, 0.55 * away);
    this.camera.near = this.size / 500;
    this.camera.far = this.size * 60;
    this.camera.updateProjectionMatrix();
    this.pointer.controls.target.set(0, 0, 0);
    this.pointer.controls.minDistance = this.size / 100;
    this.pointer.controls.maxDistance = this.size * 12;
    this.pointer.controls.update();
    this.isFitted = true;
    this.pointer.isTurned = false;
    this.stale.world = this.stale.route = true;
  }
}
