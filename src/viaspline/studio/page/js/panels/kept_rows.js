/** Long lists of which only the rows that say something new are made again. */

/**
 * Put rows into a list in place of those that say something else.
 * @param {HTMLElement} list
 * @param {{says: unknown, make: () => HTMLElement}[]} rows what a row says is all that it is made of
 */
export function keptRows(list, rows) {
  const { children } = list;
  rows.forEach(({ says, make }, i) => {
    const words = JSON.stringify(says);
    const old = /** @type {HTMLElement|undefined} */ (children[i]);
    if (old && SAID.get(old) === words) return;
    const row = make();
    SAID.set(row, words);
    if (old) exchange(old, row);
    else list.append(row);
  });
  while (children.length > rows.length) children[children.length - 1].remove();
}

/** @type {WeakMap<Element, string>} */ const SAID = new WeakMap();

/** What has the focus in the old row keeps it, by its label. @param {HTMLElement} old @param {HTMLElement} row */
function exchange(old, row) {
  const active = document.activeElement;
  const label = active && old.contains(active) ? active.getAttribute("aria-label") : null;
  old.replaceWith(row);
  if (label === null) return;
  /** @type {HTMLElement|null} */ (row.querySelector(`[aria-label="${CSS.escape(label)}"]`))?.focus({ preventScroll: true });
}
