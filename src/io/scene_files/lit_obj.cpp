#include "io/scene_files/lit_obj.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace hemilux {
namespace {

/// Returns the numbers of a corner's word, 0 where there is none.
std::array<std::int64_t, 3> numbers_of(std::string_view word) {
    std::array<std::int64_t, 3> numbers{};
    const char* at = word.data();
    const char* const end = at + word.size();
    for (std::size_t k = 0; k < 3; ++k) {
        at = std::from_chars(at, end, numbers.at(k)).ptr;
        if (at == end || *at++ != '/')
            break;
    }
    return numbers;
}

/// Returns a number from 0 of one that counts from 1, or backwards from the last one so far.
std::uint32_t index_of(std::int64_t number, std::size_t so_far) {
    const std::int64_t index = number < 0 ? number + static_cast<std::int64_t>(so_far) : number - 1;
    return index >= 0 && index < std::int64_t{LitObj::none} ? static_cast<std::uint32_t>(index)
                                                            : LitObj::none;
}

glm::vec3 numbers_from(std::string_view rest, int count) {
    glm::vec3 numbers(0.0f);
    for (int k = 0; k < count; ++k)
        numbers[k] = static_cast<float>(parse_decimal(take_word(rest)).value_or(0));
    return numbers;
}

std::string number_text(float number) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

/// Returns the word of a corner with this place.
std::string word_of(const LitObj::Corner& corner, std::uint32_t place) {
    std::string word = std::to_string(std::uint64_t{corner.vertex} + 1);
    if (place != LitObj::none)
        word += "/" + std::to_string(std::uint64_t{place} + 1);
    if (corner.normal != LitObj::none)
        word +=
            (place == LitObj::none ? "//" : "/") + std::to_string(std::uint64_t{corner.normal} + 1);
    return word;
}

/// A text that replaces some bytes of the file.
struct Change {
    std::size_t begin, end;
    std::string text;
};

} // namespace

LitObj::LitObj(const std::string& path) : path_(path), text_(read_input(path, InputKind::regular)) {
    if (text_.starts_with(byte_order_mark)) {
        mark_ = byte_order_mark;
        text_.erase(0, mark_.size());
    }
    TextReader reader(text_); // which joins lines in its own copy
    const char* const begin = reader.content().data();
    Statement statement;
    while (reader.next(statement)) {
        const std::string_view keyword = statement.keyword;
        if (keyword == "v") {
            ++vertices_;
        } else if (keyword == "vt") {
            places_.emplace_back(glm::vec2(numbers_from(statement.rest, 2)));
            places_before_ += faces_.empty();
        } else if (keyword == "vn") {
            normals_.push_back(numbers_from(statement.rest, 3));
        } else if (keyword == "f" || keyword == "fo") {
            const std::size_t first = corners_.size();
            read_corners(statement.rest, begin);
            if (corners_.size() == first)
                throw InputError(path, statement.line, "expected a face with corners");
            faces_.push_back({static_cast<std::size_t>(keyword.data() - begin), corners_.back().end,
                              first, corners_.size() - first});
        } else if (keyword == "l") {
            const std::size_t first = corners_.size();
            read_corners(statement.rest, begin);
            other_corners_.insert(other_corners_.end(),
                                  corners_.begin() + static_cast<std::ptrdiff_t>(first),
                                  corners_.end());
            corners_.resize(first);
        }
        has_libraries_ = has_libraries_ || keyword == "mtllib";
    }
    if (faces_.empty())
        throw InputError(path, "no faces; expected the file that was read before");
}

void LitObj::read_corners(std::string_view rest, const char* content) {
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
        const auto [vertex, place, normal] = numbers_of(word);
        const auto begin = static_cast<std::size_t>(word.data() - content);
        corners_.push_back({begin, begin + word.size(), index_of(vertex, vertices_),
                            index_of(place, places_.size()), index_of(normal, normals_.size())});
    }
}

/// Returns the number of a place of the file once so many stand before the first face.
std::uint32_t LitObj::moved(std::uint32_t place, std::size_t added) const {
    return place == none || place < places_before_ ? place
                                                   : place + static_cast<std::uint32_t>(added);
}

std::string LitObj::text_with(std::span<const glm::vec2> places,
                              std::span<const NewPlaces> of_face) const {
    const std::string_view line_end = text_.find("\r\n") != std::string::npos ? "\r\n" : "\n";
    const auto number_of = [&](std::uint32_t place) {
        return static_cast<std::uint32_t>(places_before_) + place;
    };
    std::vector<Change> changes;
    const auto keep_place = [&](const Corner& corner) {
        if (corner.place != none && places_.size() > places_before_)
            changes.push_back(
                {corner.begin, corner.end, word_of(corner, moved(corner.place, places.size()))});
    };
    std::string all;
    for (const glm::vec2& place : places)
        all += "vt " + number_text(place.x) + " " + number_text(place.y) + std::string(line_end);
    changes.push_back({faces_.front().begin, faces_.front().begin, all});
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const std::span<const Corner> corners = corners_of(f);
        const NewPlaces& found = of_face[f];
        if (!found.pieces.empty()) {
            std::string pieces;
            for (const Piece& piece : found.pieces) {
                pieces += pieces.empty() ? "f" : std::string(line_end) + "f";
                for (const auto& [corner, place] : piece)
                    pieces += " " + word_of(corners[corner], number_of(place));
            }
            changes.push_back({faces_[f].begin, faces_[f].end, std::move(pieces)});
            continue;
        }
        for (std::size_t k = 0; k < corners.size(); ++k)
            if (found.of_corners.empty())
                keep_place(corners[k]);
            else
                changes.push_back({corners[k].begin, corners[k].end,
                                   word_of(corners[k], number_of(found.of_corners[k]))});
    }
    for (const Corner& corner : other_corners_)
        keep_place(corner);
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.begin < b.begin; });
    std::string text = mark_;
    std::size_t at = 0;
    for (const Change& change : changes) {
        text.append(text_, at, change.begin - at);
        text += change.text;
        at = change.end;
    }
    return text.append(text_, at, std::string::npos);
}

} // namespace hemilux
