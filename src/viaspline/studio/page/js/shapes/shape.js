/**
 * What the page asks of a kind of obstacle. A kind is one file that answers all of this, and one
 * line in `registry.js`; nothing else in the page tells the kinds apart.
 *
 * Items are obstacles as they stand in the document. They are never changed in place: whatever
 * changes one gives another. Nothing is asked of an item that `isSound` says no to.
 */

/** @typedef {Record<string, any>} Item */
/** @typedef {number[]} Place x, y [m] */
/** @typedef {import("../draw/pen.js").Pen} Pen */

/**
 * A handle of what is selected. `corner` and `new-corner` are those of a vertex and of the edge
 * after it: dragging them asks `withVertex` and `withNewVertex`. Any other role is the kind's own.
 * @typedef {{role: string, at: Place, vertex: number}} ShapeHandle
 */

/**
 * A field of the panel: `put` gives the item, as it is by then, with another value.
 * @typedef {{type: "number", label: string, unit: string, min: number, value: number, put: (item: Item, value: number) => Item}
 *   | {type: "choice", label: string, value: string, options: [string, string][], put: (item: Item, value: string) => Item}
 *   | {type: "note", text: string}} ShapeField
 */

/**
 * How a kind is drawn by hand. Either between the places where the mouse is pressed and let go,
 * and by a click (or by Enter, without a mouse), with a size that can be seen; or corner by corner.
 * @typedef {object} ShapeTool
 * @property {string} label what its button says
 * @property {string} key the letter that takes it up
 * @property {string} words what the help sheet and an empty list call its product
 * @property {(from: Place, to: Place, snapped: (at: Place) => Place) => Item} [drag]
 * @property {(at: Place, size: number) => Item} [click]
 * @property {(corners: Place[]) => Item} [close] takes three corners at least
 */

/**
 * @typedef {object} Shape
 * @property {string} key its key in a mission file
 * @property {string} name what lists call it
 * @property {string} icon outline of a picture of 24 by 24, as SVG path data
 * @property {boolean} hasOutline whether the page draws it; else it comes as a picture of its own
 * @property {boolean} hasSides whether a side can be asked for on which it is passed
 * @property {ShapeTool|null} tool
 * @property {string} vertexName what one of its vertices is called
 * @property {(item: Item) => boolean} isSound whether an item is of this kind, and can be drawn
 * @property {(item: Item) => string} title what stands beside its name
 * @property {(item: Item) => string|null} usualName what it is called that has no name, if not by its number
 * @property {(pen: Pen, item: Item) => void} trace put its outline into the path of the canvas
 * @property {(item: Item) => boolean} isPierced whether it has holes: then it is filled alone
 * @property {(item: Item, look: string) => string} svg an element with these attributes
 * @property {(item: Item) => number[]|null} box x_min, y_min, x_max, y_max [m]
 * @property {(item: Item) => number} reach how far it extends from the origin of its frame if it moves [m]
 * @property {(p: Place, item: Item) => boolean} covers
 * @property {(p: Place, item: Item) => Place|null} edgeNear the nearest place on its edge
 * @property {(item: Item) => Place|null} anchor the place that its coordinates tell; null if it can't be moved
 * @property {(item: Item, at: Place) => Item} movedTo with its anchor there
 * @property {(item: Item, move: (at: Place) => Place) => Item} mapped with all of its places moved or turned
 * @property {(item: Item) => Place[]} vertices what can be selected and moved on its own
 * @property {(path: (string|number)[]) => number} vertexAt the vertex that a path within an item leads to, or -1
 * @property {(item: Item, vertex: number, at: Place) => Item} withVertex
 * @property {(item: Item, after: number, at: Place) => Item} withNewVertex
 * @property {(item: Item, vertex: number) => Item|null} withoutVertex null if it can't do without
 * @property {(item: Item, scale: number) => ShapeHandle[]} handles at so many pixels a metre
 * @property {(item: Item, role: string, at: Place, snapped: (at: Place) => Place) => Item} dragged a handle of a role of its own
 * @property {(item: Item) => ShapeField[]} fields besides name and place
 */

/** What a kind answers that has no vertices of its own. */
export const NO_VERTICES = {
  vertexName: "",
  vertices: () => [],
  vertexAt: () => -1,
  withVertex: (/** @type {Item} */ item) => item,
  withNewVertex: (/** @type {Item} */ item) => item,
  withoutVertex: () => null,
  mapped: (/** @type {Item} */ item) => item,
  reach: () => 0,
};

/** What a kind answers that comes from a file through the server: it is drawn from there, and stays where it is. */
export const FROM_A_FILE = {
  ...NO_VERTICES,
  hasOutline: false,
  hasSides: false,
  tool: null,
  trace: () => {},
  isPierced: () => false,
  svg: () => "",
  box: () => null,
  covers: () => false,
  edgeNear: () => null,
  anchor: () => null,
  movedTo: (/** @type {Item} */ item) => item,
  handles: () => [],
  dragged: (/** @type {Item} */ item) => item,
};
