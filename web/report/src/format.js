/** Numbers for people: millimetres and degrees exist only here. */

const DASH = '–';

/** A number with so many significant digits, without an exponent where it can be. */
export function number(value, digits = 3) {
    if (value === null || value === undefined || Number.isNaN(value)) return DASH;
    if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
    if (Math.abs(value) < 5e-7) return '0';
    const places = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value))));
    return value.toFixed(Math.min(places, 6)).replace('-', '−');
}

export function millimetres(metres) {
    return metres === null || metres === undefined || Number.isNaN(metres)
        ? DASH
        : `${number(1e3 * metres)} mm`;
}

export function degrees(radians) {
    return radians === null || radians === undefined || Number.isNaN(radians)
        ? DASH
        : `${number((180 / Math.PI) * radians)}°`;
}

/** A margin in the unit that the planner names. */
export function margin(value, unit) {
    if (value === undefined) return DASH;
    if (unit === 'm') return millimetres(value);
    if (unit === 'rad') return degrees(value);
    return number(value);
}

/** A point or direction [m] as "x, y, z". */
export function vector(values, scale = 1, places = 1) {
    return values.map((value) => (scale * value).toFixed(places).replace('-', '−')).join(', ');
}

export function milliseconds(ms) {
    return ms >= 1000 ? `${number(ms / 1000)} s` : `${number(ms)} ms`;
}

/** 12345 -> "12 345". */
export function count(value) {
    return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}
