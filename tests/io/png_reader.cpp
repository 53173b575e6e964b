#include "io/png_reader.h"

#include "support/temporary_folder.h"

#include <array>
#include <cstdlib>
#include <span>
#include <stdexcept>

namespace hemilux::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

void expect(bool condition, const char* what) {
    if (!condition)
        throw std::runtime_error(std::string("PNG: ") + what);
}

/// A canonical Huffman code: the lengths of all symbols say what it is (RFC 1951, 3.2.2).
class Code {
  public:
    explicit Code(std::span<const int> lengths) {
        for (int length = 1; length < 16; ++length)
            for (std::uint32_t symbol = 0; symbol < lengths.size(); ++symbol)
                if (lengths[symbol] == length) {
                    symbols_.push_back(symbol);
                    ++count_.at(static_cast<std::size_t>(length));
                }
    }
    /// Takes bits one by one until they are a symbol's.
    template <class NextBit>
    std::uint32_t take(const NextBit& next_bit) const {
        std::uint32_t code = 0, first = 0, before = 0;
        for (const std::uint32_t count : std::span(count_).subspan(1)) {
            code = code << 1 | next_bit();
            first <<= 1;
            if (code - first < count)
                return symbols_.at(before + code - first);
            first += count;
            before += count;
        }
        throw std::runtime_error("PNG: a code that no symbol has");
    }

  private:
    std::array<std::uint32_t, 16> count_{}; ///< of symbols, by length
    std::vector<std::uint32_t> symbols_;
};

/// Deflate (RFC 1951).
class Inflate {
  public:
    explicit Inflate(const Bytes& in) : in_(in) {}

    Bytes run() {
        bool last = false;
        while (!last) {
            last = bits(1);
            const std::uint32_t type = bits(2);
            expect(type < 3, "the type of a block");
            type == 0 ? stored() : type == 1 ? fixed() : dynamic();
        }
        return std::move(out_);
    }

  private:
    std::uint32_t bits(int count) {
        std::uint32_t value = 0;
        for (int i = 0; i < count; ++i, ++at_) {
            expect(at_ / 8 < in_.size(), "data end too early");
            value |= (in_[at_ / 8] >> (at_ % 8) & 1u) << i;
        }
        return value;
    }
    std::uint32_t symbol(const Code& code) {
        return code.take([&] { return bits(1); });
    }
    void stored() {
        at_ = (at_ + 7) / 8 * 8;
        const std::uint32_t length = bits(16);
        expect((bits(16) ^ length) == 0xffff, "a stored block's length");
        for (std::uint32_t i = 0; i < length; ++i)
            out_.push_back(static_cast<std::uint8_t>(bits(8)));
    }
    void fixed() {
        std::array<int, 288> lengths{};
        for (std::size_t s = 0; s < lengths.size(); ++s)
            lengths[s] = s < 144 ? 8 : s < 256 ? 9 : s < 280 ? 7 : 8;
        block(Code(lengths), Code(std::vector<int>(30, 5)));
    }
    /// A block that begins with its codes, whose lengths are in a code themselves.
    void dynamic() {
        constexpr std::array<std::size_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                    11, 4,  12, 3, 13, 2, 14, 1, 15};
        const std::uint32_t literals = 257 + bits(5), distances = 1 + bits(5),
                            of_lengths = 4 + bits(4);
        std::array<int, 19> first{};
        for (std::uint32_t k = 0; k < of_lengths; ++k)
            first[order[k]] = static_cast<int>(bits(3));
        const Code code_of_lengths(first);
        std::vector<int> lengths;
        while (lengths.size() < literals + distances) {
            const std::uint32_t s = symbol(code_of_lengths);
            if (s < 16) {
                lengths.push_back(static_cast<int>(s));
                continue;
            }
            expect(s > 16 || !lengths.empty(), "a repeated length without one before");
            const int value = s == 16 ? lengths.back() : 0;
            const std::uint32_t times = s == 16   ? 3 + bits(2)
                                        : s == 17 ? 3 + bits(3)
                                                  : 11 + bits(7);
            lengths.insert(lengths.end(), times, value);
        }
        const std::span all(lengths);
        block(Code(all.first(literals)), Code(all.subspan(literals)));
    }
    void block(const Code& literals, const Code& distances) {
        for (std::uint32_t s = symbol(literals); s != 256; s = symbol(literals)) {
            if (s < 256) {
                out_.push_back(static_cast<std::uint8_t>(s));
                continue;
            }
            const std::uint32_t length = length_of(s - 257);
            const std::uint32_t distance = distance_of(symbol(distances));
            expect(distance <= out_.size(), "a distance");
            for (std::uint32_t i = 0; i < length; ++i)
                out_.push_back(out_[out_.size() - distance]);
        }
    }
    std::uint32_t length_of(std::uint32_t c) {
        if (c < 8)
            return 3 + c;
        if (c == 28)
            return 258;
        const std::uint32_t extra = (c - 4) / 4;
        return 3 + ((4 + c % 4) << extra) + bits(static_cast<int>(extra));
    }
    std::uint32_t distance_of(std::uint32_t c) {
        if (c < 4)
            return 1 + c;
        const std::uint32_t extra = c / 2 - 1;
        return 1 + ((2 + c % 2) << extra) + bits(static_cast<int>(extra));
    }

    const Bytes& in_;
    std::size_t at_ = 0; ///< in bits
    Bytes out_;
};

