# awk -f report.awk unreachable.txt [-] ...: reads what gcov -b -c -t says of the programs that hold
# subdiv.h, one after the other, and adds it up. Prints the lines that never ran and those with
# branches that were never taken, with their section, and a table. unreachable.txt has lines of the
# header that say "never" to this, each with its reason; they count as reached.
FILENAME == ARGV[1] { if (/^- /) reason[substr($0, 3)] = 1; next }

/^ *-: *0:Source:/ { inside = /:Source:(.*\/)?subdiv\.h$/; object++; next }
!inside { next }
/^ *[-0-9#=*]+: *[0-9]+:/ {
    split($0, part, ":")
    at = part[2] + 0
    if (!(at in text)) {
        text[at] = $0
        sub(/^[^:]*:[^:]*:/, "", text[at])
    }
    branches = 0
    if (part[1] !~ /-/) {
        code[at] = 1
        if (part[1] !~ /[#=]/) ran[at] = 1
        if (at > last) last = at
    }
    next
}
# The shape of a branch: its number on the line. A line may have others in another configuration.
/^branch/ {
    branches++
    if (!((at, branches) in owner)) owner[at, branches] = object
    if (branches > most[at]) most[at] = branches
    if ($0 ~ /taken [1-9]/) taken[at, branches] = 1
}

function trim(line) { sub(/^ +/, "", line); return line }

END {
    for (at = 1; at <= last; at++) {
        if (text[at] ~ /^\/\/ -+ >>/) {
            section = text[at]
            sub(/.*>>/, "", section)
            if (!(section in known)) order[++sections] = section
            known[section] = 1
        }
        if (!(at in code)) continue
        never = ""
        lines[section]++
        excused = trim(text[at]) in reason
        if (excused) used[trim(text[at])] = 1
        if (at in ran || excused) lines_ran[section]++
        else never = "line"
        for (b = 1; b <= most[at]; b++) {
            all[section]++
            if ((at, b) in taken || excused) all_taken[section]++
            else if (at in ran) never = never " " b
        }
        if (never != "") printf "%s\t%d\t%s\t%s\n", section, at, trim(never), trim(text[at])
    }
    printf "%-20s %7s %7s %9s %7s\n", "section", "lines", "ran", "branches", "taken"
    for (i = 1; i <= sections; i++) {
        s = order[i]
        if (!lines[s]) continue
        printf "%-20s %7d %7.1f %9d %7.1f\n", s, lines[s], 100 * lines_ran[s] / lines[s], all[s],
            all[s] ? 100 * all_taken[s] / all[s] : 100
        l += lines[s]; lr += lines_ran[s]; a += all[s]; at_ += all_taken[s]
    }
    printf "%-20s %7d %7.2f %9d %7.2f\n", "all", l, 100 * lr / l, a, 100 * at_ / a
    for (line in reason) if (!(line in used)) { print "no such line: " line; stale = 1 }
    exit stale || lr < 0.995 * l || at_ < 0.92 * a
}
