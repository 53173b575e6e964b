#pragma once
// A file of VTK in XML with its numbers as raw little-endian bytes (VTK file formats, "Serial XML",
// version 1.0).

#include "geometry/vector.h"
#include "io/files/atomic_file.h"
#include "io/files/little_endian.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hemilux {

/// The XML before the bytes, and the bytes: each array follows its length in bytes.
class VtkGrid {
  public:
    template <class Number>
    void add(const std::string& name, int components, const std::vector<Number>& numbers) {
        xml_ += "<DataArray type=\"" + type_of(Number{}) + "\" Name=\"" + name +
                "\" NumberOfComponents=\"" + std::to_string(components) +
                "\" format=\"appended\" offset=\"" + std::to_string(bytes_.size()) + "\"/>\n";
        append_number(bytes_, std::uint64_t{numbers.size() * sizeof(Number)});
        for (const Number number : numbers)
            append_number(bytes_, number);
    }

    void add(const std::string& name, const std::vector<Vec3>& vectors) {
        std::vector<double> numbers;
        numbers.reserve(3 * vectors.size());
        for (const Vec3& vector : vectors)
            numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
        add(name, 3, numbers);
    }

    /// Adds letters as numbers, each text with a 0 after it.
    void add_texts(const std::string& name, const std::vector<std::string>& texts) {
        xml_ += "<DataArray type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" +
                std::to_string(texts.size()) + "\" format=\"ascii\">";
        for (const std::string& text : texts) {
            for (const char c : text)
                xml_ += std::to_string(static_cast<unsigned char>(c)) + " ";
            xml_ += "0 ";
        }
        xml_ += "</DataArray>\n";
    }

    void add(const std::string& line) { xml_ += line + "\n"; }

    void write(const std::string& path) const {
        AtomicFile file(path);
        file.write(xml_ + "<AppendedData encoding=\"raw\">\n_");
        file.write(bytes_);
        file.write("\n</AppendedData>\n</VTKFile>\n");
        file.commit();
    }

  private:
    static std::string type_of(double) { return "Float64"; }
    static std::string type_of(std::uint8_t) { return "UInt8"; }
    static std::string type_of(std::uint32_t) { return "UInt32"; }
    static std::string type_of(std::uint64_t) { return "UInt64"; }

    std::string xml_, bytes_;
};

} // namespace hemilux
