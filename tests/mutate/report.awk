# awk -f report.awk equivalent.txt list results: what came of the mutants of the list in the end, by
# section, and which survived. Fails if under 97 % of those that are not equivalent were killed.
function trim(line) { sub(/^ +/, "", line); return line }

FILENAME == ARGV[1] {
    if (/^- /) old = trim(substr($0, 3))
    if (/^\+ /) equivalent[old "\t" trim(substr($0, 3))] = 1
    next
}
{ split($0, part, "\t") }
FILENAME == ARGV[2] {
    wanted[part[2] "\t" part[3] "\t" part[4]] = 1
    next
}
{
    mutant = part[4] "\t" part[5] "\t" part[6]
    if (mutant in wanted && part[1] != "invalid") found[mutant] = $0
}

function tell(result,    part, verdict) {
    split(result, part, "\t")
    verdict = part[1]
    if (verdict == "survived" && trim(part[5]) "\t" trim(part[6]) in equivalent) verdict = "same"
    if (verdict == "survived") printf "%s:%d\n- %s\n+ %s\n", part[4], part[3], trim(part[5]), trim(part[6])
    count[part[4], verdict]++
    count["all", verdict]++
    sections[part[4]] = 1
}

function line(s) {
    printf "%-20s %6d %8d %10d %8d\n", s, count[s, "killed"] + count[s, "same"] + count[s, "survived"],
        count[s, "killed"], count[s, "same"], count[s, "survived"]
}

END {
    for (mutant in wanted) left += !(mutant in found)
    for (mutant in found) tell(found[mutant])
    printf "%-20s %6s %8s %10s %8s\n", "section", "made", "killed", "equivalent", "survived"
    for (s in sections) line(s)
    line("all")
    if (left) print left " do not compile or were not run"
    killed = count["all", "killed"]
    all = killed + count["all", "survived"]
    if (all) printf "%.1f %% of those that are not equivalent were killed\n", 100 * killed / all
    exit !(all && killed >= 0.97 * all)
}