std::uint8_t paeth(int a, int b, int c) {
    const int p = a + b - c, da = std::abs(p - a), db = std::abs(p - b), dc = std::abs(p - c);
    return static_cast<std::uint8_t>(da <= db && da <= dc ? a : db <= dc ? b : c);
}

/// Undoes the filter of each row (PNG specification, section 9).
Bytes unfilter(const Bytes& rows, std::size_t width, std::size_t height) {
    const std::size_t stride = 3 * width;
    expect(rows.size() == height * (stride + 1), "the amount of data");
    Bytes out(height * stride);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < stride; ++x) {
            const int a = x >= 3 ? out[y * stride + x - 3] : 0;
            const int b = y > 0 ? out[(y - 1) * stride + x] : 0;
            const int c = x >= 3 && y > 0 ? out[(y - 1) * stride + x - 3] : 0;
            const std::array<int, 5> guess{0, a, b, (a + b) / 2, paeth(a, b, c)};
            const std::uint8_t filter = rows[y * (stride + 1)];
            expect(filter < 5, "a filter");
            out[y * stride + x] =
                static_cast<std::uint8_t>(rows[y * (stride + 1) + 1 + x] + guess[filter]);
        }
    return out;
}

} // namespace

Bytes unzipped(const Bytes& stream) {
    expect(stream.size() > 2, "no data");
    const Bytes content(stream.begin() + 2, stream.end()); // after zlib's header
    return Inflate(content).run();
}

Png read_png(const std::string& path) {
    const std::string file = content_of(path);
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(file.at(i)); };
    const auto word = [&](std::size_t i) {
        return std::uint32_t{byte(i)} << 24 | std::uint32_t{byte(i + 1)} << 16 |
               std::uint32_t{byte(i + 2)} << 8 | byte(i + 3);
    };
    expect(file.substr(0, 8) == "\x89PNG\r\n\x1a\n", "the signature");
    Png png;
    Bytes compressed;
    for (std::size_t at = 8; at < file.size(); at += 12 + word(at)) {
        const std::string type = file.substr(at + 4, 4);
        if (type == "IHDR") {
            png.width = static_cast<int>(word(at + 8));
            png.height = static_cast<int>(word(at + 12));
            expect(byte(at + 16) == 8 && byte(at + 17) == 2 && byte(at + 20) == 0, "the format");
        } else if (type == "IDAT") {
            for (std::size_t i = 0; i < word(at); ++i)
                compressed.push_back(byte(at + 8 + i));
        }
    }
    png.bytes = unfilter(unzipped(compressed), static_cast<std::size_t>(png.width),
                         static_cast<std::size_t>(png.height));
    return png;
}

} // namespace hemilux::test
