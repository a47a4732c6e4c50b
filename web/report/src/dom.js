/** Trees as plain data, ['tag', {attributes}, ...children], and how they become elements. Text stays
 *  text: nothing of a report is ever read as markup. */

const SVG = 'http://www.w3.org/2000/svg';

/** A child may be a tree, a list of children, text, or nothing. */
function flattened(children) {
    return children.flatMap((child) => {
        if (child === undefined || child === null || child === false) return [];
        const isList = Array.isArray(child) && typeof child[0] !== 'string';
        return isList ? flattened(child) : [child];
    });
}

/** @param {string|number|Node|Array} tree @param {boolean} [inSvg] */
export function mount(tree, inSvg = false) {
    if (tree instanceof Node) return tree;
    if (!Array.isArray(tree)) return document.createTextNode(String(tree));
    const [tag, attributes, ...children] = tree;
    const svg = inSvg || tag === 'svg';
    const element = svg ? document.createElementNS(SVG, tag) : document.createElement(tag);
    for (const [name, value] of Object.entries(attributes ?? {})) {
        if (value === undefined || value === null || value === false) continue;
        if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
        else element.setAttribute(name, value === true ? '' : value);
    }
    for (const child of flattened(children)) element.append(mount(child, svg));
    return element;
}

/** Puts trees in place of what an element holds. */
export function fill(element, ...trees) {
    element.replaceChildren(...trees.filter(Boolean).map((tree) => mount(tree)));
}
