// node tests/playground.js CHROMIUM PAGE SUBDIV: plays on the page as a person would, and compares
// what it shows with what the command line makes of the same cage.
const fs = require('fs');
const { execFileSync } = require('child_process');
const { chromium } = require('playwright-core');

const [browserPath, pagePath, subdiv] = process.argv.slice(2);
const out = 'build/playground';
let passed = 0,
    failed = 0;

function check(name, holds) {
    if (holds) return passed++;
    failed++;
    console.log(`FAILED  ${name}`);
}

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

async function dragVertex(page, vertex, dx, dy) {
    const at = await on(page, 'vertexOnScreen', vertex);
    await page.mouse.move(at.x, at.y);
    await page.waitForTimeout(100);
    const text = await page.textContent('#explain');
    await page.mouse.down();
    await page.mouse.move(at.x + dx / 2, at.y + dy / 2, { steps: 4 });
    await page.mouse.move(at.x + dx, at.y + dy, { steps: 4 });
    await page.waitForTimeout(100);
    await page.mouse.up();
    const end = await on(page, 'vertexOnScreen', vertex);
    check(
        `vertex ${vertex}, dragged, goes where the pointer goes`,
        Math.hypot(end.x - at.x - dx, end.y - at.y - dy) < 2,
    );
    return text;
}

async function clickEdge(page) {
    const at = await page.evaluate(() => {
        const p = window.playground,
            count = p.lib.describe().edgeCount;
        for (let e = 0; e < count; e++) {
            const place = p.edgeOnScreen(e),
                hit = p.hitAt(place.x, place.y);
            if (hit && hit.kind === 'edge' && hit.index === e) return { ...place, e };
        }
    });
    await page.mouse.move(at.x, at.y);
    await page.mouse.click(at.x, at.y);
    return page.evaluate(e => window.playground.lib.describe().sharpness[e], at.e);
}

async function surfaces(page) {
    await page.evaluate(() => window.playground.set({ levels: 2, limit: false }));
    const before = await compare(page, 'the cube', '-l', '2');
    const text = await dragVertex(page, 3, 70, -50);
    check('the text explains', text.startsWith('Point 3 of the mesh refined once'));
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
    await page.evaluate(() => window.playground.set({ levels: 3, limit: true }));
    await compare(page, 'on the limit', '-l', '3', '--limit');
    await page.evaluate(() => window.playground.set({ scheme: 1, rule: 1, limit: false }));
    await compare(
        page,
        'Loop',
        '-l',
        '3',
        '-s',
        'loop',
        '--triangulate',
        '--vertex-rule',
        'warren',
    );
    await page.evaluate(() =>
        window.playground.set({ scheme: 0, rule: 0, levels: 2, creasing: 1 }),
    );
    await compare(page, 'Chaikin', '-l', '2', '-c', 'chaikin');
}

// A page opened at the address shows the same.
async function address(page, context) {
    await page.waitForTimeout(800);
    const other = await context.newPage();
    await other.goto(page.url());
    await other.waitForFunction(() => window.playground);
    await other.waitForTimeout(500);
    const [here, there] = await Promise.all(
        [page, other].map(p =>
            p.evaluate(() => [
                window.playground.obj(),
                window.playground.count(),
                window.playground.state.creasing,
            ]),
        ),
    );
    check('the address has the state', page.url().includes('#') && `${here}` === `${there}`);
    await other.close();
}

async function files(page) {
    const obj = fs.readFileSync('examples/cages/octopus.obj', 'utf8');
    await page.evaluate(obj => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([obj], 'dropped.obj'));
        window.dispatchEvent(new DragEvent('drop', { dataTransfer }));
    }, obj);
    await page.waitForTimeout(300);
    check(
        'a dropped file is the cage',
        numbers(await page.evaluate(() => window.playground.obj()), 'v').length ===
            numbers(obj, 'v').length,
    );
    await page.evaluate(() => window.playground.set({ levels: 4, limit: true, creasing: 0 }));
    const [frame, evaluation] = await page.evaluate(() => window.playground.time(20));
    const count = await page.evaluate(() => window.playground.count());
    console.log(
        `playground: new positions of ${count} points on the limit, with normals: ` +
            `${evaluation.toFixed(1)} ms, with all that the page copies ${frame.toFixed(1)} ms`,
    );
    check('a large cage is shown', count > 100000);
    await page.evaluate(() =>
        window.dispatchEvent(
            Object.assign(new DragEvent('drop', { dataTransfer: new DataTransfer() })),
        ),
    );
    await page.evaluate(() => window.playground.load('v 0 0 0\nf 1 2 3\n', 'bad'));
    check('an error has words', /vertex 2 does not exist/.test(await page.textContent('#error')));
}

async function curves(page) {
    await page.evaluate(() =>
        window.playground.set({ mode: 'curve', curveRule: 1, ends: 2, levels: 3, limit: false }),
    );
    await dragVertex(page, 1, 40, 30);
    const shown = await page.evaluate(() => [window.playground.obj(), window.playground.curve()]);
    const told = refined(shown[0], '--curve', 'chaikin', '-l', '3'),
        made = Array.from(Object.values(shown[1]));
    check(`a curve: ${told.length} points`, 3 * told.length === made.length);
    check(
        'a curve: positions',
        told.every((p, i) => distance(p, made.slice(3 * i, 3 * i + 3)) < 1e-5),
    );
}

(async () => {
    const browser = await chromium.launch({
        executablePath: browserPath,
        args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
    });
    const context = await browser.newContext({ viewport: { width: 900, height: 600 } });
    const page = await context.newPage();
    page.on('pageerror', error => check(`no error: ${error.message}`, false));
    page.on('request', request =>
        check(
            `no request: ${request.url().slice(0, 60)}`,
            /^(file|data|blob):/.test(request.url()),
        ),
    );
    await page.goto(`file://${fs.realpathSync(pagePath)}`);
    await page.waitForFunction(() => window.playground);
    await page.evaluate(() => {
        window.playground.scene.refines = false;
    });
    await surfaces(page);
    await address(page, context);
    await files(page);
    await curves(page);
    await browser.close();
    console.log(
        `${'playground'.padEnd(24)} ${String(passed).padStart(4)} passed, ${failed} failed`,
    );
    process.exitCode = failed > 0 ? 1 : 0;
})().catch(error => {
    console.log(`FAILED  ${error.stack}`);
    process.exit(1);
});
