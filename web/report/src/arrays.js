/** Numbers of the report come as base64 of their little-endian bytes; this turns them back. */

/**
 * @param {string} text base64
 * @param {new (buffer: ArrayBuffer) => any} Type a typed array's constructor
 */
export function decode(text, Type) {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return new Type(bytes.buffer);
}

/** The i-th point of a flat array of coordinates. */
export function pointAt(flat, i) {
    return [flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]];
}
