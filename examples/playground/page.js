// The page: what is seen (scene.js shows it), what pointer and keys do, the controls, files, undo.
import * as lib from './library.js';
import { Scene } from './scene.js';
import { pack, unpack } from './address.js';
import { curveMask, fraction, perEdge, surfaceMask } from './masks.js';
import { CAGES, OF_TRIANGLES, POLYGON } from './cages.js';

const RULES = [
    ['standard', 'averaged', 'Doo-Sabin'],
    ['standard', 'Warren', 'five eighths'],
    ['standard'],
];
const LOOP = 1,
    CLOSED = 2, // ends of a curve
    FOREVER = 10,
    MOST_FACES = 1.2e6,
    MOST_AT_FIRST = 3e5, // faces of the level that a file is shown at
    MOST_COORDINATE = 1e15, // its square is still a float
    MOST_BYTES = 1e8,
    MOST_SHARED = 5e6, // letters of a state in the address,
    MOST_KEPT = 1e8; // and of all states that undo goes back to
const SELECTS = ['scheme', 'boundary', 'creasing', 'rule', 'triangles', 'curveRule', 'ends'],
    CHECKS = ['limit', 'cage', 'wire'];

const $ = id => document.getElementById(id);
const number = x => x.toLocaleString('en');
const s = {
    mode: 'surface',
    scheme: 0,
    boundary: 0,
    creasing: 0,
    rule: 0,
    triangles: 0,
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
    points = [], // of the curve
    chosen = -1, // edge that the slider sharpens
    loaded = {}, // what reset goes back to: { surface, curve }
    evaluated = 0, // milliseconds
    marked = null; // what has its mask shown: { kind: 'vertex' | 'edge' | 'face', index }

// ------------------------------------------------------------------------------- showing

const isCurve = () => s.mode === 'curve';
const rule = () => (s.scheme === LOOP && s.rule > 0 ? s.rule + 2 : s.rule);
const curve = () => ({ rule: s.curveRule, ends: s.ends, levels: s.levels, limit: s.limit });
const vertexAt = v =>
    Array.from((isCurve() ? points : lib.describe().positions).slice(3 * v, 3 * v + 3));

const say = text => ($('message').textContent = text);

// The faces of a level.
function facesAt(level) {
    const sides = faces.reduce((sum, face) => sum + face.length, 0);
    if (s.scheme === LOOP) return (sides - 2 * faces.length) * 4 ** level;
    return level ? sides * 4 ** (level - 1) : faces.length;
}

// The level asked for, or below it the highest one that has at most so many faces.
function levels(most = MOST_FACES) {
    let level = s.levels;
    while (level && facesAt(level) > most) level--;
    return level;
}

function rebuild() {
    say('');
    if (isCurve()) showCurve();
    else showSurface();
    scene.show(s);
    mark(marked);
    showFacts();
    remember();
}

function showSurface() {
    const { edgeCount } = lib.describe();
    try {
        lib.set({ ...s, rule: rule() });
        lib.rebuild(levels(), s.limit);
        const names = lib.materials(faces.length);
        scene.showSurface(lib.describe(), names, s);
    } catch (e) {
        say(e.message);
        scene.clearSurface();
    }
    const d = lib.describe();
    if (d.edgeCount !== edgeCount) [chosen, marked] = [-1, null];
    scene.showCage(d, chosen);
    if (levels() < s.levels)
        say(`Level ${s.levels} has ${number(facesAt(s.levels))} faces, too many for a page.`);
}

function showCurve() {
    const start = performance.now(),
        smooth = lib.curve(curve(), 3, points);
    evaluated = performance.now() - start;
    if (!smooth.length) say('A curve whose ends are cut needs 3 points.');
    scene.clearSurface();
    scene.showCurve(points, smooth, s.ends === CLOSED, s.cage, s.levels < 4 && !s.limit);
}

// All that happens in a frame while a vertex is dragged.
function moveVertex(v, x, y) {
    const at = scene.unproject(x, y, scene.onScreen(vertexAt(v))[2]);
    if (isCurve()) {
        points.splice(3 * v, 3, ...at);
        showCurve();
    } else if (scene.surface) {
        const start = performance.now(),
            d = lib.describe();
        d.positions.set(at, 3 * v);
        lib.evaluate();
        evaluated = performance.now() - start;
        scene.moveVertex(v, at, d.edges);
        scene.lookAt(lib.describe().buffer, true);
    }
}

function sharpen(edge, sharpness) {
    lib.sharpen(edge, sharpness);
    chosen = edge;
    rebuild();
    showControls();
}

function sharpenMore(edge) {
    if (isCurve()) return;
    const now = lib.describe().sharpness[edge];
    sharpen(edge, [1, 2, 3, FOREVER].find(x => x > now) ?? 0);
}

// Shows the mask of a vertex, an edge or a face; of nothing if null.
function mark(hit) {
    if (hit?.kind === 'face' && s.scheme === LOOP) hit = null;
    if (isCurve() && hit?.kind === 'edge' && hit.index >= curveEdgePoints()) hit = null;
    marked = hit;
    const { weights, text } = !hit
        ? { weights: [], text: 'Point at the cage: this says which rule makes the point there.' }
        : isCurve()
          ? curveMask(curve(), points.length / 3, hit)
          : surfaceMask(hit);
    const from = weights.map(([v, weight]) => ({
        at: vertexAt(v),
        weight,
        text: fraction(weight),
        own: hit.kind === 'vertex' && v === hit.index,
    }));
    const sum = k => from.reduce((total, { at, weight }) => total + weight * at[k], 0);
    scene.showMask(from, from.length ? [0, 1, 2].map(sum) : null);
    explain(text);
}

// The panel breaks prose anew: the lines of a title are one. Formulas and diagrams keep theirs.
function explain(text) {
    const rows = text
        .trimEnd()
        .replace(/\n {7}(?=[^ /\\])/g, ' ')
        .split('\n')
        .map(line => {
            const row = document.createElement('div');
            row.textContent = line;
            row.className = line.startsWith(' ') ? 'formula' : '';
            return row;
        });
    $('explain').replaceChildren(...rows);
}

// ------------------------------------------------------------------------------- pointer

const middle = (face, positions) =>
    [0, 1, 2].map(k => face.reduce((sum, v) => sum + positions[3 * v + k], 0) / face.length);

// The edges of a curve, as pairs of points.
function curveEdges() {
    const count = points.length / 3,
        edges = [];
    for (let i = 0; i < (s.ends === CLOSED ? count : count - 1); i++)
        edges.push(i, (i + 1) % count);
    return edges;
}

const curveEdgePoints = () => (curveEdges().length / 2) * perEdge(curve());

// What can be seen under the pointer: a vertex, else an edge, of a curve a point on it, else the
// middle of a face.
function hitAt(x, y, reach = 1) {
    if (!s.cage) return null;
    const d = lib.describe(),
        seen = scene.onScreen(isCurve() ? points : d.positions),
        inSight = at => isCurve() || !lib.hidden(at, scene.camera.position.toArray());
    const vertex = scene.nearest(seen, x, y, 12 * reach);
    if (vertex >= 0 && inSight(vertexAt(vertex))) return { kind: 'vertex', index: vertex };
    const edges = isCurve() ? curveEdges() : d.edges,
        { edge, t, depth } = scene.nearestEdge(seen, edges, x, y, 7 * reach);
    if (isCurve())
        return edge < 0 ? null : { kind: 'edge', index: Math.floor((edge + t) * perEdge(curve())) };
    if (edge >= 0 && inSight(scene.unproject(x, y, depth))) return { kind: 'edge', index: edge };
    if (s.scheme === LOOP) return null;
    const middles = faces.map(face => middle(face, d.positions)),
        face = scene.nearest(scene.onScreen(middles.flat()), x, y, 16 * reach);
    return face >= 0 && inSight(middles[face]) ? { kind: 'face', index: face } : null;
}

let press = null,
    frames = 0,
    since = 0; // when counting frames began

function pointerDown(event) {
    if (event.button !== 0 || !event.isPrimary) return;
    const { x, y } = scene.place(event),
        hit = hitAt(x, y, event.pointerType === 'touch' ? 2 : 1);
    press = { hit, x, y };
    if (!hit) return;
    if (hit.kind === 'vertex') press.vertex = scene.onScreen(vertexAt(hit.index));
    scene.controls.enabled = false;
    scene.canvas.setPointerCapture(event.pointerId);
}

function pointerMove(event) {
    if (!event.isPrimary) return;
    const { x, y } = scene.place(event);
    if (!press) {
        const hit = event.buttons ? null : hitAt(x, y);
        if (hit && JSON.stringify(hit) !== JSON.stringify(marked)) mark(hit);
        scene.canvas.style.cursor = hit ? (hit.kind === 'vertex' ? 'grab' : 'pointer') : '';
        return;
    }
    if (!press.moved && Math.hypot(x - press.x, y - press.y) < 4) return;
    if (!press.moved && press.vertex) mark(null);
    press.moved = true;
    if (!press.vertex) return;
    press.to = [press.vertex[0] + x - press.x, press.vertex[1] + y - press.y];
    scene.wake();
}

// Before each frame: moves the vertex to where the pointer is by then.
function eachFrame() {
    scene.lookAt(lib.describe().buffer, false);
    if (!press?.to) return;
    moveVertex(press.hit.index, ...press.to);
    press.to = null;
    frames++;
    if (performance.now() - since > 500) showFacts();
}

function pointerUp(event) {
    if (!press || !event.isPrimary) return;
    eachFrame();
    const { hit, moved, vertex } = press;
    press = null;
    scene.controls.enabled = true;
    if (!moved && hit?.kind === 'edge') sharpenMore(hit.index);
    if (!moved || vertex) mark(hit);
    if (moved && vertex) edited();
}

function edited() {
    scene.settle();
    showFacts();
    remember();
}

// ------------------------------------------------------------------------------- keys

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] },
    KINDS = { v: 'vertex', e: 'edge', f: 'face' };

