# awk -f report.awk equivalent.txt list results: what came of the mutants of the list, by section,
# and which survived. Fails if under 97 % of those that are not equivalent were killed.
FILENAME == ARGV[1] {
    if (/^- /) old = substr($0, 3)
    if (/^\+ /) equivalent[old "\t" substr($0, 3)] = 1
    next
}
FILENAME == ARGV[2] { wanted[$0] = 1; next }
{
    split($0, part, "\t")
    mutant = substr($0, length(part[1] part[2]) + 3)
    if (!(mutant in wanted) || mutant in found) next
    found[mutant] = 1
    verdict = part[1]
    section = part[3]
    change = part[5] "\t" part[6]
    gsub(/(^|\t) +/, "&\001", change)
    gsub(/ +\001/, "", change)
    if (verdict == "invalid") next
    if (verdict == "survived" && change in equivalent) verdict = "same"
    if (verdict == "survived") survivors = survivors section ":" part[4] "\n-" part[5] "\n+" part[6] "\n"
    count[section, verdict]++
    count["all", verdict]++
    sections[section] = 1
}
function line(s) {
    printf "%-20s %6d %8d %10d %8d\n", s, count[s, "killed"] + count[s, "same"] + count[s, "survived"],
        count[s, "killed"], count[s, "same"], count[s, "survived"]
}
END {
    for (mutant in wanted) left += !(mutant in found)
    printf "%s", survivors
    printf "%-20s %6s %8s %10s %8s\n", "section", "made", "killed", "equivalent", "survived"
    for (s in sections) line(s) | "LC_ALL=C sort"
    close("LC_ALL=C sort")
    line("all")
    if (left) print left " were not run"
    killed = count["all", "killed"]
    all = killed + count["all", "survived"]
    if (all) printf "%.1f %% of those that are not equivalent were killed\n", 100 * killed / all
    exit !(all && killed >= 0.97 * all)
}
