#!/bin/sh
# viewer.sh SUBDIV: looks at pages of --html in a headless Chromium without a network.
. tests/lib/browser.sh

find_browser viewer
mkdir -p build/viewer
exec node tests/viewer.js "$browser" "$1"
