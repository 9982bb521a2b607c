// The page: what is seen (scene.js shows it), what the pointer does, and the controls.
import * as lib from './library.js';
import { Scene } from './scene.js';
import octopus from '../cages/octopus.obj';
import camera from '../cages/camera.obj';
import lotus from '../cages/lotus.obj';
import whale from '../cages/whale.obj';

const CUBE = `v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1
f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nf 2 8 6 4\nf 7 1 3 5\n`;
const PATCH = (() => {
    let obj = '';
    for (let r = 0; r < 4; r++)
        for (let c = 0; c < 4; c++)
            obj += `v ${c - 1.5} ${r % 3 && c % 3 ? 0.6 : 0} ${r - 1.5}\n`;
    for (let r = 0; r < 3; r++)
        for (let c = 0; c < 3; c++) {
            const a = 4 * r + c + 1;
            obj += `f ${a} ${a + 4} ${a + 5} ${a + 1}\n`;
        }
    return obj;
})();
const TETRAHEDRON =
    'v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n';
const CAGES = { cube: CUBE, patch: PATCH, tetrahedron: TETRAHEDRON, octopus, camera, lotus, whale };
const LOOPS = { tetrahedron: 1, whale: 1 };
const POLYGON = [-1.6, -0.9, 0, -1.2, 0.9, 0, 0, 0.6, 0, 0.3, -0.9, 0, 1.6, 0.8, 0];
const RULES = [
    ['standard', 'averaged', 'Doo-Sabin'],
    ['standard', 'Warren', 'five eighths'],
    ['standard'],
];
const MOST_POINTS = 1.2e6,
    FOREVER = 10;

const $ = id => document.getElementById(id);
const s = {
    mode: 'surface',
    scheme: 0,
    boundary: 0,
    creasing: 0,
    rule: 0,
    levels: 4,
    limit: true,
    cage: true,
    wire: false,
    name: 'cube',
    curveRule: 0,
    ends: 0,
};
let scene,
    faces = [],
    points = POLYGON.slice(),
    chosen = -1,
    loaded = '',
    evaluated = 0,
    marked = null;

// ------------------------------------------------------------------------------- doing

const ruleNumber = () => (s.scheme === 1 && s.rule > 0 ? s.rule + 2 : s.rule);
const curveOf = (more = {}) => ({
    rule: s.curveRule,
    ends: s.ends,
    levels: s.levels,
    limit: s.limit,
    ...more,
});

// The most levels whose result is not too large for the page.
function levelsThatFit() {
    const d = lib.describe();
    let sides = faces.reduce((sum, f) => sum + f.length, 0),
        levels = 0;
    if (s.scheme === 1) sides = 4 * d.faceCount;
    while (levels < 6 && sides * 4 ** levels < MOST_POINTS) levels++;
    return levels;
}

function rebuild() {
    $('error').textContent = '';
    if (s.mode === 'curve') return showCurve();
    try {
        lib.set({ ...s, rule: ruleNumber() });
        lib.rebuild(Math.min(s.levels, levelsThatFit()), s.limit);
        const names = lib.materials(lib.describe().faceCount),
            d = lib.describe();
        scene.showSurface(d, names, s);
        if (chosen >= d.edgeCount) chosen = -1;
        scene.showCage(d.positions, d.edges, d.sharpness, chosen);
    } catch (e) {
        $('error').textContent = e.message;
        scene.clearSurface();
    }
    mark(null);
    showFacts();
    remember();
}

function evaluate() {
    const start = performance.now();
    lib.evaluate();
    evaluated = performance.now() - start;
    const d = lib.describe();
    scene.moveSurface(d.buffer);
    scene.moveCage(d.positions, d.edges);
}

function showCurve() {
    const start = performance.now(),
        smooth = lib.curve(curveOf(), 3, points);
    evaluated = performance.now() - start;
    if (!smooth.length) $('error').textContent = 'A curve whose ends are cut needs 3 points.';
    scene.clearSurface();
    scene.showCurve(points, smooth, s.ends === 2, s.cage, s.levels < 4 && !s.limit);
    mark(null);
    showFacts();
    remember();
}

