#include "io/results/statistics.h"
#include "support/catch.h"

using namespace hemilux;

namespace {

Statistics example() {
    Statistics s;
    s.patches = 986;
    s.faces = 36;
    s.materials = 4;
    s.method = "hemisphere";
    s.seed = 7;
    s.threads = 2;
    s.steps = 16;
    s.rays_energy = 18'446'744'073'709'551'615u;
    s.rays_density = 40426;
    s.seconds_read = 0.1;
    s.bytes_density = 40000;
    s.bytes_density_paper = 82824;
    s.bytes_peak = 1 << 20;
    s.energy = {{1, 2, 3}, {0.5, 1, 1.5}, {0.5, 1, 1.5}, {0, 0.5, 0}};
    s.left_out = {{"two channels", "all is \"grey\"", "2/3 of the memory"}};
    s.program = "hemilux 7";
    s.settings = {{"SCENE", {"room.obj"}}, {"--keep-all", {}}, {"--output", {"a.csv", "b.csv"}}};
    return s;
}

} // namespace

TEST_CASE("statistics are the JSON object of the contract, in its order") {
    const std::string expected = R"({
  "patches": 986,
  "faces": 36,
  "materials": 4,
  "method": "hemisphere",
  "seed": 7,
  "threads": 2,
  "steps": 16,
  "rays_energy": 18446744073709551615,
  "rays_density": 40426,
  "seconds_read": 0.1,
  "seconds_bvh": null,
  "seconds_density": null,
  "seconds_solve": null,
  "seconds_divide": 0.0,
  "rays_divide": 0,
  "seconds_division_error": null,
  "rays_division_error": 0,
  "rays_per_second": null,
  "bytes_density": 40000,
  "bytes_density_paper": 82824,
  "bytes_transport": 0,
  "links": 0,
  "bytes_peak": 1048576,
  "estimated_error": null,
  "estimated_error_uncertainty": null,
  "error_bound": null,
  "error_local": null,
  "estimated_error_of": "patches",
  "error_sampling": null,
  "error_division": null,
  "error_division_uncertainty": null,
  "energy": {
    "emitted": [
      1.0,
      2.0,
      3.0
    ],
    "absorbed": [
      0.5,
      1.0,
      1.5
    ],
    "escaped": [
      0.5,
      1.0,
      1.5
    ],
    "unshot": [
      0.0,
      0.5,
      0.0
    ],
    "imbalance": 0.25
  },
  "left_out": [
    {
      "what": "two channels",
      "why": "all is \"grey\"",
      "saved": "2/3 of the memory"
    }
  ],
  "seconds_analysis": null,
  "seconds_learn": 0.0,
  "rays_learn": 0,
  "rays_gather": 0,
  "seconds_gather": 0.0,
  "seconds_picture": 0.0,
  "seconds_write": 0.0,
  "seconds_total": null,
  "program": "hemilux 7",
  "settings": {
    "SCENE": "room.obj",
    "keep-all": true,
    "output": [
      "a.csv",
      "b.csv"
    ]
  }
}
)";
    CHECK(to_json(example()) == expected);
}

TEST_CASE("a name that is not UTF-8 does not cost the statistics") {
    Statistics s = example();
    s.left_out[0].why = "M\xfcnchen";
    CHECK(to_json(s).find("nchen") != std::string::npos);
}

TEST_CASE("nothing left out is an empty list") {
    CHECK(to_json(Statistics{}).find("\"left_out\": []") != std::string::npos);
}

TEST_CASE("peak memory counts what was used") {
    const std::uint64_t before = peak_memory_bytes();
    CHECK(before > 1'000'000);
    const std::vector<char> block(before + 50'000'000, 1);
    CHECK(peak_memory_bytes() >= before + 40'000'000);
    CHECK(block.back() == 1);
}
