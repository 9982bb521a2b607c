#!/bin/sh
# build.sh OUTPUT: builds the page. It compiles playground.c to WebAssembly, bundles page.js with
# three, and puts both and the cages into one HTML file. What npm installs stays in build/.
set -e
here=examples/playground
out=build/playground
mkdir -p $out

for tool in clang wasm-ld npm node; do
    command -v $tool > $out/log || { echo "playground: $tool is missing; see README.md"; exit 1; }
done
if [ ! -d $out/node_modules/three ]; then
    echo '{ "private": true }' > $out/package.json
    (cd $out && npm install --no-package-lock --no-save --no-audit --no-fund \
        three@0.187 esbuild@0.28 playwright-core@1.65)
fi

clang --target=wasm32-wasi --sysroot=/usr -O3 -msimd128 -DNDEBUG -std=c99 -Wall -Wextra -I. \
    -fvisibility=hidden -nostartfiles -Wl,--no-entry -Wl,--export-dynamic -Wl,--strip-all \
    -o $out/subdiv.wasm $here/playground.c -lm
NODE_PATH=$out/node_modules $out/node_modules/.bin/esbuild $here/page.js --bundle --minify \
    --format=iife --target=es2020 --loader:.obj=text --log-level=warning --outfile=$out/page.js
node $here/assemble.js $here/page.html $out/page.js $out/subdiv.wasm "$1"