function undoKey(event) {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z') return;
    event.preventDefault();
    undo(event.shiftKey ? 1 : -1);
}

// On the picture: v, e and f go through vertices, edges and faces, and with shift back. Arrows move
// the vertex or turn the view, Enter sharpens the edge.
function pictureKey(event) {
    const kind = KINDS[event.key.toLowerCase()],
        arrow = ARROWS[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (kind) goThrough(kind, event.shiftKey ? -1 : 1);
    else if (arrow) followArrow(...arrow);
    else if (event.key === 'Enter' && marked?.kind === 'edge') sharpenMore(marked.index);
    else if (event.key === 'Escape') mark(null);
    else return;
    event.preventDefault();
}

function goThrough(kind, step) {
    const d = lib.describe(),
        count = isCurve()
            ? { vertex: points.length / 3, edge: curveEdgePoints(), face: 0 }
            : { vertex: d.vertexCount, edge: d.edgeCount, face: d.faceCount };
    if (!count[kind]) return;
    const from = marked?.kind === kind ? marked.index : step > 0 ? -1 : 0;
    mark({ kind, index: (from + step + count[kind]) % count[kind] });
    if (kind !== 'edge' || isCurve()) return;
    chosen = marked.index;
    scene.showCage(d, chosen);
    showControls();
}

function followArrow(x, y) {
    if (marked?.kind !== 'vertex') {
        scene.controls.rotateLeft(0.1 * x);
        scene.controls.rotateUp(0.1 * y);
        return;
    }
    const at = scene.onScreen(vertexAt(marked.index));
    moveVertex(marked.index, at[0] + 8 * x, at[1] + 8 * y);
    mark(marked);
    edited();
}

// ------------------------------------------------------------------------------- controls

function showFacts() {
    const now = performance.now(),
        rate = press && since ? Math.round((1000 * frames) / (now - since)) : 0;
    frames = 0;
    since = press ? now : 0;
    const d = lib.describe();
    $('facts').textContent =
        (isCurve()
            ? `${lib.curveCount(curve(), points.length / 3)} points`
            : `${number(d.pointCount)} points, ${number(d.fineFaces)} faces`) +
        (evaluated ? `, evaluated in ${evaluated.toFixed(1)} ms` : '') +
        (rate ? `, ${rate} frames a second` : '');
}

const choices = (select, names) => select.replaceChildren(...names.map(name => new Option(name)));

function showControls() {
    document.body.classList.toggle('curve', isCurve());
    for (const mode of ['surface', 'curve']) {
        $(mode).classList.toggle('on', s.mode === mode);
        $(mode).setAttribute('aria-pressed', s.mode === mode);
    }
    choices($('rule'), RULES[s.scheme]);
    if (s.rule >= RULES[s.scheme].length) s.rule = 0;
    $('rule').disabled = RULES[s.scheme].length === 1;
    $('triangles').disabled = s.scheme !== 0;
    for (const key of SELECTS) $(key).selectedIndex = s[key];
    for (const key of CHECKS) $(key).checked = s[key];
    choices($('name'), [...new Set([...Object.keys(CAGES), s.name])]);
    $('name').value = s.name;
    $('levels').value = s.levels;
    $('levels-out').textContent = isCurve() ? s.levels : levels();
    const sharpness = chosen >= 0 ? lib.describe().sharpness[chosen] : 0;
    $('sharpness').disabled = chosen < 0;
    $('sharpness').value = Math.min(sharpness, 5);
    $('sharpness-out').textContent = chosen < 0 ? '' : sharpness >= FOREVER ? '∞' : sharpness;
}

function set(more) {
    Object.assign(s, more);
    showControls();
    rebuild();
}

function setMode(mode) {
    marked = null;
    s.mode = mode;
    scene.frame(isCurve() ? points : lib.describe().positions);
    set({});
}

function addPoint(event) {
    const { x, y } = scene.place(event);
    if (!isCurve() || hitAt(x, y)?.kind === 'vertex') return;
    points.push(...scene.unproject(x, y, scene.onScreen(points)[2]));
    rebuild();
}

function connectControls() {
    const on = (id, what, act) => $(id).addEventListener(what, act);
    for (const key of SELECTS) on(key, 'change', () => set({ [key]: $(key).selectedIndex }));
    on('limit', 'change', () => set({ limit: $('limit').checked }));
    for (const key of ['cage', 'wire'])
        on(key, 'change', () => {
            s[key] = $(key).checked;
            if (isCurve()) showCurve();
            scene.show(s);
            remember();
        });
    on('levels', 'input', () => set({ levels: +$('levels').value }));
    on('sharpness', 'input', () => {
        const value = +$('sharpness').value;
        sharpen(chosen, value >= 5 ? FOREVER : value);
    });
    on('name', 'change', () => {
        const name = $('name').value,
            obj = CAGES[name] ?? loaded.surface;
        s.scheme = OF_TRIANGLES.includes(name) ? LOOP : 0;
        s.levels = obj.length > 3000 ? 3 : 4;
        load(obj, name);
    });
    on('surface', 'click', () => setMode('surface'));
    on('curve', 'click', () => setMode('curve'));
    on('undo', 'click', () => undo(-1));
    on('redo', 'click', () => undo(1));
    on('reset', 'click', () => load(loaded[s.mode], s.name));
}

function connectPicture() {
    const { canvas } = scene;
    canvas.tabIndex = 0;
    canvas.setAttribute('aria-label', 'The cage and its surface; keys: v, e, f, arrows, Enter');
    canvas.addEventListener('pointerdown', pointerDown, { capture: true });
    canvas.addEventListener('pointermove', pointerMove);
    canvas.addEventListener('pointerup', pointerUp);
    canvas.addEventListener('pointercancel', pointerUp);
    canvas.addEventListener('dblclick', addPoint);
    canvas.addEventListener('keydown', pictureKey);
    canvas.addEventListener('webglcontextlost', () =>
        say('The graphics card was taken away: when it is back, so is the picture.'),
    );
    canvas.addEventListener('webglcontextrestored', () => say(''));
    addEventListener('keydown', undoKey);
}

// ------------------------------------------------------------------------------- files

const SETTINGS = '# playground ';

// The settings in an OBJ file: those that this page may have.
function settingsOf(obj) {
    const line = obj.split('\n').find(line => line.startsWith(SETTINGS));
    if (!line) return {};
    let settings;
    try {
        settings = JSON.parse(line.slice(SETTINGS.length));
    } catch (e) {
        throw Error('The settings in this file cannot be read.');
    }
    return checked(settings);
}

function checked(settings) {
    for (const [key, value] of Object.entries(settings))
        if (typeof value !== typeof s[key] || !isAllowed(key, value, settings.scheme))
            throw Error(`The settings in this file have ${key} = ${value}.`);
    return settings;
}

// Numbers of lists and levels are what their controls take.
function isAllowed(key, value, scheme) {
    if (key === 'mode') return value === 'surface' || value === 'curve';
    if (key === 'rule') return value in (RULES[scheme] || []);
    if (typeof value !== 'number') return true;
    const control = $(key);
    if (control.tagName === 'SELECT') return control.options[value] !== undefined;
    return Number.isInteger(value) && value >= 0 && value <= +control.max;
}

// Shows what is in an OBJ file; if that cannot be, says why and leaves all as it was.
function load(obj, name) {
    const before = lib.save();
    let warning, settings;
    try {
        warning = lib.load(obj);
        settings = settingsOf(obj);
        const d = lib.describe();
        if (d.faceCount > MOST_FACES)
            throw Error(`A cage of ${number(d.faceCount)} faces is too large for this page.`);
        if (d.positions.some(x => Math.abs(x) > MOST_COORDINATE))
            throw Error('Coordinates above 1e15 are too large for this page.');
        if (!d.faceCount && !d.lineCount) throw Error('This file has no faces and no lines.');
        if (!d.faceCount && d.lineCount > 1)
            warning = `This page shows the first of ${d.lineCount} polylines.`;
    } catch (e) {
        if (before) lib.load(before);
        return say(e.message);
    }
    marked = null;
    chosen = -1;
    if (lib.describe().faceCount) takeCage(obj, name);
    else {
        takeLine(obj);
        lib.load(before);
    }
    Object.assign(s, settings);
    const level = settings.levels ?? levels(MOST_AT_FIRST);
    if (!isCurve() && level < s.levels) {
        s.levels = level;
        warning ||= `This cage has ${number(faces.length)} faces: it begins at level ${level}.`;
    }
    setMode(s.mode);
    if (warning) say(warning);
}

function takeCage(obj, name) {
    const { boundary, creasing, triangles } = lib.describe();
    Object.assign(s, { boundary, creasing, triangles, name, mode: 'surface' });
    faces = lib.faces();
    loaded.surface = obj;
}

function takeLine(obj) {
    const line = lib.line(),
        { positions } = lib.describe(),
        closed = line[0] === line[line.length - 1];
    s.mode = 'curve';
    loaded.curve = obj;
    s.ends = closed ? CLOSED : s.ends === CLOSED ? 0 : s.ends;
    points = [];
    for (const v of closed ? line.slice(0, -1) : line)
        points.push(...positions.slice(3 * v, 3 * v + 3));
}

// With the fewest digits that read back as the same float.
function shortest(x) {
    const float = Math.fround(x);
    let digits = 6;
    while (digits < 9 && Math.fround(float.toPrecision(digits)) !== float) digits++;
    return +float.toPrecision(digits);
}

// What is seen as an OBJ file, with the settings that OBJ has no words for as a comment.
function saved() {
    const { name, ...settings } = s,
        comment = `${SETTINGS}${JSON.stringify(settings)}\n`;
    if (!isCurve()) return comment + lib.save();
    let obj = comment,
        line = 'l';
    for (let i = 0; i < points.length; i += 3) {
        obj += `v ${points
            .slice(i, i + 3)
            .map(shortest)
            .join(' ')}\n`;
        line += ` ${i / 3 + 1}`;
    }
    return obj + line + (s.ends === CLOSED ? ' 1\n' : '\n');
}

async function openFile(file) {
    if (file.size > MOST_BYTES) return say('This file is too large for a page.');
    load(await file.text(), file.name.replace(/\.obj$/i, ''));
}

function save() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([saved()], { type: 'model/obj' }));
    link.download = `${s.name}.obj`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Out of the page, into a folder or onto another page.
