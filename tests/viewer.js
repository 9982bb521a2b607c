// node tests/viewer.js CHROMIUM SUBDIV: opens pages of --html and uses them as a person would.
const fs = require('fs');
const { execFileSync } = require('child_process');
const { check, run } = require('./lib/browse.js');

const [browserPath, subdiv] = process.argv.slice(2);
const out = 'build/viewer';

// A cube of two materials, with a crease that fades, one that does not, and a sharp corner.
const cube = `v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1
v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
usemtl a\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nusemtl b\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
t crease 2/1/0 4 5 1.5\nt crease 2/1/0 6 7 10\nt corner 1/1/0 7 10\n`;

// A page of the command line, opened.
async function open(context, name, obj, ...options) {
    fs.writeFileSync(`${out}/${name}.obj`, obj);
    execFileSync(subdiv, [...options, '--html', `${out}/page.html`, `${out}/${name}.obj`]);
    const page = await context.newPage();
    page.on('pageerror', error => check(`${name}: ${error.message}`, false));
    page.on('console', message => check(`${name}: ${message.text()}`, false));
    page.on('request', request =>
        check(`${name}: no request of ${request.url()}`, /^file:/.test(request.url())),
    );
    await page.goto(`file://${fs.realpathSync(`${out}/page.html`)}`);
    await page.evaluate(() => {
        refines = false;
        wake();
    });
    await frame(page);
    return page;
}

const frame = page =>
    page.evaluate(
        () => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))),
    );

async function picture(page) {
    await frame(page);
    return page.evaluate(() => document.getElementById('canvas').toDataURL());
}

// The picture after an action, which has to be another one than before it.
async function changes(page, name, act) {
    const before = await picture(page);
    await act();
    check(`${name} changes the picture`, (await picture(page)) !== before);
}

