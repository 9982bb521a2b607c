// node tests/playground.js CHROMIUM PAGE SUBDIV: plays on the page as a person would, and compares
// what it shows with what the command line makes of the same cage.
const fs = require('fs');
const zlib = require('zlib');
const { execFileSync } = require('child_process');
const { check, run } = require('./lib/browse.js');

const [browserPath, pagePath, subdiv] = process.argv.slice(2);
const out = 'build/playground';

const numbers = (obj, letter) =>
    obj
        .split('\n')
        .filter(line => line.startsWith(letter + ' '))
        .map(line => line.split(/\s+/).slice(1, 4).map(Number));

// The vertices that the command line makes of a cage.
function refined(obj, ...options) {
    fs.writeFileSync(`${out}/cage.obj`, obj);
    execFileSync(subdiv, [...options, `${out}/cage.obj`, `${out}/fine.obj`]);
    return numbers(fs.readFileSync(`${out}/fine.obj`, 'utf8'), 'v');
}

const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

async function compare(page, name, ...options) {
    const shown = await page.evaluate(() => {
        const p = window.playground,
            count = p.count();
        return { obj: p.obj(), points: Array.from({ length: count }, (_, i) => p.position(i)) };
    });
    const told = refined(shown.obj, ...options);
    check(`${name}: ${told.length} points`, told.length === shown.points.length);
    check(
        `${name}: positions`,
        shown.points.every((p, i) => told[i] && distance(p, told[i]) < 1e-5),
    );
    return shown;
}

const on = (page, what, i) => page.evaluate(([what, i]) => window.playground[what](i), [what, i]);
const set = (page, more) => page.evaluate(more => window.playground.set(more), more);
const obj = page => page.evaluate(() => window.playground.obj());

async function dragVertex(page, vertex, dx, dy) {
    const [x, y] = await on(page, 'vertexOnScreen', vertex);
    await page.mouse.move(x, y);
    await page.waitForTimeout(100);
    const text = await page.textContent('#explain');
    await page.mouse.down();
    await page.mouse.move(x + dx / 2, y + dy / 2, { steps: 4 });
    await page.mouse.move(x + dx, y + dy, { steps: 4 });
    await page.waitForTimeout(100);
    await page.mouse.up();
    const end = await on(page, 'vertexOnScreen', vertex);
    check(
        `vertex ${vertex}, dragged, goes where the pointer goes`,
        distance(end.slice(0, 2), [x + dx, y + dy]) < 2,
    );
    return text;
}

async function clickEdge(page) {
    const [x, y, edge] = await page.evaluate(() => {
        const p = window.playground,
            count = p.lib.describe().edgeCount;
        for (let e = 0; e < count; e++) {
            const [x, y] = p.edgeOnScreen(e),
                hit = p.hitAt(x, y);
            if (hit && hit.kind === 'edge' && hit.index === e) return [x, y, e];
        }
    });
    await page.mouse.move(x, y);
    await page.mouse.click(x, y);
    return page.evaluate(e => window.playground.lib.describe().sharpness[e], edge);
}

async function surfaces(page) {
    await set(page, { levels: 2, limit: false });
    const before = await compare(page, 'the cube', '-l', '2');
    const text = await dragVertex(page, 3, 70, -50);
    check('the text explains', text.startsWith('Point 3 of the mesh refined once'));
    check(
        'the panel and its text have room',
        await page.$$eval('#panel, #explain div', parts =>
            parts.every(part => part.scrollWidth <= part.clientWidth),
        ),
    );
    const dragged = await compare(page, 'a vertex dragged', '-l', '2');
    check('dragging moves the surface', distance(before.points[3], dragged.points[3]) > 0.05);
    check('a click sharpens an edge', (await clickEdge(page)) === 1);
    check(
        'the file has the crease',
        /^t crease .*\b1$/m.test((await compare(page, 'an edge sharpened', '-l', '2')).obj),
    );
    for (let i = 0; i < 3; i++) await clickEdge(page);
    check('more clicks sharpen it for ever', (await clickEdge(page)) === 0);
    await clickEdge(page);
    await set(page, { levels: 3, limit: true });
    await compare(page, 'on the limit', '-l', '3', '--limit');
    await set(page, { scheme: 1, rule: 1, limit: false });
    const warren = ['-s', 'loop', '--triangulate', '--vertex-rule', 'warren'];
    await compare(page, 'Loop', '-l', '3', ...warren);
    await set(page, { scheme: 0, rule: 0, levels: 2, creasing: 1 });
    await compare(page, 'Chaikin', '-l', '2', '-c', 'chaikin');
    const [x, y] = await on(page, 'vertexOnScreen', 3);
    await page.mouse.move(x, y);
    const labels = () => page.$$eval('#labels span', spans => spans.map(s => s.textContent));
    const standard = await labels();
    await page.selectOption('#rule', 'averaged');
    check('a mask stays and follows the rule', `${await labels()}` !== `${standard}`);
    await page.selectOption('#rule', 'standard');
    check('and back', `${await labels()}` === `${standard}` && standard.length > 6);
}

