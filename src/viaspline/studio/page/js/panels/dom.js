/** Elements in one call, and the few controls that every panel is made of. */

import { SHAPES } from "../shapes/registry.js";

/**
 * @param {string} tag @param {Record<string, any>} [props] listeners begin with `on`
 * @param {...(Node|string|null|undefined|false)} children
 * @returns {any}
 */
export function h(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "class") element.className = value;
    else if (key === "value" && tag === "input") /** @type {any} */ (element).defaultValue = value; // what is typed can be told from it
    else if (key === "value" || key === "checked" || key === "indeterminate") /** @type {any} */ (element)[key] = value;
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false).map((c) => /** @type {Node|string} */ (c)));
  return element;
}

/** @type {Record<string, string>} */
const ICONS = {
  ...Object.fromEntries(SHAPES.map((shape) => [shape.key, shape.icon])),
  select: "M5 3l14 8-6 1.5L10 19z",
  via: "M12 21s7-6.2 7-11.5A7 7 0 0 0 5 9.500C5 14.800 12 21 12 21zM12 6.500v6M9 9.500h6",
  zone: "M4 18a9 9 0 1 1 16 0M12 16l4-6M12 16.500v.5",
  fence: "M4 8h16M4 15h16M7 4l-1 16M18 4l-1 16M12 4v16",
  several: "M4 8V4h4M11 4h3M17 4h3v4M20 11v3M20 17v3h-4M13 20h-3M7 20H4v-3M4 14v-3M9 9h6v6H9z",
  fleet: "M4 4h7v6H4zM13 14h7v6h-7zM7.500 10v7H13",
  measure: "M3 15L15 3l6 6L9 21zM7 11l2.500 2.500M10 8l1.500 1.500M13 5l2.500 2.500",
  pan: "M8 12V6.500a1.500 1.500 0 0 1 3 0V11 5a1.500 1.500 0 0 1 3 0v6-4a1.500 1.500 0 0 1 3 0v7c0 4-2.500 6.500-6 6.500-3 0-4.500-1.500-6-4.500l-2-4a1.500 1.500 0 0 1 2.600-1.400L8 13",
  undo: "M9 7L4 12l5 5M4 12h10a6 6 0 0 1 0 12",
  redo: "M15 7l5 5-5 5M20 12H10a6 6 0 0 0 0 12",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  play: "M7 4l13 8-13 8z",
  pause: "M7 4h4v16H7zM14 4h4v16h-4z",
  watch: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16zM10 8.500l5.500 3.500-5.500 3.500z",
  next: "M5 4l10 8-10 8zM18 4v16",
  prev: "M19 4L9 12l10 8zM6 4v16",
  stop: "M6 6h12v12H6z",
  file: "M6 3h8l4 4v14H6zM14 3v4h4",
  folder: "M3 6h6l2 2h10v11H3z",
  save: "M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6",
  export: "M12 15V4M8 8l4-4 4 4M5 14v6h14v-6",
  picture: "M4 5h16v14H4zM4 16l5-5 4 4 3-3 4 4M15.500 9h.01",
  link: "M10 14a4 4 0 0 0 6 0l3-3a4 4 0 0 0-6-6l-1 1M14 10a4 4 0 0 0-6 0l-3 3a4 4 0 0 0 6 6l1-1",
  help: "M9 9a3 3 0 1 1 4.500 2.600c-1 .6-1.500 1.200-1.500 2.400M12 17.500v.5",
  up: "M12 19V5M6 11l6-6 6 6",
  down: "M12 5v14M6 13l6 6 6-6",
  trash: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
  eye: "M2 12s4-7 10-7 10 7 10 7-4 7-10 7S2 12 2 12zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  hidden: "M4 4l16 16M9 6a9 9 0 0 1 3-.5c6 0 10 6.500 10 6.500a18 18 0 0 1-3 3.500M6 8a17 17 0 0 0-4 4s4 6.500 10 6.500a9 9 0 0 0 4-1",
  layers: "M12 3l9 5-9 5-9-5zM3 13l9 5 9-5",
  more: "M5 12h.01M12 12h.01M19 12h.01",
  plus: "M12 5v14M5 12h14",
  check: "M4 12.500l5 5L20 6.500",
  close: "M6 6l12 12M18 6L6 18",
  warn: "M12 3L2 20h20zM12 10v4M12 17v.5",
};

/** @param {string} name @param {number} [size] */
export function icon(name, size = 18) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  const box = name === "undo" || name === "redo" ? "0 3 24 24" : "0 0 24 24";
  for (const [key, value] of Object.entries({ viewBox: box, width: size, height: size, class: "icon", "aria-hidden": "true" })) svg.setAttribute(key, String(value));
  path.setAttribute("d", ICONS[name]);
  if (name === "more") svg.classList.add("icon-dots");
  svg.append(path);
  return svg;
}

/** A button with a picture; its label is read out and shown on hovering. @param {string} name @param {string} label @param {() => void} onclick @param {Record<string, any>} [props] */
export const iconButton = (name, label, onclick, props = {}) =>
  h("button", { type: "button", class: "icon-button", "aria-label": label, title: label, onclick, ...props }, icon(name));

/**
 * A number with its name and unit. `set` hears every sound number; an empty field means null.
 * @param {{label: string, value: number|null, unit?: string, step?: number, min?: number, max?: number,
 *   placeholder?: string, set: (value: number|null) => void}} options
 */
