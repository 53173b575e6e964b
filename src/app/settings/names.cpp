#include "app/settings/names.h"

#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <numeric>

namespace hemilux {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Row i of the table holds the distances of a's first i letters to all beginnings of b.
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

std::string nearest_name(std::string_view word, std::span<const std::string> known) {
    const std::string* nearest = nullptr;
    std::size_t least = word.size() / 2 + 1;
    for (const std::string& name : known) {
        const bool begun = word.size() > 1 && name.starts_with(word);
        const std::size_t distance = begun ? 0 : edit_distance(word, name);
        if (distance < least) {
            least = distance;
            nearest = &name;
        }
    }
    return nearest ? *nearest : std::string();
}

std::string unknown_name(std::string_view kind, std::string_view word,
                         std::span<const std::string> known) {
    std::string text = "unknown " + std::string(kind) + " '" + std::string(word) + "'; ";
    const std::string nearest = nearest_name(word, known);
    if (!nearest.empty())
        return text + "did you mean '" + nearest + "'?";
    return text + "there " + (known.size() == 1 ? "is " : "are ") +
           (known.empty() ? "none" : list_names(known));
}

} // namespace hemilux