// The part of the picture that has a colour: paper, shadows and edges have none.
const drawn = page =>
    page.evaluate(() => {
        const { width, height } = document.getElementById('canvas');
        const pixels = new Uint8Array(4 * width * height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        let colored = 0;
        for (let i = 0; i < pixels.length; i += 4) {
            const rgb = pixels.subarray(i, i + 3);
            if (Math.max(...rgb) - Math.min(...rgb) > 40) colored++;
        }
        return colored / width / height;
    });

async function levels(page, last, ...options) {
    for (let level = last; level >= 0; level--) {
        await page.locator('#level').fill(`${level}`);
        execFileSync(subdiv, [...options, '-l', level, `${out}/cube.obj`, `${out}/fine.obj`]);
        const told = fs.readFileSync(`${out}/fine.obj`, 'utf8').split('\n');
        const count = letter => told.filter(line => line.startsWith(letter + ' ')).length;
        const facts = (await page.textContent('#facts')).replace(/,(?=\d)/g, '');
        check(`level ${level}: ${facts}`, facts === `${count('v')} points, ${count('f')} faces`);
        check(`level ${level} is named`, (await page.textContent('#label')) === `level ${level}`);
        await frame(page);
        check(`level ${level} is drawn`, (await drawn(page)) > 0.05);
    }
}

async function use(page) {
    const key = name => () => page.keyboard.press(name);
    await page.evaluate(() => document.activeElement.blur());
    await changes(page, 'a key of a level', key('2'));
    check('the slider follows', (await page.inputValue('#level')) === '2');
    for (const name of ['ArrowLeft', 'ArrowUp', '+', 'Home']) await changes(page, name, key(name));
    const home = await picture(page);
    await changes(page, 'dragging', async () => {
        await page.mouse.move(200, 150);
        await page.mouse.down();
        await page.mouse.move(230, 160, { steps: 3 });
        await page.mouse.up();
    });
    await changes(page, 'the wheel', () => page.mouse.wheel(0, -200));
    await changes(page, 'a double click', () => page.mouse.dblclick(200, 150));
    check('a double click begins again', (await picture(page)) === home);
    for (const name of ['cage', 'edges', 'creases', 'normals']) {
        await changes(page, `${name}, first`, () => page.click(`#${name}`));
        await changes(page, `${name}, again`, () => page.click(`#${name}`));
    }
    check('switches go back', (await picture(page)) === home);
    await changes(page, 'the dark', () => page.emulateMedia({ colorScheme: 'dark' }));
    await page.emulateMedia({ colorScheme: 'light' });
}

// The picture has the size of the window, in pixels of the screen.
async function sharp(browser) {
    const context = await browser.newContext({ ...settings, deviceScaleFactor: 2 });
    const page = await open(context, 'cube', cube, '-l', '2');
    const size = () => page.evaluate(() => `${gl.drawingBufferWidth} ${gl.drawingBufferHeight}`);
    check('pixels of the screen', (await size()) === '800 600');
    await page.setViewportSize({ width: 200, height: 180 });
    await frame(page);
    check('another size', (await size()) === '400 360');
    check('another size is drawn', (await drawn(page)) > 0.05);
    await context.close();
}

async function touch(context, page) {
    const session = await context.newCDPSession(page);
    const send = (type, ...points) =>
        session.send('Input.dispatchTouchEvent', {
            type,
            touchPoints: points.map(([x, y], id) => ({ x, y, id })),
        });
    await changes(page, 'a finger', async () => {
        await send('touchStart', [150, 150]);
        await send('touchMove', [180, 150]);
        await send('touchEnd');
    });
    const zoom = await page.evaluate(() => view.zoom);
    await send('touchStart', [140, 150], [160, 150]);
    await send('touchMove', [130, 150], [170, 150]);
    await send('touchEnd');
    check('two fingers zoom', Math.abs((await page.evaluate(() => view.zoom)) / zoom - 2) < 0.1);
}

// Where nothing moves, the light becomes soft.
async function refine(page) {
    await changes(page, 'time', async () => {
        await page.evaluate(() => {
            performance.now = () => 0;
            refines = true;
            resize();
        });
        await page.waitForFunction(() => pass > FIRST);
        await page.evaluate(() => {
            refines = false;
        });
    });
}

const settings = {
    viewport: { width: 400, height: 300 },
    hasTouch: true,
    offline: true,
    colorScheme: 'light',
};

run('viewer', browserPath, async browser => {
    const context = await browser.newContext(settings);
    let page = await open(context, 'cube', cube, '-l', '3');
    check('the page has the name of the mesh', (await page.title()) === 'cube');
    await levels(page, 3);
    await use(page);
    await touch(context, page);
    await refine(page);
    await sharp(browser);
    page = await open(context, 'cube', cube, '-L', '-l', '1');
    await levels(page, 1, '-L');
    page = await open(context, `<b>"&amp;'\u00e9`, cube, '--tessellate', '3');
    check('any name', (await page.title()) === `<b>"&amp;'\u00e9`);
    check('a tessellation', (await page.textContent('#label')) === '3 pieces an edge');
    await changes(page, 'the cage of a tessellation', () => page.keyboard.press('0'));
    const strokes = 'v 0 0 0\nv 8 0 0\nv 0 8 0\nl 1 2 3\nl 1 2 3 1\n';
    page = await open(context, 'strokes', strokes, '--curve', 'chaikin', '-l', '2');
    const facts = await page.textContent('#facts');
    check(`curves: ${facts}`, facts === '24 points, 2 polylines');
    check('curves are drawn', (await drawn(page)) > 0.005);
    await changes(page, 'the cage of curves', () => page.click('#cage'));
    await changes(page, 'a level of curves', () => page.keyboard.press('1'));
    const far = cube.replace(/^v (\S+) (\S+) /gm, (_, x, y) => `v ${+x + 1e6} ${+y - 1e6} `);
    for (const [name, obj] of [
        ['far', far],
        ['tiny', cube.replace(/^v .*/gm, line => line.replace(/1/g, '1e-30'))],
        ['huge', cube.replace(/^v .*/gm, line => line.replace(/1/g, '3e38'))],
    ]) {
        page = await open(context, name, obj, '-l', '2');
        check(`${name} is drawn`, (await drawn(page)) > 0.05);
    }
});
