// Radiosity in one file: plain loops and the standard library, to be typed by hand.
//
//     g++ -std=c++20 -O2 examples/core/core.cpp -o core
//     ./core SCENE.obj [STEPS [RAYS]] >table.csv
//
// Monte Carlo progressive radiosity (paper section 3.3). Each of the STEPS (64) shoots the light of
// the lamps by RAYS (16) times as many rays as there are patches, then what is reflected, until
// nothing is left. The result is the mean of the steps. docs/paper/core.md leads on from here.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

struct Vec { // a point, a direction, or red, green and blue
    double x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec& operator+=(Vec& a, Vec b) { return a = a + b; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double sum(Vec a) { return a.x + a.y + a.z; }
double dot(Vec a, Vec b) { return sum(a * b); }
double length(Vec a) { return std::sqrt(dot(a, a)); }
Vec unit(Vec a) { return 1 / length(a) * a; }
Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Patch {              // a face of the file; a material has no more than the colours
    Vec rho{.5, .5, .5}, E; // reflectance [-], emission [W/m2]
    std::array<Vec, 4> corner, inward; // a triangle has its last corner twice; across each side
    Vec x, y, normal, centre;          // the frame of the hemisphere
    double area = 0;                   // 0 unless the face is flat and convex
};
using Scene = std::vector<Patch>;

void set_shape(Patch& p, const std::array<Vec, 4>& corner) {
    const Vec twice_area = cross(corner[2] - corner[0], corner[3] - corner[1]);
    p.corner = corner;
    p.area = length(twice_area) / 2;
    p.normal = unit(twice_area);
    p.x = unit(corner[1] - corner[0]), p.y = cross(p.normal, p.x);
    p.centre = .25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    for (std::size_t k = 0; k < 4; ++k) {
        p.inward[k] = cross(p.normal, corner[(k + 1) % 4] - corner[k]);
        p.area *= dot(p.inward[k], corner[(k + 2) % 4] - corner[k]) > -1e-9 * p.area &&
                  std::abs(dot(p.normal, corner[k] - p.centre)) < 1e-4 * std::sqrt(p.area);
    }
}

/// Reads an OBJ file, or an MTL file: their words differ.
void read(const std::string& path, Scene& scene) {
    static std::map<std::string, Patch> materials;
    std::ifstream file(path);
    std::vector<Vec> vertices;
    std::string line, name;
    bool right = bool(file);
    int number = 0;
    for (; right && std::getline(file, line); ++number) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "mtllib" && words >> name) {
            read(path.substr(0, path.rfind('/') + 1) + name, scene);
        } else if ((word == "newmtl" || word == "usemtl") && words >> name) {
            right = materials.contains(name) == (word == "usemtl");
            materials[name];
        } else if (word == "Kd" || word == "Ke") {
            Vec& v = word == "Kd" ? materials[name].rho : materials[name].E;
            right = words >> v.x >> v.y >> v.z && v.x >= 0 && v.y >= 0 && v.z >= 0 &&
                    (word == "Ke" || (v.x < 1 && v.y < 1 && v.z < 1));
        } else if (word == "v") {
            Vec& v = vertices.emplace_back();
            right = bool(words >> v.x >> v.y >> v.z);
        } else if (word == "f") {
            std::array<Vec, 4> corner;
            std::size_t corners = 0;
            for (; right && words >> word; ++corners) { // 7, 7/1 or 7/1/3: the vertex comes first
                const std::size_t i = std::strtoul(word.c_str(), nullptr, 10);
                right = i > 0 && i <= vertices.size() && corners < 4;
                if (right)
                    corner[corners] = corner[3] = vertices[i - 1];
            }
            set_shape(scene.emplace_back(materials[name]), corner);
            right = right && corners > 2 && scene.back().area > 0;
        }
    }
    if (!right) {
        std::fprintf(stderr, "%s:%d: cannot be read: %s\n", path.c_str(), number, line.c_str());
        std::exit(2);
    }
}

/// Where on a ray the patch lies; infinity if that is not before t_max.
double distance(const Patch& p, Vec origin, Vec direction, double t_max) {
    const double t = dot(p.normal, p.centre - origin) / dot(p.normal, direction);
    bool hit = t > 1e-9 && t < t_max;
    for (std::size_t k = 0; hit && k < 4; ++k) // no gap between neighbours
        hit = dot(p.inward[k], origin + t * direction - p.corner[k]) >= -1e-9;
    return hit ? t : INFINITY;
}