// What the page behind shows of its state, whatever the view.
const seen = page =>
    page.evaluate(() =>
        JSON.stringify([
            window.playground.state,
            window.playground.obj(),
            window.playground.count(),
            window.playground.position(7),
        ]),
    );

async function undoing(page) {
    await page.waitForTimeout(500);
    const before = await seen(page);
    await dragVertex(page, 3, -30, -20);
    const after = await seen(page);
    await page.keyboard.press('Control+z');
    check('undo brings back what was', (await seen(page)) === before && before !== after);
    await page.waitForTimeout(500);
    await page.click('#redo');
    check('redo brings back what was undone', (await seen(page)) === after);
    await page.keyboard.press('Control+z');
    check('undo again', (await seen(page)) === before);
}

async function keys(page) {
    await page.focus('canvas');
    for (const key of ['v', 'v', 'Shift+V', 'v']) await page.keyboard.press(key);
    check('v goes through vertices', (await page.textContent('#explain')).includes('of vertex 1.'));
    const at = () => page.evaluate(() => window.playground.vertexOnScreen(1));
    const before = await at();
    await page.keyboard.press('ArrowLeft');
    const after = await at();
    check('an arrow moves it', Math.abs(after[0] - before[0] + 8) < 0.1);
    await page.keyboard.press('e');
    const sharpness = () => page.evaluate(() => window.playground.lib.describe().sharpness[0]);
    const sharp = await sharpness();
    await page.keyboard.press('Enter');
    check('Enter sharpens an edge', (await sharpness()) > sharp);
    await page.keyboard.press('Escape');
    check('Escape takes the mask away', (await page.$$('#labels span')).length === 0);
    await page.selectOption('#name', 'tetrahedron');
    await page.focus('canvas');
    await page.keyboard.press('e');
    const rows = await page.$$eval('#explain div', all => all.map(row => row.textContent));
    const sides = rows.filter(row => /^ +[/\\] +[/\\]$/.test(row));
    check('a diagram keeps its lines', sides.length === 4);
}

// Of a cube that is its own surface, of any size, all vertices can be caught but the one behind.
async function inSight(page) {
    await page.selectOption('#name', 'cube');
    await set(page, { levels: 0, limit: false });
    const cube = await obj(page);
    for (const size of [1e-12, 1e12, 1]) {
        const scaled = (_, at) => `v ${at.split(' ').map(x => size * x).join(' ')}`;
        await drop(page, 'cube.obj', cube.replace(/^v (.*)$/gm, scaled));
        const caught = await page.evaluate(() =>
            [0, 1, 2, 3, 4, 5, 6, 7].filter(v => {
                const [x, y] = window.playground.vertexOnScreen(v),
                    hit = window.playground.hitAt(x, y);
                return hit && hit.kind === 'vertex' && hit.index === v;
            }),
        );
        check(`vertices in sight can be caught: ${caught}`, `${caught}` === '0,1,2,3,4,5,7');
    }
}

// The pixels of a square of the picture, as it is when all frames are drawn.
const pixels = (page, x, y, size) =>
    page.evaluate(
        async ([x, y, size]) => {
            for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
            const picture = new OffscreenCanvas(size, size).getContext('2d');
            picture.drawImage(window.playground.scene.canvas, -x, -y);
            return Array.from(picture.getImageData(0, 0, size, size).data);
        },
        [x, y, size],
    );

