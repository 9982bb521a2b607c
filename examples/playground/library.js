// The library as the page sees it: a thin layer over playground.c.

let c, memory;

export async function start() {
    const bytes = Uint8Array.from(atob(WASM), letter => letter.charCodeAt(0));
    const module = await WebAssembly.instantiate(bytes, {});
    c = module.instance.exports;
    memory = c.memory;
}

// Arrays in the library's memory. They are valid until that grows: ask anew after each call.
export const floats = (at, count) => new Float32Array(memory.buffer, at, count);
export const ints = (at, count) => new Int32Array(memory.buffer, at, count);
const unsigneds = (at, count) => new Uint32Array(memory.buffer, at, count);

function text(at) {
    const bytes = new Uint8Array(memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

function lend(bytes, use) {
    const at = c.take(bytes.length + 1);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    const result = use(at);
    c.give(at);
    return result;
}

function check(result) {
    if (result) throw new Error(text(c.message()) || 'out of memory');
}

// Returns a warning, or ''.
export function load(obj) {
    const bytes = new TextEncoder().encode(obj);
    check(lend(bytes, at => c.load(at, bytes.length)));
    return text(c.warning());
}

export function save() {
    const size = c.take(4),
        at = c.save(size);
    const obj = at
        ? new TextDecoder().decode(new Uint8Array(memory.buffer, at, ints(size, 1)[0]).slice())
        : '';
    (c.give(at), c.give(size));
    return obj;
}

export const set = s => c.set(s.scheme, s.boundary, s.creasing, s.rule, s.triangles);
export const rebuild = (levels, limit) => check(c.rebuild(levels, limit ? 1 : 0));
export const evaluate = () => check(c.evaluate());
export const sharpen = (edge, sharpness) => check(c.sharpen(edge, sharpness));
export const explain = point => text(c.explain(point));
export const hidden = (point, eye) => c.hidden(...point, ...eye) !== 0;

export function describe() {
    const a = ints(c.describe(), 19);
    return {
        vertexCount: a[0],
        positions: floats(a[1], 3 * a[0]),
        faceCount: a[2],
        edgeCount: a[3],
        edges: ints(a[4], 2 * a[3]),
        sharpness: floats(a[5], a[3]),
        bufferCount: a[6],
        buffer: floats(a[7], 6 * a[6]),
        indices: unsigneds(a[9], a[8]),
        wire: unsigneds(a[11], a[10]),
        triangleFaces: ints(a[12], a[8] / 3),
        pointCount: a[13],
        fineFaces: a[14],
        lineCount: a[15],
        boundary: a[16],
        creasing: a[17],
        triangles: a[18],
    };
}

export function faces() {
    const count = ints(c.describe(), 16)[2],
        result = [];
    for (let f = 0, at = 0; f < count; f++) {
        const size = c.face_size(f);
        result.push(ints(c.face_vertices() + 4 * at, size).slice());
        at += size;
    }
    return result;
}

export const line = () => ints(c.line_vertices(), c.line_size()).slice();

// The material of each face by the usemtl statements of the file.
export function materials(faceCount) {
    const names = new Array(faceCount).fill(''),
        place = c.take(4),
        statements = [];
    for (let i = 0, at; (at = c.statement(i, place)); i++)
        if (text(at).startsWith('usemtl ')) statements.push([ints(place, 1)[0], text(at).slice(7)]);
    c.give(place);
    statements.forEach(([face, name], i) => {
        names.fill(name, face, i + 1 < statements.length ? statements[i + 1][0] : faceCount);
    });
    return names;
}

export function mask(point) {
    const places = c.take(8),
        count = c.mask(point, places, places + 4);
    const [indices, weights] = ints(places, 2),
        result = [];
    for (let i = 0; i < count; i++)
        result.push([ints(indices, count)[i], floats(weights, count)[i]]);
    c.give(places);
    return result;
}

export const curveCount = (k, count) => c.curve_count(k.rule, k.ends, count, k.levels);

export function curve(k, channels, points) {
    const count = points.length / channels,
        room = channels * Math.max(curveCount(k, count), 1);
    const at = c.take(4 * (points.length + room));
    floats(at, points.length).set(points);
    const failed = c.curve(
        k.rule,
        k.ends,
        k.levels,
        k.limit ? 1 : 0,
        channels,
        count,
        at,
        at + 4 * points.length,
    );
    const result = failed ? [] : floats(at + 4 * points.length, room).slice();
    c.give(at);
    return result;
}
