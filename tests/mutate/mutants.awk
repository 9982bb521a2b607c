# awk -v seed=N -v count=N -f mutants.awk subdiv.h: a list of about so many mutants, one in each
# line: number of the line, section, the line, what it becomes, with tabs between them. A mutant
# changes one place: a sign, a weight, a bound, a comparison, a condition; or drops a statement.
#
# Each section gets its share, at least 4. Which ones depends on seed and on the line's text alone,
# so that a change of the header leaves the mutants of other lines.

function hash(text,    i, h) {
    h = 7 + seed
    for (i = 1; i <= length(text); i++)
        h = (h * 257 + index(letters, substr(text, i, 1))) % 4294967291
    for (i = 0; i < 4; i++) h = (h * 69621 + 12345) % 4294967291
    return h
}

function mutant(line,    key) {
    key = section "\t" $0 "\t" line
    if (key in seen) return
    seen[key] = 1
    all++
    in_section[section]++
    sections[all] = section
    hashes[all] = hash(key)
    texts[all] = FNR "\t" key
}

# The line with another token, which stands after before.
function other(before, token, rest) { mutant(before token rest comment) }

function number(before, token, rest,    digits, suffix, open) {
    if (token ~ /^0x/) return
    if (token ~ /\.|[0-9]e/) {
        if (token + 0 != 0) other(before, "(1.03125" (token ~ /f$/ ? "f" : "") " * " token ")", rest)
        return
    }
    open = gsub(/\[/, "[", before) - gsub(/\]/, "]", before)
    if (declaration && open > 0) return             # the size of an array
    digits = token
    sub(/[uUlL]+$/, "", digits)
    suffix = substr(token, length(digits) + 1)
    if (before !~ /SDV_NEW/) other(before, digits + 1 suffix, rest)      # more room does no harm
    if (digits + 0 > 0) other(before, digits - 1 suffix, rest)
}

function operator(before, token, rest,    binary) {
    binary = before ~ / $/ && rest ~ /^ /
    if (token in swap) other(before, swap[token], rest)
    else if (token == "!" ) other(before, "", rest)
    else if (token == "-" && !binary) other(before, "", rest)
    else if (binary && token in swap_binary) other(before, swap_binary[token], rest)
}

# Goes through the tokens of the line.
function tokens(code,    before, token, rest, is_number) {
    before = ""
    rest = code
    while (rest != "") {
        is_number = 0
        if (match(rest, /^[A-Za-z_][A-Za-z_0-9]*/)) token = substr(rest, 1, RLENGTH)
        else if (match(rest, /^[0-9][0-9]*[.]?[0-9]*(e[-+]?[0-9]+|x[0-9a-fA-F]+)?[uUlLf]*/)) {
            token = substr(rest, 1, RLENGTH)
            is_number = 1
        }
        else if (match(rest, /^"([^"\\]|\\.)*"/) || match(rest, /^'([^'\\]|\\.)*'/) ||
                 match(rest, /^(->|<<=|>>=)/) ||
                 match(rest, /^(<=|>=|==|!=|&&|\|\||<<|>>|\+\+|--|\+=|-=|\*=|\/=|\|=|&=|%=|\^=)/))
            token = substr(rest, 1, RLENGTH)
        else token = substr(rest, 1, 1)
        rest = substr(rest, length(token) + 1)
        if (is_number) number(before, token, rest)
        else operator(before, token, rest)
        before = before token
    }
}

# The number of letters up to the parenthesis that closes the one at the beginning, or 0.
function closing(code,    i, depth, letter) {
    for (i = 1; i <= length(code); i++) {
        letter = substr(code, i, 1)
        depth += (letter == "(") - (letter == ")")
        if (depth == 0) return i
    }
    return 0
}

function conditions(code,    at, start, end) {
    at = index(code, "if (")
    if (at == 0 || substr(code, 1, at - 1) !~ /^ *(} else |else )?$/) return
    start = substr(code, 1, at + 3)
    code = substr(code, at + 3)
    end = closing(code)
    if (end == 0) return
    mutant(start "0 && " substr(code, 1, end) ")" substr(code, end + 1) comment)
    mutant(start "1 || " substr(code, 1, end) ")" substr(code, end + 1) comment)
}

# A statement of one line which is all that stands in it.
function statement(code,    text) {
    text = code
    sub(/^ */, "", text)
    if (declaration || code !~ /^ .*; *$/ || code ~ /'[()]'/ || previous !~ /[;{})]$/) return
    if (text ~ /^(break|continue);/ || text ~ /^(\+\+|--|\*|\()?[A-Za-z_]+[A-Za-z_0-9]*[^A-Za-z_0-9 ]/ ||
        text ~ /^[a-z_]+ [-+*\/|&^%<>]*= /)
        if (text !~ /^(return|if|for|while|else|do|case|default|goto)[^a-z_]/)
            mutant(substr(code, 1, length(code) - length(text)) ";" comment)
}

BEGIN {
    letters = ""
    for (i = 32; i < 127; i++) letters = letters sprintf("%c", i)
    swap["<"] = "<="; swap["<="] = "<"; swap[">"] = ">="; swap[">="] = ">"
    swap["=="] = "!="; swap["!="] = "=="; swap["&&"] = "||"; swap["||"] = "&&"
    swap["+="] = "-="; swap["-="] = "+="; swap["++"] = "--"; swap["--"] = "++"
    swap["<<"] = ">>"; swap[">>"] = "<<"; swap["*="] = "/="; swap["|="] = "&="; swap["&="] = "|="
    swap_binary["+"] = "-"; swap_binary["-"] = "+"; swap_binary["*"] = "/"; swap_binary["/"] = "*"
    swap_binary["&"] = "|"; swap_binary["|"] = "&"
}

/^#define SUBDIV_IMPLEMENTED/ { inside = 1 }
/>>cleanup$/ { inside = 0 }
!inside { next }
/^\/\/ -+ >>/ { section = $0; sub(/.*>>/, "", section) }
# Not plain mode, which has a test of its own, nor other machines.
/^#if defined\(SUBDIV_NO_SIMD\)/, /^#endif/ { next }
section == "plain" { next }
/^ *#/ || macro { macro = /\\$/; next }             # of the preprocessor
{
    code = $0
    comment = ""
    if (match(code, /(^| )\/\/ .*/)) {
        comment = substr(code, RSTART)
        code = substr(code, 1, RSTART - 1)
    }
    sub(/ *$/, "", code)
    if (code ~ /^ *$/) next
    declaration = code ~ /^ *(static |const |unsigned )*(int|float|double|char|size_t|void|unsigned|u?int[0-9]*_t|sdv_[a-z_]+|subdiv_[a-z_]+) +[*]*[A-Za-z_]/
    if (code !~ /SUBDIV_ASSERT|^[a-z].*\)$/ && code ~ /^ /) {
        tokens(code)
        conditions(code)
        statement(code)
    }
    previous = code
}

# Of each section, those with the smallest hashes: as many as its share.
END {
    for (s in in_section) {
        share[s] = int(count * in_section[s] / all + 0.5)
        if (share[s] < 4) share[s] = 4
    }
    for (i = 1; i <= all; i++) printf "%s\t%.0f\t%s\n", share[sections[i]], hashes[i], texts[i] | \
        "LC_ALL=C sort -t '\t' -k 4,4 -k 2,2n | awk -F '\t' '$4 != s { s = $4; n = 0 } " \
        "n++ < $1' | cut -f 3-"
}
