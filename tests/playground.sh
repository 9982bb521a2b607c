#!/bin/sh
# playground.sh PAGE SUBDIV: drives the page of make playground in a headless Chromium, and compares
# its points with those of the command line.
modules=build/playground/node_modules
for name in chromium chromium-browser google-chrome; do
    browser=$(command -v $name) && break
done

skip() {
    echo "playground: SKIPPED, $1"
    printf '%-24s %4d passed, %d failed\n' playground 0 0
    exit 0
}

[ -f "$1" ] || skip "make playground has not built the page"
[ "$browser" ] || skip "Chromium is not installed"
[ -d $modules/playwright-core ] || skip "playwright-core is not in $modules"
NODE_PATH=$PWD/$modules exec node tests/playground.js "$browser" "$1" "$2"
