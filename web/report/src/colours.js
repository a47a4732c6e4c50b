/** The scale of concavity: blue on the convex hull, red at the deepest (the paper's Fig. 3f). */

const STOPS = [
    [0.16, 0.3, 0.75],
    [0.15, 0.62, 0.75],
    [0.35, 0.75, 0.35],
    [0.95, 0.8, 0.25],
    [0.85, 0.15, 0.12],
];
const ENCLOSED = [0.55, 0.1, 0.5];
const TEXELS = 256;
const SCALE_TEXELS = 250; // the rest is for enclosed vertices
export const ENCLOSED_U = (TEXELS - 1.5) / TEXELS;

/** sRGB in [0, 1] of a share of the largest concavity. */
export function colourAt(share) {
    const place = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
    const low = Math.min(Math.floor(place), STOPS.length - 2);
    return STOPS[low].map((value, k) => value + (place - low) * (STOPS[low + 1][k] - value));
}

/** Where in the texture a vertex's concavity [m] lies. */
export function textureU(value, largest) {
    if (value === Infinity) return ENCLOSED_U;
    const share = largest > 0 && Number.isFinite(value) ? value / largest : 0;
    return (0.5 + Math.min(share, 1) * (SCALE_TEXELS - 1)) / TEXELS;
}

/** RGBA bytes of the texture, one row. */
export function textureBytes() {
    const bytes = new Uint8Array(4 * TEXELS);
    for (let i = 0; i < TEXELS; ++i) {
        const rgb = i < SCALE_TEXELS ? colourAt(i / (SCALE_TEXELS - 1)) : ENCLOSED;
        bytes.set([...rgb.map((value) => Math.round(255 * value)), 255], 4 * i);
    }
    return bytes;
}

/** The scale as a CSS gradient, for the legend. */
export function cssGradient() {
    const stops = STOPS.map(
        (rgb) => `rgb(${rgb.map((value) => Math.round(255 * value)).join(' ')})`,
    );
    return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** Round values [m] for the marks of a scale that ends at `largest`. */
export function scaleMarks(largest, most = 4) {
    if (!(largest > 0)) return [0];
    const raw = largest / most;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((k) => k * power).find((value) => value >= raw);
    const marks = [];
    for (let k = 0; k * step <= largest * (1 + 1e-9); ++k) marks.push(k * step);
    return marks;
}
