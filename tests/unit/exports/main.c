/* Drives an exported network along a sine, sets a number, goes back to a state, and prints the forces. */
#include <math.h>
#include <stdio.h>

#include "mount.h"

#define SAMPLES 400
#define STEP 1e-3

static mount_network network;
static double kept[MOUNT_STATE];

static double force_at(int k)
{
    const double phase = 60.0 * STEP * k;
    return mount_step(&network, 2e-3 * sin(phase), 0.12 * cos(phase), STEP);
}

int main(void)
{
    mount_init(&network, 4e-3);
    for (int k = 0; k < SAMPLES; ++k) {
        if (k == 200) {
            mount_get_state(&network, kept);
        }
        printf("%.17g\n", force_at(k));
    }
    mount_set_state(&network, kept);
    for (int k = 200; k < SAMPLES; ++k) {
        printf("%.17g\n", force_at(k));
    }
    if (mount_set(&network, "no.such", 1.0) || !mount_set(&network, "rubber.stiffness", 3e5)) {
        return 1;
    }
    mount_reset(&network);
    printf("%.17g\n", force_at(100));
    return mount_status(&network);
}