// A flat face has one shade. When the graphics card comes back, so does the picture.
async function pictures(page) {
    await page.click('#reset');
    await set(page, { levels: 0, limit: false, cage: false });
    const [x, y] = await page.evaluate(() => window.playground.scene.onScreen([0, 1, 0]));
    const face = await pixels(page, x - 20, y - 20, 40),
        red = face.filter((_, i) => i % 4 === 0);
    const shades = Math.max(...red) - Math.min(...red);
    check(`a flat face has one shade, not ${shades}`, red[0] > 150 && shades < 4);
    const told = is =>
        page.waitForFunction(
            is => (document.getElementById('message').textContent !== '') === is,
            is,
        );
    await page.evaluate(() => window.playground.scene.renderer.forceContextLoss());
    await told(true);
    await page.evaluate(() => window.playground.scene.renderer.forceContextRestore());
    await told(false);
    const again = await pixels(page, x - 20, y - 20, 40);
    check('a lost picture comes back', `${again}` === `${face}`);
    await set(page, { cage: true });
}

async function touch(browser) {
    const context = await browser.newContext({
        viewport: { width: 400, height: 800 },
        hasTouch: true,
        isMobile: true,
    });
    const page = await open(context);
    const [x, y] = await on(page, 'vertexOnScreen', 3);
    const cdp = await context.newCDPSession(page);
    const send = (type, ...touchPoints) =>
        cdp.send('Input.dispatchTouchEvent', { type, touchPoints });
    await send('touchStart', { x: x + 15, y });
    for (let i = 1; i <= 5; i++) await send('touchMove', { x: x + 15 - 8 * i, y });
    await send('touchEnd');
    const end = await on(page, 'vertexOnScreen', 3);
    check('a finger drags a vertex', Math.abs(end[0] - x + 40) < 1 && Math.abs(end[1] - y) < 1);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    check('the page fits a phone', wide <= 400);
    await context.close();
}

// A page opened at the address shows the same.
async function address(page, context) {
    await set(page, { triangles: 1, wire: true });
    await page.evaluate(() => window.playground.record());
    const other = await open(context, page.url());
    check('the address has the state', page.url().includes('#'));
    check('a page at the address shows it', (await seen(page)) === (await seen(other)));
    const held = zlib.inflateRawSync(Buffer.from(page.url().split('#')[1], 'base64url')),
        odd = zlib.deflateRawSync(`${held}`.replace(/"levels":\d/, '"levels":99'));
    await other.evaluate(hash => (location.hash = hash), odd.toString('base64url'));
    await other.waitForTimeout(300);
    const said = await other.textContent('#message');
    check('an address with odd settings is refused', said.startsWith('The address holds'));
    check('and changes nothing', (await seen(page)) === (await seen(other)));
    await other.close();
    await set(page, { wire: false, creasing: 0 });
}

const drop = (page, name, text) =>
    page.evaluate(
        async ([name, text]) => {
            const dataTransfer = new DataTransfer();
            if (name) dataTransfer.items.add(new File([text], name));
            else dataTransfer.setData('text/plain', text);
            window.dispatchEvent(new DragEvent('drop', { dataTransfer }));
            await new Promise(done => setTimeout(done, 300));
        },
        [name, text],
    );

// What a folder gets if the save button is dragged there: the file's name and its text.
async function draggedOut(page) {
    const [url, text] = await page.evaluate(() => {
        const dataTransfer = new DataTransfer();
        document
            .getElementById('save')
            .dispatchEvent(new DragEvent('dragstart', { dataTransfer, bubbles: true }));
        return [dataTransfer.getData('DownloadURL'), dataTransfer.getData('text/plain')];
    });
    const [, name, data] = url.match(/^model\/obj:([^:]+):data:model\/obj,(.*)$/) ?? [];
    check('the dragged file is the text', data && decodeURIComponent(data) === text);
    return [name, text];
}

async function savedByButton(page) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
    return [download.suggestedFilename(), fs.readFileSync(await download.path(), 'utf8')];
}

