// What the tests in a browser share: check(NAME, HOLDS) counts, and run(NAME, CHROMIUM, TEST) gives
// the test a browser and says what was counted.
const { chromium } = require('playwright-core');

let passed = 0,
    failed = 0;

function check(name, holds) {
    if (holds) return passed++;
    failed++;
    console.log(`FAILED  ${name}`);
}

async function run(name, executablePath, test) {
    try {
        const args = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
        const browser = await chromium.launch({ executablePath, args });
        await test(browser);
        await browser.close();
    } catch (error) {
        console.log(`FAILED  ${error.stack}`);
        process.exit(1);
    }
    console.log(`${name.padEnd(24)} ${String(passed).padStart(4)} passed, ${failed} failed`);
    process.exitCode = failed > 0 ? 1 : 0;
}

module.exports = { check, run };