function dragOut({ dataTransfer }) {
    const obj = saved();
    dataTransfer.setData(
        'DownloadURL',
        `model/obj:${s.name}.obj:data:model/obj,${encodeURIComponent(obj)}`,
    );
    dataTransfer.setData('text/plain', obj);
}

function drop(event) {
    const { dataTransfer } = event,
        text = dataTransfer.getData('text/plain');
    event.preventDefault();
    document.body.classList.remove('dropping');
    if (dataTransfer.files.length) openFile(dataTransfer.files[0]);
    else if (text) load(text, s.name);
}

function connectFiles() {
    $('open').addEventListener('click', () => $('file').click());
    $('file').addEventListener('change', () => {
        if ($('file').files.length) openFile($('file').files[0]);
        $('file').value = '';
    });
    $('save').addEventListener('click', save);
    $('save').addEventListener('dragstart', dragOut);
    addEventListener('dragover', event => {
        event.preventDefault();
        document.body.classList.add('dropping');
    });
    addEventListener('dragleave', event => {
        if (!event.relatedTarget) document.body.classList.remove('dropping');
    });
    addEventListener('drop', drop);
    addEventListener('hashchange', recall);
}

// ------------------------------------------------------------------------------- undo, the address

let past = [], // states as JSON
    here = -1,
    timer = 0,
    written = '';

