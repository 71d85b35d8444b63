// Tire model 5 as somebody would write it by hand for speed: sixteen lanes side by side in the vectors of GCC and Clang,
// friction in closed form between reversals, relaxation exactly along the cubic path, what the motion alone decides
// computed before. The Wright omega function takes one start and one step of third order, good to about 1e-10.
#include <math.h>

typedef double vec __attribute__((vector_size(64), aligned(8)));
typedef long long bits __attribute__((vector_size(64)));
enum { LANES = 8, SIDE_BY_SIDE = 2, FRICTIONS = 3, RELAXATIONS = 3, TERMS = 4 };
#define ROUNDING 6755399441055744.0
#define EACH for (int g = 0; g < SIDE_BY_SIDE; g++)

static inline vec choose(bits where, vec yes, vec no) { return (vec)((where & (bits)yes) | (~where & (bits)no)); }
static inline vec all(double x) { return x - (vec){}; }

static inline vec two_to(vec x) {
    vec shifted = x + ROUNDING, f = x - (shifted - ROUNDING), y = all(1.0205905413765595e-07);
    y = y * f + 1.3215451631221434e-06;
    y = y * f + 1.5252672924850737e-05;
    y = y * f + 0.00015403530424776529;
    y = y * f + 0.0013333558200794592;
    y = y * f + 0.009618129107618665;
    y = y * f + 0.05550410866465167;
    y = y * f + 0.24022650695910075;
    y = y * f + 0.6931471805599462;
    y = y * f + 1.0;
    return (vec)((bits)y + ((bits)shifted << 52));
}

static inline vec omega(vec p) {
    vec low = choose(p < -8.0, all(-8.0), p), top, bottom;
    p = choose(p < -600.0, all(-600.0), p);
    top = low * 0.00011072075573655662 + 0.0017453797235457513;
    top = top * low + 0.033564115415736305;
    top = top * low + 0.08235211367797804;
    top = top * low + 0.7010005474163719;
    top = top * low - 0.8186519570288853;
    bottom = low * 1.4265236442888172e-05 + 0.0005511463825132435;
    bottom = bottom * low + 0.007771445050429686;
    bottom = bottom * low + 0.07218180668419655;
    bottom = bottom * low + 0.268335298843771;
    bottom = bottom * low + 1.0;
    vec start = top / bottom + (p - low) * 1.4426950408889634, y = two_to(start);
    vec b = 1.0 / (1.0 + y), m = ((p - start * 0.6931471805599453) - y) * b;
    return y * (1.0 + m * (1.0 + 0.5 * b * m));
}

// motion (samples, 5): way since the reversal, three weights of the cubic path, damping; static_force (samples,)
// strokes: first samples (strokes + 1,), sides (strokes,), whole ways (strokes,)
// numbers (lanes, 18): damping, then stiffness and limit of frictions and slider, then fading and three gains of each
// relaxation; error (lanes,) gathers the squared errors
void score(long strokes, const long *first, const double *sides, const double *ways, const double *motion,
           const double *static_force, const double *measured, const double *numbers, long stride, double sharpness,
           double *error) {
    vec damping[SIDE_BY_SIDE], pace[FRICTIONS][SIDE_BY_SIDE], limit[FRICTIONS + 1][SIDE_BY_SIDE];
    vec begin[FRICTIONS][SIDE_BY_SIDE], rate[SIDE_BY_SIDE], left[SIDE_BY_SIDE], sum[SIDE_BY_SIDE];
    vec gain[RELAXATIONS][TERMS][SIDE_BY_SIDE], force[RELAXATIONS][SIDE_BY_SIDE];
    EACH {
        const double *own = numbers + LANES * g;
#define ROW(n) (*(const vec *)(own + stride * (n)))
        damping[g] = ROW(0), left[g] = all(1.0), sum[g] = all(0.0);
        for (int i = 0; i < FRICTIONS; i++) {
            limit[i][g] = ROW(2 + 2 * i), pace[i][g] = sharpness * ROW(1 + 2 * i) / limit[i][g];
            begin[i][g] = all(sharpness + log(sharpness));
        }
        limit[FRICTIONS][g] = ROW(8), rate[g] = ROW(7) / ROW(8) * 1.4426950408889634;
        for (int i = 0; i < RELAXATIONS; i++) {
            force[i][g] = all(0.0);
            for (int j = 0; j < TERMS; j++) gain[i][j][g] = ROW(9 + TERMS * i + j);
        }
    }
    for (long s = 0; s < strokes; s++) {
        double side = sides[s];
        for (long k = first[s]; k < first[s + 1]; k++) {
            const double *x = motion + 5 * k;
            vec total[SIDE_BY_SIDE], y[FRICTIONS][SIDE_BY_SIDE];
            EACH total[g] = damping[g] * x[4] + (static_force[k] - measured[k]);
            for (int i = 0; i < FRICTIONS; i++) EACH y[i][g] = omega(begin[i][g] - pace[i][g] * x[0]);
            for (int i = 0; i < RELAXATIONS; i++) EACH {
                force[i][g] = gain[i][0][g] * force[i][g] + gain[i][1][g] * x[1] + gain[i][2][g] * x[2] + gain[i][3][g] * x[3];
                total[g] += force[i][g];
            }
            for (int i = 0; i < FRICTIONS; i++) EACH total[g] += side * limit[i][g] * (1.0 - y[i][g] * (1.0 / sharpness));
            EACH {
                vec fallen = rate[g] * -x[0];
                fallen = choose(fallen < -1000.0, all(-1000.0), fallen);
                total[g] += side * limit[FRICTIONS][g] * (1.0 - left[g] * two_to(fallen));
                sum[g] += total[g] * total[g];
            }
        }
        EACH {
            for (int i = 0; i < FRICTIONS; i++) {
                vec y = 2.0 * sharpness - omega(begin[i][g] - pace[i][g] * ways[s]);
                for (int l = 0; l < LANES; l++) begin[i][g][l] = y[l] + log(y[l]);
            }
            vec fallen = rate[g] * -ways[s];
            left[g] = 2.0 - left[g] * two_to(choose(fallen < -1000.0, all(-1000.0), fallen));
        }
    }
    EACH for (int l = 0; l < LANES; l++) error[LANES * g + l] = sum[g][l];
}
