// Masks: their weights, and the words that explain them.
import * as lib from './library.js';

// The weight as a fraction, if it is one of small numbers.
export function fraction(x) {
    for (let q = 1; q <= 400; q++) {
        const p = Math.round(x * q);
        if (p && Math.abs(x * q - p) < 2e-6 * p) return q > 1 ? `${p}/${q}` : `${p}`;
    }
    return x.toFixed(3);
}

// The weights of the cage's vertices in the point of a vertex, an edge or a face, and its text.
export function surfaceMask({ kind, index }) {
    const { vertexCount, edgeCount } = lib.describe(),
        before = { vertex: 0, edge: vertexCount, face: vertexCount + edgeCount }[kind];
    return { weights: lib.mask(before + index), text: lib.explain(before + index) };
}

// The weights of the control points in the first new point of point i: the curve of unit vectors.
export function curveMask(curve, count, i) {
    const isEnd = curve.ends !== 2 && (i === 0 || i === count - 1),
        text = curveText(curve, i, isEnd);
    if (curve.ends === 1 && isEnd) return { weights: [], text };
    const unit = new Array(count * count).fill(0),
        weights = [];
    for (let j = 0; j < count; j++) unit[j * count + j] = 1;
    const made = lib.curve({ ...curve, levels: 1, limit: false }, count, unit),
        row = 2 * i - (curve.ends === 1 ? 1 : 0);
    for (let j = 0; j < count; j++)
        if (made[row * count + j]) weights.push([j, made[row * count + j]]);
    return { weights, text };
}

function curveText(curve, i, isEnd) {
    const end = curve.ends ? 'It is cut off.' : 'It stays: its mask is 1.';
    if (isEnd) return `Point ${i} is an end.\n${end}`;
    if (curve.rule === 0)
        return `Point ${i} is even: it moves along the cubic B-spline.

    V = (a + 6 v + b) / 8

    1/8 ------ 3/4 ------ 1/8

Each edge gets an odd point, its middle.

    E = (a + b) / 2

On the limit: (a + 4 v + b) / 6.`;
    return `Chaikin cuts the corner at point ${i}: two points replace it.

    P = (a + 3 v) / 4
    Q = (3 v + b) / 4

The limit is a quadratic B-spline.`;
}
