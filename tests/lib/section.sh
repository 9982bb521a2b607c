# section TITLE: the indented lines of a section of the opening comment, up to the next title.
section() {
    awk -v title="$1" '
        /\*\// { exit }
        /^   [A-Z]/ { inside = index($0, title) > 0; next }
        inside && /^       / { print substr($0, 8); next }
        inside && /^$/ { print }' subdiv.h
}