/// The first patch on a ray that leaves `from`; `from` itself if there is none.
const Patch& nearest(const Scene& scene, const Patch& from, Vec origin, Vec direction) {
    const Patch* found = &from;
    double t_min = INFINITY;
    for (const Patch& p : scene)
        if (const double t = distance(p, origin, direction, t_min); t < t_min && &p != &from)
            t_min = t, found = &p;
    return *found;
}

double random_number() { // uniform in [0,1)
    static std::mt19937_64 bits(1);
    return double(bits() >> 11) * 0x1p-53;
}

Vec random_point(const Patch& p) { // uniform over the triangles abc and acd
    const auto& [a, b, c, d] = p.corner;
    const bool in_abc = random_number() * p.area < length(cross(b - a, c - a)) / 2;
    const double u = random_number(), v = std::sqrt(random_number());
    return (1 - v) * a + v * ((1 - u) * (in_abc ? b : d) + u * c);
}

Vec cosine_direction(const Patch& p) { // uniform over the unit disc, lifted to the hemisphere
    const double r2 = random_number(), phi = 2 * M_PI * random_number(), r = std::sqrt(r2);
    return r * std::cos(phi) * p.x + r * std::sin(phi) * p.y + std::sqrt(1 - r2) * p.normal;
}

/// Shoots N rays with the power Phi of a patch in all, and adds it to what others receive.
void shoot(const Scene& scene, const Patch& from, int N, Vec Phi, std::vector<Vec>& received) {
    for (int ray = 0; ray < N; ++ray) {
        const Vec direction = cosine_direction(from);
        const Patch& to = nearest(scene, from, random_point(from), direction);
        if (dot(to.normal, direction) < 0) // the front of another; backs absorb
            received[std::size_t(&to - scene.data())] += 1.0 / N * Phi;
    }
}

/// A step: all light, by rays of about equal power.
std::vector<Vec> compute_radiosity(const Scene& scene, double Phi_ray, long& rays) {
    std::vector<Vec> B, unshot, received(scene.size());
    for (const Patch& p : scene)
        B.push_back(p.E), unshot.push_back(p.area * p.E);
    for (double left = 1; left > 0;) { // bounce after bounce
        for (std::size_t i = 0; i < B.size(); ++i) {
            const double due = sum(unshot[i]) / Phi_ray; // rays by power
            const int N = int(due + random_number());    // rounded up or down by chance
            shoot(scene, scene[i], N, due < 1 ? 1 / due * unshot[i] : unshot[i], received);
            rays += N;
        }
        left = 0;
        for (std::size_t i = 0; i < B.size(); ++i) { // B = E + rho Phi / A
            unshot[i] = scene[i].rho * received[i];
            B[i] += 1 / scene[i].area * unshot[i];
            left += sum(unshot[i]), received[i] = {};
        }
    }
    return B;
}

int main(int count, char** arguments) {
    const int steps = count > 2 ? std::atoi(arguments[2]) : 64;
    const double N_hemi = count > 3 ? std::atof(arguments[3]) : 16;
    if (count < 2 || steps < 2 || !(N_hemi > 0))
        return std::fputs("usage: core SCENE.obj [STEPS [RAYS]] >table.csv\n", stderr), 1;
    Scene scene;
    read(arguments[1], scene);
    double emitted = 1e-300; // not 0, by which the power of rays would be divided
    for (const Patch& p : scene)
        emitted += p.area * sum(p.E);
    long rays = 0;
    std::vector<Vec> mean(scene.size());       // of the steps
    std::vector<double> squares(scene.size()); // of what they are off, by Welford (1962)
    for (int step = 1; step <= steps; ++step) {
        const auto B = compute_radiosity(scene, emitted / N_hemi / double(scene.size()), rays);
        double error = 0, light = 0;
        for (std::size_t i = 0; i < B.size(); ++i) {
            const Vec off = B[i] - mean[i];
            mean[i] += 1.0 / step * off;
            squares[i] += dot(off, B[i] - mean[i]);
            error += scene[i].area * squares[i] / step / (step - 1);
            light += scene[i].area * dot(mean[i] - scene[i].E, mean[i] - scene[i].E);
        }
        if (step > 1)
            std::fprintf(stderr, "step %d: %ld rays, error %.2f %%\n", step, rays,
                         100 * std::sqrt(error / light));
    }
    std::puts("patch,radiosity_r,radiosity_g,radiosity_b,stderr");
    for (std::size_t i = 0; i < scene.size(); ++i)
        std::printf("%zu,%.9g,%.9g,%.9g,%.9g\n", i, mean[i].x, mean[i].y, mean[i].z,
                    std::sqrt(squares[i] / steps / (steps - 1)));
}