function load(obj, name) {
    const d0 = s.mode;
    try {
        lib.load(obj);
        s.mode = 'surface';
        const d = lib.describe();
        if (d.faceCount === 0 && d.lineCount > 0) {
            const line = lib.line(),
                closed = line[0] === line[line.length - 1];
            points = [];
            for (const v of closed ? line.slice(0, -1) : line)
                points.push(...d.positions.slice(3 * v, 3 * v + 3));
            s.ends = closed ? 2 : s.ends === 2 ? 0 : s.ends;
            s.mode = 'curve';
        }
        faces = lib.faces();
        loaded = obj;
        s.name = name;
        chosen = -1;
        scene.frame(s.mode === 'curve' ? points : d.positions);
    } catch (e) {
        s.mode = d0;
        $('error').textContent = e.message;
        return;
    }
    showControls();
    rebuild();
}

function saved() {
    if (s.mode === 'surface') return lib.save();
    let obj = '',
        line = 'l';
    for (let i = 0; i < points.length; i += 3) {
        obj += `v ${points[i]} ${points[i + 1]} ${points[i + 2]}\n`;
        line += ` ${i / 3 + 1}`;
    }
    return obj + line + (s.ends === 2 ? ' 1\n' : '\n');
}

function sharpen(edge, sharpness) {
    lib.sharpen(edge, sharpness);
    chosen = edge;
    rebuild();
    showControls();
}

// ------------------------------------------------------------------------------- masks

function fraction(x) {
    for (let q = 1; q <= 400; q++) {
        const p = Math.round(x * q);
        if (p && Math.abs(x * q - p) < 2e-6 * p) return q > 1 ? `${p}/${q}` : `${p}`;
    }
    return x.toFixed(3);
}

const center = list => [0, 1, 2].map(k => list.reduce((sum, p) => sum + p[k], 0) / list.length);
const vertexAt = v =>
    s.mode === 'curve'
        ? points.slice(3 * v, 3 * v + 3)
        : Array.from(lib.describe().positions.slice(3 * v, 3 * v + 3));

// Shows the mask of what is under the pointer: { kind: 'vertex' | 'edge' | 'face', index }.
function mark(hit) {
    marked = hit;
    let weights = [],
        text = '';
    if (hit && s.mode === 'curve') {
        weights = curveMask(hit.index);
        text = curveText(hit.index);
    } else if (hit) {
        const d = lib.describe();
        const point =
            hit.index +
            (hit.kind === 'vertex' ? 0 : d.vertexCount) +
            (hit.kind === 'face' ? d.edgeCount : 0);
        weights = lib.mask(point); // d may be out of date now
        text = lib.explain(point);
    }
    const from = weights.map(([v, w]) => [vertexAt(v), w]);
    const made = from.length
        ? [0, 1, 2].map(k => from.reduce((sum, [p, w]) => sum + w * p[k], 0))
        : null;
    scene.showMask(
        from.map(([p, w], i) => ({
            at: p,
            text: fraction(w),
            weight: w,
            own: hit.kind === 'vertex' && weights[i][0] === hit.index,
        })),
        made,
    );
    $('explain').textContent =
        text || 'Point at the cage, and this says which rule makes the point there.';
}

// The weights of the control points in the first new point of point i: the curve of unit vectors.
function curveMask(i) {
    const n = points.length / 3,
        unit = new Array(n * n).fill(0),
        k = curveOf({ levels: 1, limit: false });
    for (let j = 0; j < n; j++) unit[j * n + j] = 1;
    const made = lib.curve(k, n, unit),
        row = 2 * i - (s.ends === 1 ? 1 : 0),
        result = [];
    if (s.ends === 1 && (i === 0 || i === n - 1)) return []; // cut off
    for (let j = 0; j < n; j++) if (made[row * n + j]) result.push([j, made[row * n + j]]);
    return result;
}

