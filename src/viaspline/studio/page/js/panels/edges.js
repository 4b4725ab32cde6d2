/** The edges of the panels beside the map: dragged, or moved with the keys; the browser keeps their places. */

import { h } from "./dom.js";

const KEPT = "viaspline-studio-widths";
const LEAST_STAGE_PX = 480;
const STEP_PX = 16;

/** @typedef {{name: string, label: string, least: number, most: number, way: 1|-1}} Side */

/** @type {Side[]} */
const SIDES = [
  { name: "--side", label: "Width of the lists", least: 180, most: 520, way: 1 },
  { name: "--fields", label: "Width of the fields", least: 256, most: 620, way: -1 },
];

export function listenToEdges() {
  /** @type {Record<string, number>} */ const widths = read();
  const root = document.documentElement;
  const now = (/** @type {Side} */ side) => Math.round(parseFloat(getComputedStyle(root).getPropertyValue(side.name)));
  const edges = SIDES.map((side) => ({ side, element: make(side) }));

  /** As wide as somebody made it, and as the window lets it be. */
  const apply = () => {
    for (const { side, element } of edges) {
      const other = now(SIDES[0] === side ? SIDES[1] : SIDES[0]);
      const most = Math.max(side.least, Math.min(side.most, innerWidth - other - LEAST_STAGE_PX));
      const wanted = widths[side.name];
      if (wanted === undefined) root.style.removeProperty(side.name);
      else root.style.setProperty(side.name, `${Math.min(most, Math.max(side.least, wanted))}px`);
      element.setAttribute("aria-valuenow", String(now(side)));
      element.setAttribute("aria-valuemin", String(side.least));
      element.setAttribute("aria-valuemax", String(most));
    }
  };

  /** @param {Side} side @param {number|undefined} width undefined: as it is usually */
  const put = (side, width) => {
    if (width === undefined) delete widths[side.name];
    else widths[side.name] = Math.round(Math.min(side.most, Math.max(side.least, width)));
    apply();
    if (width !== undefined) widths[side.name] = now(side); // no farther than it went
    write(widths);
  };

  for (const { side, element } of edges) {
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      element.focus();
      element.setPointerCapture(event.pointerId);
      const [start, width] = [event.clientX, now(side)];
      const move = (/** @type {PointerEvent} */ e) => put(side, width + side.way * (e.clientX - start));
      const end = () => {
        element.removeEventListener("pointermove", move);
        element.removeEventListener("pointerup", end);
        element.removeEventListener("pointercancel", end);
      };
      element.addEventListener("pointermove", move);
      element.addEventListener("pointerup", end);
      element.addEventListener("pointercancel", end);
    });
    element.addEventListener("dblclick", () => put(side, undefined));
    element.addEventListener("keydown", (event) => {
      const step = STEP_PX * (event.shiftKey ? 4 : 1);
      const width = { ArrowRight: now(side) + side.way * step, ArrowLeft: now(side) - side.way * step, Home: side.least, End: side.most }[event.key];
      if (width === undefined && event.key !== "Enter") return;
      put(side, width);
      event.preventDefault();
      event.stopPropagation();
    });
  }
  addEventListener("resize", apply);
  apply();
}

/** @param {Side} side @returns {HTMLElement} */
function make(side) {
  const element = h("div", {
    class: `edge is-${side.name.slice(2)}`, role: "separator", tabindex: 0, "aria-orientation": "vertical", "aria-label": side.label,
    title: `${side.label}: drag, or use the arrow keys; double-click or Enter: as usual`,
  });
  document.body.append(element);
  return element;
}

/** @returns {Record<string, number>} */
function read() {
  try {
    const found = JSON.parse(localStorage.getItem(KEPT) ?? "{}");
    return Object.fromEntries(Object.entries(found ?? {}).filter(([name, width]) => SIDES.some((side) => side.name === name) && Number.isFinite(width)));
  } catch {
    return {};
  }
}

/** @param {Record<string, number>} widths */
function write(widths) {
  try {
    localStorage.setItem(KEPT, JSON.stringify(widths));
  } catch { /* a browser that keeps nothing: as usual next time */ }
}