export function numberField({ label, value, unit = "", step = 0.1, min, max, placeholder, set }) {
  const input = h("input", {
    type: "number", step: "any", min, max, placeholder, inputmode: "decimal",
    value: value === null || value === undefined ? "" : String(Number(value.toFixed(4))),
    "aria-label": unit ? `${label} in ${unit}` : label,
    onchange: () => {
      const next = input.value === "" ? null : Number(input.value);
      if (next !== null && (!Number.isFinite(next) || (min !== undefined && next < min) || (max !== undefined && next > max))) {
        input.setAttribute("aria-invalid", "true");
        return;
      }
      input.removeAttribute("aria-invalid");
      set(next);
    },
    onkeydown: (/** @type {KeyboardEvent} */ event) => {
      const way = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
      if (!way || input.value === "") return;
      event.preventDefault();
      const next = Number(input.value) + way * step * (event.shiftKey ? 10 : 1);
      input.value = input.defaultValue = String(Number(Math.min(max ?? Infinity, Math.max(min ?? -Infinity, next)).toFixed(6)));
      set(Number(input.value));
    },
  });
  return h("label", { class: "field" }, h("span", { class: "field-name" }, label), h("span", { class: "field-box" }, input, unit ? h("span", { class: "unit" }, unit) : null));
}

/** A text; `set` may say false to what it can't take. @param {{label: string, value: string, placeholder?: string, most?: number, set: (value: string) => unknown}} options */
export function textField({ label, value, placeholder, most = 80, set }) {
  const input = h("input", {
    type: "text", value, placeholder, "aria-label": label, maxlength: most, spellcheck: "false",
    onchange: () => {
      if (set(input.value.trim()) === false) input.setAttribute("aria-invalid", "true");
      else input.removeAttribute("aria-invalid");
    },
  });
  return h("label", { class: "field" }, h("span", { class: "field-name" }, label), h("span", { class: "field-box" }, input));
}

/**
 * A number between two others, heard of while it is dragged.
 * @param {{label: string, value: number, min: number, max: number, step: number, words: (value: number) => string, shown?: string,
 *   ends?: [string, string], grab: () => void, set: (value: number) => void, drop: () => void}} options `shown` stands for a value that no number says
 */
export function slider({ label, value, min, max, step, words, shown, ends, grab, set, drop }) {
  const output = h("output", { class: "slider-value" }, shown ?? words(value));
  const input = h("input", {
    type: "range", min, max, step, value: String(value), "aria-label": label,
    onpointerdown: grab,
    oninput: () => {
      output.textContent = words(Number(input.value));
      set(Number(input.value));
    },
    onchange: drop,
  });
  return h("label", { class: "field" }, h("span", { class: "field-name" }, label, output), input,
    ends ? h("span", { class: "scale-ends" }, h("span", {}, ends[0]), h("span", {}, ends[1])) : null);
}

/** @param {{label: string, value: string, options: [string, string][], set: (value: string) => void}} options */
export function choice({ label, value, options, set }) {
  const select = h("select", { "aria-label": label, title: options.find(([key]) => key === value)?.[1], onchange: () => set(select.value) }, ...options.map(([key, text]) => h("option", { value: key, selected: key === value }, text)));
  return h("label", { class: "field" }, h("span", { class: "field-name" }, label), h("span", { class: "field-box" }, select));
}

/** @param {{label: string, value: boolean, set: (value: boolean) => void}} options */
export function checkbox({ label, value, set }) {
  const input = h("input", { type: "checkbox", checked: value, onchange: () => set(input.checked) });
  return h("label", { class: "check" }, input, h("span", {}, label));
}

/** Put other children into an element; what has the focus there keeps it, by its label. @param {HTMLElement} element @param {...(Node|string|null|undefined|false)} children */
export function fill(element, ...children) {
  const active = document.activeElement;
  const label = active && element.contains(active) ? active.getAttribute("aria-label") : null;
  element.replaceChildren(...children.filter((c) => c !== null && c !== undefined && c !== false).map((c) => /** @type {Node|string} */ (c)));
  if (!label) return;
  const again = /** @type {HTMLElement|null} */ (element.querySelector(`[aria-label="${CSS.escape(label)}"]`));
  again?.focus({ preventScroll: true });
  if (again instanceof HTMLInputElement && again.type !== "range") again.select(); // as if it had been tabbed to
}

/** Whether somebody is typing into a field of a panel, and nothing has heard of it yet. @param {HTMLElement} panel */
export function isTypedInto(panel) {
  const active = document.activeElement;
  return active instanceof HTMLInputElement && panel.contains(active) && active.value !== active.defaultValue;
}

let soon = 0; // works that are still to be done

/** Whether nothing is left to be done soon: panels show what there is. */
export const isUpToDate = () => soon === 0;

/** Do something soon, once for many calls: panels need not keep up with every drag. @param {() => void} work @param {number} ms */
export function lazily(work, ms) {
  let timer = 0;
  let last = 0;
  return () => {
    if (timer) return;
    const wait = Math.max(0, ms - (performance.now() - last));
    soon += 1;
    timer = setTimeout(() => {
      soon -= 1;
      timer = 0;
      last = performance.now();
      work();
    }, wait);
  };
}

/**
 * Keeps a panel's canvas as fine as the screen, and the panel's size in CSS pixels, and draws it then.
 * @param {{canvas: HTMLCanvasElement, width: number, height: number, draw: () => void}} panel
 */
export function fitted(panel) {
  const { canvas } = panel;
  new ResizeObserver(() => {
    const { width, height } = canvas.getBoundingClientRect();
    if (!width) return;
    const ratio = Math.min(devicePixelRatio || 1, 3);
    panel.width = width;
    panel.height = height;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    panel.draw();
  }).observe(canvas);
}

/** With a capital at its beginning. @param {string} text */
export const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);
