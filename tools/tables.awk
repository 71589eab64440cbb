# awk -f tools/tables.awk TABLE... DOCUMENT: the Markdown document with its tables replaced by those that have the same first column.
FNR == 1 { file++ }
file < ARGC - 1 { if (FNR == 1) head = $2; if (/^\|/) fresh[head] = fresh[head] $0 "\n"; next }
/^\|/ {
    if (!inside) { inside = 1; replaced = ($2 in fresh); if (replaced) printf "%s", fresh[$2] }
    if (!replaced) print
    next
}
{ inside = 0; print }