function curveText(i) {
    const n = points.length / 3,
        inner = s.ends === 2 || (i > 0 && i < n - 1);
    if (!inner)
        return `Point ${i} is an end.\n` + (s.ends ? 'It is cut off.' : 'It stays: its mask is 1.');
    return s.curveRule === 0
        ? `Point ${i} is even: it moves along the cubic B-spline.\n\n` +
              '    V = (a + 6 v + b) / 8\n\n   1/8 ------ 3/4 ------ 1/8\n\n' +
              'Each edge gets an odd point, its middle.\n\n    E = (a + b) / 2\n\n' +
              'On the limit: (a + 4 v + b) / 6.'
        : `Chaikin cuts the corner at point ${i}: two points replace it.\n\n` +
              '    P = (a + 3 v) / 4\n    Q = (3 v + b) / 4\n\n' +
              'The limit is a quadratic B-spline.';
}

// ------------------------------------------------------------------------------- pointer

// What is under the pointer, nearest first: vertices, edges, middles of faces.
function hitAt(x, y) {
    if (!s.cage) return null;
    if (s.mode === 'curve') {
        const v = scene.nearest(points.length / 3, i => points.slice(3 * i, 3 * i + 3), x, y, 14);
        return v < 0 ? null : { kind: 'vertex', index: v };
    }
    const d = lib.describe(),
        p = i => d.positions.subarray(3 * i, 3 * i + 3);
    const v = scene.nearest(d.vertexCount, p, x, y, 12);
    if (v >= 0) return { kind: 'vertex', index: v };
    const e = scene.nearestEdge(
        d.edgeCount,
        i => [p(d.edges[2 * i]), p(d.edges[2 * i + 1])],
        x,
        y,
        7,
    );
    if (e >= 0) return { kind: 'edge', index: e };
    if (s.scheme === 1) return null;
    const f = scene.nearest(faces.length, i => center(Array.from(faces[i], p)), x, y, 16);
    return f < 0 ? null : { kind: 'face', index: f };
}

let drag = null,
    frames = 0,
    since = 0;

function pointerDown(event) {
    if (event.button !== 0) return;
    const { x, y } = scene.place(event),
        hit = hitAt(x, y);
    if (!hit) return;
    drag = { hit, x, y, moved: false };
    scene.controls.enabled = false;
    scene.canvas.setPointerCapture(event.pointerId);
}

function pointerMove(event) {
    const { x, y } = scene.place(event);
    if (!drag) {
        const hit = event.buttons ? null : hitAt(x, y);
        if (JSON.stringify(hit) !== JSON.stringify(marked)) mark(hit);
        scene.canvas.style.cursor = hit ? (hit.kind === 'vertex' ? 'grab' : 'pointer') : '';
        return;
    }
    if (!drag.moved && Math.hypot(x - drag.x, y - drag.y) < 4) return;
    if (!drag.moved) mark(null);
    drag.moved = true;
    if (drag.hit.kind === 'vertex') drag.to = { x, y };
    scene.wake();
}

// Once a frame: moves the vertex to where the pointer is by then.
function moveVertex() {
    if (!drag || !drag.to) return;
    const v = drag.hit.index,
        at = scene.unproject(drag.to.x, drag.to.y, vertexAt(v));
    drag.to = null;
    if (s.mode === 'curve') {
        points.splice(3 * v, 3, ...at);
        scene.showCurve(
            points,
            lib.curve(curveOf(), 3, points),
            s.ends === 2,
            s.cage,
            s.levels < 4 && !s.limit,
        );
    } else {
        lib.describe().positions.set(at, 3 * v);
        evaluate();
    }
    frames++;
    showFacts();
}

function pointerUp() {
    if (!drag) return;
    const { hit, moved } = drag;
    moveVertex();
    drag = null;
    scene.controls.enabled = true;
    if (!moved && hit.kind === 'edge') {
        const now = lib.describe().sharpness[hit.index],
            next = [1, 2, 3, FOREVER];
        sharpen(hit.index, next.find(x => x > now) || 0);
        mark(hit);
    } else if (moved) {
        scene.settle();
        remember();
    }
}

// ------------------------------------------------------------------------------- controls

function showFacts() {
    const now = performance.now();
    if (now - since > 500 || !drag) {
        scene.rate = drag && since ? Math.round((1000 * frames) / (now - since)) : 0;
        frames = 0;
        since = drag ? now : 0;
    }
    const d = lib.describe(),
        number = x => x.toLocaleString('en');
    $('facts').textContent =
        (s.mode === 'curve'
            ? `${lib.curveCount(curveOf(), points.length / 3)} points`
            : `${number(d.pointCount)} points, ${number(d.fineFaces)} faces`) +
        (evaluated ? `; evaluated in ${evaluated.toFixed(1)} ms` : '') +
        (scene.rate ? `; ${scene.rate} frames a second` : '');
}

