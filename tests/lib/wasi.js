// node tests/lib/wasi.js PROGRAM ARGUMENTS...: runs a WebAssembly program that sees this folder.
const { WASI } = require('wasi');
const args = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args, preopens: { '.': '.' } });
const imports = { wasi_snapshot_preview1: wasi.wasiImport };
WebAssembly.instantiate(require('fs').readFileSync(args[0]), imports)
    .then(program => { process.exitCode = wasi.start(program.instance); });
