// The estimator as plain C++: sample a direction, evaluate f cos / pdf, reject what falls below the horizon.
// Written as one writes it for a renderer: Vec3, one class a model, std:: mathematics, one loop.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace {

constexpr double pi = 3.14159265358979323846;

struct Vec3 {
    double x, y, z;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 normalize(Vec3 a) { return (1.0 / std::sqrt(dot(a, a))) * a; }

// std::mt19937_64 with std::uniform_real_distribution: what the standard library offers.
struct MersenneTwister {
    std::mt19937_64 engine;
    std::uniform_real_distribution<double> distribution{0.0, 1.0};
    explicit MersenneTwister(uint64_t seed) : engine(seed) {}
    double operator()() { return distribution(engine); }
};

// xoshiro256+ (Blackman and Vigna 2018), seeded by splitmix64: what one takes when the standard one is too slow.
struct Xoshiro {
    uint64_t s[4];
    explicit Xoshiro(uint64_t seed) {
        for (uint64_t& word : s) {
            uint64_t z = (seed += 0x9e3779b97f4a7c15);
            z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
            z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
            word = z ^ (z >> 31);
        }
    }
    double operator()() {
        const uint64_t result = s[0] + s[3], t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = (s[3] << 45) | (s[3] >> 19);
        return static_cast<double>(result >> 11) * 0x1.0p-53;
    }
};

struct StretchedPhong {
    double n;

    double evaluate(Vec3 wi, Vec3 wo) const {
        const double c = std::max(0.0, dot(mirror(wo), wi));
        return std::pow(c, n) / std::max(wi.z, wo.z);
    }
    Vec3 sample(Vec3 wo, double u1, double u2) const {
        const double c = std::pow(u1, 1.0 / (n + 1.0)), s = std::sqrt(std::max(0.0, 1.0 - c * c)), phi = 2.0 * pi * u2;
        const Vec3 r = mirror(wo);
        const double a = -1.0 / (1.0 + r.z), b = r.x * r.y * a;  // Frisvad's frame; r.z > 0
        const Vec3 t{1.0 + r.x * r.x * a, b, -r.x}, bt{b, 1.0 + r.y * r.y * a, -r.y};
        return s * std::cos(phi) * t + s * std::sin(phi) * bt + c * r;
    }
    double pdf(Vec3 wi, Vec3 wo) const {
        const double c = std::max(0.0, dot(mirror(wo), wi));
        return (n + 1.0) / (2.0 * pi) * std::pow(c, n);
    }
    double weight(Vec3 wo, double u1, double u2) const {
        const double c = std::pow(u1, 1.0 / (n + 1.0)), s = std::sqrt(std::max(0.0, 1.0 - c * c));
        const double z = c * wo.z + s * std::sqrt(wo.x * wo.x + wo.y * wo.y) * std::cos(2.0 * pi * u2);
        return z > 0.0 ? 2.0 * pi / (n + 1.0) * z / std::max(z, wo.z) : 0.0;
    }
    static Vec3 mirror(Vec3 w) { return {-w.x, -w.y, w.z}; }
};

struct Ward {
    double m;

    double evaluate(Vec3 wi, Vec3 wo) const {
        return gaussian(normalize(wi + wo)) / (4.0 * pi * m * m * std::sqrt(wi.z * wo.z));
    }
    Vec3 sample(Vec3 wo, double u1, double u2) const {
        const Vec3 h = normal(u1, u2);
        return 2.0 * dot(wo, h) * h - wo;
    }
    double pdf(Vec3 wi, Vec3 wo) const {
        const Vec3 h = normalize(wi + wo);
        return gaussian(h) / (pi * m * m * h.z * h.z * h.z) / (4.0 * dot(wo, h));
    }
    double weight(Vec3 wo, double u1, double u2) const {
        const Vec3 h = normal(u1, u2);
        const double d = dot(wo, h), z = 2.0 * d * h.z - wo.z;
        return z > 0.0 ? d * h.z * h.z * h.z * std::sqrt(z / wo.z) : 0.0;
    }
    double gaussian(Vec3 h) const {
        const double cos2 = h.z * h.z;
        return std::exp(-(1.0 - cos2) / (cos2 * m * m));
    }
    Vec3 normal(double u1, double u2) const {
        const double slope = m * std::sqrt(-std::log(1.0 - u1)), phi = 2.0 * pi * u2;
        const double c = 1.0 / std::sqrt(1.0 + slope * slope);
        return {slope * c * std::cos(phi), slope * c * std::sin(phi), c};
    }
};

template <bool reduced, class Random, class Model>
void estimate(const Model& model, uint64_t seed, int64_t samples, double mu, double* moments) {
    Random random(seed);
    const Vec3 wo{std::sqrt(1.0 - mu * mu), 0.0, mu};
    double sum = 0.0, squares = 0.0;
    for (int64_t i = 0; i < samples; ++i) {
        const double u1 = random(), u2 = random();
        double w = 0.0;
        if (reduced) {
            w = model.weight(wo, u1, u2);
        } else {
            const Vec3 wi = model.sample(wo, u1, u2);
            if (wi.z > 0.0) w = model.evaluate(wi, wo) * wi.z / model.pdf(wi, wo);
        }
        sum += w;
        squares += w * w;
    }
    moments[0] = sum;
    moments[1] = squares;
}

template <class Model>
void choose(const Model& model, int reduced, int fast, uint64_t seed, int64_t samples, double mu, double* moments) {
    if (reduced && fast) estimate<true, Xoshiro>(model, seed, samples, mu, moments);
    if (reduced && !fast) estimate<true, MersenneTwister>(model, seed, samples, mu, moments);
    if (!reduced && fast) estimate<false, Xoshiro>(model, seed, samples, mu, moments);
    if (!reduced && !fast) estimate<false, MersenneTwister>(model, seed, samples, mu, moments);
}

}  // namespace

extern "C" void stretched_phong(double n, int reduced, int fast, uint64_t seed, int64_t samples, double mu, double* moments) {
    choose(StretchedPhong{n}, reduced, fast, seed, samples, mu, moments);
}

extern "C" void ward(double m, int reduced, int fast, uint64_t seed, int64_t samples, double mu, double* moments) {
    choose(Ward{m}, reduced, fast, seed, samples, mu, moments);
}