const state = () => ({
    ...s,
    points,
    obj: lib.save(),
    loaded: {
        surface: CAGES[s.name] === loaded.surface ? undefined : loaded.surface,
        curve: POLYGON === loaded.curve ? undefined : loaded.curve,
    },
});

function show({ obj, points: given, loaded: first, view, ...settings }) {
    checked(settings);
    lib.load(obj);
    faces = lib.faces();
    Object.assign(s, settings);
    points = given;
    loaded = { surface: CAGES[s.name], curve: POLYGON, ...first };
    [chosen, marked] = [-1, null];
    if (view) {
        scene.frame(isCurve() ? points : lib.describe().positions);
        scene.look(view);
    }
    set({});
}

// Takes down what is seen, when nothing has changed for a moment.
function remember() {
    clearTimeout(timer);
    timer = setTimeout(record, 300);
}

async function record() {
    clearTimeout(timer);
    const now = JSON.stringify(state());
    if (now !== past[here]) past.splice(++here, Infinity, now);
    while (here > 1 && past.length * now.length > MOST_KEPT) (past.shift(), here--);
    $('undo').disabled = here === 0;
    $('redo').disabled = here === past.length - 1;
    if (now.length > MOST_SHARED) written = '#';
    else written = '#' + (await pack(JSON.stringify({ ...state(), view: scene.viewpoint() })));
    history.replaceState(null, '', written);
}

