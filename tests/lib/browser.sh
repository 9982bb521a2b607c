# For the scripts of tests in a browser: skip NAME WHY ends the test; find_browser NAME sets browser
# to Chromium and lets node find playwright-core, or skips.
skip() {
    echo "$1: SKIPPED, $2"
    printf '%-24s %4d passed, %d failed\n' "$1" 0 0
    exit 0
}

find_browser() {
    modules=build/playground/node_modules
    for name in chromium chromium-browser google-chrome; do
        browser=$(command -v $name) && break
    done
    [ "$browser" ] || skip "$1" "Chromium is not installed"
    [ -d $modules/playwright-core ] || skip "$1" "playwright-core is not in $modules"
    NODE_PATH=$PWD/$modules
    export NODE_PATH
}