function showControls() {
    document.body.classList.toggle('curve', s.mode === 'curve');
    $('tab-curve').classList.toggle('on', s.mode === 'curve');
    $('tab-surface').classList.toggle('on', s.mode === 'surface');
    $('rule').innerHTML = RULES[s.scheme].map(name => `<option>${name}`).join('');
    if (s.rule >= RULES[s.scheme].length) s.rule = 0;
    for (const [id, key] of [
        ['scheme', 'scheme'],
        ['boundary', 'boundary'],
        ['creasing', 'creasing'],
        ['rule', 'rule'],
        ['curve-rule', 'curveRule'],
        ['ends', 'ends'],
    ])
        $(id).selectedIndex = s[key];
    $('cage').value = s.name;
    $('levels').value = s.levels;
    const most = s.mode === 'curve' ? 6 : levelsThatFit();
    $('levels-out').textContent = s.levels > most ? `${most}!` : s.levels;
    $('limit').checked = s.limit;
    $('show-cage').checked = s.cage;
    $('show-wire').checked = s.wire;
    const sharpness = chosen >= 0 ? lib.describe().sharpness[chosen] : 0;
    $('sharpness').disabled = chosen < 0;
    $('sharpness').value = Math.min(sharpness, 5);
    $('sharpness-out').textContent = chosen < 0 ? '' : sharpness >= FOREVER ? '∞' : sharpness;
}

function connect() {
    const choose = (id, key) =>
        $(id).addEventListener('change', () => {
            s[key] = $(id).selectedIndex;
            showControls();
            rebuild();
        });
    (choose('scheme', 'scheme'), choose('boundary', 'boundary'), choose('creasing', 'creasing'));
    (choose('rule', 'rule'), choose('curve-rule', 'curveRule'), choose('ends', 'ends'));
    const check = (id, key) =>
        $(id).addEventListener('change', () => {
            s[key] = $(id).checked;
            rebuild();
        });
    (check('limit', 'limit'), check('show-cage', 'cage'), check('show-wire', 'wire'));
    $('levels').addEventListener('input', () => {
        s.levels = +$('levels').value;
        showControls();
        rebuild();
    });
    $('sharpness').addEventListener('input', () => {
        const value = +$('sharpness').value;
        if (chosen >= 0) sharpen(chosen, value >= 5 ? FOREVER : value);
    });
    $('cage').innerHTML = Object.keys(CAGES)
        .map(name => `<option>${name}`)
        .join('');
    $('cage').addEventListener('change', () => {
        const name = $('cage').value;
        s.scheme = LOOPS[name] || 0;
        s.levels = CAGES[name].length > 3000 ? 3 : 4;
        load(CAGES[name], name);
    });
    $('tab-surface').addEventListener('click', () => setMode('surface'));
    $('tab-curve').addEventListener('click', () => setMode('curve'));
    $('reset').addEventListener('click', () => {
        if (s.mode === 'curve') ((points = POLYGON.slice()), rebuild());
        else load(loaded, s.name);
    });
    $('open').addEventListener('click', () => $('file').click());
    $('file').addEventListener('change', () => openFile($('file').files[0]));
    $('save').addEventListener('click', () => {
        const link = document.createElement('a');
        link.href = URL.createObjectURL(new Blob([saved()], { type: 'model/obj' }));
        link.download = `${s.name || 'cage'}.obj`;
        link.click();
    });
    $('save').addEventListener('dragstart', event => {
        // out of the page, into a folder
        event.dataTransfer.setData(
            'DownloadURL',
            `model/obj:${s.name || 'cage'}.obj:data:model/obj;` + `base64,${btoa(saved())}`,
        );
        event.dataTransfer.setData('text/plain', saved());
    });
    addEventListener('dragover', event => {
        event.preventDefault();
        document.body.classList.add('dropping');
    });
    addEventListener('dragleave', event => {
        if (!event.relatedTarget) document.body.classList.remove('dropping');
    });
    addEventListener('drop', event => {
        event.preventDefault();
        document.body.classList.remove('dropping');
        openFile(event.dataTransfer.files[0]);
    });
    scene.canvas.addEventListener('pointerdown', pointerDown, { capture: true });
    scene.canvas.addEventListener('pointermove', pointerMove);
    scene.canvas.addEventListener('pointerup', pointerUp);
    scene.canvas.addEventListener('dblclick', event => {
        if (s.mode !== 'curve') return;
        const { x, y } = scene.place(event);
        if (hitAt(x, y)) return;
        points.push(...scene.unproject(x, y, [0, 0, 0]));
        rebuild();
    });
    addEventListener('hashchange', recall);
}

