/** The bar with the file and its deeds, the tools, what is shown, the tabs of a narrow screen. */

import { TOOLS, makes } from "../input/tools.js";
import { DRAWN } from "../shapes/registry.js";
import { fill, h, icon } from "./dom.js";

const LAYERS = [
  ["rings", "Clearance rings", "R"], ["losers", "Sides not taken", "L"], ["speed", "Speed as colour", "X"],
  ["comb", "Curvature comb", "K"], ["detours", "Detour points", "D"], ["grid", "Grid", "G"],
  ["snap", "Snap to the grid", "S"], ["points", "Snap to points", "J"], ["body", "Body and what it sweeps", "O"], ["names", "Names", ""],
];

/** @param {any} app */
export function listenToBars(app) {
  const { store, files } = app;
  const find = (/** @type {string} */ id) => /** @type {HTMLElement} */ (document.querySelector(id));
  const click = (/** @type {string} */ id, /** @type {() => void} */ act) => find(id).addEventListener("click", act);
  click("#new", () => files.blank());
  click("#open", () => files.open());
  click("#save", () => files.save());
  click("#save-as", () => files.saveAs());
  click("#export", () => files.export());
  click("#link", () => files.link());
  click("#add-map", () => files.addMap());
  click("#compare-variants", () => app.compare.open());
  click("#undo", () => app.undo());
  click("#redo", () => app.redo());
  click("#show-help", () => app.help());
  click("#fit", () => app.fit());
  find("#help").addEventListener("click", (event) => {
    if (event.target === find("#help")) /** @type {any} */ (find("#help")).close();
  });
  click("#help-close", () => /** @type {any} */ (find("#help")).close());
  for (const [id, name] of /** @type {[string, any][]} */ ([["#new", "plus"], ["#open", "folder"], ["#save", "save"], ["#export", "export"], ["#link", "link"], ["#undo", "undo"], ["#redo", "redo"], ["#show-help", "help"], ["#fit", "fit"], ["#add-map", "map"], ["#compare-variants", "layers"], ["#make-fleet", "fleet"], ["#save-as", "save"], ["#menu-show", "layers"], ["#menu-more", "more"], ["#step-back", "prev"], ["#step-on", "next"]])) {
    find(id).prepend(icon(name));
  }
  explainTools();
  listenToTools(app);
  listenToShown(app);
  listenToMenus();
  const file = () => {
    const name = store.name ?? "new mission";
    fill(find("#file-name"), h("span", { class: "file-stem", title: name }, name), store.dirty ? h("span", { class: "dirty", title: "not saved" }, "edited") : null);
    document.title = `${store.dirty ? "• " : ""}${name} – viaspline studio`;
    /** @type {HTMLButtonElement} */ (find("#undo")).disabled = !store.past.length;
    /** @type {HTMLButtonElement} */ (find("#redo")).disabled = !store.future.length;
  };
  store.on("document file", file);
  find("#tabs").addEventListener("click", (event) => {
    const name = /** @type {HTMLElement} */ (event.target).closest("button")?.getAttribute("data-sheet");
    if (name) app.openSheet(document.body.dataset.sheet === name ? "none" : name);
  });
}

/** Put the keys of the tools into the help sheet. */
function explainTools() {
  const kinds = DRAWN.flatMap(({ tool }) => [
    h("dt", {}, h("kbd", {}, tool.key)),
    h("dd", {}, tool.words, ...(tool.close ? ["; ", h("kbd", {}, "Enter"), " closes it"] : [])),
  ]);
  document.querySelector("#help-areas")?.before(...kinds);
  const crossed = TOOLS.filter(({ name }) => makes(name)).flatMap(({ key }) => [h("kbd", {}, key), " "]);
  document.querySelector("#help-cross")?.replaceChildren(...crossed.slice(0, -1));
}

/** @param {any} app */
function listenToTools({ store, scene }) {
  const bar = /** @type {HTMLElement} */ (document.querySelector("#tools"));
  const render = () => fill(bar, ...TOOLS.map(({ name, label, key }) => h("button", {
    type: "button", class: "icon-button tool", "aria-pressed": String(store.tool === name), "aria-label": label, "aria-keyshortcuts": key, title: `${label} (${key})`,
    onclick: () => { store.setTool(name); scene.canvas.focus(); },
  }, icon(name, 20))));
  render();
  store.on("tool", () => {
    render();
    scene.canvas.dataset.tool = store.tool;
    if (!makes(store.tool)) {
      scene.cross = null;
      scene.later();
    }
  });
}

/** @param {any} app */
function listenToShown({ store }) {
  const menu = /** @type {HTMLElement} */ (document.querySelector("#shown"));
  const render = () => fill(menu, ...LAYERS.map(([name, label, key]) => h("button", {
    type: "button", class: "menu-item", role: "menuitemcheckbox", "aria-checked": String(store.show[name]), "aria-label": label, onclick: () => store.toggle(name),
  }, h("span", { class: "tick" }, store.show[name] ? icon("check", 14) : ""), h("span", {}, label), h("kbd", {}, key))));
  render();
  store.on("view", () => { if (!menu.hidden) render(); });
  menu.addEventListener("beforetoggle", render);
  /** @type {any} */ (menu).renderNow = render;
}

/** Menus open under their buttons; Escape and a click elsewhere close them. */
function listenToMenus() {
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-menu]"))) {
    const menu = /** @type {HTMLElement} */ (document.getElementById(/** @type {string} */ (button.dataset.menu)));
    const close = () => {
      menu.hidden = true;
      button.setAttribute("aria-expanded", "false");
    };
    button.addEventListener("click", () => {
      const isOpen = !menu.hidden;
      document.querySelectorAll(".menu").forEach((other) => { /** @type {HTMLElement} */ (other).hidden = true; });
      menu.hidden = isOpen;
      button.setAttribute("aria-expanded", String(!isOpen));
      if (!isOpen) {
        /** @type {any} */ (menu).renderNow?.();
        const box = button.getBoundingClientRect();
        menu.style.top = `${box.bottom + 6}px`;
        menu.style.left = `${Math.max(8, Math.min(box.left, innerWidth - menu.offsetWidth - 8))}px`;
        /** @type {HTMLElement|null} */ (menu.querySelector("button"))?.focus();
      }
    });
    menu.addEventListener("keydown", (event) => {
      const items = [.../** @type {NodeListOf<HTMLElement>} */ (menu.querySelectorAll("button"))];
      const i = items.indexOf(/** @type {HTMLElement} */ (document.activeElement));
      const to = event.key === "ArrowDown" ? i + 1 : event.key === "ArrowUp" ? i - 1 : -1;
      if (items[to]) items[to].focus();
      if (event.key === "Escape") {
        close();
        button.focus();
      }
      if (["ArrowDown", "ArrowUp", "Escape"].includes(event.key)) {
        event.preventDefault();
        event.stopPropagation();
      }
    });
    menu.addEventListener("click", () => { if (menu.id !== "shown") close(); });
    addEventListener("pointerdown", (event) => {
      const target = /** @type {Node} */ (event.target);
      if (!menu.hidden && !menu.contains(target) && !button.contains(target)) close();
    });
  }
}
