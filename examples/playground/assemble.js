// node assemble.js PAGE SCRIPT WASM OUTPUT: puts the script and the WebAssembly into the page.
const fs = require('fs');
const [page, script, wasm, output] = process.argv.slice(2);
const parts = {
    '<!-- wasm -->':
        '<script>const WASM = "' + fs.readFileSync(wasm).toString('base64') + '";</script>',
    '<!-- script -->':
        '<script>' +
        fs.readFileSync(script, 'utf8').replace(/<\/script/g, '<\\/script') +
        '</script>',
};
let html = fs.readFileSync(page, 'utf8');
for (const [mark, text] of Object.entries(parts)) html = html.replace(mark, () => text);
fs.writeFileSync(output, html);
const kb = file => Math.round(fs.statSync(file).size / 1000) + ' KB';
console.log(
    `${output}: ${kb(output)}, of which the library ${kb(wasm)} and the script ${kb(script)}`,
);