// A page that gets a saved file shows the same as the page that saved it.
async function saveAndLoad(page, context, what) {
    const [name, text] = await draggedOut(page);
    check(
        `${what}: button and drag save alike`,
        `${await savedByButton(page)}` === `${[name, text]}`,
    );
    const other = await open(context);
    await drop(other, name, text);
    check(`${what}: a dropped file shows the same`, (await seen(page)) === (await seen(other)));
    await drop(other, 'cube.obj', fs.readFileSync('examples/cages/camera.obj', 'utf8'));
    check(`${what}: another file shows something else`, (await seen(page)) !== (await seen(other)));
    await set(other, { name: name.replace('.obj', '') });
    await drop(other, '', text);
    check(`${what}: dropped text shows the same`, (await seen(page)) === (await seen(other)));
    await other.close();
}

const PYRAMID =
    'v 0 2 0\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv -1 0 1\n' +
    'f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\nf 5 4 3 2\n# Привет\n';

async function files(page, context) {
    await drop(page, 'pyramid.obj', PYRAMID);
    await set(page, { levels: 3, limit: false });
    const plain = await compare(page, 'triangles', '-l', '3', '-t', 'catmull-clark');
    await page.selectOption('#triangles', 'smooth');
    const smooth = await compare(page, 'smooth triangles', '-l', '3', '-t', 'smooth');
    check(
        'smooth triangles differ',
        smooth.points.some((p, i) => distance(p, plain.points[i]) > 0.01),
    );
    await compare(page, 'smooth triangles by the file', '-l', '3');
    const triangles = () => page.$eval('#triangles', select => select.value);
    await drop(page, 'pyramid.obj', PYRAMID);
    check('a file without tags has the default', (await triangles()) === 'as other faces');
    await drop(page, 'pyramid.obj', `${PYRAMID}t smoothtriangles 0/0/1 smooth\n`);
    check('a file says what its triangles are', (await triangles()) === 'smooth');
    await address(page, context);
    await set(page, { scheme: 0, rule: 2, boundary: 1, levels: 2, limit: true });
    await clickEdge(page);
    const rules = ['--vertex-rule', 'doo-sabin'];
    await compare(page, 'the saved file', '-l', '2', '--limit', ...rules);
    await saveAndLoad(page, context, 'a surface');
}

const TRIANGLE = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n';

async function refusals(page) {
    const before = await seen(page);
    for (const [text, words] of [
        ['v 0 0 0\nf 1 2 3\n', /vertex 2 does not exist/],
        ['\x89PNG\r\n\x1a\n\0\0', /binary data/],
        ['', /no vertices/],
        ['v 0 0 0\n', /no faces/],
        [TRIANGLE.replace('1', '1e30'), /too large/],
        [`# playground {"scheme":1,"lev\n${TRIANGLE}`, /cannot be read/],
        [`# playground {"levels":99}\n${TRIANGLE}`, /levels = 99/],
        [`# playground {"scheme":7}\n${TRIANGLE}`, /scheme = 7/],
        [`# playground {"scheme":0,"rule":"x"}\n${TRIANGLE}`, /rule = x/],
        [`# playground {"mode":"foo"}\n${TRIANGLE}`, /mode = foo/],
    ]) {
        await drop(page, 'bad.obj', text);
        const said = await page.textContent('#message');
        check(`${JSON.stringify(text)} is refused with words, not "${said}"`, words.test(said));
        check('and changes nothing', (await seen(page)) === before);
    }
    await page.evaluate(() =>
        window.dispatchEvent(new DragEvent('drop', { dataTransfer: new DataTransfer() })),
    );
    await drop(page, 'warned.obj', `${PYRAMID}f 1 2\n`);
    check('a warning has words', /face/.test(await page.textContent('#message')));
}

function grid(n) {
    const rows = [];
    for (let i = 0; i <= n; i++)
        for (let j = 0; j <= n; j++) rows.push(`v ${i / n} ${j / n} ${((i * j) % 7) / n}`);
    for (let i = 0; i < n; i++)
        for (let j = 0; j < n; j++) {
            const a = i * (n + 1) + j + 1;
            rows.push(`f ${a} ${a + n + 1} ${a + n + 2} ${a + 1}`);
        }
    return rows.join('\n');
}

