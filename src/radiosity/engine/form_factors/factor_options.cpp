#include "radiosity/engine/form_factors/factor_options.h"

#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/own_options.h"

#include <array>
#include <charconv>
#include <stdexcept>
#include <string>

namespace hemilux {
namespace {

constexpr std::array<std::string_view, 3> kind_names{"rays", "exact", "hemicube"};
constexpr std::string_view with_edge = "hemicube:";

bool set_factors(SolveOptions& options, std::string_view text) {
    if (text.starts_with(with_edge)) {
        const std::string_view number = text.substr(with_edge.size());
        std::uint32_t edge = 0;
        const auto [end, error] =
            std::from_chars(number.data(), number.data() + number.size(), edge);
        if (error != std::errc() || end != number.data() + number.size() ||
            !Hemicube::is_edge(edge))
            throw std::invalid_argument("hemicube:N with an even N from 2 to 1024");
        set_own_options(options, FactorOptions{FactorKind::hemicube, edge});
        return true;
    }
    const auto found = std::ranges::find(kind_names, text);
    if (found == kind_names.end())
        return false;
    set_own_options(options,
                    FactorOptions{.kind = static_cast<FactorKind>(found - kind_names.begin())});
    return true;
}

std::string factors_text(const SolveOptions& options) {
    const auto& factors = own_options<FactorOptions>(options);
    if (factors.kind == FactorKind::hemicube &&
        factors.hemicube_edge != FactorOptions().hemicube_edge)
        return std::string(with_edge) + std::to_string(factors.hemicube_edge);
    return std::string(kind_names.at(static_cast<std::size_t>(factors.kind)));
}

bool is_exact(const SolveOptions& options) {
    return own_options<FactorOptions>(options).kind == FactorKind::exact;
}

} // namespace

MethodOption factors_option(bool with_exact) {
    const auto set = [with_exact](SolveOptions& options, std::string_view text) {
        return (with_exact || text != "exact") && set_factors(options, text);
    };
    return {
        .name = "--factors",
        .help = "form factors by rays; exact: by integrals, without chance where patches see each "
                "other fully; hemicube: by a hemicube over each patch, N pixels along its edge "
                "[rays; N 64]",
        .values = with_exact ? std::vector<std::string>{"rays", "exact", "hemicube", "hemicube:N"}
                             : std::vector<std::string>{"rays", "hemicube", "hemicube:N"},
        .set = set,
        .get = factors_text,
        .on_page = false};
}

MethodOption exact_option() {
    return {.name = "--exact",
            .help = "the same as --factors exact",
            .values = {},
            .set =
                [](SolveOptions& options, std::string_view text) {
                    const bool is_yes = text == "yes";
                    if (!is_yes && text != "no")
                        return false;
                    return is_yes == is_exact(options) ||
                           set_factors(options, is_yes ? "exact" : "rays");
                },
            .get = [](const SolveOptions& options) { return is_exact(options) ? "yes" : "no"; },
            .on_page = false,
            .excludes = "--factors"};
}

void adapt_to_factors(MethodWork& work, const SolveOptions& options) {
    if (own_options<FactorOptions>(options).kind != FactorKind::hemicube)
        return;
    work.pairs = work.passes = false;
    work.estimates_error = false;
}

} // namespace hemilux
