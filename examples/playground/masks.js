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

// How many points an edge of a curve gets: of a B-spline one, under Chaikin's rule two.
export const perEdge = curve => (curve.rule ? 2 : 1);

// The weights of the control points in a point of level 1, that of a vertex (under Chaikin's rule
// the first of two) or one on an edge: what becomes of unit vectors.
export function curveMask(curve, count, { kind, index }) {
    const once = { ...curve, levels: 1, limit: false },
        made = lib.curveCount(once, count),
        isVertex = kind === 'vertex',
        at = isVertex ? index : Math.floor(index / perEdge(curve)),
        isEnd = isVertex && curve.ends !== 2 && (at === 0 || at === count - 1),
        text = isVertex
            ? vertexText(curve, at, isEnd)
            : edgeText(curve, at, (at + 1) % count, index % 2),
        weights = [];
    if (isEnd && curve.ends === 1) return { weights, text };
    let row = 2 * at + (isVertex ? 0 : 1 + (index % perEdge(curve))) - (curve.ends === 1 ? 1 : 0);
    if (isEnd && at) row = made - 1;
    for (const v of new Set([-1, 0, 1, 2].map(k => (at + k + count) % count))) {
        const unit = new Array(count).fill(0);
        unit[v] = 1;
        const weight = lib.curve(once, 1, unit)[row % made];
        if (weight) weights.push([v, weight]);
    }
    return { weights, text };
}

function edgeText(curve, from, to, isSecond) {
    const ends = `from point ${from} to point ${to}`;
    if (curve.rule === 0)
        return `The edge ${ends} gets an odd point, its middle.

    E = (a + b) / 2

    1/2 ------ 1/2`;
    return `The edge ${ends} gets two points. This is ${isSecond ? 'Q' : 'P'}.

    P = (3 a + b) / 4
    Q = (a + 3 b) / 4`;
}

function vertexText(curve, i, isEnd) {
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