async function largeCage(page) {
    await set(page, { levels: 4 });
    await drop(page, 'grid.obj', grid(120));
    const begun = await page.textContent('#message');
    check(`a large cage begins low, "${begun}"`, /14,400 faces: .* level 2\.$/.test(begun));
    const few = await page.evaluate(() => window.playground.count());
    check(`at the level it says: ${few}`, few === 481 ** 2);
    await set(page, { scheme: 0, levels: 6 });
    const told = await page.textContent('#message');
    check(
        `a level too high is refused with words, not "${told}"`,
        /^Level 6 .* too many/.test(told),
    );
    const count = await page.evaluate(() => window.playground.count());
    check(`the level below is shown: ${count}`, count > 2e5 && count < 1.3e6);
}

// Counts what the page does: calls of the library, and buffers made, filled and changed in place.
// While drawing is off, all is done but what the graphics card does.
function spy(drawing) {
    const counts = (window.counts = {}),
        count = (what, by = 1) => (counts[what] = (counts[what] ?? 0) + by);
    window.drawing = drawing;
    const instantiate = WebAssembly.instantiate;
    WebAssembly.instantiate = async (...given) => {
        const result = await instantiate(...given),
            exports = {};
        for (const [name, value] of Object.entries(result.instance.exports))
            exports[name] =
                typeof value === 'function' ? (...a) => (count(name), value(...a)) : value;
        return { instance: { exports } };
    };
    const gl = WebGL2RenderingContext.prototype,
        wrap = (name, before) => {
            const own = gl[name];
            gl[name] = function (...given) {
                return before(...given) === false ? undefined : own.apply(this, given);
            };
        };
    wrap('createBuffer', () => void count('buffers'));
    wrap('bufferData', () => void count('buffers'));
    wrap(
        'bufferSubData',
        (target, at, array, from, length) =>
            void count(
                target === gl.ELEMENT_ARRAY_BUFFER ? 'indices' : 'bytes',
                length ? 4 * length : array.byteLength,
            ),
    );
    for (const name of [
        'drawElements',
        'drawArrays',
        'drawArraysInstanced',
        'drawElementsInstanced',
    ])
        wrap(name, () => window.drawing);
}

// Drags a vertex at more than 100,000 points, and looks at what each frame does and takes.
async function dragLarge(page, context) {
    await page.selectOption('#name', 'octopus');
    await set(page, { levels: 4, limit: true });
    const points = await page.evaluate(() => window.playground.count());
    check('a large cage is shown', points > 100000);
    const [x, y] = await page.evaluate(() => {
        for (let v = 0; ; v++) {
            const [x, y] = window.playground.vertexOnScreen(v);
            const hit = window.playground.hitAt(x, y);
            if (hit && hit.kind === 'vertex' && hit.index === v) return [x, y];
        }
    });
    const cdp = await context.newCDPSession(page);
    await cdp.send('Performance.enable', { timeDomain: 'threadTicks' });
    const spent = async () => {
        const { metrics } = await cdp.send('Performance.getMetrics');
        return Object.fromEntries(metrics.map(({ name, value }) => [name, 1000 * value]));
    };
    await page.evaluate(() => (window.drawing = false));
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 0; i < 10; i++) await page.mouse.move(x + i, y - i); // all is made by now
    await page.waitForTimeout(100);
    await page.evaluate(() => Object.keys(window.counts).forEach(key => delete window.counts[key]));
    const before = await spent();
    for (let i = 0; i < 100; i++) await page.mouse.move(x + 10 + i / 3, y - 10 - i / 4);
    await page.waitForTimeout(100);
    const after = await spent(),
        counts = await page.evaluate(() => window.counts),
        frames = counts.evaluate;
    await page.mouse.up();
    await page.evaluate(() => (window.drawing = true));
    const each = key => ((after[key] - before[key]) / frames).toFixed(1);
    console.log(
        `playground: a frame of dragging at ${points} points on the limit, with normals: ` +
            `${each('ScriptDuration')} ms of script, ${each('TaskDuration')} ms with all that ` +
            `the browser does but drawing (mean of ${frames})`,
    );
    check('a drag moves points once a frame', frames > 20);
    check('a drag prepares nothing', !counts.rebuild && !counts.take && !counts.explain);
    check('a drag makes no buffers and changes no indices', !counts.buffers && !counts.indices);
    const surface = 24 * (await page.evaluate(() => window.playground.lib.describe().bufferCount)),
        rest = counts.bytes / frames - surface;
    check(`a drag changes the surface and ${rest} bytes`, rest >= 0 && rest < 1000);
}