function setMode(mode) {
    s.mode = mode;
    scene.frame(mode === 'curve' ? points : lib.describe().positions);
    if (mode === 'surface') scene.clearCurve();
    showControls();
    rebuild();
}

async function openFile(file) {
    if (file) load(await file.text(), file.name.replace(/\.obj$/i, ''));
}

// ------------------------------------------------------------------------------- the address

async function packed(text, how) {
    const stream =
        how === 'pack'
            ? new CompressionStream('deflate-raw')
            : new DecompressionStream('deflate-raw');
    const bytes =
        how === 'pack'
            ? new TextEncoder().encode(text)
            : Uint8Array.from(atob(text.replace(/-/g, '+').replace(/_/g, '/')), x =>
                  x.charCodeAt(0),
              );
    const result = new Uint8Array(
        await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer(),
    );
    if (how !== 'pack') return new TextDecoder().decode(result);
    let letters = '';
    for (const byte of result) letters += String.fromCharCode(byte);
    return btoa(letters).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

let timer,
    written = '';

// Writes what is seen into the address, when nothing has changed for a moment.
function remember() {
    clearTimeout(timer);
    timer = setTimeout(async () => {
        const state = {
            ...s,
            points,
            obj: lib.save(),
            loaded: CAGES[s.name] === loaded ? undefined : loaded,
            view: scene.viewpoint(),
        };
        written = '#' + (await packed(JSON.stringify(state), 'pack'));
        history.replaceState(null, '', written);
    }, 300);
}

async function recall() {
    if (location.hash.length < 2 || location.hash === written) return false;
    try {
        const state = JSON.parse(await packed(location.hash.slice(1), 'unpack'));
        const { obj, view, points: given, loaded: first, mode, ...rest } = state;
        load(obj, rest.name);
        Object.assign(s, rest);
        points = given;
        loaded = first || CAGES[s.name] || obj;
        setMode(mode);
        scene.look(view);
        return true;
    } catch (e) {
        $('error').textContent = 'The address holds no state that can be read.';
        return false;
    }
}

// ------------------------------------------------------------------------------- start

async function start() {
    await lib.start();
    scene = new Scene($('view'), $('labels'), moveVertex, remember);
    connect();
    load(CUBE, 'cube');
    await recall();
    showControls();
    // For tests and the console.
    window.playground = {
        state: s,
        scene,
        lib,
        load,
        rebuild,
        points: () => points,
        set: more =>
            more.mode
                ? (Object.assign(s, more), setMode(more.mode))
                : (Object.assign(s, more), showControls(), rebuild()),
        vertexOnScreen: v => scene.onScreen(vertexAt(v)),
        edgeOnScreen: e => {
            const d = lib.describe();
            return scene.onScreen(center([vertexAt(d.edges[2 * e]), vertexAt(d.edges[2 * e + 1])]));
        },
        hitAt,
        curve: () => lib.curve(curveOf(), 3, points),
        obj: saved,
        count: () => lib.describe().pointCount,
        position: i => Array.from(lib.describe().buffer.slice(6 * i, 6 * i + 3)),
        time: count => {
            const t0 = performance.now();
            for (let i = 0; i < count; i++) evaluate();
            const t1 = performance.now();
            for (let i = 0; i < count; i++) lib.evaluate();
            return [(t1 - t0) / count, (performance.now() - t1) / count];
        },
    };
}

start();
