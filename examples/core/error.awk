# The error of a table of the core against one of the program, relative to the reflected light:
#
#     awk -F, -f examples/core/error.awk core.csv reference.csv
#
# Prints that of all patches, of the groups named detail..., and of the rest.
BEGIN { split("radiosity_r radiosity_g radiosity_b", B, " "); split("emission_r emission_g emission_b", E, " ") }
FNR == 1 { for (i = 1; i <= NF; ++i) column[FILENAME, $i] = i; next }
function field(name) { return $(column[FILENAME, name]) }
NR == FNR { for (c = 1; c <= 3; ++c) core[$1, c] = field(B[c]); next }
{
    part = field("group") ~ /^detail/ ? "detail" : "rest"
    for (c = 1; c <= 3; ++c) {
        squares[part] += field("area") * (core[$1, c] - field(B[c])) ^ 2
        light[part] += field("area") * (field(B[c]) - field(E[c])) ^ 2
    }
}
END {
    printf "all %.2f %%\n", 100 * sqrt((squares["detail"] + squares["rest"]) / (light["detail"] + light["rest"]))
    if (light["detail"] > 0) printf "detail %.2f %%\n", 100 * sqrt(squares["detail"] / light["detail"])
    if (light["rest"] > 0) printf "rest %.2f %%\n", 100 * sqrt(squares["rest"] / light["rest"])
}