async function curves(page, context) {
    await page.click('#curve');
    await set(page, { curveRule: 1, ends: 2, levels: 3, limit: false });
    await dragVertex(page, 1, 40, 30);
    const shown = await page.evaluate(() => [window.playground.obj(), window.playground.curve()]);
    const told = refined(shown[0], '--curve', 'chaikin', '-l', '3'),
        made = Array.from(Object.values(shown[1]));
    check(`a curve: ${told.length} points`, 3 * told.length === made.length);
    check(
        'a curve: positions',
        told.every((p, i) => distance(p, made.slice(3 * i, 3 * i + 3)) < 1e-5),
    );
    const other = await open(context);
    await drop(other, 'curve.obj', shown[0]);
    const again = await obj(other);
    check('a dropped curve is the same', again === shown[0]);
    await set(other, { ends: 0 });
    await dragVertex(other, 2, 20, 20);
    await other.click('#reset');
    check('reset goes back to it', (await obj(other)) === shown[0]);
    await other.click('#surface');
    check('and the cage is still there', (await on(other, 'count')) > 300);
    await other.close();
}

// The masks that pointer and keys show are those of all points of level 1.
async function curveMasks(page) {
    for (const [curveRule, ends] of [0, 1].flatMap(rule => [0, 1, 2].map(ends => [rule, ends]))) {
        await set(page, { curveRule, ends, levels: 1, limit: false });
        const name = `rule ${curveRule}, ends ${ends}`,
            [a, b] = [await on(page, 'vertexOnScreen', 1), await on(page, 'vertexOnScreen', 2)];
        await page.mouse.move(a[0] + 0.7 * (b[0] - a[0]), a[1] + 0.7 * (b[1] - a[1]));
        const labels = await page.$$eval('#labels span', spans => spans.map(s => s.textContent));
        check(`${name}: the mask is ${labels}`, `${labels}` === ['1/2,1/2,', '1/4,3/4,'][curveRule]);
        await page.focus('canvas');
        const shown = [];
        for (const key of 'vvvvveeeeeeeeee') {
            await page.keyboard.press(key);
            shown.push(await page.evaluate(() => window.playground.scene.marks.at(-1)?.at));
        }
        const made = Object.values(await page.evaluate(() => window.playground.curve())),
            points = made.flatMap((_, i) => (i % 3 ? [] : [made.slice(i, i + 3)])),
            among = (point, list) => list.some(other => distance(point, other) < 1e-6),
            places = shown.filter(Boolean);
        check(`${name}: all points have masks`, points.every(point => among(point, places)));
        check(`${name}: all masks have points`, places.every(place => among(place, points)));
    }
}

let pagePlace;

async function open(context, place = pagePlace, drawing = false) {
    const page = await context.newPage();
    page.setDefaultTimeout(120000); // other tests may run at the same time
    page.on('pageerror', error => check(`no error: ${error.message}`, false));
    page.on('console', said => check(`no error: ${said.text()}`, said.type() !== 'error'));
    page.on('request', request =>
        check(
            `no request: ${request.url().slice(0, 60)}`,
            /^(file|data|blob):/.test(request.url()),
        ),
    );
    await page.addInitScript(spy, drawing);
    await page.goto(place);
    await page.waitForFunction(() => window.playground);
    await page.evaluate(() => (window.playground.scene.refines = false));
    return page;
}

run('playground', browserPath, async browser => {
    const context = await browser.newContext({ viewport: { width: 1000, height: 600 } });
    pagePlace = `file://${fs.realpathSync(pagePath)}`;
    const page = await open(context, pagePlace, true);
    await surfaces(page);
    await undoing(page);
    await keys(page);
    await inSight(page);
    await pictures(page);
    await dragLarge(page, context);
    await files(page, context);
    await refusals(page);
    await curves(page, context);
    await curveMasks(page);
    await largeCage(page);
    await touch(browser);
});
