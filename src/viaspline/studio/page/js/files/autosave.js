/** Edits that aren't saved yet are kept by the browser, so that a closed tab loses nothing. */

const KEY_PREFIX = "viaspline-studio:";
const MAX_KEPT_MISSIONS = 20;

/** @param {string} folder @param {string|null} name */
const keyOf = (folder, name) => `${KEY_PREFIX}${folder}/${name ?? ""}`;

/** @param {import("../core/store.js").Store} store */
export function keepSaving(store) {
  let timer = 0;
  const keep = () => {
    clearTimeout(timer);
    timer = 0;
    const key = keyOf(store.folder, store.name);
    try {
      if (store.dirty) localStorage.setItem(key, JSON.stringify({ doc: store.file, base: store.savedFile, time: Date.now() }));
      else localStorage.removeItem(key);
    } catch {
      forgetOldest();
    }
  };
  store.on("document file", () => {
    clearTimeout(timer);
    timer = setTimeout(keep, 300);
  });
  addEventListener("pagehide", keep);
  document.addEventListener("visibilitychange", keep);
}

/** What was kept of a file; null if nothing, or if it is what the file holds. @param {string} folder @param {string|null} name @param {any} doc of the file */
export function kept(folder, name, doc) {
  try {
    const found = JSON.parse(localStorage.getItem(keyOf(folder, name)) ?? "null");
    if (!found?.doc || JSON.stringify(found.doc) === JSON.stringify(doc)) return null;
    return { doc: found.doc, isOfOtherFile: JSON.stringify(found.base) !== JSON.stringify(doc) };
  } catch {
    return null;
  }
}

function forgetOldest() {
  const keys = Object.keys(localStorage).filter((key) => key.startsWith(KEY_PREFIX));
  const age = (/** @type {string} */ key) => JSON.parse(localStorage.getItem(key) ?? "{}").time ?? 0;
  keys.sort((a, b) => age(a) - age(b)).slice(0, Math.max(1, keys.length - MAX_KEPT_MISSIONS)).forEach((key) => localStorage.removeItem(key));
}