function undo(step) {
    record();
    if (past[here + step]) show(JSON.parse(past[(here += step)]));
}

async function recall() {
    if (location.hash.length < 2 || location.hash === written) return;
    try {
        show(JSON.parse(await unpack(location.hash.slice(1))));
    } catch (e) {
        say('The address holds no state that can be read.');
    }
}

// ------------------------------------------------------------------------------- start

async function start() {
    await lib.start();
    scene = new Scene($('view'), $('labels'), eachFrame, remember);
    connectControls();
    connectPicture();
    connectFiles();
    load(CAGES.cube, 'cube');
    load(POLYGON, 'cube');
    setMode('surface');
    await recall();
    // For tests and the console.
    window.playground = {
        state: s,
        scene,
        lib,
        set,
        setMode,
        load,
        hitAt,
        record,
        obj: saved,
        curve: () => lib.curve(curve(), 3, points),
        vertexOnScreen: v => Array.from(scene.onScreen(vertexAt(v))),
        edgeOnScreen: e => {
            const { edges, positions } = lib.describe();
            return Array.from(scene.onScreen(middle(edges.slice(2 * e, 2 * e + 2), positions)));
        },
        count: () => lib.describe().pointCount,
        position: i => Array.from(lib.describe().buffer.slice(6 * i, 6 * i + 3)),
    };
}

start().catch(e => say(e.message));
