#!/bin/sh
# playground.sh PAGE SUBDIV: drives the page of make playground in a headless Chromium, and compares
# its points with those of the command line.
. tests/lib/browser.sh

[ -f "$1" ] || skip playground "make playground has not built the page"
find_browser playground
exec node tests/playground.js "$browser" "$1" "$2"
